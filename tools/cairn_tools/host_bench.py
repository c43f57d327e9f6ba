"""Time a step on the host, beside Debian's libraries of Chipmunk and Box2D: two large scenes, the engines in turn."""

from __future__ import annotations

import json
import math
import shutil
import statistics
import subprocess
import tempfile
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from . import bench, engine, peers, scene

PROJECT = peers.HERE / "host"
BUILD = peers.PLACE / "host"
FOLDER = engine.ROOT / "build" / "host-bench"
ROUNDS = 7
# Of their diameter, how far balls may lie in each other: an engine that lets them sink has less to solve.
PRESSED = 0.1
TIMEOUT = 600  # seconds a run; one takes about two

SETTINGS = peers.SETTINGS | {
    "chipmunk": "Debian's library, in double; 10 iterations; collision slop 0.005 m, by default 0.1",
    "box2d": "Debian's library, in single precision; 8 velocity and 3 position iterations; else as by default",
    "all": "one thread, by its own processor time; dt 1/60 s; no sleep; gcc -O2, the libraries as Debian builds them",
}

Say = Callable[[str], None]
Costs = Sequence[float]  # of one round's steps 121 to 240, in nanoseconds


@dataclass(frozen=True)
class Time:
    """Of one engine's step in one scene, over steps 121 to 240."""

    scene: str
    engine: str
    version: str
    microseconds: float  # mean over the steps of each one's median over the rounds
    fastest_round: float  # mean of its steps, in microseconds
    slowest_round: float
    times_cairn: float
    lowest_times: float  # of the rounds, each against Cairn in the same round
    highest_times: float
    from_start_microseconds: float  # over steps 1 to 240, in which everything falls and hits
    from_start_times_cairn: float
    farthest_move: float  # metres, of any moving body, from its start to step 240
    overlap: float  # of two balls at step 240, in their diameter; 0 without balls
    stands: bool


# ---- the scenes ----


def pyramid(rows: int) -> dict[str, Any]:
    """Crates of a metre as in pyramid10, each row one shorter than the one below."""
    crates = [
        {
            "shape": "crate",
            "position": [round(1.05 * (i - (rows - 1 - row) / 2), 4), round(0.51 + 1.01 * row, 4)],
        }
        for row in range(rows)
        for i in range(rows - row)
    ]
    shapes = {"ground": {"box": [50, 1]}, "crate": {"box": [1, 1]}}
    return {"shapes": shapes, "bodies": [{"type": "static", "shape": "ground", "position": [0, -0.5]}, *crates]}


def circles(columns: int, rows: int) -> dict[str, Any]:
    """Balls as in circles100, every other row shifted, that fall into a box and lie packed."""
    side, high = 0.3 * columns + 1, 0.6 * rows + 2
    walls = [{"type": "static", "shape": "wall", "position": [sign * side, high / 2]} for sign in (-1, 1)]
    balls = [
        {
            "shape": "ball",
            "position": [round(0.6 * (i - (columns - 1) / 2) + 0.05 * (row % 2), 3), round(0.4 + 0.6 * row, 3)],
        }
        for row in range(rows)
        for i in range(columns)
    ]
    shapes = {"ground": {"box": [2 * side + 2, 1]}, "wall": {"box": [1, high]}, "ball": {"circle": 0.25}}
    return {"shapes": shapes, "bodies": [{"type": "static", "shape": "ground", "position": [0, -0.5]}, *walls, *balls]}


SCENES: dict[str, Callable[[], dict[str, Any]]] = {
    "pyramid465": lambda: pyramid(30),
    "circles1000": lambda: circles(40, 25),
}


def load(name: str) -> scene.Scene:
    """One of them; its file is in build/host-bench."""
    FOLDER.mkdir(parents=True, exist_ok=True)
    path = FOLDER / f"{name}.json"
    material = {"static_friction": 0.5, "kinetic_friction": 0.5, "restitution": 0}
    data = {"cairn_scene": 1, "name": name, "materials": {"default": material}, **SCENES[name]()}
    path.write_text(json.dumps(data), encoding="utf-8")
    return scene.load(path)


# ---- the programs ----


def fetch() -> dict[str, str]:
    """Installs the libraries where they are missing; gives the versions of Debian's packages."""
    with engine.lock("peers"):
        done = subprocess.run([str(peers.HERE / "fetch"), "--host"], capture_output=True, text=True, check=False)
    if done.returncode != 0:
        lines = done.stderr.strip().splitlines()
        raise engine.EngineError(f"the libraries cannot be installed: {lines[-1] if lines else done.returncode}")
    return dict(line.split() for line in done.stdout.splitlines())


def settings(versions: dict[str, str]) -> dict[str, str]:
    """What the engines run with, and which they are."""
    return {f"{name} {versions[name]}" if name in versions else name: text for name, text in SETTINGS.items()}


