"""How deep the stack of each of the engine's public functions can get, in any scene: by gcc's call graph.

`-fcallgraph-info=su` writes it beside the objects. A call through a pointer goes to what the classes of src/ put there:
POINTERS says it by the source line. The game's own callbacks are its own. A function that calls itself, in however
many steps, has no bound and is an error.
"""

from __future__ import annotations

import re
from collections import defaultdict
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from fnmatch import fnmatchcase
from functools import cache
from pathlib import Path

from . import engine

HEADERS = engine.ROOT / "include" / "cairn"
OUTSIDE = (
    32  # bytes of what the compiler calls of its own library, as memcpy() and products in 64 bits: 20 to 28 on an M0
)
COPY = re.compile(r"\.(part|isra|constprop|cold|lto_priv)\b.*")  # behind the name of a part or a copy
SHAPES = ("shape_circle", "shape_box", "shape_polygon")

# What stands on the line of the call, and the functions that it may reach: names, or FILE:NAME of static ones;
# * stands for any text.
POINTERS: tuple[tuple[str, tuple[str, ...]], ...] = (
    (r"->collide\[", tuple(f"cairn_collide_{pair}" for pair in ("circles", "circle_polygon", "boxes", "polygons"))),
    (r"kind->check\(", tuple(f"{file}:check" for file in SHAPES)),
    (r"kind->extents\(", ("shape_circle:extents", "shape_box:extents", "cairn_outline_extents")),
    (r"broad\(world\)->find_pairs\(", ("broad_pairs:find_pairs", "quadtree:find_pairs")),
    (r"solver\(world\)->solve\(", ("solver_soft:solve", "solver_small:solve")),
    *((rf"sleep\(world\)->{name}\(", (f"sleep:{name}",)) for name in ("wake", "settle", "disturb")),
    *((rf"continuous\(world\)->{name}\(", (f"continuous:{name}",)) for name in ("meet", "slide", "clip")),
    *((rf"continuous\(world\)->{name}\(", (f"cairn_arbiters_{name}",)) for name in ("hold_back", "land")),
    (r"bounce\(world\)->impact\(", ("bounce:impact_phase",)),
    (r"block\(world\)->kind->find\(", ("cairn_block_find",)),
    (r"block\(world\)->kind->release\(", ("cairn_block_release",)),
    *((rf"block\(world\)->kind->{name}\(", (f"block:{name}",)) for name in ("warm_start", "biased_pass", "relax_pass")),
    (r"\bpass\(world, world->block\)", ("block:warm_start_block", "block:biased_block", "block:relax_block")),
    (r"springs\(world\)->kind->prepare\(", ("cairn_springs_prepare",)),
    (r"springs\(world\)->kind->substep\(", ("cairn_springs_substep",)),
    *((rf"springs\(world\)->kind->{name}\(", (f"spring:{name}",))
      for name in ("joined", "remove_body", "link", "wake")),
    (r"mesh->kind->make\(", ("cairn_meshes_make",)),
    (r"mesh->kind->solve\(", ("spring_mesh:solve",)),
    (r"\bvisit\(world, spring->a", ("sleep:join",)),
    (r"\btest\(asked, &about", ("query:holds_point", "query:meets_box")),
    (r"\bkeep\(world, ", ("arbiter:is_current", "arbiter:is_of_others")),
    (r"\bquick\[", ("sweep_quick:warm_start_*", "sweep_quick:biased_*", "sweep_quick:relax_*")),
    (r"\brule\(pair, ", ("sweep_careful:biased", "sweep_careful:relaxed")),
    (r"\bcareful\(world, ", ("cairn_careful_warm_start", "cairn_careful_biased_pass", "cairn_careful_relax_pass")),
    (r"draw->\w+\(|\bvisit\(context", ()),  # the game's
)  # fmt: skip


