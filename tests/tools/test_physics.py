"""Energy, momentum, rest and overlap, from states alone."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest
from cairn_tools import scene
from cairn_tools.overlap import Surfaces
from cairn_tools.physics import Physics
from cairn_tools.trajectory import Trajectory

SHAPES = {
    "ball": scene.Shape("circle", 0.5),
    "crate": scene.Shape("box", 0.0, ((-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5))),
    # A box of 1 x 1 whose origin is its lower left corner.
    "corner": scene.Shape("polygon", 0.0, ((0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0))),
}


def scene_of(*bodies: scene.Body, springs: tuple[scene.Spring, ...] = ()) -> scene.Scene:
    return scene.Scene("test", SHAPES, list(bodies), Path("test.json"), list(springs))


def states(*bodies: tuple[float, ...]) -> np.ndarray:
    """One record."""
    return np.array([[[*body, *[0.0] * (6 - len(body))] for body in bodies]])


def test_energy_is_of_motion_height_and_springs() -> None:
    spring = scene.Spring(0, 1, rest_length=1.0, stiffness=50.0)
    loaded = scene_of(scene.Body("crate", (0, 0), type="static"), scene.Body("crate", (0, 2)), springs=(spring,))
    start, later = states((0, 0), (0, 2)), states((0, 0), (0, 3, 0, 2, 0, 6))
    energy = Physics(loaded).energy(np.concatenate([start, later]))
    assert energy[0] == pytest.approx(25)  # 1/2 k 1^2
    # m = 1, I = 1/6, a metre higher at 10 m/s^2, the spring 2 m longer than at rest.
    assert energy[1] == pytest.approx(2 + 3 + 10 + 100)


def test_heights_are_of_the_centre_of_mass() -> None:
    loaded = scene_of(scene.Body("corner", (0, 0)))
    turned = states((0, 0, math.pi / 2))  # the box is now left of its origin
    np.testing.assert_allclose(Physics(loaded).centres(turned)[0, 0], (-0.5, 0.5))
    assert Physics(loaded).heights(turned)[0] == pytest.approx(0.5)


def test_momentum_is_of_what_moves() -> None:
    loaded = scene_of(scene.Body("crate", (0, 0), density=3), scene.Body("ball", (5, 0), type="static"))
    np.testing.assert_allclose(Physics(loaded).momentum(states((0, 0, 0, 1, -2), (5, 0)))[0], (3, -6))


def test_time_to_rest_is_when_nothing_moves_any_more() -> None:
    loaded = scene_of(scene.Body("ball", (0, 0)))
    run = Trajectory(np.arange(4), np.concatenate([states((0, 0, 0, v)) for v in (1.0, 0.005, 0.5, 0.0)]))
    assert Physics(loaded).time_to_rest(run) == 3 / 60
    assert math.isnan(Physics(loaded).time_to_rest(Trajectory(run.steps[:3], run.states[:3])))
    assert Physics(loaded).time_to_rest(Trajectory(run.steps[3:], run.states[3:])) == 0


def test_gaps_are_of_the_poses_whatever_the_origin() -> None:
    loaded = scene_of(scene.Body("corner", (0, 0)), scene.Body("crate", (0, 0)), scene.Body("ball", (0, 0)))
    poses = states((0, 0), (1.48, 0.5), (1.9, 1.6))[0]
    a, b, gap = Surfaces.of(loaded).gaps(poses, within=0.2)
    found = {(int(i), int(j)): value for i, j, value in zip(a, b, gap, strict=True)}
    assert found == {(0, 1): pytest.approx(-0.02), (1, 2): pytest.approx(0.1)}
    assert Surfaces.of(loaded).penetration(poses) == pytest.approx(0.02)


def test_bodies_that_do_not_meet_have_no_overlap() -> None:
    springs = (scene.Spring(0, 1, rest_length=1.0, stiffness=1.0, collide=False),)
    bodies = (scene.Body("ball", (0, 0)), scene.Body("ball", (0, 0)), scene.Body("ball", (0, 0), sensor=True))
    assert Surfaces.of(scene_of(*bodies, springs=springs)).penetration(states((0, 0), (0, 0), (0, 0))[0]) == 0
