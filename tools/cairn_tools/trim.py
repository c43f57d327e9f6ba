"""What scenes need of Cairn, found by running them; the build that has no more is weighed and held to the same bits."""

from __future__ import annotations

import json
import math
import re
import shutil
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import numpy as np

from . import engine, footprint, trim_files, trim_findings, trim_recording
from . import scene as scene_model
from .errors import UserError
from .scene import Body, Scene, Shape

CORE = "m0"
FLAGS = "-Os -g -flto"
PROJECT = engine.ROOT / "tools" / "trim"
FEATURES = ("SPRINGS", "BOUNCE", "CONTINUOUS", "BLOCKS", "SLEEP", "QUADTREE", "SOFT_SOLVER", "SLIDES_SOLVER",
            "SMALL_SOLVER", "FIXED_POSITION", "SENSORS", "DAMPING", "POLYGONS", "FRICTION", "TURNING", "SLOPES",
            "MASSES", "SETTINGS", "GIANTS", "SORT", "GRAVITY_SCALE", "PINS")  # fmt: skip
UNEVEN = 30  # bodies of more than so many times one another's mass get memory for blocks, as in tools/runner/storage.h
FAST = 0.25  # of its smallest half size in a step: then continuous.c watches a body
FIRST_SETTINGS = (60, 4, 10)  # of a world: steps a second, sub-steps of the soft solver, passes of the others
LARGE = 15  # metres of radius: a giant has more
FEW = 16  # bodies that are held each against each as quickly as sorted
REFERENCE_SUBSTEPS = 16
LARGEST_POOL = 65000
BYTES_OF_ID = 4
BROADS = ("pairs", "quadtree")
WORTH = 0.02  # of the instructions, that the quadtree must save

Say = Callable[[str], None]


@dataclass(frozen=True)
class Wish:
    """What the user asks for."""

    steps: int
    margin: float  # percent
    tolerance: float | None  # metres
    keep: tuple[str, ...]
    flash: int | None  # bytes, of Cairn and the scenes
    ram: int | None
    solver: str | None = None  # instead of the scenes' own


@dataclass(frozen=True)
class Image:
    """Of one scene on the M0; bytes beyond the same image without Cairn."""

    flash: int
    ram: int
    stack: int
    mean: int  # instructions a step
    worst: int
    hash: str


@dataclass
class Needs:
    """Options of the config header, pool sizes, and why."""

    options: dict[str, int] = field(default_factory=dict)
    why: dict[str, str] = field(default_factory=dict)
    pools: dict[str, int] = field(default_factory=dict)
    found: list[trim_findings.Finding] = field(default_factory=list)
    comes_and_goes: bool = False  # bodies are spawned


@dataclass(frozen=True)
class Trimmed:
    """One scene's share of the outcome."""

    name: str
    solver: str
    substeps: int  # of the soft solver
    passes: int  # of the others
    broad_phase: str
    error: float | None  # metres from the reference, where a tolerance is asked for
    before: Image
    after: Image

    @property
    def flash_saved(self) -> float:
        return 1 - self.after.flash / self.before.flash

    @property
    def ram_saved(self) -> float:
        return 1 - self.after.ram / self.before.ram


def trim(scenes: list[Scene], wish: Wish, out: Path, say: Say) -> tuple[Needs, list[Trimmed]]:
    """Writes the folder, if the trimmed build gives the same bits as the full one."""
    names = [identifier(scene) for scene in scenes]
    for scene in scenes:
        _check_length(scene, wish)
    if twice := next((name for name in names if names.count(name) > 1), None):
        raise UserError(f"two scenes of the name {twice}")
    with engine.lock("trim"):
        folder = engine.BUILDS / "trim"
        folder.mkdir(exist_ok=True)
        shutil.rmtree(folder / "trim", ignore_errors=True)
        errors: list[float | None] = [None] * len(scenes)
        chosen = [replace(scene, solver=wish.solver or scene.solver) for scene in scenes]
        if wish.tolerance is not None:
            found = [with_substeps(scene, wish, say) for scene in chosen]
            chosen, errors = [scene for scene, _ in found], [error for _, error in found]
        for scene in chosen:
            peaks(scene, wish, say)  # what overflows is refused before anything is built
        full = Builder(folder / "build-full", folder, wish.steps)
        say("all of Cairn, with the scenes as they are")
        before = full.run(scenes)
        say("all pairs or the quadtree")
        chosen, wanted = choose_broad(full, [_rewritten(scene, folder) for scene in chosen], folder)
        runs = [peaks(scene, wish, say) for scene in chosen]
        needs = needs_of(chosen, runs, wish)
        say("what is needed")
        after = held(needs, chosen, wanted, folder, wish, say)
        _check_limits(after, wish)
        result = [Trimmed(scene.name, scene.solver, scene.substeps, scene.passes, scene.broad_phase, *rest)
                  for scene, *rest in zip(chosen, errors, before, after, strict=True)]  # fmt: skip
        trim_files.write_summary(folder / "trim", needs, result, wish)
        try:
            shutil.copytree(folder / "trim", out, dirs_exist_ok=True)
        except OSError as error:
            raise UserError(f"{out}: {error.strerror or error}") from error
    return needs, result


