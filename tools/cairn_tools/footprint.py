"""Flash and RAM of feature sets on a core: tiny games (tools/footprint) at -Os, minus the same image without Cairn."""

from __future__ import annotations

import json
import subprocess
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from elftools.elf.elffile import ELFFile
from elftools.elf.sections import SymbolTableSection

from . import engine

# A toolchain file of cmake/ for each core.
CORES = ("m0", "m3", "m4f")
FILE = engine.ROOT / "tests" / "bench" / "footprint.json"
PROJECT = engine.ROOT / "tools" / "footprint"
ADDR2LINE = "arm-none-eabi-addr2line"
FLAGS = "-Os -g -flto"
RISE = 0.02  # more than this needs a new record
WRITES, RUNS, TAKES_ROOM = 1, 4, 2  # SHF_WRITE, SHF_EXECINSTR, SHF_ALLOC


@dataclass(frozen=True)
class FeatureSet:
    """A tiny game: its capacities, the features it calls, and issue 6's goals in bytes."""

    name: str
    what: str
    features: tuple[str, ...]
    bodies: int = 32
    arbiters: int = 64
    flash_goal: int | None = None
    ram_goal: int | None = None


BASE = ("BALLS", "WALLS", "BOXES")
SHAPES = (*BASE, "POLYGONS", "RESTITUTION")
# What each adds to balls, walls and boxes, and the files of src/ that no game without it may contain.
FEATURES = {
    "POLYGONS": ("polygons", ("shape_polygon", "collide_polygon")),
    "HULLS": ("polygons from points", ()),
    "RESTITUTION": ("restitution", ("bounce", "bounce_meet", "bounce_strike")),
    "CONTINUOUS": ("continuous collision", ("continuous",)),
    "SLEEP": ("sleep", ("sleep",)),
    "QUADTREE": ("the quadtree", ("quadtree", "quadtree_walk")),
    "SPRINGS": ("springs", ("spring", "spring_map", "spring_ends", "spring_network", "spring_path", "spring_quick",
                            "spring_reach", "spring_solve")),
    "BLOCKS": ("blocks", ("block", "block_find", "block_solve")),
    "CONTACTS": ("reading contacts", ("contact",)),
    "FORCES": ("forces and impulses", ("body_force",)),
    "CHANGES": ("changing and destroying bodies", ()),
    "QUERIES": ("queries", ("query",)),
    "DRAWING": ("debug drawing", ("debug_draw",)),
    "HASH": ("the hash", ("hash",)),
    "MESHES": ("springs with meshes", ("spring_mesh",)),
    "SLIDES": ("the slides' solver instead", ("solver_slides",)),
    # Of the games that all others build on:
    "WALLS": ("walls", ("collide_circle_polygon", "shape_box", "collide_box")),
    "BOXES": ("boxes", ()),
}  # fmt: skip
NEEDS = {"MESHES": ("SPRINGS",), "HULLS": ("POLYGONS",)}
BROUGHT = {"SLEEP": ("quadtree_walk",)}  # files that a feature shares with another one
EVERYTHING = (*SHAPES, *(name for name in FEATURES if name not in (*SHAPES, "SLIDES")))
SETS = (
    FeatureSet("none", "an image without Cairn", ("NOTHING",)),
    FeatureSet("balls", "balls only", ("BALLS",), 16, 16),
    FeatureSet("balls_walls", "balls and walls", ("BALLS", "WALLS"), 16, 16, 5 * 1024, 2560),
    FeatureSet("shapes", "and boxes, polygons, friction, restitution", SHAPES, 32, 64, 10 * 1024, 8 * 1024),
    FeatureSet("everything", "everything in the library", EVERYTHING, 32, 64, 20 * 1024),
    FeatureSet("base", "balls, walls and boxes", BASE),
    *(FeatureSet(name.lower(), f"+ {what}", (*BASE, *NEEDS.get(name, ()), name))
      for name, (what, _) in FEATURES.items() if name not in BASE),
)  # fmt: skip

Say = Callable[[str], None]


@dataclass(frozen=True)
class Row:
    """Bytes of a feature set on a core, beyond the image without Cairn."""

    core: str
    name: str
    what: str
    flash: int  # code and constants
    ram: int  # variables: the world's pools
    added: int | None  # flash beyond that of balls, walls and boxes, for what is added to them
    flash_goal: int | None
    ram_goal: int | None


def measure(cores: tuple[str, ...], say: Say) -> list[Row]:
    """All sets, core by core."""
    rows: list[Row] = []
    for core in cores:
        say(f"feature sets on {core}")
        sized = {name: sizes(image) for name, image in build(core).items()}
        bare = sized["none"]
        for entry in SETS[1:]:
            flash, ram = (size - without for size, without in zip(sized[entry.name], bare, strict=True))
            added = sized[entry.name][0] - sized["base"][0] if entry.what.startswith("+") else None
            goals = (entry.flash_goal, entry.ram_goal) if core == "m0" else (None, None)
            rows.append(Row(core, entry.name, entry.what, flash, ram, added, *goals))
    return rows


