"""What each function takes of a step on an emulated core: a plugin in QEMU counts (tools/profile/profile.c)."""

from __future__ import annotations

import tempfile
from collections import Counter
from collections.abc import Callable
from dataclasses import dataclass
from fnmatch import fnmatch
from functools import cache
from pathlib import Path

from elftools.elf.elffile import ELFFile

from . import engine
from .scene import Scene

# The stages of a step, in its order, with the files of src/ that make them. A file's functions that belong to another
# stage are named on their own.
STAGES: dict[str, tuple[str, ...]] = {
    "broad": ("world.c", "broad_pairs.c", "quadtree*", "cairn_bodies_look_ahead", "cairn_bodies_end_search",
              "set_extents"),
    "narrow": ("arbiter.c", "meet.c", "shape_*", "collide_*", "continuous.c", "driven.c", "contact.c"),
    "prepare": ("rows.c",),
    "sub-steps": ("solver_*", "sweep*", "landing.c", "block*", "bounce*.c", "spring*", "cairn_bodies_start",
                  "cairn_bodies_repeat", "cairn_body_limit_speed"),
    "finish": ("motion.c", "sleep.c"),
}  # fmt: skip
STEP = "cairn_world_step"
# The ports' interrupt handlers: neither part of a step nor its end.
INTERRUPTS = ("cairn_systick",)


@dataclass(frozen=True)
class Function:
    """A function of an image and where it comes from; no file where that is not told."""

    low: int
    high: int
    name: str
    file: str

    @property
    def kind(self) -> str:
        """What the plugin makes of it, see profile.c."""
        if self.name == STEP:
            return "step"
        if self.name in INTERRUPTS:
            return "aside"
        # The compiler's and the C library's own tell a file of their makers, or none.
        if not self.file or not Path(self.file).resolve().is_relative_to(engine.ROOT.resolve()):
            return "helper"
        return "engine" if Path(self.file).resolve().is_relative_to((engine.ROOT / "src").resolve()) else "outside"


@dataclass(frozen=True)
class Profile:
    """Mean instructions, or cycles, a step."""

    stages: dict[str, float]
    functions: dict[str, float]  # the dearest first


def measure(scene: Scene, core: str, first: int, last: int) -> Profile:
    """Runs a scene to its step `last` and counts from step `first`."""
    return _shares([(function, numbers[0]) for function, numbers in rows(scene, core, first, last)], last - first + 1)


def measure_cycles(scene: Scene, first: int, last: int) -> Profile:
    """The same in cycles of the RP2040, as rp2040js has them."""
    with tempfile.TemporaryDirectory(prefix="cairn-") as folder:
        image, table, counts = (Path(folder) / name for name in ("runner.elf", "map", "counts"))
        engine.build_image(scene, "rp2040", image)
        functions = _functions(image)
        table.write_text(_map(functions), encoding="utf-8")
        options = ["--map", str(table), "--out", str(counts), "--first", str(first), "--last", str(last)]
        engine.run_image(scene, "rp2040", image, engine.words_of(scene, last, 0), options)
        cycles = [int(line.split()[1]) for line in counts.read_text(encoding="utf-8").splitlines()]
    return _shares(list(zip(functions, cycles, strict=True)), last - first + 1)


def _shares(numbers: list[tuple[Function, int]], steps: int) -> Profile:
    stages: Counter[str] = Counter({name: 0 for name in STAGES})
    own: Counter[str] = Counter()
    for function, number in numbers:
        if number:
            stages[_stage(function)] += number / steps
            own[function.name] += number / steps
    return Profile(dict(stages), dict(own.most_common()))


def _map(functions: list[Function]) -> str:
    return "".join(f"{f.low:x} {f.high:x} {f.kind}\n" for f in functions)


def rows(
    scene: Scene, core: str, first: int, last: int, listing: Callable[[Path], list[str]] | None = None
) -> list[tuple[Function, list[int]]]:
    """The plugin's numbers of each function; by class too where a listing of the image's instructions is given."""
    plugin = engine.profiler()
    with tempfile.TemporaryDirectory(prefix="cairn-") as folder:
        image, counts, code = (Path(folder) / name for name in ("runner.elf", "counts", "code"))
        engine.build_image(scene, core, image)
        functions = _functions(image)
        table = Path(folder) / "map"
        table.write_text(_map(functions), encoding="utf-8")
        words = f"file={plugin},map={table},out={counts},first={first},last={last}"
        if listing is not None:
            code.write_text("\n".join(listing(image)) + "\n", encoding="utf-8")
            words += f",code={code}"
        engine.run_image(scene, core, image, engine.words_of(scene, last, 0), ["--qemu=-plugin", f"--qemu={words}"])
        lines = counts.read_text(encoding="utf-8").splitlines()
    return [(function, [int(word) for word in line.split()]) for function, line in zip(functions, lines, strict=True)]


def _stage(function: Function) -> str:
    file = Path(function.file).name
    by_name = (stage for stage, of in STAGES.items() if function.name in of)
    by_file = (stage for stage, of in STAGES.items() if any(fnmatch(file, pattern) for pattern in of))
    return next(by_name, None) or next(by_file, "finish")


def _functions(image: Path) -> list[Function]:
    """All functions of an image in the order of their addresses."""
    with image.open("rb") as binary:
        elf = ELFFile(binary)
        dwarf = elf.get_dwarf_info()
        ranges = dwarf.get_aranges()

        @cache
        def file_of(offset: int) -> str:
            unit = dwarf.get_CU_at(offset)
            return unit.get_top_DIE().get_full_path()

        found: dict[int, Function] = {}
        for symbol in elf.get_section_by_name(".symtab").iter_symbols():
            if symbol["st_info"]["type"] == "STT_FUNC" and symbol["st_size"]:
                low = symbol["st_value"] & ~1  # its lowest bit says that it is Thumb code
                offset = ranges.cu_offset_at_addr(low)
                file_name = "" if offset is None else file_of(offset)
                found[low] = Function(low, low + symbol["st_size"], symbol.name, file_name)
    return [found[low] for low in sorted(found)]
