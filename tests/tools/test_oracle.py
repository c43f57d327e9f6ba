"""The oracle against closed forms and against the laws that it stands for."""

import math
from typing import Any

import numpy as np
import pytest
from cairn_tools import oracle, scene
from cairn_tools.oracle import closed_forms, solver
from scenes_for_oracle import made, material, on_slope

FLOOR = {"shape": "floor", "type": "static", "position": [0, -0.5]}
FRICTIONLESS = material(0.0, 0.0, 1.0, 0.0)
SPRING = {"a": 0, "b": 1, "rest_length": 1.5, "frequency": 1.2, "damping_ratio": 0.3}

SMOOTH = {
    "projectile": made([{"shape": "box", "position": [0, 0], "velocity": [3, 9], "angular_velocity": 2}]),
    "spring": made([{"shape": "disc", "position": [0, 4], "density": 2, "mask": 0},
                    {"shape": "pea", "position": [0, 2.2], "velocity": [0, 0.7], "mask": 0}], springs=[SPRING]),
    "disc rolls": made(on_slope(0.3, "disc"), materials=material(0.5)),
    "disc slides and turns": made(on_slope(1.2, "disc"), materials=material(0.3, 0.2)),
    "disc comes to roll": made(on_slope(0.0, "disc", velocity=[3, 0]), materials=material(0.5, 0.4)),
    "block slides": made(on_slope(0.6), materials=material(0.5, 0.4)),
    "block stops": made(on_slope(0.2, velocity=[2, 2 * math.tan(-0.2)]), materials=material(0.5, 0.4)),
    "ball bounces": made([FLOOR, {"shape": "pea", "position": [0, 1.25]}], materials=material(0, 0, 0.8)),
    "discs meet": made([{"shape": "disc", "position": [0, 0], "velocity": [4, 0], "angular_velocity": 3},
                        {"shape": "pea", "position": [3, 0.3], "density": 3, "velocity": [-2, 0]}],
                       gravity=[0, 0], materials=material(0.3, 0.2, 0.5)),
}  # fmt: skip


@pytest.mark.parametrize("name", SMOOTH)
def test_smooth_scenes_follow_their_closed_form(name: str) -> None:
    of = SMOOTH[name]
    known = closed_forms.find(of)
    assert known is not None
    got = oracle.run(of, 90, every=10, fineness=32)
    # Discs and blocks that stop do so within a part of a step: 5e-4 s long.
    limit = 2e-7 if name in ("disc comes to roll", "block stops") else 1e-9
    np.testing.assert_allclose(got.trajectory.states, known.trajectory(of, 90, 10).states, atol=limit)
    assert got.not_converged == 0


def kept(of: scene.Scene, states: np.ndarray) -> tuple[np.ndarray, float, float]:
    """Momentum, angular momentum about the origin, kinetic energy."""
    masses = np.array([body.density * of.shape_of(body).area for body in of.bodies])
    inertias = masses * np.array([1 / 6 if body.shape == "box" else of.shape_of(body).radius ** 2 / 2
                                  for body in of.bodies])  # fmt: skip
    x, y, _, vx, vy, omega = states.T
    energy = (masses * (vx**2 + vy**2) + inertias * omega**2).sum() / 2
    return masses @ states[:, 3:5], float(masses @ (x * vy - y * vx) + inertias @ omega), float(energy)


@pytest.mark.parametrize(("friction", "restitution"), [(0.0, 1.0), (0.5, 0.4)])
def test_impacts_keep_momentum_and_gain_no_energy(friction: float, restitution: float) -> None:
    bodies = [{"shape": "box", "position": [0, 0], "velocity": [4, 0], "angular_velocity": 1},
              {"shape": "box", "position": [3, 0.3], "density": 3, "velocity": [-2, 0], "angle": 0.7},
              {"shape": "disc", "position": [-3, 0.2], "velocity": [9, 0.1], "angular_velocity": -8}]  # fmt: skip
    of = made(bodies, gravity=[0, 0], materials=material(friction, friction, restitution, 0.0))
    got = oracle.run(of, 60, fineness=4)
    assert got.impacts >= 3
    momentum, spin, energy = kept(of, got.trajectory.states[0])
    after = kept(of, got.trajectory.states[-1])
    np.testing.assert_allclose(after[0], momentum, atol=1e-12)
    assert after[1] == pytest.approx(spin, abs=1e-8)
    if friction == 0:
        assert after[2] == pytest.approx(energy, rel=1e-9)
    assert (np.diff(got.energy) < 1e-9 * energy).all()


@pytest.mark.parametrize("beside", [-1e-4, 1e-4])
def test_a_box_on_a_slope_rests_below_the_friction_angle_and_slides_above_it(beside: float) -> None:
    angle = math.atan(0.5) + beside
    got = oracle.run(made(on_slope(angle), materials=material(0.5)), 60, every=60, fineness=16)
    way = np.hypot(*(got.trajectory.states[-1, 1, :2] - got.trajectory.states[0, 1, :2]))
    slides = max(0.0, 5 * (math.sin(angle) - 0.5 * math.cos(angle)))
    assert way == pytest.approx(slides, abs=1e-9)


