"""What a world takes of RAM on a core: the engine's types, the world of pyramid10, and the stack of the step."""

from __future__ import annotations

import json
import re
import tempfile
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from elftools.dwarf.die import DIE
from elftools.elf.elffile import ELFFile

from . import call_graph, engine, scene

CORES = ("m0", "m3")
STEPS = 120
FILE = engine.ROOT / "tests" / "bench" / "memory.json"
FOLDER = engine.ROOT / "build" / "memory"
RAM = 0x20000000  # where a Cortex-M's lies; constants lie below
# The types whose sizes are told; issue 4 sets goals for some of them, in bytes.
TYPES = ("body", "arbiter", "spring", "world", "quadtree", "quadtree_cell", "quadtree_entry", "quadtree_box", "block")
GOALS = {"a body": 72, "an arbiter": 80, "pyramid10's world with its tree": 14 * 1024}
STACK_GOAL = 1024
STEP = "cairn_world_step"
# The calls of a game's loop and of its set-up that go deepest, of which the table tells; the others are in one row.
CALLS = (
    STEP, "cairn_query_ray", "cairn_query_ray_all", "cairn_query_point", "cairn_query_box", "cairn_debug_draw_bodies",
    "cairn_debug_draw_contacts", "cairn_debug_draw_cells", "cairn_debug_draw_springs", "cairn_world_next_contact",
    "cairn_body_create", "cairn_body_destroy", "cairn_body_set_model", "cairn_body_set_transform",
    "cairn_body_apply_impulse_at", "cairn_spring_create", "cairn_spring_tune", "cairn_world_set_rate",
    "cairn_world_init_with", "cairn_polygon_init", "cairn_polygon_init_regular", "cairn_polygon_init_hull",
)  # fmt: skip
WORLD = "pyramid10"

Say = Callable[[str], None]
Change = Callable[[scene.Scene], scene.Scene]


@dataclass(frozen=True)
class Row:
    """Bytes of something on a core."""

    kind: str  # "size"; "stack", of steps of a scene; or "call", at most and in any scene
    name: str
    core: str
    bytes: int
    goal: int | None = None

    @property
    def verdict(self) -> str:
        if self.goal is None:
            return "-"
        return "ok" if self.bytes <= self.goal else f"{self.bytes - self.goal:,} over"


# ---- scenes: each takes another way through the step ----

POLYGON = {"regular": {"sides": 8, "radius": 0.5}}
GROUND = {"type": "static", "shape": "ground", "position": [0, -0.5]}
SHAPES = {"ground": {"box": [60, 1]}, "octagon": POLYGON, "box": {"box": [1, 1]}, "ball": {"circle": 0.3}}


def _shots() -> dict[str, Any]:
    """Fast polygons, boxes and balls along and down into columns of polygons, by the quadtree."""
    columns = [{"shape": "octagon", "position": [x, 0.5 + y]} for x in range(6, 27, 4) for y in range(4)]
    along = [
        {"shape": shape, "position": [-6 - 3 * i, 0.8 + 0.6 * i], "velocity": [200, 0]}
        for i, shape in enumerate(("octagon", "box", "octagon", "ball", "octagon"))
    ]
    down = [
        {"shape": "octagon", "position": [x + 0.05 * x - 0.5, 8 + x], "velocity": [0, -40 - 8 * x]}
        for x in range(6, 27, 4)
    ]
    return {"shapes": SHAPES, "bodies": [GROUND, *columns, *along, *down], "broad_phase": "quadtree"}


def _heavy() -> dict[str, Any]:
    """Columns of heavy polygons on light ones, shot at, that bounce, by the quadtree, with sleep."""
    columns = [
        {"shape": "octagon", "position": [x, 0.5 + 1.01 * y], "density": 1 if y < 2 else 100}
        for x in (0, 3, 6)
        for y in range(4)
    ]
    shot = {"shape": "octagon", "position": [-8, 1.4], "velocity": [200, 0], "density": 100}
    jelly = {"default": {"static_friction": 0.5, "kinetic_friction": 0.4, "restitution": 0.5}}
    return {"shapes": SHAPES, "materials": jelly, "bodies": [GROUND, *columns, shot], "broad_phase": "quadtree",
            "sleep": True}  # fmt: skip


