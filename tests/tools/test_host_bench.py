"""`bench --host`: the scenes, and what the rounds come to. Installs nothing: runs the peers where they are."""

from __future__ import annotations

import json
import math
import shutil
import subprocess
from ctypes.util import find_library
from dataclasses import asdict, replace
from pathlib import Path

import pytest
from cairn_tools import bench, bench_tables, engine, host_bench, peers, scene

VERSIONS = {"chipmunk": "7.0.3-5", "box2d": "2.4.1-3"}


def output_of(loaded: scene.Scene, costs: list[int]) -> peers.Output:
    places: list[peers.Point | None] = [body.position for body in loaded.bodies]
    return peers.Output(starts=places, ends=list(places), costs=costs)


def outputs_of(loaded: scene.Scene, units: dict[str, list[int]]) -> dict[str, list[peers.Output]]:
    """A round of an engine takes the same in every step, in nanoseconds."""
    return {name: [output_of(loaded, [unit] * bench.LAST_STEP) for unit in own] for name, own in units.items()}


@pytest.fixture
def pyramid() -> scene.Scene:
    return host_bench.load("pyramid465")


@pytest.mark.parametrize(("name", "moving"), [("pyramid465", 465), ("circles1000", 1000)])
def test_a_scene_has_its_bodies_and_none_overlap(name: str, moving: int) -> None:
    loaded = host_bench.load(name)
    assert host_bench.load(name).path.read_text() == loaded.path.read_text()
    places = [body.position for body in loaded.bodies if not body.static]
    assert len(places) == moving
    size = 1.0 if name == "pyramid465" else 0.5
    for i, (x, y) in enumerate(places):
        assert all(max(abs(x - a), abs(y - b)) >= size for a, b in places[:i])
    # Nothing starts in the ground or a wall.
    assert min(y for _, y in places) > size / 2
    walls = [abs(body.position[0]) - 0.5 for body in loaded.bodies if body.shape == "wall"]
    assert all(max(abs(x) for x, _ in places) + size / 2 < wall for wall in walls)
    assert host_bench.overlap(loaded, output_of(loaded, [])) == 0


def test_the_scenes_compile_for_the_peers(pyramid: scene.Scene, tmp_path: Path) -> None:
    file = tmp_path / "peer.c"
    file.write_text(peers.table(pyramid))
    subprocess.run(["gcc", "-std=c99", "-Wall", "-Werror", "-fsyntax-only", f"-I{peers.HERE}", str(file)], check=True)


def test_a_step_is_taken_as_its_median_over_the_rounds() -> None:
    # Another program was in the way of one step of the second round.
    assert host_bench.typical_step([[10, 20], [10, 900], [12, 22]]) == pytest.approx((10 + 22) / 2)


def test_times_are_ratios_to_cairn_in_the_same_round(pyramid: scene.Scene) -> None:
    units = {"cairn": [1000, 2000, 1000], "chipmunk": [3000, 4000, 2000], "box2d": [500, 500, 500]}
    cairn, chipmunk, box2d = host_bench.times(pyramid, VERSIONS, outputs_of(pyramid, units))
    assert (cairn.microseconds, cairn.times_cairn, cairn.slowest_round) == (1.0, 1.0, 2.0)
    assert (chipmunk.microseconds, chipmunk.times_cairn) == (3.0, 3.0)
    assert (chipmunk.lowest_times, chipmunk.highest_times) == (2.0, 3.0)
    assert (box2d.times_cairn, box2d.version, box2d.from_start_times_cairn) == (0.5, "2.4.1-3", 0.5)
    assert cairn.stands and chipmunk.stands and box2d.stands


def test_only_steps_121_to_240_count_but_for_the_whole(pyramid: scene.Scene) -> None:
    outputs = outputs_of(pyramid, {"cairn": [1000]})
    outputs["cairn"][0].costs[: bench.FIRST_STEP - 1] = [9000] * (bench.FIRST_STEP - 1)
    (cairn,) = host_bench.times(pyramid, VERSIONS, outputs)
    assert cairn.microseconds == 1.0
    assert cairn.from_start_microseconds == pytest.approx(5.0)


def test_a_pyramid_that_fell_does_not_stand(pyramid: scene.Scene) -> None:
    outputs = outputs_of(pyramid, {name: [1000] for name in peers.ENGINES})
    x, y = pyramid.bodies[-1].position
    outputs["box2d"][0].ends[-1] = (x + 3, y - 20)
    outputs["chipmunk"][0].ends[-1] = None
    times = host_bench.times(pyramid, VERSIONS, outputs)
    assert [time.stands for time in times] == [True, False, False]


def test_balls_that_sank_into_each_other_do_not_stand() -> None:
    loaded = host_bench.load("circles1000")
    outputs = outputs_of(loaded, {name: [1000] for name in peers.ENGINES})
    x, y = loaded.bodies[-1].position
    outputs["chipmunk"][0].ends[-2] = (x + 0.4, y)
    outputs["box2d"][0].ends[-2] = None
    cairn, chipmunk, box2d = host_bench.times(loaded, VERSIONS, outputs)
    assert cairn.stands and not chipmunk.stands and not box2d.stands
    assert chipmunk.overlap == pytest.approx(0.2)
    assert box2d.overlap == math.inf


def test_times_are_told(pyramid: scene.Scene) -> None:
    units = {"cairn": [1000], "chipmunk": [3000], "box2d": [500]}
    times = host_bench.times(pyramid, VERSIONS, outputs_of(pyramid, units))
    times[2] = replace(times[2], stands=False)
    assert json.loads(json.dumps([asdict(time) for time in times]))[1]["times_cairn"] == 3
    lines = bench_tables.as_markdown(bench_tables.host_table(times)).splitlines()
    assert lines[2] == "| pyramid465 | cairn | 1 | 1-1 | 1.00 | - | 1 | 1.00 | 0.00 | - |"
    assert lines[3] == "| pyramid465 | chipmunk | 3 | 3-3 | 3.00 | 3.00-3.00 | 3 | 3.00 | 0.00 | - |"
    assert lines[4].endswith("| 0.00 FELL | - |")


def test_settings_name_the_versions() -> None:
    assert "box2d 2.4.1-3" in host_bench.settings(VERSIONS)


def test_a_program_that_fails_is_an_error(tmp_path: Path) -> None:
    program = tmp_path / "peer"
    program.write_text("#!/bin/sh\necho error the engine refuses the scene\nexit 1\n")
    program.chmod(0o755)
    with pytest.raises(engine.EngineError, match="refuses the scene"):
        host_bench.run(program)


@pytest.mark.skipif(
    not (find_library("chipmunk") and find_library("box2d") and Path("/usr/include/chipmunk/chipmunk.h").exists()),
    reason="libchipmunk-dev and libbox2d-dev are not installed",
)
@pytest.mark.skipif(not shutil.which("g++"), reason="no C++ compiler")
def test_the_engines_run_a_scene_in_turn() -> None:
    said: list[str] = []
    stack = scene.load(scene.find("stack10"))
    times = host_bench.measure(stack, VERSIONS, 2, said.append)
    assert [time.engine for time in times] == list(peers.ENGINES)
    assert [line.split(" on ")[1].split(",")[0] for line in said] == [*peers.ENGINES, *peers.ENGINES]
    assert all(time.stands and time.microseconds > 0 for time in times)