def build(core: str) -> dict[str, Path]:
    """The images by the sets' names."""
    folder = engine.BUILDS / f"footprint-{core}"
    sets = ";".join(f"{e.name}:{e.bodies}:{e.arbiters}:{','.join(e.features)}" for e in SETS)
    toolchain = engine.ROOT / "cmake" / f"toolchain-{core}.cmake"
    with engine.lock(f"footprint-{core}"):
        engine.check_build(engine.cmake("-S", str(PROJECT), "-B", str(folder), "-G", "Ninja", f"-DSETS={sets}",
                                        f"-DCMAKE_TOOLCHAIN_FILE={toolchain}", "-DCMAKE_BUILD_TYPE=RelWithDebInfo",
                                        f"-DCMAKE_C_FLAGS_RELWITHDEBINFO={FLAGS}"))  # fmt: skip
        engine.check_build(engine.cmake("--build", str(folder)))
    return {entry.name: folder / entry.name for entry in SETS}


def sizes(image: Path) -> tuple[int, int]:
    """Flash and RAM, without the stack: initialised variables are in both."""
    flash = ram = 0
    with image.open("rb") as binary:
        for section in ELFFile(binary).iter_sections():
            if section["sh_flags"] & TAKES_ROOM and section.name != ".stack":
                flash += section["sh_size"] if section["sh_type"] != "SHT_NOBITS" else 0
                ram += section["sh_size"] if section["sh_flags"] & WRITES else 0
    return flash, ram


def functions(image: Path) -> dict[str, str]:
    """The engine's functions in an image, and the file of src/ or include/ that each is of."""
    with image.open("rb") as binary:
        table = ELFFile(binary).get_section_by_name(".symtab")
        assert isinstance(table, SymbolTableSection)
        found = [s for s in table.iter_symbols() if s["st_info"]["type"] == "STT_FUNC" and s["st_value"]]
    asked = "\n".join(hex(symbol["st_value"] & ~1) for symbol in found)
    told = subprocess.run([ADDR2LINE, "-e", str(image)], input=asked, capture_output=True, text=True, check=True).stdout
    places = (Path(line.rpartition(":")[0]).resolve() for line in told.splitlines())
    ours = (engine.ROOT / "src", engine.ROOT / "include")
    return {symbol.name.split(".")[0]: place.name for symbol, place in zip(found, places, strict=True)
            if any(place.is_relative_to(folder) for folder in ours)}  # fmt: skip


def strangers(entry: FeatureSet, found: dict[str, str]) -> list[str]:
    """The functions of features that a game does not use."""
    foreign = {f"{file}.c" for name, (_, files) in FEATURES.items() if name not in entry.features for file in files}
    foreign -= {f"{file}.c" for name in entry.features for file in BROUGHT.get(name, ())}
    return sorted(name for name, file in found.items() if file in foreign)


# ---- the record ----


def write(rows: list[Row]) -> None:
    """Sizes, and by feature set the engine's public and shared functions of the first core."""
    record: dict[str, Any] = {}
    for row in rows:
        record.setdefault(row.core, {})[row.name] = {"flash": row.flash, "ram": row.ram}
    images = build(CORES[0])
    record["functions"] = {entry.name: _shared(images[entry.name]) for entry in SETS[1:]}
    FILE.write_text(json.dumps(record, indent=1) + "\n", encoding="utf-8")


def troubles(rows: list[Row]) -> Iterator[str]:
    """What changed by more than the record allows, a gain too; and what is in an image that it does not need."""
    record = json.loads(FILE.read_text(encoding="utf-8"))
    for row in rows:
        kept = record.get(row.core, {}).get(row.name)
        if kept is None:
            yield f"{row.name} on {row.core}: not on record"
            continue
        for what, now in (("flash", row.flash), ("ram", row.ram)):
            if abs(now - kept[what]) > RISE * kept[what]:
                yield f"{row.name} on {row.core}: {now:,} bytes of {what}, on record {kept[what]:,}"
    images = build(CORES[0])
    for entry in SETS[1:]:
        for name in strangers(entry, functions(images[entry.name])):
            yield f"{entry.name}: contains {name}, of a feature that it does not use"
        for name in sorted(set(_shared(images[entry.name])) - set(record["functions"].get(entry.name, ()))):
            yield f"{entry.name}: contains {name}, not on record"


def _shared(image: Path) -> list[str]:
    """The functions that the engine's files share; the others the compiler may split and merge as it likes."""
    return sorted(name for name in functions(image) if name.startswith("cairn_"))