MADE = {"shots": _shots, "heavy": _heavy}
CHANGES: dict[str, Change] = {
    "quadtree": lambda loaded: _changed(loaded, broad_phase="quadtree"),
    "sleep": lambda loaded: _changed(loaded, sleep=True),
    "slides": lambda loaded: replace(loaded, solver="slides"),
    "small": lambda loaded: replace(loaded, solver="small"),
}
# A scene's name and, behind a blank, what is changed in it.
SCENES = ("pyramid10", "pyramid10 quadtree", "pyramid10 sleep", "pyramid10 slides", "pyramid10 small", "circles100",
          "mixed50", "mixed50 quadtree", "curtain150", "bridge", "balls50", "heavy100", "shots", "heavy")  # fmt: skip


def load(name: str) -> scene.Scene:
    """One of SCENES."""
    base, _, change = name.partition(" ")
    made = MADE[base]() if base in MADE else None
    loaded = _written(base, made) if made else scene.load(scene.find(base))
    return CHANGES[change](loaded) if change else loaded


def _changed(loaded: scene.Scene, **fields: Any) -> scene.Scene:
    """The same scene from a file with other fields: the engine reads those from the file."""
    data = json.loads(loaded.path.read_text(encoding="utf-8-sig"))
    return _written("-".join([loaded.name, *fields]), {**data, **fields})


def _written(name: str, data: dict[str, Any]) -> scene.Scene:
    FOLDER.mkdir(parents=True, exist_ok=True)
    path = FOLDER / f"{name}.json"
    path.write_text(json.dumps({**data, "cairn_scene": 1, "name": name}), encoding="utf-8")
    return scene.load(path)


# ---- measuring ----


def measure(cores: Iterable[str], names: Iterable[str], say: Say) -> list[Row]:
    """Sizes and stacks, core by core."""
    rows = []
    for core in cores:
        say(f"the world of {WORLD} on {core}")
        rows += _sizes(core)
        stacks = []
        for name in names:
            say(f"the stack of {name} on {core}")
            got = engine.run(load(name), "q16", core, STEPS, 0)
            stacks.append(Row("stack", name, core, got.stack - got.stack_before, STACK_GOAL))
        worst = max((row.bytes for row in stacks), default=0)
        if stacks:
            bounds = _bounds(core)
            rows += [*stacks, Row("stack", "the worst", core, worst, STACK_GOAL), *bounds]
            if worst > bounds[0].bytes:
                most = bounds[0].bytes
                raise engine.EngineError(f"{core}: a step took {worst} bytes, by the call graph {most} at most")
    return rows


def _bounds(core: str) -> list[Row]:
    """The deepest that each call can get. The core's library has been built for the stacks."""
    depths = {name: size for name, (size, _) in call_graph.depths(engine.CORES[core].preset).items()}
    others = max(size for name, size in depths.items() if name not in CALLS)
    named = [*((name, depths[name]) for name in CALLS), ("any other", others)]
    return [Row("call", name, core, size, STACK_GOAL) for name, size in named]


def _sizes(core: str) -> list[Row]:
    """The types, from DWARF; and the world, linked with pools that just suffice: it must end in the same state."""
    loaded = load(f"{WORLD} quadtree")
    roomy = engine.run(loaded, "q16", core, 2 * STEPS, 0)
    most = roomy.statistics
    bodies = len(loaded.bodies)
    pools = {"CAIRN_WORLD(world": (bodies, most["most_arbiters"]),
             "CAIRN_QUADTREE(world_quadtree": (bodies, most["most_tree_cells"], most["most_tree_entries"])}  # fmt: skip
    with tempfile.TemporaryDirectory(prefix="cairn-") as folder:
        image = Path(folder) / "runner.elf"
        engine.build_image(loaded, core, image, lambda text: cut(text, pools))
        tight = engine.run_built(loaded, core, image, 2 * STEPS, 0)
        if tight.hash != roomy.hash or tight.statistics["dropped_contacts"]:
            raise engine.EngineError(f"{WORLD} on {core}: does not do the same with {pools}")
        types, world = type_sizes(image), sum(pool_sizes(image).values())
    named = {_with_article(name): types[f"cairn_{name}"] for name in TYPES}
    named[f"{WORLD}'s world with its tree"] = world
    return [Row("size", name, core, size, GOALS.get(name)) for name, size in named.items()]


