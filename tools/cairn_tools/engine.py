"""Runs scenes on the engine: builds the runner (tools/runner) by CMake, starts it here or in QEMU, reads its lines."""

from __future__ import annotations

import fcntl
import math
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from .errors import UserError
from .scene import EVENT_KINDS, Play, Scene
from .trajectory import Trajectory

ROOT = Path(__file__).parents[2]
# Folders of its own: a developer's build, or tools/test, may be at work in build/<preset> at the same time.
BUILDS = ROOT / "build" / "tools"
ARITHMETICS = {"q16": "host", "f64": "host-double"}  # and the CMake preset of each on the host


@dataclass(frozen=True)
class Emulated:
    """A core in an emulator: the CMake preset it is built by and the board it is on."""

    preset: str
    board: str


CORES = {
    "m0": Emulated("m0", "microbit"),
    "m3": Emulated("m3", "mps2-an385"),
    "m4f": Emulated("m4f", "mps2-an386"),
    "m7": Emulated("m7", "mps2-an500"),
    "m33": Emulated("m33", "mps2-an505"),
    "m55": Emulated("m55", "mps3-an547"),
    "lm3s6965evb": Emulated("m3", "lm3s6965evb"),
    "rp2040": Emulated("m0", "rp2040"),  # in rp2040js: its costs are cycles, not instructions
}
COUNTED = tuple(name for name in CORES if name != "rp2040")  # in QEMU, whose costs are instructions
TARGETS = ("host", *CORES)

STATUS = {
    -1: "a null argument",
    -2: "a stale id",
    -3: "a number out of range",
    -4: "a full pool",
    -5: "a shape that is not convex, or is degenerate",
    -6: "a call that does not apply",
    -7: "a locked world",
}


class EngineError(Exception):
    """The build or the run itself failed: not the fault of the command's input."""


@dataclass
class Run:
    """What the runner printed."""

    arithmetic: str
    target: str
    steps: int
    trajectory: Trajectory
    hash: str = ""
    statistics: dict[str, int | float | str] = field(default_factory=dict)
    costs: list[int] = field(default_factory=list)  # a step: instructions in QEMU, cycles in rp2040js
    stack: int = 0  # bytes, the most used in the steps
    stack_before: int = 0  # of which the runner's own, where it calls the step
    contacts: np.ndarray = field(default_factory=lambda: np.zeros((0, 4)))


def run(scene: Scene, arithmetic: str, target: str, steps: int, every: int) -> Run:
    """Runs a scene and records each `every` steps (0: records nothing)."""
    if target != "host":
        with tempfile.TemporaryDirectory(prefix="cairn-") as folder:
            image = Path(folder) / "runner.elf"
            build_image(scene, target, image)
            return run_built(scene, target, image, steps, every)
    command = [str(host_program(ARITHMETICS[arithmetic], "cairn-runner")), "-", *words_of(scene, steps, every)]
    with _played(scene, arithmetic) as words:
        output = _output_of([*command, *words], scene, None)
    return _parse(output, scene, Run(arithmetic, target, steps, _no_states(scene)))


@contextmanager
def _played(scene: Scene, arithmetic: str) -> Iterator[list[str]]:
    """The host's word for what happens in a recorded run."""
    if scene.play is None:
        yield []
        return
    with tempfile.NamedTemporaryFile("w", prefix="cairn-", encoding="utf-8") as file:
        file.write(numbers_of(scene.play, arithmetic))
        file.flush()
        yield [f"play={file.name}"]


def numbers_of(play: Play, arithmetic: str) -> str:
    """A recorded run as tools/runner/host_play.h reads it."""
    lines = [f"{play.present} {len(play.events)}"]
    for event in play.events:
        x, y = (value if arithmetic == "f64" else round(value * 65536) for value in event.value)
        lines.append(f"{event.step} {EVENT_KINDS.index(event.kind)} {event.body} {x!r} {y!r}")
    return "\n".join([*lines, ""])


def run_built(scene: Scene, target: str, image: Path, steps: int, every: int) -> Run:
    """The same of an image that build_image() made."""
    output = run_image(scene, target, image, [*words_of(scene, steps, every), "costs=1"], timeout=120 + steps)
    return _parse(output, scene, Run("q16", target, steps, _no_states(scene)))


