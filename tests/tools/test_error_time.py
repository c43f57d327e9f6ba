"""Error against run time: what is measured of poses, which points are on the front, and whether peers are beaten."""

from __future__ import annotations

import json
import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from cairn_tools import scene
from cairn_tools.accuracy import error_time, frames, integrators, plot, rows, tables
from cairn_tools.accuracy.reference import Reference
from cairn_tools.accuracy.rows import Errors, Row, Settings
from cairn_tools.errors import UserError

CRATE = scene.Shape("box", 0.0, ((-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5)))


def scene_of(name: str) -> scene.Scene:
    return scene.load(scene.find(name))


@pytest.fixture
def pair() -> scene.Scene:
    """A crate on the ground, which is a crate too."""
    bodies = [scene.Body("crate", (0, 0), type="static"), scene.Body("crate", (0, 1))]
    return scene.Scene("pair", {"crate": CRATE}, bodies, Path("pair.json"))


def still(frames_: int, height: float) -> np.ndarray:
    poses = np.zeros((frames_, 2, 3))
    poses[:, 1, 1] = height
    return poses


def against(poses: np.ndarray, frames_: int) -> Reference:
    return Reference("test", (len(poses) - 1) / 30, (frames_ - 1) / 30, poses[:frames_])


def test_a_body_that_sinks_and_one_that_hovers_are_as_wrong(pair: scene.Scene) -> None:
    exact = against(still(31, 1.0), 31)
    for height in (0.99, 1.01):
        got = frames.errors(pair, still(31, height), exact)
        wanted = (0.01, 0.01, 0.01, max(1 - height, 0))
        assert (got.rms_error, got.largest_error, got.contact_error, got.penetration) == pytest.approx(wanted)
        assert (got.drift, got.energy_gained) == (0, 0)


def test_positions_are_compared_up_to_the_horizon_only(pair: scene.Scene) -> None:
    poses = still(31, 1.0)
    poses[11:, 1, 0] = 0.3
    assert frames.errors(pair, poses, against(still(31, 1.0), 11)).largest_error == 0
    assert frames.errors(pair, poses, against(still(31, 1.0), 12)).largest_error == pytest.approx(0.3)


def test_a_body_in_free_fall_rests_on_nothing_and_gains_nothing(pair: scene.Scene) -> None:
    poses = still(31, 30.0)
    poses[:, 1, 1] -= 5 * (np.arange(31) / 30) ** 2
    got = frames.errors(pair, poses, against(poses, 31))
    assert math.isnan(got.contact_error)
    assert got.energy_gained == pytest.approx(0, abs=1e-9)


def test_a_lost_body_is_infinitely_wrong(pair: scene.Scene) -> None:
    poses = still(31, 1.0)
    poses[20:, 1] = math.nan
    assert frames.errors(pair, poses, against(still(31, 1.0), 31)).rms_error == math.inf


def test_settings_hold_the_default_and_each_of_its_neighbours() -> None:
    loaded = scene_of("balls50")
    settings = error_time.settings_of_cairn(loaded)
    own = Settings.of(loaded)
    assert own.quadtree and own in settings
    assert {replace(own, sleep=True), replace(own, quadtree=False), replace(own, substeps=16)} <= set(settings)
    assert {replace(own, solver="small", passes=n, quadtree=True) for n in error_time.PASSES} <= set(settings)
    assert len(settings) == len(set(settings)) == 34
    assert len({s.label for s in settings}) == 34


def test_a_scene_without_those_frames_is_refused() -> None:
    with pytest.raises(UserError, match="steps_per_second: must be a multiple of 30"):
        error_time.of(replace(scene_of("stack10"), steps_per_second=50))
    assert error_time.of(scene_of("mixed50"))[1] == 4.0


def row(cost: float, error: float, engine: str = "cairn", **changes: object) -> Row:
    settings = Settings(engine, **changes)
    is_default = settings == Settings()
    return Row("pair", "m0", settings, is_default, 2.0, 2.0, "test", cost, round(cost), cost,
               Errors(error, error, error, error, math.nan, 0.0, 0.0))  # fmt: skip


def test_the_front_is_what_nothing_beats_in_both() -> None:
    points = [row(4, 1, substeps=8), row(2, 3), row(1, 5, substeps=1), row(3, 4, substeps=5), row(9, math.nan)]
    assert [r.instructions_per_frame for r in error_time.front(points, "rms_error")] == [1, 2, 4]


def test_a_peer_that_is_cheaper_or_nearer_is_told() -> None:
    points = [row(2, 3.0), row(20, 4.0, "chipmunk"), row(20, 2.0, "box2d", passes=8), row(1, 9.0, "box2d", passes=4)]
    found = {(v.peer.passes, v.below_and_left) for v in error_time.verdicts(points) if v.measure == "rms_error"}
    assert found == {(10, True), (8, False), (4, False)}
    lines = tables.sentences(points)
    assert "NOT below and left of box2d, 8 iterations, 60 Hz (2.0e+00 to 3.0e+00, 10.0 times" in lines[0]
    assert len(lines) == 2  # there is no contact error here
    assert not tables.sentences([row(2, 0.0), row(20, 0.0, "chipmunk")])  # nothing touches
    assert "all 1 points" in tables.sentences(points[:2])[0]


def test_tables_and_json_hold_every_point() -> None:
    points = [row(2, 3.0), row(5, 2.0, substeps=8), row(20, math.inf, "chipmunk")]
    (table,) = tables.tables(points)
    assert table.row_count == 3
    record = json.loads(json.dumps(tables.record(points), allow_nan=False))
    assert [entry["errors"]["rms_error"] for entry in record] == [3.0, 2.0, None]
    assert record[1]["front"] == ["rms_error", "penetration"]


def test_the_plot_is_a_file_a_scene(tmp_path: Path) -> None:
    points = [row(2, 3.0), row(5, 2.0, substeps=8), row(20, 4.0, "chipmunk"), row(30, math.inf, "box2d")]
    points += [row(3, 9.0, solver="small"), row(3, 9.5, solver="slides")]
    (file,) = plot.write(points, tmp_path)
    assert file.name == "error-time-pair.png" and file.stat().st_size > 10_000


def test_a_point_is_measured_on_a_core_and_is_the_same_twice() -> None:
    loaded = scene_of("rolling")
    own, coarse = (rows.measure(loaded, settings, "m3", 1.0) for settings in (Settings(), Settings(substeps=1)))
    assert own.is_default and not coarse.is_default
    assert own == rows.measure(loaded, Settings(), "m3", 1.0)
    assert own.reference.startswith("closed form") and own.compared_seconds == 1.0
    assert 500 < coarse.instructions_per_step < own.instructions_per_step < 20_000
    assert own.errors.rms_error < coarse.errors.rms_error < 0.05


def test_adams_bashforth_is_more_accurate_at_fine_steps_and_no_more_stable() -> None:
    points = {(p.method, p.steps_per_second): p for p in integrators.measure(lambda _: None)}
    euler, adams = ({rate: points[method, rate] for rate in integrators.RATES} for method in integrators.METHODS)
    assert adams[3840].rms_error < 0.3 * euler[3840].rms_error
    assert adams[60].energy_ratio > 1000 > 2 > euler[60].energy_ratio
    # Euler's keeps the energy within bounds up to w dt = 2; the other has left all bounds long before.
    assert math.isfinite(euler[16].rms_error) and math.isinf(euler[15].rms_error)
    assert math.isinf(adams[30].rms_error)
    (table,) = integrators.tables(list(points.values()))
    assert table.row_count == len(integrators.RATES)
