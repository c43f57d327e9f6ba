"""Costs of copies of a scene that lie a little elsewhere."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from cairn_tools import bench, bench_tables, copies, scene
from cairn_tools.app import app
from cairn_tools.errors import UserError
from typer.testing import CliRunner


@pytest.fixture(scope="module")
def stack() -> scene.Scene:
    return scene.load(scene.find("stack10"))


def test_what_moves_is_moved_by_little_and_what_stands_is_not(stack: scene.Scene, tmp_path: Path) -> None:
    for body, other in zip(stack.bodies, copies.moved(stack, 1, tmp_path).bodies, strict=True):
        apart = max(abs(body.position[0] - other.position[0]), abs(body.position[1] - other.position[1]))
        assert (apart == 0) == body.static
        assert apart <= copies.MOST


def test_a_seed_is_a_copy_of_its_own(stack: scene.Scene, tmp_path: Path) -> None:
    one, again, other = (copies.moved(stack, seed, tmp_path).bodies for seed in (1, 1, 2))
    assert one == again
    assert one != other


def test_the_spread_is_that_of_the_copies(stack: scene.Scene, tmp_path: Path) -> None:
    costs = [bench.measure(copies.moved(stack, seed, tmp_path), "m3") for seed in (1, 2)]
    first, second = (cost.mean_instructions for cost in costs)
    assert first != second
    spread = copies.measure(stack, "m3", 2, lambda _: None)
    assert spread.mean == pytest.approx((first + second) / 2)
    assert spread.standard_error == pytest.approx(abs(first - second) / 2)
    assert (spread.least, spread.most) == (min(first, second), max(first, second))
    assert spread.most_worst == max(cost.worst_instructions_from_start for cost in costs)


def test_the_command_prints_them() -> None:
    done = CliRunner().invoke(app, ["bench", "--core", "m3", "--scene", "stack10", "--copies", "1", "--json"])
    (row,) = json.loads(done.stdout)
    assert (row["copies"], row["standard_error"]) == (1, None)
    assert row["mean"] == row["least"] == row["most"]
    assert len(bench_tables.copies_table([copies.Spread(**row)]).rows) == 1


@pytest.mark.parametrize("other", ["--cycles", "--profile", "--growth", "--host", "--peers", "--keep", "--memory"])
def test_copies_and_other_measurements_do_not_go_together(other: str) -> None:
    assert isinstance(CliRunner().invoke(app, ["bench", "--copies", "2", other]).exception, UserError)