def load(name: str) -> Scene:
    """A scene's file or name, or a recorded run's file."""
    if not name.endswith(trim_recording.ENDING):
        return scene_model.load(scene_model.find(name))
    folder = engine.BUILDS / "trim"
    folder.mkdir(parents=True, exist_ok=True)
    return trim_recording.load(Path(name), folder)


def _check_length(scene: Scene, wish: Wish) -> None:
    last = max((event.step for event in scene.play.events), default=-1) if scene.play else -1
    if last >= wish.steps:
        raise UserError(f"{scene.name}: its last event is after {last} steps: --steps must be more, not {wish.steps}")


def identifier(scene: Scene) -> str:
    return re.sub(r"[^A-Za-z0-9]", "_", scene.name)


def _rewritten(scene: Scene, folder: Path) -> Scene:
    """The scene as a file that says its settings, from which tables are made."""
    data = json.loads(scene.path.read_text(encoding="utf-8-sig"))
    data |= {"solver": scene.solver, "substeps": scene.substeps, "broad_phase": scene.broad_phase}
    file = folder / f"{identifier(scene)}-{scene.broad_phase}.json"
    file.write_text(json.dumps(data), encoding="utf-8")
    return replace(scene, path=file)


# ---- what is to be chosen ----


def with_substeps(scene: Scene, wish: Wish, say: Say) -> tuple[Scene, float]:
    """The fewest sub-steps, or another solver, within the tolerance of the double build at 16; how far off it is."""
    assert wish.tolerance is not None
    reference = _positions(replace(scene, solver="soft", substeps=REFERENCE_SUBSTEPS), "f64", wish.steps)
    least = math.inf
    for substeps in range(1, REFERENCE_SUBSTEPS + 1) if scene.solver == "soft" else [scene.substeps]:
        say(f"{scene.name}: " + (f"{substeps} sub-steps" if scene.solver == "soft" else f"the {scene.solver} solver"))
        tried = replace(scene, substeps=substeps)
        error = float(np.linalg.norm(_positions(tried, "q16", wish.steps) - reference, axis=-1).max())
        if error <= wish.tolerance:
            return tried, error
        least = min(least, error)
    what = "no sub-steps keep" if scene.solver == "soft" else f"the {scene.solver} solver does not keep"
    nearest = "the nearest" if scene.solver == "soft" else "it"
    raise UserError(f"{scene.path}: {what} it within {wish.tolerance:g} m of the double build at {REFERENCE_SUBSTEPS} "
                    f"sub-steps for {wish.steps} steps: {nearest} is {least:.2g} m off")  # fmt: skip


def _positions(scene: Scene, arithmetic: str, steps: int) -> np.ndarray:
    return engine.run(scene, arithmetic, "host", steps, 1).trajectory.states[:, :, :2]


def choose_broad(full: Builder, scenes: list[Scene], folder: Path) -> tuple[list[Scene], list[Image]]:
    """By fewer instructions on the M0; a tree that saves next to nothing is not worth its memory. The same for all."""
    runs = {}
    for broad in BROADS:
        tried = [_rewritten(replace(scene, broad_phase=broad), folder) for scene in scenes]
        runs[broad] = (tried, full.run(tried))
    means = {broad: sum(image.mean for image in images) for broad, (_, images) in runs.items()}
    return runs["quadtree" if means["quadtree"] < (1 - WORTH) * means["pairs"] else "pairs"]


# ---- what is needed ----


def peaks(scene: Scene, wish: Wish, say: Say) -> engine.Run:
    """A run on the host, in the pools that tools/runner gives a scene."""
    say(f"{scene.name}: the most it needs")
    run = engine.run(scene, "q16", "host", wish.steps, 1)
    if dropped := int(run.statistics["dropped_contacts"]):
        raise UserError(f"{scene.path}: overflows the pool of arbiters: {dropped} contacts dropped")
    return run