@dataclass
class Graph:
    """Bytes of the functions' own frames, and what they call. Of an image not all that a pointer may reach is there."""

    whole: bool = True
    frames: dict[str, int] = field(default_factory=dict)
    calls: dict[str, set[str]] = field(default_factory=lambda: defaultdict(set))
    depths: dict[str, tuple[int, tuple[str, ...]]] = field(default_factory=dict)

    def depth(self, name: str, above: tuple[str, ...] = ()) -> tuple[int, tuple[str, ...]]:
        """Bytes of a call with all that it may call, and the deepest way."""
        if name in above:
            raise engine.EngineError("calls itself: " + " > ".join([*above[above.index(name) :], name]))
        if name not in self.depths:
            below = [self.depth(called, (*above, name)) for called in self._called(name)]
            most, way = max(below, default=(0, ()))
            own = self.frames.get(name, OUTSIDE)
            self.depths[name] = own + most, (f"{name.removeprefix('src/')} {own}", *way)
        return self.depths[name]

    def _called(self, name: str) -> set[str]:
        """What it calls; what an image has no frame of is folded into another copy of the same function, or outside."""
        called = self.calls.get(name, set())
        lost = {_base(copy) for copy in called if copy not in self.frames}
        if self.whole or not lost:
            return called
        return called | {frame for frame in self.frames if _base(frame) in lost}

    def named(self, name: str) -> list[str]:
        """The functions that a name of POINTERS stands for: a compiler may have made parts or copies of one."""
        file, _, own = name.rpartition(":")
        wanted = f"{file}.c:{own}" if file else own
        found = [title for title in self.frames if fnmatchcase(_base(title), wanted)]
        if not found and self.whole:
            raise engine.EngineError(f"the engine has no {name}, which tools/cairn_tools/call_graph.py names")
        return found


def _base(title: str) -> str:
    """Without folder, and what a part or a copy has behind its name."""
    return COPY.sub("", title.rpartition("/")[2])


def read(files: Iterable[Path]) -> Graph:
    """The graph of all translation units."""
    return _graph((path.read_text(encoding="utf-8") for path in files), Graph())


def image_depth(image: Path) -> int:
    """Bytes of stack that main() of an image can take, linked with -flto and -fcallgraph-info=su."""
    texts = [path.read_text(encoding="utf-8") for path in sorted(image.parent.glob(f"{image.name}.ltrans*.ci"))]
    graph = _graph(map(_as_if_compiled_alone, texts), Graph(whole=False))
    if "main" not in graph.frames:
        raise engine.EngineError(f"{image} has no call graph: it takes gcc 10 or later")
    return graph.depth("main")[0]


def _as_if_compiled_alone(text: str) -> str:
    """Titles by the source file, which linking with -flto replaces by that of its own object."""
    for title, file in re.findall(r'node: \{ title: "([^"]+)" label: "[^"\\]*\\n([^"]+?):\d+:\d+(?:\\n|")', text):
        own = title.rpartition(":")[2]
        shared = own.startswith("cairn_") or own == "main"
        text = text.replace(f'"{title}"', f'"{own}"' if shared else f'"{file}:{own}"')
    text = re.sub(r'"[^"\s]+\.o:(cairn_[^"]+)"', r'"\1"', text)
    return text


def _graph(texts: Iterable[str], graph: Graph) -> Graph:
    pointers = []
    for text in texts:
        for title, size in re.findall(r'node: \{ title: "([^"]+)" label: "[^"]*?\\n(\d+) bytes', text):
            graph.frames[_short(title)] = int(size)
        for source, target, place in re.findall(
            r'edge: \{ sourcename: "([^"]+)" targetname: "([^"]+)"(?: label: "([^"]+)")?', text
        ):
            if target == "__indirect_call":
                pointers.append((_short(source), place))
            else:
                graph.calls[_short(source)].add(_short(target))
    for source, place in pointers:
        graph.calls[source].update(title for name in _reached(place) for title in graph.named(name))
    return graph


def _short(title: str) -> str:
    return title.replace(f"{engine.ROOT}/", "")


def _reached(place: str) -> tuple[str, ...]:
    line = _line(place)
    for pattern, names in POINTERS:
        if re.search(pattern, line):
            return names
    raise engine.EngineError(
        f"{place}: a call through a pointer that tools/cairn_tools/call_graph.py does not know: {line.strip()}"
    )


def _line(place: str) -> str:
    file, number, _ = place.rsplit(":", 2)
    return _lines(engine.ROOT / file)[int(number) - 1]


@cache
def _lines(path: Path) -> list[str]:
    return path.read_text(encoding="utf-8").splitlines()


def public_functions() -> Iterator[str]:
    """What the headers declare and do not define."""
    for header in sorted(HEADERS.glob("*.h")):
        if not header.name.startswith("arith"):
            yield from re.findall(
                r"^(?!static|typedef|#|\s)[\w\s\*]*?\b(cairn_\w+)\([^;{]*\);", header.read_text(encoding="utf-8"), re.M
            )


def depths(preset: str) -> dict[str, tuple[int, tuple[str, ...]]]:
    """Of each public function: bytes and the deepest way. The library of the preset must be built."""
    folder = engine.BUILDS / preset / "CMakeFiles" / "cairn.dir" / "src"
    graph = read(sorted(folder.glob("*.ci")))
    if not graph.frames:
        raise engine.EngineError(f"{folder} has no call graph: it takes gcc 10 or later")
    return {name: graph.depth(name) for name in public_functions() if name in graph.frames}