def words_of(scene: Scene, steps: int, every: int) -> list[str]:
    """What the runner is asked for: a run with the scene's settings, which may be others than its file's."""
    words = [f"steps={steps}", f"every={every}", "contacts=1", f"solver={scene.solver}", f"sleep={int(scene.sleep)}"]
    words += [f"substeps={scene.substeps}", f"passes={scene.passes}", f"rate={scene.steps_per_second}"]
    return [*words, f"broad={scene.broad_phase}"]


def run_image(
    scene: Scene, target: str, image: Path, words: list[str], options: Sequence[str] = (), timeout: int = 600
) -> str:
    """What the runner's firmware prints in its emulator, tools/qemu-run or tools/rp2040-run with the options."""
    board = CORES[target].board
    if board == "rp2040":
        emulator = [str(ROOT / "tools" / "rp2040-run"), "--timeout", str(10 * timeout), *options]
    else:
        emulator = [sys.executable, str(ROOT / "tools" / "qemu-run"), "--timeout", str(timeout), *options, board]
    return _output_of([*emulator, str(image), *words], scene, target)


def table(scene: Scene, name: str) -> str:
    """The scene as a C table, from the loader that the host runs scenes with, with the file's own settings."""
    return _output_of([str(host_program("host", "cairn-table")), "-", name], scene, None)


def build_image(scene: Scene, target: str, image: Path, change: Callable[[str], str] | None = None) -> None:
    """Links the runner's firmware with a scene's table, changed where wished, and puts it into the given file."""
    emulated = CORES[target]
    text = table(scene, "cairn_the_scene")
    if change:
        text = change(text)
    _configure(emulated.preset)
    place = BUILDS / emulated.preset / "tools" / "runner"
    with lock(emulated.preset):
        source = place / emulated.board / "table.c"
        source.parent.mkdir(parents=True, exist_ok=True)
        source.write_text(text, encoding="utf-8")
        log = cmake("--build", str(BUILDS / emulated.preset), "--target", f"runner-{emulated.board}")
        if log and "overflowed by" in log:
            raise UserError(f"{scene.path}: does not fit into the memory of {emulated.board}")
        check_build(log)
        shutil.copy(place / f"runner-{emulated.board}.elf", image)


def _no_states(scene: Scene) -> Trajectory:
    return Trajectory(np.zeros(0, dtype=np.int64), np.zeros((0, len(scene.bodies), 6)))


def host_program(preset: str, name: str) -> Path:
    """A program of the host's, built where it is not up to date."""
    _configure(preset)
    with lock(preset):
        check_build(cmake("--build", str(BUILDS / preset), "--target", name))
    return BUILDS / preset / "tools" / "runner" / name


def host_library(preset: str) -> Path:
    """The engine as a shared library for cairn_tools.host, built where it is not up to date."""
    _configure(preset)
    with lock(preset):
        check_build(cmake("--build", str(BUILDS / preset), "--target", "cairn-shared"))
    return BUILDS / preset / "tools" / "host" / "libcairn-shared.so"


def profiler() -> Path:
    """The plugin for QEMU of tools/profile."""
    _configure("host")
    with lock("host"):
        check_build(cmake("--build", str(BUILDS / "host"), "--target", "cairn-profile"))
    return BUILDS / "host" / "tools" / "profile" / "libcairn-profile.so"


def build_target(preset: str, target: str, folder: str = "", options: Sequence[str] = ()) -> Path:
    """Builds one target where it is not up to date, in a folder of the preset's name or another; gives the folder."""
    place = BUILDS / (folder or preset)
    _configure(preset, folder, options)
    with lock(place.name):
        check_build(cmake("--build", str(place), "--target", target))
    return place


def _configure(preset: str, folder: str = "", options: Sequence[str] = ()) -> None:
    place = BUILDS / (folder or preset)
    with lock(place.name):
        if not (place / "build.ninja").is_file():
            check_build(cmake("--preset", preset, "-B", str(place), "-DCAIRN_BUILD_TESTS=OFF", *options))


def cmake(*arguments: str) -> str | None:
    """Runs CMake quietly; gives what it said if it failed."""
    done = subprocess.run(["cmake", *arguments], cwd=ROOT, capture_output=True, text=True, check=False)
    return None if done.returncode == 0 else done.stdout + done.stderr