def needs_of(scenes: list[Scene], runs: list[engine.Run], wish: Wish) -> Needs:
    needs = Needs()
    for name in FEATURES:
        said = [_reason(name, scene, run, wish) for scene, run in zip(scenes, runs, strict=True)]
        reasons = [reason for reason in said if reason]
        if name.lower() in wish.keep:
            reasons.append("asked for")
        needs.options[f"CAIRN_WITH_{name}"] = int(bool(reasons))
        needs.why[f"CAIRN_WITH_{name}"] = reasons[0] if reasons else "not in any scene"
    _fit_solvers(needs)
    movers = [scene.shape_of(body) for scene in scenes for body in scene.bodies if not body.static]
    _fit_slopes(needs, movers)
    two = any(shape.kind != "circle" for shape in movers) or bool(needs.options["CAIRN_WITH_BLOCKS"])
    needs.options["CAIRN_MAX_POINTS"] = 2 if two else 1
    needs.why["CAIRN_MAX_POINTS"] = "boxes or polygons move, or blocks are in use" if two else "all that moves is round"
    shapes = [shape for scene in scenes for shape in scene.shapes.values()]
    corners = max((len(shape.corners) for shape in shapes if shape.kind not in ("circle", "box")), default=0)
    needs.options["CAIRN_MAX_VERTICES"] = max(4, corners)
    reason = f"polygons have up to {corners} corners" if corners else "no polygons; a box has four"
    needs.why["CAIRN_MAX_VERTICES"] = reason
    needs.pools = _pools(scenes, runs, wish)
    needs.comes_and_goes = any(scene.play for scene in scenes)
    needs.found = trim_findings.findings(scenes, runs, wish.margin)
    return needs


def _reason(name: str, scene: Scene, run: engine.Run, wish: Wish) -> str:
    """Why a scene needs a feature; empty if it does not."""
    way, soft = _fastest(scene, run), scene.solver == "soft"
    found: dict[str, Callable[[], Any]] = {
        "SPRINGS": lambda: scene.springs and f"springs, {len(scene.springs)} of them",
        "BOUNCE": lambda: any(scene.material(b.material).restitution > 0 for b in scene.bodies) and "bouncing bodies",
        "CONTINUOUS": lambda: way * (1 + wish.margin / 100) > FAST and f"{way:.0%} of a smallest half size in a step",
        "BLOCKS": lambda: soft and _unevenness(scene) > UNEVEN and f"masses differ by {_unevenness(scene):.3g} times",
        "SLEEP": lambda: scene.sleep and "sleep is on",
        "QUADTREE": lambda: scene.broad_phase == "quadtree" and "it saves 2 % of the instructions or more",
        "SOFT_SOLVER": lambda: soft and "the soft solver",
        "SLIDES_SOLVER": lambda: scene.solver == "slides" and "the slides' solver",
        "SMALL_SOLVER": lambda: scene.solver == "small" and "the small solver",
        "FIXED_POSITION": lambda: any(body.fixed_position for body in scene.bodies) and "bodies of fixed position",
        "SENSORS": lambda: any(body.sensor for body in scene.bodies) and "sensors",
        "DAMPING": lambda: "",  # scene files have none
        "POLYGONS": lambda: any(s.kind not in ("circle", "box") for s in scene.shapes.values()) and "polygons",
        "FRICTION": lambda: any(scene.material(b.material).static_friction > 0 for b in scene.bodies) and "friction",
        "TURNING": lambda: any(_turns(body) for body in scene.bodies) and "bodies that turn",
        "MASSES": lambda: len(_kinds(scene)) > 1 and "other masses",
        "SETTINGS": lambda: _settings(scene) != FIRST_SETTINGS and "a rate, sub-steps or passes of its own",
        "GIANTS": lambda: any(s.kind == "circle" and s.radius > LARGE for s in scene.shapes.values()) and "giants",
        "SORT": lambda: len(scene.bodies) > FEW and f"{len(scene.bodies)} bodies",
        "GRAVITY_SCALE": lambda: "",  # scene files have none
        "PINS": lambda: any(spring.rest_length == 0 for spring in scene.springs) and "springs of no rest length",
        "SLOPES": lambda: any(_leans(scene, body) for body in scene.bodies) and "what stands at an angle, or turns",
    }
    reason = found[name]()
    return f"{scene.name}: {reason}" if reason else ""