def _with_article(name: str) -> str:
    words = name.replace("_", " ")
    return f"{'an' if words[0] in 'aeiou' else 'a'} {words}"


def cut(table: str, pools: dict[str, tuple[int, ...]]) -> str:
    """A scene's table with other sizes of its pools, by the macro and its first argument."""
    for start, sizes in pools.items():
        tight = f"{', '.join([start, *map(str, sizes)])})"
        table, count = re.subn(re.escape(start) + r", \d+" * len(sizes) + r"\)", tight, table)
        if count != 1:
            raise engine.EngineError(f"the table has no {start}")
    return table


def pool_sizes(image: Path) -> dict[str, int]:
    """The variables that CAIRN_WORLD, CAIRN_QUADTREE and CAIRN_SPRINGS declare in a scene's table."""
    with image.open("rb") as binary:
        symbols = ELFFile(binary).get_section_by_name(".symtab").iter_symbols()
        return {s.name: s["st_size"] for s in symbols
                if s.name.startswith("world_") and s["st_info"]["type"] == "STT_OBJECT"
                and s["st_value"] >= RAM}  # fmt: skip


def type_sizes(image: Path, names: Iterable[str] | None = None) -> dict[str, int]:
    """Bytes of the engine's types by name; by default of TYPES."""
    wanted = {f"cairn_{name}" for name in names or TYPES}
    found: dict[str, int] = {}
    with image.open("rb") as binary:
        for name, die in _typedefs(ELFFile(binary)):
            if name in wanted - found.keys():
                target = _target(die)
                if "DW_AT_byte_size" in target.attributes:
                    found[name] = target.attributes["DW_AT_byte_size"].value
            if len(found) == len(wanted):
                return found
    raise engine.EngineError(f"the image does not tell the size of {', '.join(sorted(wanted - found.keys()))}")


def _target(die: DIE) -> DIE:
    """What a name stands for in the end."""
    while die.tag == "DW_TAG_typedef":
        die = die.get_DIE_from_attribute("DW_AT_type")
    return die


def _typedefs(elf: Any) -> Iterator[tuple[str, DIE]]:
    for unit in elf.get_dwarf_info().iter_CUs():
        for die in unit.get_top_DIE().iter_children():
            if die.tag == "DW_TAG_typedef" and "DW_AT_type" in die.attributes:
                yield die.attributes["DW_AT_name"].value.decode(), die


# ---- the record ----


def write(rows: Iterable[Row]) -> None:
    record: dict[str, dict[str, dict[str, int]]] = {}
    for row in rows:
        record.setdefault(row.core, {}).setdefault(row.kind, {})[row.name] = row.bytes
    FILE.parent.mkdir(exist_ok=True)
    FILE.write_text(json.dumps(record, indent=1) + "\n", encoding="utf-8")


def troubles(rows: Iterable[Row]) -> Iterator[str]:
    """What takes more than the record allows."""
    record = json.loads(FILE.read_text(encoding="utf-8"))
    for row in rows:
        kept = record.get(row.core, {}).get(row.kind, {}).get(row.name)
        if kept is None:
            yield f"{row.kind} of {row.name} on {row.core}: not on record"
        elif row.bytes > kept:
            yield f"{row.kind} of {row.name} on {row.core}: {row.bytes:,} bytes, on record {kept:,}"
