"""The same scenes on Cairn, Chipmunk and Box2D, on the same emulated cores: tools/peers has the adapters."""

from __future__ import annotations

import math
import shutil
import subprocess
import tempfile
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

from elftools.elf.elffile import ELFFile

from . import bench, engine, geometry
from .errors import UserError
from .geometry import Point
from .scene import Body, Scene, Shape, Spring

HERE = engine.ROOT / "tools" / "peers"
PLACE = engine.ROOT / "build" / "peers"
ENGINES = ("cairn", "chipmunk", "box2d")
CORES = ("m0", "m3", "m4f", "m7", "m33")  # of the others, the board has too little RAM for Box2D
CORNERS = 8  # as in peer.h and in Box2D
LOST = -(2**31)

# What a body may move farther than Cairn's farthest: half a crate of the scenes. A heap that fell apart moves by more.
SLACK = 0.5
# Metres around all that the scene starts with; beyond, a body has left.
MARGIN = 1.0

SETTINGS = {
    "cairn": "the scene's own, 4 sub-steps in those by default",
    "chipmunk": "single precision, 10 iterations; collision slop 0.005 m and pools by 2 KB, by default 0.1 and 32",
    "box2d": "8 velocity and 3 position iterations; warm starting and continuous collision on, as by default",
    "all": "gcc -O2, asserts off; no sleep; heap as newlib takes it, by 4 KB; of Cairn's arbiters those that were used",
}


@dataclass(frozen=True)
class Cost:
    """Of one engine's step, over steps 121 to 240, and of its image less the image without an engine."""

    scene: str
    core: str
    engine: str
    version: str
    mean_instructions: float
    worst_instructions: int
    times_cairn: float
    farthest_move: float  # metres, of any moving body, from its start to step 240
    stands: bool
    flash_bytes: int  # without the scene's table
    static_bytes: int
    heap_bytes: int
    ram_bytes: int  # static and heap, less what the run did not need of Cairn's pools; without the stack
    stack_bytes: int  # of the whole image


@dataclass
class Output:
    """What tools/peers/main.c prints; places in metres, None where the engine lost the body."""

    starts: list[Point | None] = field(default_factory=list)
    ends: list[Point | None] = field(default_factory=list)
    costs: list[int] = field(default_factory=list)
    numbers: dict[str, int] = field(default_factory=dict)
    poses: list[list[tuple[float, ...]]] = field(default_factory=list)  # x, y, angle of each body; NaN where lost


@dataclass(frozen=True)
class Sizes:
    """Bytes of an image."""

    flash: int
    static: int


def fetch() -> dict[str, str]:
    """Brings the peers' sources where they are missing; gives the versions of Debian's packages."""
    with engine.lock("peers"):
        done = subprocess.run([str(HERE / "fetch")], capture_output=True, text=True, check=False)
    if done.returncode != 0:
        lines = done.stderr.strip().splitlines()
        raise engine.EngineError(f"the peers cannot be fetched: {lines[-1] if lines else done.returncode}")
    return {name: (PLACE / "source" / f"{name}.version").read_text(encoding="utf-8").strip() for name in ENGINES[1:]}


def settings(versions: dict[str, str]) -> dict[str, str]:
    """What the engines run with, and which they are."""
    return {f"{name} {versions[name]}" if name in versions else name: text for name, text in SETTINGS.items()}


def measure(scene: Scene, core: str, versions: dict[str, str]) -> Iterator[Cost]:
    """Cairn first, then the peers."""
    with tempfile.TemporaryDirectory(prefix="cairn-") as folder:
        sizes = link(scene, core, Path(folder))
        cairn = None
        for name in ENGINES:
            output = parse(engine.run_image(scene, core, Path(folder) / f"{name}.elf", [str(bench.LAST_STEP)]))
            steady = output.costs[bench.FIRST_STEP - 1 : bench.LAST_STEP]
            mean, move = sum(steady) / len(steady), farthest_move(scene, output)
            static = sizes[name].static - sizes["none"].static
            cost = Cost(
                scene=scene.name,
                core=core,
                engine=name,
                version=versions.get(name, ""),
                mean_instructions=mean,
                worst_instructions=max(steady),
                times_cairn=mean / cairn.mean_instructions if cairn else 1.0,
                farthest_move=move,
                stands=not left(scene, output) and move <= (cairn.farthest_move + SLACK if cairn else math.inf),
                flash_bytes=sizes[name].flash - sizes["none"].flash,
                static_bytes=static,
                heap_bytes=output.numbers["heap"],
                ram_bytes=static + output.numbers["heap"] - output.numbers["spare"],
                stack_bytes=output.numbers["stack"],
            )
            cairn = cairn or cost
            yield cost


