"""Scenes with a closed form: they are found, and the formulas keep the laws that they stand for."""

import math

import numpy as np
import pytest
from cairn_tools import scene
from cairn_tools.oracle import closed_forms
from scenes_for_oracle import made, material, on_slope

NONE = {"mask": 0}


def found(of: scene.Scene) -> closed_forms.ClosedForm:
    form = closed_forms.find(of)
    assert form is not None
    return form


@pytest.mark.parametrize(
    ("name", "kind"), [("projectile", "projectile"), ("spring", "spring"), ("rolling", "rolling"), ("bounce", "bounce")]
)
def test_the_smooth_scenes_are_found(name: str, kind: str) -> None:
    assert found(scene.load(scene.find(name))).name == kind


@pytest.mark.parametrize("name", ["pyramid10", "curtain150", "mixed50", "bridge", "boxes3", "heavy100"])
def test_other_scenes_have_none(name: str) -> None:
    assert closed_forms.find(scene.load(scene.find(name))) is None


def test_a_projectile_flies_along_its_parabola() -> None:
    got = found(scene.load(scene.find("projectile"))).trajectory(scene.load(scene.find("projectile")), 60, 30)
    assert list(got.steps) == [0, 30, 60]
    np.testing.assert_allclose(got.states[-1, 0], [10, 7, 0, 10, 2, 0], atol=1e-14)


@pytest.mark.parametrize("ratio", [0.0, 0.3, 1.0, 3.0])
def test_a_spring_obeys_its_equation(ratio: float) -> None:
    """x'' as differences of x' is the force over the mass, for both ends free and one with gravity."""
    spring = {"a": 0, "b": 1, "rest_length": 1.5, "frequency": 1.2, "damping_ratio": ratio}
    for held in (True, False):
        bodies = [{"shape": "disc", "position": [0, 4], "density": 2, **({"type": "static"} if held else {}), **NONE},
                  {"shape": "pea", "position": [0, 2.2], "velocity": [0, 0.7], **NONE}]  # fmt: skip
        form = found(made(bodies, springs=[spring]))
        mass = math.pi * np.array([2 * 0.25, 0.0625])
        inverse = np.array([0 if held else 1 / mass[0], 1 / mass[1]])
        turn = 2 * math.pi * 1.2
        for t in (0.0, 0.37, 2.9):
            now, d = form.states(t), 1e-5
            slope = (form.states(t + d)[:, 3:5] - form.states(t - d)[:, 3:5])[:, 1] / (2 * d)
            length, rate = now[0, 1] - now[1, 1], now[0, 4] - now[1, 4]
            force = (turn**2 * (length - 1.5) + 2 * ratio * turn * rate) / inverse.sum()
            want = np.array([-force * inverse[0] - (0 if held else 10), force * inverse[1] - 10])
            np.testing.assert_allclose(slope, want, atol=1e-6)


def test_a_disc_rolls_down_a_slope_at_two_thirds_of_the_pull() -> None:
    angle = 0.3
    form = found(made(on_slope(angle, "disc"), materials=material(0.5)))
    way = form.states(2.0)[1, :2] - form.states(0.0)[1, :2]
    assert np.hypot(*way) == pytest.approx(10 * math.sin(angle) * 2 / 3 * 2, abs=1e-12)
    assert form.states(2.0)[1, 5] == pytest.approx(-np.hypot(*form.states(2.0)[1, 3:5]) / 0.5, abs=1e-12)


def test_a_disc_on_a_steep_slope_slides_and_turns() -> None:
    angle = 1.2
    got = found(made(on_slope(angle, "disc"), materials=material(0.3, 0.2))).states(1.0)[1]
    assert np.hypot(*got[3:5]) == pytest.approx(10 * (math.sin(angle) - 0.2 * math.cos(angle)), abs=1e-12)
    assert got[5] == pytest.approx(-10 * 0.2 * math.cos(angle) * 2 / 0.5, abs=1e-12)


def test_a_sliding_disc_comes_to_roll_with_two_thirds_of_its_speed() -> None:
    got = found(made(on_slope(0.0, "disc", velocity=[3, 0]), materials=material(0.5, 0.4))).states(2.0)[1]
    np.testing.assert_allclose(got[3:], [2, 0, -4], atol=1e-12)


def test_a_block_below_the_friction_angle_stops_and_above_it_does_not() -> None:
    stopped = found(made(on_slope(0.2, velocity=[2, 2 * math.tan(-0.2)]), materials=material(0.5, 0.4)))
    assert np.abs(stopped.states(5.0)[1, 3:]).max() == 0
    sliding = found(made(on_slope(0.6), materials=material(0.5, 0.4)))
    speed = np.hypot(*sliding.states(1.0)[1, 3:5])
    assert speed == pytest.approx(10 * (math.sin(0.6) - 0.4 * math.cos(0.6)), abs=1e-12)


def test_a_block_that_would_tip_has_none() -> None:
    assert closed_forms.find(made(on_slope(0.9), materials=material(2.0))) is None


def test_the_horizon_is_where_the_floor_ends() -> None:
    form = found(made(on_slope(0.0, "disc", velocity=[5, 0], angular_velocity=-10.0), materials=material(0.5)))
    assert form.horizon == pytest.approx(5.0)


def test_a_ball_bounces_to_the_square_of_the_restitution() -> None:
    form = found(made([{"shape": "floor", "type": "static", "position": [0, -0.5]},
                       {"shape": "pea", "position": [0, 5.25]}], materials=material(0, 0, 0.8)))  # fmt: skip
    apexes = 1.0 + np.cumsum([1.6, 1.28, 1.024]) - np.array([0.8, 0.64, 0.512])
    for time, height in zip(apexes, 5 * 0.64 ** np.arange(1, 4), strict=True):
        np.testing.assert_allclose(form.states(time)[1], [0, 0.25 + height, 0, 0, 0, 0], atol=1e-12)
    assert form.states(60.0)[1, 1] == pytest.approx(0.25, abs=1e-12)


@pytest.mark.parametrize(("friction", "restitution"), [(0.0, 1.0), (0.3, 1.0), (0.1, 0.5), (2.0, 0.0)])
def test_two_discs_keep_momentum_and_lose_what_restitution_says(friction: float, restitution: float) -> None:
    bodies = [{"shape": "disc", "position": [0, 0], "velocity": [4, 0]},
              {"shape": "pea", "position": [3, 0.3], "density": 3, "velocity": [-2, 0]}]  # fmt: skip
    form = found(made(bodies, gravity=[0, 0], materials=material(friction, friction, restitution)))
    assert form.name == "impact"
    mass = np.array([0.25, 3 * 0.0625]) * math.pi
    inertia = mass / 2 * np.array([0.25, 0.0625])

    def kept(t: float) -> tuple[np.ndarray, float, float]:
        s = form.states(t)
        spin = mass @ (s[:, 0] * s[:, 4] - s[:, 1] * s[:, 3]) + inertia @ s[:, 5]
        return mass @ s[:, 3:5], spin, float(mass @ (s[:, 3:5] ** 2).sum(axis=1) + inertia @ s[:, 5] ** 2) / 2

    before, after = kept(0.0), kept(2.0)
    np.testing.assert_allclose(after[0], before[0], atol=1e-12)
    assert after[1] == pytest.approx(before[1], abs=1e-12)
    if friction == 0:
        assert after[2] == pytest.approx(before[2], abs=1e-12)
    else:
        assert after[2] < before[2]
