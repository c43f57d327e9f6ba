"""Flash, RAM and stack of feature sets: tiny games (tools/footprint) at -Os, minus the same image without Cairn."""

from __future__ import annotations

import re
import shutil
import subprocess
from collections import Counter
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from pathlib import Path

from elftools.elf.elffile import ELFFile
from elftools.elf.sections import Symbol, SymbolTableSection

from . import call_graph, engine, memory
from .errors import UserError

# A toolchain file of cmake/ for each core, and what tools/setup installs by default.
CORES = ("m0", "m3", "m4f", "rv32")
DEFAULT_CORES = CORES[:3]
COMPILERS = {"rv32": "riscv64-unknown-elf-gcc"}
SOURCES = engine.ROOT / "src"
PROJECT = engine.ROOT / "tools" / "footprint"
ADDR2LINE = "arm-none-eabi-addr2line"
FLAGS = "-Os -g -flto"
TYPES = ("world", "body", "arbiter", "spring_pool", "spring", "quadtree", "quadtree_box", "quadtree_cell",
         "quadtree_entry", "block", "mesh", "mesh_part", "mesh_node", "mesh_row", "mesh_link", "share")  # fmt: skip
WRITES, RUNS, TAKES_ROOM = 1, 4, 2  # SHF_WRITE, SHF_EXECINSTR, SHF_ALLOC


@dataclass(frozen=True)
class FeatureSet:
    """A tiny game: its capacities, the features it calls, issue 6's goals in bytes, and options of config.h."""

    name: str
    what: str
    features: tuple[str, ...]
    bodies: int = 32
    arbiters: int = 64
    flash_goal: int | None = None
    ram_goal: int | None = None
    options: tuple[str, ...] = ()


BASE = ("BALLS", "WALLS", "BOXES")
SHAPES = (*BASE, "POLYGONS", "RESTITUTION")


@dataclass(frozen=True)
class Feature:
    """What it is; the files of src/ that no game without it may contain, and functions of other files."""

    what: str
    files: tuple[str, ...] = ()
    functions: tuple[str, ...] = ()


FEATURES = {
    "POLYGONS": Feature("polygons", ("shape_polygon", "collide_circle_polygon", "collide_polygon", "polygon_init")),
    "HULLS": Feature("polygons from points", (), ("cairn_polygon_init", "cairn_polygon_init_hull")),
    "RESTITUTION": Feature("restitution", ("bounce", "bounce_meet", "bounce_strike")),
    "CONTINUOUS": Feature("continuous collision", ("continuous", "driven", "landing")),
    "SLEEP": Feature("sleep", ("sleep",)),
    "QUADTREE": Feature("the quadtree", ("quadtree", "quadtree_walk")),
    "SPRINGS": Feature("springs", ("spring", "spring_map", "spring_ends", "spring_network", "spring_path",
                                   "spring_quick", "spring_reach", "spring_solve")),
    "BLOCKS": Feature("blocks", ("block", "block_find", "block_solve")),
    "CONTACTS": Feature("reading contacts", ("contact",)),
    "FORCES": Feature("forces and impulses", ("body_force",)),
    "CHANGES": Feature("changing and destroying bodies", (), (
        "cairn_body_set_velocity", "cairn_body_set_angular_velocity", "cairn_body_set_transform",
        "cairn_body_set_model", "cairn_body_destroy", "cairn_world_set_rate")),
    "QUERIES": Feature("queries", ("query",)),
    "DRAWING": Feature("debug drawing", ("debug_draw",)),
    "HASH": Feature("the hash", ("hash",)),
    "MESHES": Feature("springs with meshes", ("spring_mesh", "spring_mesh_make")),
    "SLIDES": Feature("the slides' solver instead", ("solver_small",)),
    "SMALL": Feature("the small solver instead", ("solver_small",)),
    # Of the games that all others build on:
    "BALLS": Feature("balls", ("shape_circle",)),
    "WALLS": Feature("walls", ("collide_circle_box", "shape_box", "collide_box")),
    "BOXES": Feature("boxes"),
}  # fmt: skip
# The soft solver and what corrects its motion; a build without it has none of these, nor the bounces of FEATURES.
SOFT_FILES = ("hold", "idle", "slide", "solver_soft", "sweep", "sweep_careful", "sweep_quick")
WITHOUT_SOFT = "CAIRN_WITH_SOFT_SOLVER=0"
# What the step is made of, and what any game may call.
CORE_FILES = (*SOFT_FILES, "arbiter", "arith_fixed", "body", "body_state", "broad_pairs", "material", "meet", "motion",
              "rows", "shape_measure", "world")  # fmt: skip