def _settings(scene: Scene) -> tuple[int, int, int]:
    """What a solver has no use for is as it is at first."""
    _, substeps, passes = FIRST_SETTINGS
    if scene.solver == "soft":
        return scene.steps_per_second, scene.substeps, passes
    return scene.steps_per_second, substeps, scene.passes


def _kinds(scene: Scene) -> set[tuple[str, float]]:
    return {(body.shape, body.density) for body in scene.bodies if body.type == "dynamic"}


def _turns(body: Body) -> bool:
    return not body.static and not body.fixed_rotation


def _leans(scene: Scene, body: Body) -> bool:
    return scene.shape_of(body).kind != "circle" and (body.angle != 0 or _turns(body))


def _fit_solvers(needs: Needs) -> None:
    """Blocks are the soft solver's; and with that one and another, the sub-steps are no constant."""
    soft, settings = "CAIRN_WITH_SOFT_SOLVER", "CAIRN_WITH_SETTINGS"
    if needs.options["CAIRN_WITH_BLOCKS"] and not needs.options[soft]:
        needs.options[soft], needs.why[soft] = 1, "blocks are of that solver"
    others = needs.options["CAIRN_WITH_SLIDES_SOLVER"] or needs.options["CAIRN_WITH_SMALL_SOLVER"]
    if needs.options[soft] and others and not needs.options[settings]:
        needs.options[settings], needs.why[settings] = 1, "solvers with and without sub-steps"


def _fit_slopes(needs: Needs, movers: list[Shape]) -> None:
    """config.h has no upright boxes that move beside balls that turn."""
    name = "CAIRN_WITH_SLOPES"
    if not needs.options[name] and needs.options["CAIRN_WITH_TURNING"] and any(s.kind != "circle" for s in movers):
        needs.options[name], needs.why[name] = 1, "boxes move, and something turns"


def _fastest(scene: Scene, run: engine.Run) -> float:
    """The longest way that a body goes in a step, in smallest half sizes."""
    speeds = np.linalg.norm(run.trajectory.states[:, :, 3:5], axis=-1).max(axis=0)
    spins = np.abs(run.trajectory.states[:, :, 5]).max(axis=0)
    ways = [(speed + spin * _reach(scene.shape_of(body))) / _inradius(scene.shape_of(body))
            for body, speed, spin in zip(scene.bodies, speeds, spins, strict=True) if not body.static]  # fmt: skip
    return float(max(ways, default=0.0)) / scene.steps_per_second


def _reach(shape: Shape) -> float:
    return 0.0 if shape.kind == "circle" else shape.reach


def _inradius(shape: Shape) -> float:
    """About the middle of the corners, which is near enough to the centre of mass for this question."""
    if shape.kind == "circle":
        return shape.radius
    corners = np.array(shape.corners)
    edges = np.roll(corners, -1, axis=0) - corners
    to_middle = corners.mean(axis=0) - corners
    away = np.abs(edges[:, 0] * to_middle[:, 1] - edges[:, 1] * to_middle[:, 0]) / np.linalg.norm(edges, axis=1)
    return float(away.min())


def _unevenness(scene: Scene) -> float:
    masses = [body.density * scene.shape_of(body).area for body in scene.bodies if not body.static]
    return max(masses, default=1.0) / min(masses, default=1.0)


def _pools(scenes: list[Scene], runs: list[engine.Run], wish: Wish) -> dict[str, int]:
    """Bodies and springs are as many as there are, unless bodies are spawned; what comes and goes gets the margin."""

    def most(name: str) -> int:
        return _roomy(max(int(run.statistics[name]) for run in runs), wish)

    bodies = max(_roomy(scene.play.most, wish) if scene.play else len(scene.bodies) for scene in scenes)
    pools = {"bodies": bodies, "arbiters": most("most_arbiters")}
    if any(scene.springs for scene in scenes):
        pools["springs"] = max(len(scene.springs) for scene in scenes)
    if scenes[0].broad_phase == "quadtree":
        pools |= {"cells": most("most_tree_cells"), "entries": most("most_tree_kept")}
    if over := next((name for name, count in pools.items() if count > LARGEST_POOL), None):
        raise UserError(f"{scenes[0].path}: needs a pool of {pools[over]} {over}; at most {LARGEST_POOL}")
    return pools


def _roomy(peak: int, wish: Wish) -> int:
    return max(1, math.ceil(peak * (1 + wish.margin / 100)))


