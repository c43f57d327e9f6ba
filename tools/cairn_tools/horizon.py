"""How long two runs of a scene can be compared body by body: until a twin that starts one LSB away went its own way.

The twin has every moving body a last bit of Q16.16 (2^-16 m) to the right or the left, in turn. While the scene is
regular it stays that near, or a hundred times as far where contacts open and close at other steps; where it is chaotic
it leaves by powers of ten. The horizon is the last step before the twins of fixed point or those of double are
SEPARATED apart, 330 times the start: whichever comes first, since the one tells of the rounding and the other of the
physics. Beyond it a distance between two runs tells of chance.
"""

from __future__ import annotations

import itertools
import tempfile
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from . import engine, scene
from .scene import Scene
from .trajectory import Trajectory

LSB = 2.0**-16
SEPARATED = 0.005  # metres, of the body that is farthest from its twin


@dataclass(frozen=True)
class Twins:
    """A run and its twin: how far apart they are, in LSB."""

    engine: str
    at_end: float
    largest: float
    horizon: int  # the last step before they are SEPARATED; the last of all if they never are


@dataclass(frozen=True)
class Horizon:
    """The last step that bodies are compared at, and whether that is because of chaos."""

    step: int
    chaotic: bool
    twins: list[Twins]


def find(loaded: Scene, runs: dict[str, Trajectory]) -> Horizon:
    """Of runs that recorded every step, by the name of their arithmetic."""
    steps = int(next(iter(runs.values())).steps[-1])
    with tempfile.TemporaryDirectory(prefix="cairn-") as folder:
        moved = perturbed(loaded, Path(folder))
        pairs = {name: (run, engine.run(moved, name, "host", steps, 1).trajectory) for name, run in runs.items()}
    twins = [apart(loaded, name, *pair) for name, pair in pairs.items()]
    first = min(pair.horizon for pair in twins)
    return Horizon(first, first < steps, twins)


def apart(loaded: Scene, name: str, run: Trajectory, twin: Trajectory) -> Twins:
    """Of two runs that recorded the same steps."""
    moving = [i for i, body in enumerate(loaded.bodies) if not body.static]
    way = (run.poses - twin.poses)[:, moving, :2]
    farthest = np.hypot(way[:, :, 0], way[:, :, 1]).max(axis=1, initial=0.0)
    left = np.flatnonzero(farthest > SEPARATED)
    last = max(int(left[0]) - 1, 0) if len(left) else len(farthest) - 1
    return Twins(name, float(farthest[-1] / LSB), float(farthest.max() / LSB), int(run.steps[last]))


def perturbed(loaded: Scene, folder: Path) -> Scene:
    """The scene with the moving bodies an LSB aside, with the same settings, in a file of that folder."""
    sides = itertools.cycle((LSB, -LSB))
    return scene.shifted(loaded, [(0.0 if body.static else next(sides), 0.0) for body in loaded.bodies], folder)