NEEDS = {"MESHES": ("SPRINGS",), "HULLS": ("POLYGONS",)}
# Files that a feature shares with another one; at -Os boxes collide as any polygon does.
BROUGHT = {"SLEEP": ("quadtree_walk",), "DRAWING": ("contact",), "WALLS": ("collide_circle_polygon", "collide_polygon"),
           "SLIDES": ("solver_small",), "SMALL": ("solver_small",)}  # fmt: skip
# The smallest of what these games can be told to take: whatever config.h can leave out.
ANY_LEAN = tuple(f"CAIRN_WITH_{name}=0" for name in (
    "SPRINGS", "CONTINUOUS", "BLOCKS", "SLEEP", "QUADTREE", "SLIDES_SOLVER", "FIXED_POSITION", "SENSORS", "DAMPING",
    "SHORTCUTS", "HOLD", "SETTINGS", "SORT", "GRAVITY_SCALE"))  # fmt: skip
LEAN = (*ANY_LEAN, "CAIRN_WITH_SMALL_SOLVER=0")
LEAN_SMALL = (*ANY_LEAN, WITHOUT_SOFT, "CAIRN_WITH_GIANTS=0")
ROUND = ("CAIRN_WITH_BOUNCE=0", "CAIRN_MAX_POINTS=1", "CAIRN_WITH_POLYGONS=0")
LEAN_BALLS = (*LEAN, *ROUND)
LEAST = (*LEAN_BALLS, *(f"CAIRN_WITH_{name}=0" for name in ("FRICTION", "TURNING", "SLOPES", "MASSES", "GIANTS")))
EVERYTHING = (*SHAPES, *(name for name in FEATURES if name not in (*SHAPES, "SLIDES", "SMALL")))
SMALL_EVERYTHING = (*(name for name in EVERYTHING if name != "BLOCKS"), "SMALL")
SETS = (
    FeatureSet("none", "an image without Cairn", ("NOTHING",)),
    FeatureSet("balls", "balls only", ("BALLS",), 16, 16),
    FeatureSet("balls_walls", "balls and walls", ("BALLS", "WALLS"), 16, 16, 5 * 1024, 2560),
    FeatureSet("balls_walls_lean", "balls and walls, by options", ("BALLS", "WALLS"), 16, 16, 5 * 1024, 2560,
               LEAN_BALLS),
    FeatureSet("balls_walls_least", "balls of one kind that slide, upright walls, by options", ("BALLS", "WALLS"),
               16, 16, 5 * 1024, 2560, LEAST),
    FeatureSet("balls_walls_small", "balls and walls, the small solver alone, by options", ("BALLS", "WALLS", "SMALL"),
               16, 16, 5 * 1024, 2560, (*LEAN_SMALL, *ROUND)),
    FeatureSet("boxes", "boxes only", ("WALLS", "BOXES"), 16, 16),
    FeatureSet("boxes_springs", "boxes and springs", ("WALLS", "BOXES", "SPRINGS"), 16, 16),
    FeatureSet("shapes", "balls, boxes, polygons, friction, restitution", SHAPES, 32, 64, 10 * 1024, 8 * 1024),
    FeatureSet("shapes_lean", "the same, by options", SHAPES, 32, 64, 10 * 1024, 8 * 1024, LEAN),
    FeatureSet("shapes_small", "the same with the small solver alone, by options", (*SHAPES, "SMALL"), 32, 64,
               10 * 1024, 8 * 1024, LEAN_SMALL),
    FeatureSet("everything", "everything in the library", EVERYTHING, 32, 64, 20 * 1024),
    FeatureSet("everything_small", "the same but blocks, with the small solver alone, by an option", SMALL_EVERYTHING,
               32, 64, 20 * 1024, options=(WITHOUT_SOFT,)),
    FeatureSet("base", "balls, walls and boxes", BASE),
    *(FeatureSet(name.lower(), f"+ {feature.what}", (*BASE, *NEEDS.get(name, ()), name))
      for name, feature in FEATURES.items() if name not in BASE),
)  # fmt: skip