def link(scene: Scene, core: str, folder: Path) -> dict[str, Sizes]:
    """Links the images of a scene into the folder; gives their sizes."""
    emulated = engine.CORES[core]
    text, own = table(scene), engine.table(scene, "cairn_the_scene")
    own += features(scene, own)
    with engine.lock(f"peers-{core}"):
        build = PLACE / core
        for name, content in (("peer.c", text), ("cairn.c", own)):
            (build / "tables").mkdir(parents=True, exist_ok=True)
            (build / "tables" / name).write_text(content, encoding="utf-8")
        if not (build / "build.ninja").is_file():
            toolchain = engine.ROOT / "cmake" / f"toolchain-{emulated.preset}.cmake"
            options = [f"-DCMAKE_TOOLCHAIN_FILE={toolchain}", "-DCMAKE_BUILD_TYPE=RelWithDebInfo"]
            options += [f"-DCMAKE_{language}_FLAGS_RELWITHDEBINFO=-O2 -g" for language in ("C", "CXX")]
            options += [f"-DCAIRN_BOARD={emulated.board}"]
            engine.check_build(engine.cmake("-G", "Ninja", "-S", str(HERE), "-B", str(build), *options))
        engine.check_build(engine.cmake("--build", str(build)))
        sizes = {}
        for name in ("none", *ENGINES):
            image = Path(shutil.copy(build / f"peer-{name}.elf", folder / f"{name}.elf"))
            tables = build / "CMakeFiles" / f"peer-{name}.dir" / "tables"
            sizes[name] = _sizes(image, [*tables.glob("*.obj"), *tables.glob("*.o")])
    return sizes


def _sizes(image: Path, tables: list[Path]) -> Sizes:
    """Flash without the scene's table, and RAM without the stack, the arena of the heap, and the adapter's handles."""
    with image.open("rb") as binary:
        elf = ELFFile(binary)
        used = {section.name: section for section in elf.iter_sections() if section["sh_flags"] & 2}  # SHF_ALLOC
        symbols = elf.get_section_by_name(".symtab")
        ours = [symbols.get_symbol_by_name(name) or [] for name in ("peer_arena", "peer_handles")]
        flash = sum(section["sh_size"] for section in used.values() if section["sh_type"] != "SHT_NOBITS")
        static = sum(used[name]["sh_size"] for name in (".data", ".bss"))
        static -= sum(symbol["st_size"] for found in ours for symbol in found)
    return Sizes(flash - sum(map(_table_bytes, tables)), static)


def _table_bytes(file: Path) -> int:
    with file.open("rb") as binary:
        return sum(s["sh_size"] for s in ELFFile(binary).iter_sections() if s.name.startswith(".rodata"))


# ---- what it printed ----


def parse(text: str) -> Output:
    """The lines of main.c."""
    output = Output()
    ended = False
    for line in text.splitlines():
        match line.split():
            case ["start" | "end" as name, x, y]:
                lost = LOST in (int(x), int(y))
                place = None if lost else (int(x) / 65536, int(y) / 65536)
                (output.starts if name == "start" else output.ends).append(place)
            case [x, y, angle]:
                numbers = [int(value) for value in (x, y, angle)]
                output.poses[-1].append(tuple(math.nan if n == LOST else n / 65536 for n in numbers))
            case ["cost", number]:
                output.costs.append(int(number))
            case ["state", _]:
                output.poses.append([])
            case ["heap" | "stack" | "spare" as name, number]:
                output.numbers[name] = int(number)
            case ["done"]:
                ended = True
    if not ended:
        raise engine.EngineError("the output of a peer's image breaks off")
    return output


def farthest_move(scene: Scene, output: Output) -> float:
    """The largest distance of a moving body from its start; infinite where one was lost."""
    pairs = zip(scene.bodies, output.starts, output.ends, strict=True)
    moves = [math.dist(start, end) if start and end else math.inf for body, start, end in pairs if not body.static]
    return max(moves, default=0.0)


def left(scene: Scene, output: Output) -> bool:
    """Whether a body is beyond all that the scene starts with."""
    starts = [
        point
        for body in scene.bodies
        for point in geometry.placed(list(_outline(scene.shape_of(body))), *body.position, body.angle)
    ]
    (left, right), (low, high) = ((min(axis) - MARGIN, max(axis) + MARGIN) for axis in zip(*starts, strict=True))
    return not all(end and left <= end[0] <= right and low <= end[1] <= high for end in output.ends)


def _outline(shape: Shape) -> tuple[Point, ...]:
    r = shape.radius
    return shape.corners or ((-r, -r), (r, -r), (r, r), (-r, r))


# ---- the scene as a table in single precision, see tools/peers/peer.h ----


