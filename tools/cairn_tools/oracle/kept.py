"""Runs of the oracle that are kept in the repository, tests/oracle/NAME.npz: `tools/cairn oracle --keep` makes them."""

from __future__ import annotations

from collections.abc import Callable
from hashlib import sha256
from pathlib import Path

import numpy as np

from .. import scene as scenes
from ..errors import UserError
from ..scene import Scene
from ..trajectory import Trajectory
from .model import bodies_of
from .simulate import run

FOLDER = Path(__file__).parents[3] / "tests" / "oracle"
EVERY = 4
FINENESS = 64
# Scenes of examples/scenes, and how many steps: those without a closed form.
STEPS = {
    "basic": 240,
    "boxes3": 240,
    "bridge": 240,
    "circles100": 60,
    "curtain150": 240,
    "instability": 240,
    "mass_proportions": 240,
    "mixed50": 60,
    "pyramid10": 240,
    "rolling_demo": 240,
    "stack10": 240,
    "tower": 240,
}
# What a processor's own sines and cosines may change before chaos makes more of it.
EQUAL = 1e-9


def keep(say: Callable[[str], None], names: list[str] | None = None) -> list[Path]:
    """Makes the files anew."""
    FOLDER.mkdir(parents=True, exist_ok=True)
    files = []
    for name in names or STEPS:
        say(name)
        of = scenes.load(scenes.find(name))
        got = run(of, STEPS[name], EVERY, FINENESS)
        if got.not_converged:
            raise UserError(f"{name}: {got.not_converged} solves did not converge, the worst to {got.residual:.1e} m/s")
        states = got.trajectory.states[:, _moving(of)]
        files.append(FOLDER / f"{name}.npz")
        np.savez_compressed(files[-1], steps=got.trajectory.steps, states=states, scene=_digest(of))
    return files


def load(scene: Scene) -> Trajectory | None:
    """A scene's kept run: none if there is no such file, or the scene was another one."""
    file = FOLDER / f"{scene.name}.npz"
    if not file.is_file():
        return None
    with np.load(file) as record:
        if str(record["scene"]) != _digest(scene):
            return None
        bodies = bodies_of(scene)
        states = np.repeat(bodies.placed(bodies.states)[None], len(record["steps"]), axis=0)
        states[:, _moving(scene)] = record["states"]
        return Trajectory(record["steps"], states)


def differs(scene: Scene, steps: int) -> float:
    """How far a new run of the first steps is from the kept one, in metres, radians and their rates."""
    kept = load(scene)
    if kept is None:
        raise UserError(f"{scene.name}: no kept run of this scene as it is; make it with tools/cairn oracle --keep")
    again = run(scene, steps, EVERY, FINENESS).trajectory
    return float(np.abs(again.states - kept.states[: len(again.steps)]).max())


def _moving(scene: Scene) -> list[int]:
    return [i for i, body in enumerate(scene.bodies) if not body.static]


def _digest(scene: Scene) -> str:
    """Of what the motion depends on: all of the scene but its file's place and the engine's own settings."""
    parts = (scene.shapes, scene.bodies, scene.springs, scene.materials, scene.gravity, scene.steps_per_second)
    return sha256(repr(parts).encode()).hexdigest()
