"""The cases of the scene files: 3600 steps at 4 sub-steps, sleep off."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from .. import scene
from ..host import X, Y
from .measure import Outlines, fastest, moved
from .model import Bench, Figure, case, least, most

STEPS = 3600
EVERY = 10
SECOND = 60 // EVERY  # records of the last second


def _run(bench: Bench, name: str) -> tuple[np.ndarray, float, Outlines]:
    """States of what moves, the deepest penetration of the last second, and the outlines."""
    world = bench.scene(scene.load(scene.find(name)))
    outlines = Outlines(world)
    places = [outlines.bodies.index(body) for body in world.moving]
    everything = world.record(STEPS, EVERY, outlines.bodies)
    deepest = max(outlines.penetration(states) for states in everything[-SECOND:])
    return everything[:, places], deepest, outlines


@case("no centre moves more than 0.1 m", over={"name": ["stack10", "tower"]}, name="scene", quick=True, baseline=True)
def stands_still(bench: Bench, name: str) -> Iterator[Figure]:
    states, deepest, _ = _run(bench, name)
    yield most("moved", moved(states), 0.1, "m")
    yield most("penetration", deepest, 0.01, "m")


# The scene starts with gaps of 10 mm: closing them takes the top down by 0.1 m in the first second.
@case("horizontally from the start, and in all from step 120, no more than 0.1 m (the 10 mm gaps of the start close)",
      name="scene-pyramid10", quick=True, baseline=True)  # fmt: skip
def pyramid10(bench: Bench) -> Iterator[Figure]:
    states, deepest, _ = _run(bench, "pyramid10")
    yield most("moved sideways", moved(states, axes=(X,)), 0.1, "m")
    yield most("moved since step 120", moved(states, 120 // EVERY), 0.1, "m")
    yield most("penetration", deepest, 0.01, "m")


@case("stands: no centre is half a crate from its place", over={"name": ["stack20", "heavy100"]}, name="scene",
      quick=True, baseline=True)  # fmt: skip
def stands(bench: Bench, name: str) -> Iterator[Figure]:
    states, deepest, _ = _run(bench, name)
    yield most("moved", moved(states), 0.5, "m")
    yield most("speed in the last second", fastest(states[-SECOND:]), 0.01, "m/s")
    if name == "heavy100":
        yield most("penetration", deepest, 0.01, "m")


@case("comes to rest inside its walls, penetration at most 1 cm", over={"name": ["circles100", "mixed50"]},
      name="scene", quick=True, baseline=True)  # fmt: skip
def comes_to_rest(bench: Bench, name: str) -> Iterator[Figure]:
    states, deepest, _ = _run(bench, name)
    half = 3.5 if name == "circles100" else 4.0  # between the walls
    yield most("farthest from the middle", np.abs(states[-1, :, X]).max(), half, "m")
    yield least("lowest centre", states[-1, :, Y].min(), 0.0, "m")
    yield most("speed in the last second", fastest(states[-SECOND:]), 0.01, "m/s")
    yield most("penetration", deepest, 0.01, "m")


@case("hangs still", name="scene-curtain150", quick=True, baseline=True)
def curtain150(bench: Bench) -> Iterator[Figure]:
    states, _, _ = _run(bench, "curtain150")
    yield most("speed in the last second", fastest(states[-SECOND:]), 0.01, "m/s")
    yield most("moved in the last second", moved(states[-SECOND:]), 0.001, "m")
    yield most("lowest bead under the rail", (6.0 - states[-1, :, Y]).max(), 4.0, "m")