def table(scene: Scene) -> str:
    """The C file of a scene for engines in floating point. Refuses what not all of them have."""
    if scene.sleep:
        raise UserError(f"{scene.path}: sleep: --peers compares without")
    shapes = list(scene.shapes)
    lines = [f"/* The scene {scene.name}, by tools/cairn_tools/peers.py. */", '#include "peer.h"', ""]
    lines += _array("shape", [_shape(scene, name) for name in shapes])
    lines += _array("body", [_body(scene, i, shapes) for i in range(len(scene.bodies))])
    lines += _array("spring", [_spring(scene, spring) for spring in scene.springs])
    lines += [
        "const peer_scene peer_the_scene = {",
        f"    {_pair(scene.gravity)}, {_real(1 / scene.steps_per_second)},",
        f"    {len(shapes)}, {len(scene.bodies)}, {len(scene.springs)},",
        f"    peer_shapes, peer_bodies, {'peer_springs' if scene.springs else '0'},",
        "};",
        f"void *peer_handles[{len(scene.bodies)}];",
    ]
    return "\n".join(lines) + "\n"


def features(scene: Scene, table: str) -> str:
    """What cairn.c is to use, behind Cairn's own table: see tools/peers/peer_cairn.h."""
    wanted = {
        "peer_use_quadtree": scene.broad_phase == "quadtree",
        "peer_use_blocks": "CAIRN_BLOCKS(" in table,
        "peer_use_slides": scene.solver == "slides",
        "peer_use_small": scene.solver == "small",
        "peer_use_springs": bool(scene.springs),
    }
    names = "".join(f"{name}, " for name, of_scene in wanted.items() if of_scene)
    return f'\n#include "peer_cairn.h"\n\nconst peer_feature peer_features[] = {{{names}NULL}};\n'


def mass(shape: Shape, density: float) -> tuple[float, float]:
    """Mass, and inertia about the centre of area."""
    total = density * shape.area
    if not shape.corners:
        return total, total * shape.radius**2 / 2
    # About the centre, by triangles from it to each edge: the sum of area / 6 * (a.a + a.b + b.b).
    x, y = shape.centre
    corners = [(px - x, py - y) for px, py in shape.corners]
    second = sum(
        (a[0] * b[1] - a[1] * b[0]) / 12 * (a[0] ** 2 + a[1] ** 2 + a[0] * b[0] + a[1] * b[1] + b[0] ** 2 + b[1] ** 2)
        for a, b in geometry.edges(corners)
    )
    return total, density * second


def _array(name: str, entries: list[str]) -> list[str]:
    plural = {"body": "bodies"}.get(name, f"{name}s")
    if not entries:
        return []
    return [f"static const peer_{name} peer_{plural}[] = {{", *(f"    {{{entry}}}," for entry in entries), "};", ""]


def _shape(scene: Scene, name: str) -> str:
    shape = scene.shapes[name]
    if len(shape.corners) > CORNERS:
        raise UserError(f"{scene.path}: shapes.{name}: --peers takes at most {CORNERS} corners")
    corners = ", ".join(map(_pair, shape.corners)) or "{0, 0}"
    return f"{_real(shape.radius)}, {len(shape.corners)}, {{{corners}}}, {_pair(shape.centre)}"


def _body(scene: Scene, index: int, shapes: list[str]) -> str:
    body: Body = scene.bodies[index]
    for unlike in ("sensor", "fixed_position"):
        if getattr(body, unlike):
            raise UserError(f"{scene.path}: bodies[{index}].{unlike}: --peers takes no such body")
    material = scene.material(body.material)
    numbers = (body.angle, body.angular_velocity, *mass(scene.shape_of(body), body.density))
    return ", ".join(
        (
            f"{shapes.index(body.shape)}, {body.layer}, {body.mask}, {int(body.static)}, {int(body.fixed_rotation)}",
            _pair(body.position),
            _pair(body.velocity),
            *map(_real, (*numbers, material.kinetic_friction, material.restitution)),
        )
    )


def _spring(scene: Scene, spring: Spring) -> str:
    if spring.stiffness is None:
        index = scene.springs.index(spring)
        raise UserError(f"{scene.path}: springs[{index}].frequency: --peers takes springs by their stiffness only")
    anchors = f"{_pair(spring.anchor_a)}, {_pair(spring.anchor_b)}"
    numbers = ", ".join(map(_real, (spring.rest_length, spring.stiffness, spring.damping)))
    return f"{spring.a}, {spring.b}, {int(spring.collide)}, {anchors}, {numbers}"


def _pair(point: Point) -> str:
    return f"{{{_real(point[0])}, {_real(point[1])}}}"


def _real(number: float) -> str:
    """Nine digits behind the first give back any float."""
    return f"{number:.9e}f"
