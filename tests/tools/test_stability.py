"""tools/cairn stability: what holds goes on holding, and the measures themselves are right."""

import json
import math
import subprocess
from collections.abc import Callable, Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from cairn_tools import engine, host, scene
from cairn_tools.stability import command, fast, measure, model, report
from cairn_tools.stability.cases import CASES
from cairn_tools.stability.hold import HOLD

ROOT = Path(__file__).parents[2]


def stability(*arguments: str) -> subprocess.CompletedProcess[str]:
    command = [ROOT / "tools" / "cairn", "stability", *arguments]
    return subprocess.run(command, capture_output=True, text=True, check=False)


@pytest.mark.parametrize("held", sorted(HOLD))
def test_what_held_once_holds(held: str) -> None:
    name, engine = held.split(":")
    result = model.run(name, engine)
    assert not result.error, result.error
    short = [figure for figure in result.figures if not figure.ok and not figure.stretch]
    assert not short, short


def test_the_scenes_of_the_slides_stack_fall_under_the_slides_scheme() -> None:
    for name in ("scene-stack10", "scene-tower", "scene-pyramid10", "scene-stack20"):
        assert not model.run(name, "q16", "slides").ok, name


@pytest.mark.parametrize("arithmetic", model.ENGINES)
def test_what_falls_under_the_slides_scheme_stands_under_the_small_solver(arithmetic: str) -> None:
    for name in ("scene-stack10", "scene-tower", "scene-pyramid10"):
        result = model.run(name, arithmetic, "small")
        assert result.ok and not result.decides, name


def test_a_row_is_under_the_other_solvers_too_where_they_may_fall() -> None:
    assert command.jobs("all", ["scene-stack20"], ["q16"], []) == [
        ("scene-stack20", "q16", solver) for solver in ("soft", "slides", "small")
    ]
    falls, holds = (model.Result("scene-tower", "q16", solver, [model.most("a", value, 1.0)], 0.0)
                    for solver, value in (("slides", 2.0), ("small", 0.5)))  # fmt: skip
    assert report.closing([falls, holds, holds]).endswith(
        "; under the slides' scheme 1 of 1 fall; under the small solver 0 of 2 fall"
    )


@pytest.mark.parametrize("arithmetic", model.ENGINES)
def test_a_scene_file_with_the_small_solver_is_built_as_the_runner_runs_it(arithmetic: str) -> None:
    loaded = replace(scene.load(scene.find("pyramid10")), solver="small", passes=5)
    world, bodies = host.build(loaded, arithmetic)
    world.step(60)
    wanted = engine.run(loaded, arithmetic, "host", 60, 60)
    assert np.allclose(world.states(bodies)[:, :2], wanted.trajectory.states[-1][:, :2], rtol=0, atol=2**-16)
    if arithmetic == "q16":
        assert world.hash == wanted.hash


def test_a_verdict_is_by_the_limits_and_never_by_a_stretch_target() -> None:
    def result(*figures: model.Figure) -> model.Result:
        return model.Result("scene-tower", "q16", "soft", list(figures), 0.0)

    assert result(model.most("a", 1.0, 1.0), model.least("b", 2.0, 2.0), model.stretch("c", 9.0, 0.0)).ok
    assert not result(model.most("a", 1.1, 1.0)).ok
    assert not result(model.least("a", 0.9, 1.0)).ok
    assert not result(model.most("a", math.nan, 1.0)).ok


def test_a_case_that_breaks_or_measures_nothing_does_not_hold(monkeypatch: pytest.MonkeyPatch) -> None:
    def breaks(bench: model.Bench) -> Iterator[model.Figure]:
        yield model.most("a", 0.0, 1.0)
        raise ValueError("broken")

    def empty(bench: model.Bench) -> list[model.Figure]:
        return []

    for check, word in ((breaks, "broken"), (empty, "measured nothing")):
        monkeypatch.setitem(CASES, "odd", model.Case("odd", "", check))
        result = model.run("odd", "q16")
        assert not result.ok
        assert word in result.error


def overlap(add: Callable[[host.World], None]) -> float:
    world = host.World(gravity=(0.0, 0.0))
    add(world)
    return measure.Outlines(world).penetration()


def test_penetration_of_boxes_is_the_least_way_apart() -> None:
    def boxes(world: host.World) -> None:
        world.add(world.box(2, 1), 0, 0)
        world.add(world.box(2, 1), 1.75, 0.5)

    assert overlap(boxes) == pytest.approx(0.25)


