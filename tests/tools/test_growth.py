"""How costs grow with the bodies."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import pytest
from cairn_tools import bench_tables, engine, growth
from cairn_tools.growth import Point


def test_the_crossover_lies_between_two_sizes_by_a_straight_line() -> None:
    assert growth.crossover([10, 20, 40], [100, 200, 800], [150, 220, 780]) == pytest.approx(30)


def test_the_crossover_is_the_last_one() -> None:
    assert growth.crossover([10, 20, 30, 40], [2, 0, 0, 2], [1, 1, 1, 1]) == pytest.approx(35)


def test_a_quadtree_that_always_or_never_pays() -> None:
    assert growth.crossover([10, 20], [5, 9], [4, 5]) == 10
    assert growth.crossover([10, 20], [5, 9], [6, 9]) is None


@pytest.mark.parametrize("kind", growth.KINDS)
@pytest.mark.parametrize("count", [10, 25, 101])
def test_a_world_has_its_bodies_and_none_overlap(kind: str, count: int) -> None:
    loaded = growth.load(kind, count, "quadtree")
    moving = [body for body in loaded.bodies if not body.static]
    assert len(moving) == count
    assert growth.load(kind, count, "quadtree").path.read_text() == loaded.path.read_text()
    for i, one in enumerate(moving):
        for other in moving[:i]:
            apart = max(abs(one.position[0] - other.position[0]), abs(one.position[1] - other.position[1]))
            assert apart > 0.5


def point(kind: str, broad_phase: str, bodies: int, per_body: float) -> Point:
    return Point(kind, broad_phase, "m0", bodies, bodies * per_body, int(2 * bodies * per_body), 3, 700 + bodies, "0")


def points() -> list[Point]:
    costs = {50: (1000, 1100), 200: (1500, 1210)}
    return [
        point(kind, broad, size, both[k])
        for kind in growth.KINDS
        for size, both in costs.items()
        for k, broad in enumerate(growth.BROAD_PHASES)
    ]


def test_the_summary_tells_growth_a_body() -> None:
    pile, sparse = growth.summary(points())
    assert (pile["kind"], sparse["kind"]) == ("pile", "sparse")
    assert pile["pairs"]["growth_percent"] == pytest.approx(50)
    assert pile["quadtree"] == {"growth_percent": pytest.approx(10), "per_body": 1210}
    # Whole steps cross: 5,000 fewer for the pairs at 50 bodies, 58,000 more at 200.
    assert pile["crossover"] == pytest.approx(50 + 150 * 5 / 63)
    assert pile["stack_bytes"] == 900


def test_sizes_that_were_not_measured_have_no_growth() -> None:
    only = [replace(p, bodies=p.bodies + 1) for p in points()]
    assert growth.summary(only)[0]["quadtree"] == {"growth_percent": None, "per_body": None}
    assert len(bench_tables.growth_tables(only)) == 2


def test_growth_is_drawn_and_told(tmp_path: Path) -> None:
    growth.plot(points(), "m0", tmp_path / "growth.png")
    assert (tmp_path / "growth.png").read_bytes().startswith(b"\x89PNG")
    record = json.loads(json.dumps(bench_tables.growth_record(points())))
    assert len(record["points"]) == 8 and record["points"][0]["per_body"] == 1000
    assert [table.row_count for table in bench_tables.growth_tables(points())] == [4, 2]


def test_a_broad_phase_that_changes_what_happens_is_an_error(monkeypatch: pytest.MonkeyPatch) -> None:
    def measured(loaded, core):
        return type("Cost", (), {
            "mean_instructions": 1.0, "worst_instructions_from_start": 1, "points": 0, "step_stack_bytes": 1,
            "hash": loaded.name,
        })  # fmt: skip

    monkeypatch.setattr(growth.bench, "measure", measured)
    with pytest.raises(engine.EngineError, match="broad phase"):
        growth.measure(["m0"], [10], lambda _: None)


def test_a_table_reads_as_markdown() -> None:
    lines = bench_tables.as_markdown(bench_tables.growth_tables(points())[1]).splitlines()
    assert lines[0].startswith("| core | world | crossover |")
    assert lines[1] == "| --- | --- | ---: | ---: | ---: | ---: | ---: |"
    assert lines[2] == "| m0 | pile | 62 | +50 % | +10 % | 1,210 | 900 |"
    assert lines[-1] == "From 50 to 200 bodies."