def test_a_box_that_a_blow_set_sliding_has_the_kinetic_friction_until_it_stops() -> None:
    """Between both coefficients' angles: at rest it stays, once it slides it goes on."""
    angle = 0.5
    for speed, way in ((0.0, 0.0), (0.1, 0.1 + 5 * (math.sin(angle) - 0.4 * math.cos(angle)))):
        velocity = [speed * math.cos(angle), -speed * math.sin(angle)]
        got = oracle.run(made(on_slope(angle, velocity=velocity), materials=material(0.6, 0.4)), 60, fineness=8)
        moved = got.trajectory.states[-1, 1, :2] - got.trajectory.states[0, 1, :2]
        assert np.hypot(*moved) == pytest.approx(way, abs=1e-9)


def test_a_stack_presses_with_what_lies_above() -> None:
    got = oracle.run(scene.load(scene.find("stack10")), 4, fineness=16)
    assert len(got.contacts) == 10
    np.testing.assert_allclose(sorted(got.contacts[:, 2]), 10.0 * np.arange(1, 11), rtol=1e-6)
    np.testing.assert_allclose(got.contacts[:, 3:5], got.contacts[:, [2, 2]] / 2, rtol=1e-5)
    assert np.abs(got.contacts[:, 5]).max() < 1e-6


def test_a_pyramid_stands_and_nothing_sinks_in() -> None:
    got = oracle.run(scene.load(scene.find("pyramid10")), 60, every=4, fineness=16)
    assert got.not_converged == 0
    assert got.residual <= solver.TOLERANCE
    assert got.penetration.max() < 1e-6
    landed, end = got.trajectory.states[4], got.trajectory.states[-1]
    assert np.abs(end - landed)[:, :3].max() < 1e-8
    assert got.contacts[got.contacts[:, 0] == 0, 2].sum() == pytest.approx(550, rel=1e-6)


@pytest.mark.parametrize("what", ["disc on a disc", "box over an edge"])
def test_halving_the_step_quarters_the_error(what: str) -> None:
    if what == "disc on a disc":
        bodies: list[dict[str, Any]] = [
            {"shape": "disc", "type": "static", "position": [0, 0]},
            {"shape": "pea", "position": [0.75 * math.sin(0.2), 0.75 * math.cos(0.2)]},
        ]
    else:
        bodies = [{**FLOOR, "position": [-25, -0.5]}, {"shape": "box", "position": [0.1, 0.5]}]  # fmt: skip
    of = made(bodies, materials=material(2.0))
    ends = [oracle.run(of, 24, every=24, fineness=k).trajectory.states[-1, 1] for k in (4, 8, 16)]
    assert np.abs(ends[0] - ends[1]).max() > 1e-8
    assert np.abs(ends[0] - ends[1]).max() / np.abs(ends[1] - ends[2]).max() == pytest.approx(4, rel=0.25)


def test_what_is_held_stays_and_what_does_not_collide_passes() -> None:
    bodies = [FLOOR,
              {"shape": "box", "position": [0, 0.5], "fixed_rotation": True},
              {"shape": "pea", "position": [0.4, 1.25], "density": 9},
              {"shape": "disc", "position": [5, 3], "fixed_position": True, "angular_velocity": 3},
              {"shape": "pea", "position": [8, 1], "sensor": True},
              {"shape": "pea", "position": [11, 1], "layer": 2, "mask": 2}]  # fmt: skip
    got = oracle.run(made(bodies), 60, fineness=8).trajectory.states[-1]
    assert got[1, 2] == 0
    np.testing.assert_allclose(got[3], [5, 3, 3, 0, 0, 3], atol=1e-12)
    np.testing.assert_allclose(got[4:, 1], 1 - 5, atol=1e-9)


@pytest.mark.parametrize("method", oracle.METHODS)
def test_every_method_lets_boxes_come_to_rest(method: str) -> None:
    got = oracle.run(scene.load(scene.find("boxes3")), 120, every=60, fineness=4, method=method)
    assert got.not_converged == 0
    np.testing.assert_allclose(got.trajectory.states[-1, 1:, 1], [0.5, 1.5, 2.5], atol=1e-6)


def test_stiff_springs_are_done_in_smaller_steps_and_too_stiff_ones_refused() -> None:
    bodies = [{"shape": "pea", "type": "static", "position": [0, 0], "mask": 0},
              {"shape": "pea", "position": [0, -1], "mask": 0}]  # fmt: skip
    stiff = made(bodies, springs=[{"a": 0, "b": 1, "stiffness": 1e7, "damping": 0}])
    got, known = oracle.run(stiff, 6, fineness=1), closed_forms.find(stiff)
    assert known is not None
    assert np.abs(got.trajectory.poses - known.trajectory(stiff, 6).poses).max() < 1e-6
    with pytest.raises(scene.UserError, match="too stiff"):
        oracle.run(made(bodies, springs=[{"a": 0, "b": 1, "stiffness": 1e9, "damping": 1e9}]), 1)


def test_what_does_not_converge_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(solver, "NEWTON_ROUNDS", 0)
    monkeypatch.setattr(solver, "MOST_ROUNDS", 0)
    got = oracle.run(scene.load(scene.find("stack10")), 1, fineness=1)
    assert got.not_converged > 0
    assert got.residual > 1e-3


@pytest.mark.parametrize("wrong", [{"steps": -1}, {"every": 0}, {"fineness": 0}, {"method": "euler"}])
def test_wrong_arguments_are_refused(wrong: dict[str, Any]) -> None:
    with pytest.raises(ValueError, match="steps"):
        oracle.run(made([FLOOR]), **{"steps": 1, **wrong})