Say = Callable[[str], None]


@dataclass(frozen=True)
class Row:
    """Bytes of a feature set on a core, beyond the image without Cairn."""

    core: str
    name: str
    what: str
    flash: int  # code and constants
    constants: int
    ram: int  # variables: the world's pools
    stack: int  # at most, of main() and all that it calls
    added: int | None  # flash beyond that of balls, walls and boxes, for what is added to them
    flash_goal: int | None
    ram_goal: int | None


def measure(cores: tuple[str, ...], say: Say) -> list[Row]:
    """All sets, core by core."""
    rows: list[Row] = []
    for core in cores:
        say(f"feature sets on {core}")
        images = build(core)
        sized = {name: sizes(image) for name, image in images.items()}
        bare = sized["none"]
        for entry in SETS[1:]:
            flash, ram = (size - without for size, without in zip(sized[entry.name], bare, strict=True))
            added = sized[entry.name][0] - sized["base"][0] if entry.what.startswith("+") else None
            goals = (entry.flash_goal, entry.ram_goal) if core == "m0" else (None, None)
            image = images[entry.name]
            rows.append(Row(core, entry.name, entry.what, flash, constants(image), ram, call_graph.image_depth(image),
                            added, *goals))  # fmt: skip
    return rows


def build(core: str) -> dict[str, Path]:
    """The images by the sets' names."""
    _ask_for_compiler(core)
    folder = engine.BUILDS / f"footprint-{core}"
    sets = ";".join(f"{e.name}:{e.bodies}:{e.arbiters}:{','.join(e.features)}:{','.join(e.options)}" for e in SETS)
    toolchain = engine.ROOT / "cmake" / f"toolchain-{core}.cmake"
    with engine.lock(f"footprint-{core}"):
        engine.check_build(engine.cmake("-S", str(PROJECT), "-B", str(folder), "-G", "Ninja", f"-DSETS={sets}",
                                        f"-DCMAKE_TOOLCHAIN_FILE={toolchain}", "-DCMAKE_BUILD_TYPE=RelWithDebInfo",
                                        f"-DCMAKE_C_FLAGS_RELWITHDEBINFO={FLAGS}"))  # fmt: skip
        engine.check_build(engine.cmake("--build", str(folder)))
    return {entry.name: folder / entry.name for entry in SETS}


def _ask_for_compiler(core: str) -> None:
    compiler = COMPILERS.get(core)
    if compiler is None:
        return
    asked = [compiler, "-print-file-name=picolibc.specs"]  # it prints a path where it finds the file
    if not shutil.which(compiler) or "/" not in subprocess.check_output(asked, text=True):
        raise UserError(f"{core} takes {compiler} with picolibc: tools/setup --rv32 installs them")


