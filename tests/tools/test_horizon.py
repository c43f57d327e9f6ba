"""How long runs can be compared: twins of scenes that are chaotic, and of some that are not."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from cairn_tools import compare, engine, horizon, scene
from cairn_tools.trajectory import Trajectory


def scene_of(name: str) -> scene.Scene:
    return scene.load(scene.find(name))


def runs(loaded: scene.Scene, steps: int) -> dict[str, Trajectory]:
    return {name: engine.run(loaded, name, "host", steps, 1).trajectory for name in ("q16", "f64")}


@pytest.mark.parametrize("name", ["projectile", "stack10"])
def test_a_regular_scene_has_no_horizon_but_the_last_step(name: str) -> None:
    found = horizon.find(scene_of(name), runs(scene_of(name), 60))
    assert (found.step, found.chaotic) == (60, False)
    assert all(1 <= pair.largest < 10 for pair in found.twins)


def test_a_heap_that_falls_together_is_chaotic() -> None:
    found = horizon.find(scene_of("mixed50"), runs(scene_of("mixed50"), 90))
    assert found.chaotic and 15 < found.step < 60
    assert found.step == min(pair.horizon for pair in found.twins)


def test_the_horizon_is_the_last_step_before_the_twins_are_apart() -> None:
    loaded = scene_of("projectile")
    run, twin = (Trajectory(np.arange(4), np.zeros((4, 1, 6))) for _ in range(2))
    twin.states[2:, 0, 0] = horizon.SEPARATED * 1.01
    assert horizon.apart(loaded, "q16", run, twin).horizon == 1
    assert horizon.apart(loaded, "q16", run, run).horizon == 3


def test_the_twin_is_an_lsb_aside_in_turn_and_keeps_the_settings(tmp_path: Path) -> None:
    loaded = replace(scene_of("stack10"), substeps=7, steps_per_second=30)
    twin = horizon.perturbed(loaded, tmp_path)
    aside = [b.position[0] - a.position[0] for a, b in zip(loaded.bodies, twin.bodies, strict=True)]
    assert aside[:4] == [0, horizon.LSB, -horizon.LSB, horizon.LSB]
    assert (twin.substeps, twin.steps_per_second) == (7, 30)


def test_compare_stops_at_the_horizon_and_goes_on_with_what_is_left() -> None:
    got = compare.compare(scene_of("mixed50"), 60, lambda _: None, with_oracle=False)
    assert list(got.errors) == ["rounding"]
    assert got.errors["rounding"][-1].step == got.horizon.step < 60
    assert [it.run for it in got.outcomes] == ["q16", "f64"]
    assert all(it.energy < 0 and it.highest_energy < 0.1 for it in got.outcomes)


def test_three_errors_add_up_to_the_total() -> None:
    got = compare.compare(scene_of("rolling"), 30, lambda _: None)
    rounding, solver, time_step, total = (got.overall[name].max_position for name in (*compare.ERRORS, "total"))
    assert got.reference == "closed form: rolling"
    # Symplectic Euler lags by half a sub-step's way: what is left in a converged run is the time step's.
    assert rounding < solver < 0.1 * time_step
    assert time_step - solver - rounding <= total <= time_step + solver + rounding
    assert [it.run for it in got.outcomes] == list(compare.RUNS)


def test_a_converged_run_of_what_the_engine_integrates_exactly_has_no_error() -> None:
    for name in ("projectile", "spring", "bounce"):
        got = compare.compare(scene_of(name), 100, lambda _: None)
        assert got.overall["time step"].max_position < 1e-6
        assert got.overall["solver"].max_position < 1e-6