def check_build(log: str | None) -> None:
    if log is None:
        return
    file = BUILDS / "build.log"
    file.write_text(log, encoding="utf-8")
    signs = ("error:", "CMake Error", "undefined reference")
    first = next((line for line in log.splitlines() if any(sign in line for sign in signs)), "cmake failed")
    raise EngineError(f"the engine does not build: {first.strip()} (all of it in {file})")


@contextmanager
def lock(name: str) -> Iterator[None]:
    """Keeps two commands from building in one folder at a time."""
    BUILDS.mkdir(parents=True, exist_ok=True)
    file = BUILDS / f"{name}.lock"
    with file.open("w", encoding="utf-8") as handle:
        fcntl.flock(handle, fcntl.LOCK_EX)
        yield


def _output_of(command: list[str], scene: Scene, target: str | None) -> str:
    """Standard output of the runner, fed with the scene file."""
    with scene.path.open("rb") as source:
        done = subprocess.run(command, stdin=source, capture_output=True, text=True, check=False)
    if done.returncode == 2 and target is None:
        raise UserError(f"{scene.path}: {done.stderr.strip().removeprefix('-: ')}")
    if done.returncode != 0:
        raise _failure(done, scene, target)
    return done.stdout


def _failure(done: subprocess.CompletedProcess[str], scene: Scene, target: str | None) -> Exception:
    """What to say of a runner that did not end well."""
    said = dict(
        line.split()[1:3] for line in done.stdout.splitlines() if line.startswith("error ") and line.count(" ") == 2
    )
    if "status" in said and "place" in said:
        place = int(said["place"])
        where = "(settings)" if place < 0 else f"bodies[{place}]"
        if place >= len(scene.bodies):
            where = f"springs[{place - len(scene.bodies)}]"
        return UserError(
            f"{scene.path}: {where}: refused by the engine: {STATUS.get(int(said['status']), said['status'])}"
        )
    if "status" in said and "event" in said and scene.play:
        number = int(said["event"])
        why = STATUS.get(int(said["status"]), said["status"])
        step = scene.play.events[number - 1].step
        return UserError(f"{scene.name}: event {number}, after step {step}: refused by the engine: {why}")
    lines = (done.stderr + done.stdout).strip().splitlines()
    on = target or "the host"
    if target and done.returncode > 100 and done.returncode != 124:
        return EngineError(f"{scene.name} on {on}: exception {done.returncode - 100}")
    return EngineError(f"{scene.name} on {on}: {lines[-1] if lines else f'exit code {done.returncode}'}")


def _parse(output: str, scene: Scene, got: Run) -> Run:
    """The runner's lines, see tools/runner/runner.h."""
    lines = iter(output.splitlines())
    steps: list[int] = []
    rows: list[str] = []
    contacts: list[str] = []
    ended = False
    for line in lines:
        name, _, rest = line.partition(" ")
        match name:
            case "state":
                steps.append(int(rest))
                rows += [next(lines) for _ in scene.bodies]
            case "cost":
                got.costs.append(int(rest))
            case "stat":
                key, value = rest.split()
                got.statistics[key] = int(value)
            case "contact":
                contacts.append(rest)
            case "hash":
                got.hash = rest
            case "stack":
                got.stack = int(rest)
            case "stack_before":
                got.stack_before = int(rest)
            case "end":
                ended = True
    if not ended:
        raise EngineError(f"{scene.name} on {got.target}: the runner's output breaks off")
    fixed = got.arithmetic == "q16"
    if steps:
        states = np.array(" ".join(rows).split(), dtype=np.float64).reshape(len(steps), len(scene.bodies), 6)
        got.trajectory = Trajectory(np.array(steps, dtype=np.int64), _in_si(states, scene, fixed))
    if contacts:
        got.contacts = np.array(" ".join(contacts).split(), dtype=np.float64).reshape(-1, 4)
        got.contacts /= 65536 if fixed else 1
    return got


def _in_si(states: np.ndarray, scene: Scene, fixed: bool) -> np.ndarray:
    """Metres and radians, the angles counted on from those in the scene file."""
    if fixed:
        states[:, :, [0, 1, 3, 4, 5]] /= 65536
        states[:, :, 2] *= 2 * math.pi / 2**32
    wanted = np.array([body.angle for body in scene.bodies])
    states[:, :, 2] += 2 * math.pi * np.round((wanted - states[0, :, 2]) / (2 * math.pi))
    return states
