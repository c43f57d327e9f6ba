"""Trajectories, their CSV, and the distance between two of them."""

import io
import math
from pathlib import Path

import numpy as np
import pytest
from cairn_tools import compare, scene
from cairn_tools.trajectory import CSV_HEADER, Trajectory


def pair_of_bodies() -> scene.Scene:
    ball = scene.Shape("circle", 1.0)
    bodies = [scene.Body("ball", (0, 0), type="static"), scene.Body("ball", (0, 3)), scene.Body("ball", (0, 6))]
    return scene.Scene("pair", {"ball": ball}, bodies, Path("pair.json"))


def run(steps: int = 3) -> Trajectory:
    return Trajectory(np.arange(steps), np.zeros((steps, 3, 6)))


def test_equal_runs_do_not_differ() -> None:
    got = compare.overall(pair_of_bodies(), run(), run())
    assert (got.rms_position, got.max_position, got.rms_angle, got.max_angle) == (0, 0, 0, 0)


def test_differences_are_over_the_bodies_that_move() -> None:
    other = run()
    other.states[2, 1, :3] = (3, 4, 0.5)
    other.states[2, 0, 0] = 100  # a static body: not counted
    got = compare.overall(pair_of_bodies(), run(), other)
    assert (got.max_position, got.max_angle, got.worst_body) == (5, 0.5, 1)
    assert got.rms_position == pytest.approx(5 / math.sqrt(6))
    by_step = compare.differences(pair_of_bodies(), run(), other)
    assert [d.max_position for d in by_step] == [0, 0, 5]
    assert by_step[2].rms_position == pytest.approx(5 / math.sqrt(2))


def test_runs_at_other_steps_are_refused() -> None:
    with pytest.raises(ValueError, match="different steps"):
        compare.overall(pair_of_bodies(), run(3), run(4))


def test_selected_steps_keep_the_first_and_the_last() -> None:
    entries = compare.differences(pair_of_bodies(), run(101), run(101))
    steps = [d.step for d in compare.selected(entries, 5)]
    assert steps == [0, 25, 50, 75, 100]


def test_csv_has_a_row_a_body_a_step_and_reads_back_exactly() -> None:
    wanted = Trajectory(np.array([0, 5]), np.random.default_rng(1).normal(size=(2, 3, 6)) * 1e-4)
    wanted.states[0, 0, 0] = -0.0
    out = io.StringIO()
    wanted.write_csv(out)
    header, *rows = out.getvalue().splitlines()
    assert header == CSV_HEADER == "step,body,x,y,angle,vx,vy,omega"
    assert [row.split(",")[:2] for row in rows] == [[s, b] for s in ("0", "5") for b in "012"]
    assert "-0," not in out.getvalue()
    read = np.loadtxt(io.StringIO("\n".join(rows)), delimiter=",")
    np.testing.assert_array_equal(read[:, 2:].reshape(2, 3, 6), wanted.states)