def build(loaded: scene.Scene, folder: Path) -> None:
    """Links the programs of a scene into the folder."""
    text, own = peers.table(loaded), engine.table(loaded, "cairn_the_scene")
    own += peers.features(loaded, own)
    with engine.lock("peers-host"):
        for name, content in (("peer.c", text), ("cairn.c", own)):
            (BUILD / "tables").mkdir(parents=True, exist_ok=True)
            (BUILD / "tables" / name).write_text(content, encoding="utf-8")
        if not (BUILD / "build.ninja").is_file():
            options = ["-DCMAKE_BUILD_TYPE=RelWithDebInfo"]
            options += [f"-DCMAKE_{language}_FLAGS_RELWITHDEBINFO=-O2 -g" for language in ("C", "CXX")]
            engine.check_build(engine.cmake("-G", "Ninja", "-S", str(PROJECT), "-B", str(BUILD), *options))
        engine.check_build(engine.cmake("--build", str(BUILD)))
        for name in peers.ENGINES:
            shutil.copy(BUILD / f"peer-{name}", folder / name)


def run(program: Path) -> peers.Output:
    """One run of one engine."""
    done = subprocess.run(
        [str(program), str(bench.LAST_STEP)], capture_output=True, text=True, check=False, timeout=TIMEOUT
    )
    if done.returncode != 0:
        lines = (done.stderr + done.stdout).strip().splitlines()
        raise engine.EngineError(f"{program.name}: {lines[-1] if lines else f'exit code {done.returncode}'}")
    return peers.parse(done.stdout)


# ---- the measurement ----


def measure(loaded: scene.Scene, versions: dict[str, str], rounds: int, say: Say) -> list[Time]:
    """Runs the engines in turn, so that what else the machine does meets all of them."""
    outputs: dict[str, list[peers.Output]] = {name: [] for name in peers.ENGINES}
    with tempfile.TemporaryDirectory(prefix="cairn-") as folder:
        build(loaded, Path(folder))
        for turn in range(rounds):
            for name in peers.ENGINES:
                say(f"{loaded.name} on {name}, round {turn + 1} of {rounds}")
                outputs[name].append(run(Path(folder) / name))
    return times(loaded, versions, outputs)


def times(loaded: scene.Scene, versions: dict[str, str], outputs: dict[str, list[peers.Output]]) -> list[Time]:
    """What the rounds come to."""
    whole = {name: typical_step([output.costs for output in own]) for name, own in outputs.items()}
    costs = {name: [_steady(output) for output in own] for name, own in outputs.items()}
    typical = {name: typical_step(own) for name, own in costs.items()}
    means = {name: [statistics.mean(costs_of_one) for costs_of_one in own] for name, own in costs.items()}
    moves = {name: peers.farthest_move(loaded, own[-1]) for name, own in outputs.items()}
    found = []
    for name, own in outputs.items():
        ratios = [mine / cairns for mine, cairns in zip(means[name], means["cairn"], strict=True)]
        deepest = overlap(loaded, own[-1])
        # Balls of a pile flow past each other, in each engine in another way: only of crates it tells that they stand.
        limit = moves["cairn"] + peers.SLACK if name != "cairn" and not deepest else math.inf
        found.append(
            Time(
                scene=loaded.name,
                engine=name,
                version=versions.get(name, ""),
                microseconds=typical[name] / 1000,
                fastest_round=min(means[name]) / 1000,
                slowest_round=max(means[name]) / 1000,
                times_cairn=typical[name] / typical["cairn"],
                lowest_times=min(ratios),
                highest_times=max(ratios),
                from_start_microseconds=whole[name] / 1000,
                from_start_times_cairn=whole[name] / whole["cairn"],
                farthest_move=moves[name],
                overlap=deepest,
                stands=not peers.left(loaded, own[-1]) and moves[name] <= limit and deepest <= PRESSED,
            )
        )
    return found


def overlap(loaded: scene.Scene, output: peers.Output) -> float:
    """How deep the two balls lie in each other that do so most, in their diameter; infinite where one was lost."""
    ends = [end for body, end in zip(loaded.bodies, output.ends, strict=True) if not loaded.shape_of(body).corners]
    if not ends:
        return 0.0
    if None in ends:
        return math.inf
    radius = max(shape.radius for shape in loaded.shapes.values())
    places = np.array(ends)
    distances = np.hypot(*(places[:, None] - places[None]).transpose(2, 0, 1))
    np.fill_diagonal(distances, math.inf)
    return max(0.0, 1 - float(distances.min()) / (2 * radius))


def _steady(output: peers.Output) -> Costs:
    return output.costs[bench.FIRST_STEP - 1 : bench.LAST_STEP]


def typical_step(rounds: Sequence[Costs]) -> float:
    """Each step does the same in every round: its median over them leaves out where another program was in the way."""
    return statistics.mean(statistics.median(step) for step in zip(*rounds, strict=True))