def test_penetration_of_turned_boxes() -> None:
    def boxes(world: host.World) -> None:
        world.add(world.box(1, 1), 0, 0)
        world.add(world.box(1, 1), 0, 0.5 + math.sqrt(0.5) - 0.01, angle=math.pi / 4)

    assert overlap(boxes) == pytest.approx(0.01, abs=3e-5)


@pytest.mark.parametrize(
    ("x", "y", "depth"), [(0.75, 0.0, 0.05), (0.0, 0.4, 0.4), (0.6, 0.6, 0.3 - math.hypot(0.1, 0.1))]
)
def test_penetration_of_a_circle_at_a_face_inside_and_at_a_corner(x: float, y: float, depth: float) -> None:
    def both(world: host.World) -> None:
        world.fixed(world.box(1, 1), 0, 0)
        world.add(world.circle(0.3), x, y)

    assert overlap(both) == pytest.approx(depth, abs=3e-5)


def test_penetration_of_circles_and_of_what_is_apart() -> None:
    def near(world: host.World) -> None:
        world.add(world.circle(0.5), 0, 0)
        world.add(world.circle(0.25), 0.7, 0)

    def apart(world: host.World) -> None:
        world.add(world.circle(0.5), 0, 0)
        world.add(world.regular(5, 0.5), 1.1, 0)

    assert overlap(near) == pytest.approx(0.05, abs=3e-5)
    assert overlap(apart) == 0.0


def test_bodies_are_created_and_read_back() -> None:
    for arithmetic, close in (("q16", 2e-5), ("f64", 1e-12)):
        world = host.World(arithmetic)
        triangle = world.polygon([(0, 0), (3, 0), (0, 3)])
        body = world.add(triangle, 1.0, 2.0, 0.5, velocity=(3.0, -4.0), omega=2.0, density=2.0)
        (state,) = world.states([body])
        turned = (math.cos(0.5) - math.sin(0.5), math.sin(0.5) + math.cos(0.5))
        assert state == pytest.approx([1 + turned[0], 2 + turned[1], 0.5, 3.0, -4.0, 2.0], abs=close)
        assert world.mass(body) == pytest.approx(9.0, rel=1e-5)


@pytest.mark.parametrize("name", ["basic", "bridge", "curtain_demo", "rolling_demo"])
def test_a_scene_built_in_python_ends_in_the_state_of_the_runner(name: str) -> None:
    loaded = scene.load(scene.find(name))
    world, _ = host.build(loaded)
    world.step(240)
    assert world.hash == engine.run(loaded, "q16", "host", 240, 0).hash


def test_what_the_engine_refuses_is_an_error_with_its_status() -> None:
    world = host.World(bodies=1)
    with pytest.raises(host.HostError) as refused:
        world.polygon([(0, 0), (1, 0), (2, 0)])
    assert refused.value.status == -5
    world.add(world.circle(1), 0, 0)
    with pytest.raises(host.HostError) as full:
        world.add(world.circle(1), 0, 0)
    assert full.value.status == -4


def test_a_removed_body_has_no_state() -> None:
    world = host.World()
    body = world.add(world.circle(1), 0, 0)
    world.remove(body)
    assert np.isnan(world.states([body])).all()


def test_recorded_angles_count_on_over_whole_turns() -> None:
    world = host.World(gravity=(0.0, 0.0))
    world.add(world.circle(1), 0, 0, omega=5.0)
    states = world.record(600, every=10)
    assert states[-1, 0, host.ANGLE] == pytest.approx(50.0, abs=1e-3)


@pytest.mark.parametrize("dynamic", [False, True])
@pytest.mark.parametrize("speed", [10.0, 100.0])
def test_a_throw_that_meets_no_wall_is_seen_to_pass(dynamic: bool, speed: float) -> None:
    seen = 0
    for seed in range(40):
        thrown = fast.throw(model.Bench("q16"), seed, speed, dynamic)
        thrown.world.set_layers(thrown.body, 1, 0)
        states = thrown.world.record(20, 1, [thrown.body, thrown.wall])
        seen += fast.passes(states, thrown.half)
    # The most grazing ones at 10 m/s are not through after 20 steps.
    assert seen >= 36


def test_the_command_says_which_rows_fall_short_by_its_exit_code() -> None:
    good = stability("--case", "scene-stack10", "--engine", "q16", "--solver", "soft", "slides", "--json")
    rows = json.loads(good.stdout)
    assert good.returncode == 0
    assert [(row["solver"], row["ok"]) for row in rows] == [("soft", True), ("slides", False)]
    assert "no such case" in stability("--case", "nothing").stderr