# ---- the images ----


@dataclass(frozen=True)
class Builder:
    """Builds and runs the images of scenes with all of Cairn, or with what a folder of ours says."""

    place: Path
    folder: Path
    steps: int

    def run(self, scenes: list[Scene]) -> list[Image]:
        """With all of Cairn and the pools that tools/runner gives."""
        tables = []
        for scene in scenes:
            name = identifier(scene)
            file = self.folder / f"{name}-table.c"
            table = engine.table(scene, f"scene_{name}")
            file.write_text(trim_recording.cut(table, scene.play) if scene.play else table, encoding="utf-8")
            tables.append(f"{name}:{file}")
        return self._images(scenes, f"-DTABLES={';'.join(tables)}")

    def run_trimmed(self, scenes: list[Scene], trimmed: Path) -> list[Image]:
        return self._images(scenes, f"-DTRIM={trimmed}", f"-DNAMES={';'.join(map(identifier, scenes))}")

    def _images(self, scenes: list[Scene], *settings: str) -> list[Image]:
        plays = [scene for scene in scenes if scene.play]
        for scene in plays:
            name = identifier(scene)
            table = trim_recording.table(scene.play, f"play_{name}", len(scene.bodies))
            (self.folder / f"{name}-play.c").write_text(table, encoding="utf-8")
        settings = (*settings, f"-DPLACE={self.folder}", f"-DPLAYS={';'.join(map(identifier, plays))}")
        toolchain = engine.ROOT / "cmake" / f"toolchain-{CORE}.cmake"
        engine.check_build(engine.cmake("-S", str(PROJECT), "-B", str(self.place), "-G", "Ninja",
                                        f"-DCMAKE_TOOLCHAIN_FILE={toolchain}", "-DCMAKE_BUILD_TYPE=RelWithDebInfo",
                                        f"-DCMAKE_C_FLAGS_RELWITHDEBINFO={FLAGS}", f"-DSTEPS={self.steps}",
                                        *settings))  # fmt: skip
        log = engine.cmake("--build", str(self.place))
        if log and "overflowed by" in log:
            raise UserError(f"{scenes[0].path}: does not fit into the memory of the emulated {CORE}")
        engine.check_build(log)
        without = footprint.sizes(self.place / "image_without.elf")
        return [self._image(scene, without) for scene in scenes]

    def _image(self, scene: Scene, without: tuple[int, int]) -> Image:
        file = self.place / f"game_{identifier(scene)}.elf"
        flash, ram = (size - other for size, other in zip(footprint.sizes(file), without, strict=True))
        ram -= BYTES_OF_ID * len(scene.bodies) if scene.play else 0  # the ids are the game's
        output = engine.run_image(scene, CORE, file, [], timeout=120 + self.steps)
        said = dict(line.split() for line in output.splitlines())
        if said.get("dropped") != "0":
            raise UserError(f"{scene.path}: overflows the pool of arbiters on the {CORE}")
        return Image(flash, ram, int(said["stack"]), int(said["mean"]), int(said["worst"]), said["hash"])


def held(needs: Needs, scenes: list[Scene], wanted: list[Image], folder: Path, wish: Wish, say: Say) -> list[Image]:
    """The trimmed images, which must give the same bits; if they do not, with slopes or continuous collision."""
    for attempt in _attempts(needs):
        say(f"the trimmed build {attempt}")
        trim_files.write(folder / "trim", scenes, needs, wish)
        images = Builder(folder / "build-trim", folder, wish.steps).run_trimmed(scenes, folder / "trim")
        if all(image.hash == other.hash for image, other in zip(images, wanted, strict=True)):
            return images
    raise engine.EngineError("the trimmed build gives other bits than the full one; nothing was written")


def _attempts(needs: Needs) -> Iterator[str]:
    yield ""
    for name, what in (("SLOPES", "slopes"), ("CONTINUOUS", "continuous collision")):
        option = f"CAIRN_WITH_{name}"
        if not needs.options[option]:
            needs.options[option], needs.why[option] = 1, "without it the bits differ"
            yield f"with {what}"


def _check_limits(images: list[Image], wish: Wish) -> None:
    flash, ram = max(image.flash for image in images), max(image.ram for image in images)
    for what, size, limit in (("flash", flash, wish.flash), ("RAM", ram, wish.ram)):
        if limit is not None and size > limit:
            raise UserError(f"needs {size:,} bytes of {what}, and {limit:,} are allowed")