def sizes(image: Path) -> tuple[int, int]:
    """Flash and RAM, without the stack: initialised variables are in both."""
    flash = ram = 0
    with image.open("rb") as binary:
        for section in ELFFile(binary).iter_sections():
            if section["sh_flags"] & TAKES_ROOM and section.name != ".stack":
                flash += section["sh_size"] if section["sh_type"] != "SHT_NOBITS" else 0
                ram += section["sh_size"] if section["sh_flags"] & WRITES else 0
    return flash, ram


def constants(image: Path) -> int:
    """Bytes of the tables in flash, which have names; what stands between instructions counts as code."""
    with image.open("rb") as binary:
        elf = ELFFile(binary)
        fixed = {i for i, s in enumerate(elf.iter_sections()) if s["sh_flags"] & (TAKES_ROOM | WRITES) == TAKES_ROOM}
        return sum(symbol["st_size"] for symbol in _objects(elf) if symbol["st_shndx"] in fixed)


def type_sizes(core: str) -> dict[str, int]:
    """Bytes of the types that a world's memory is made of."""
    return memory.type_sizes(build(core)["everything"], TYPES)


# ---- what is in an image ----


def functions(image: Path) -> dict[str, str]:
    """The functions of src/ in an image and their files; by each instruction's line, which tells inlined ones too."""
    with image.open("rb") as binary:
        asked = [hex(address) for section in ELFFile(binary).iter_sections() if section["sh_flags"] & RUNS
                 for address in range(section["sh_addr"], section["sh_addr"] + section["sh_size"], 2)]  # fmt: skip
    command = [ADDR2LINE, "-f", "-i", "-e", str(image)]
    told = subprocess.check_output(command, input="\n".join(asked), text=True).splitlines()
    places = {(name.split(".")[0], line.rpartition(":")[0]) for name, line in zip(told[::2], told[1::2], strict=True)}
    return {name: Path(file).name for name, file in places if Path(file).resolve().is_relative_to(SOURCES)}


def tables(image: Path) -> dict[str, str]:
    """The engine's constants in an image, and the file of src/ that defines each: where two do, neither."""
    known = constant_names()
    with image.open("rb") as binary:
        names = {symbol.name.split(".")[0] for symbol in _objects(ELFFile(binary))}  # -flto puts numbers behind some
    return {name: known[name] for name in names if name in known}


def _objects(elf: ELFFile) -> list[Symbol]:
    table = elf.get_section_by_name(".symtab")
    assert isinstance(table, SymbolTableSection)
    return [symbol for symbol in table.iter_symbols() if symbol["st_info"]["type"] == "STT_OBJECT"]


@cache
def constant_names() -> dict[str, str]:
    """The file-scope constants of src/, by name."""
    pattern = r"^(?:static )?const [\w \*]*?\b(\w+)(?:\[[^\n=]*\])? = "
    places = [(name, file.name) for file in sorted(SOURCES.glob("*.c"))
              for name in re.findall(pattern, file.read_text(encoding="utf-8"), re.M)]  # fmt: skip
    count = Counter(name for name, _ in places)
    return {name: file for name, file in places if count[name] == 1}


def strangers(features: tuple[str, ...], found: dict[str, str], options: tuple[str, ...] = ()) -> list[str]:
    """The functions and tables, by name with their files, of features that a game does not use."""
    others = [feature for name, feature in FEATURES.items() if name not in features]
    files = {f"{file}.c" for feature in others for file in feature.files}
    files -= {f"{file}.c" for name in features for file in BROUGHT.get(name, ())}
    if WITHOUT_SOFT in options:
        files |= {f"{file}.c" for file in (*SOFT_FILES, *FEATURES["RESTITUTION"].files)}
    names = {name for feature in others for name in feature.functions}
    return sorted(name for name, file in found.items() if file in files or name in names)


def unplaced_files() -> list[str]:
    """Files of src/ that no feature names, so that nothing tells where they must not be; and names without a file."""
    placed = {file for feature in FEATURES.values() for file in feature.files} | set(CORE_FILES)
    return sorted({file.stem for file in SOURCES.glob("*.c")} ^ placed)
