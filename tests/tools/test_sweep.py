"""tools/cairn sweep: every combination once, rows that can be trusted, and a file that a killed sweep goes on with."""

import csv
import json
import math
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path

import cloudpickle
import pytest
from cairn_tools import engine, scene
from cairn_tools.errors import UserError
from cairn_tools.sweep import cluster, command, measure, settings, table
from dask.distributed import LocalCluster

ROOT = Path(__file__).parents[2]


def cairn(*arguments: object) -> subprocess.CompletedProcess[str]:
    command = [ROOT / "tools" / "cairn", "sweep", *map(str, arguments)]
    return subprocess.run(command, capture_output=True, text=True, check=False)


@pytest.fixture(scope="module")
def scheduler() -> Iterator[str]:
    """A cluster that is there already: threads of this process."""
    measure.prepare()
    with LocalCluster(n_workers=1, threads_per_worker=2, processes=False, protocol="tcp://",
                      dashboard_address=None) as cluster:  # fmt: skip
        yield cluster.scheduler_address


def swept(file: Path, scheduler: str, names: list[str], vary: list[str], seconds: float = 0.5) -> command.Swept:
    return command.sweep(settings.jobs(names, vary, []), file, seconds, scheduler, 0, lambda done, total: None)


def row_of(name: str, *vary: str, seconds: float = 2.0, core: str = "") -> measure.Measured:
    (job,) = settings.jobs([name], list(vary), [core] if core else [])
    return measure.row(job, seconds).measured


# ---- jobs ----


def test_every_combination_is_one_row() -> None:
    jobs = settings.jobs(["stack10", "tower"], ["substeps=2,4,4", "seed=0..2"], [])
    assert len({job.key for job in jobs}) == len(jobs) == 12


def test_settings_that_the_solver_does_not_use_make_no_rows() -> None:
    jobs = settings.jobs(["stack10"], ["solver=soft,slides,small", "substeps=2,4", "passes=5,10,20"], [])
    told = sorted((job.settings.solver, job.settings.substeps, job.settings.passes) for job in jobs)
    passes = [(solver, 0, n) for solver in ("slides", "small") for n in (5, 10, 20)]
    assert told == [*passes, ("soft", 2, 0), ("soft", 4, 0)]


def test_double_runs_on_no_core() -> None:
    jobs = settings.jobs(["stack10"], ["engine=q16,f64"], ["m0", "m3"])
    assert [(job.settings.engine, job.settings.core) for job in jobs] == [("q16", "m0"), ("q16", "m3"), ("f64", "")]


def test_settings_reach_the_scene() -> None:
    vary = ["gravity=0.5", "mass=3", "friction=2", "rate=120", "sleep=on", "quadtree=on", "substeps=8"]
    (job,) = settings.jobs(["stack10"], vary, [])
    got, own = scene.parse(settings.changed(job), Path("x")), scene.load(scene.find("stack10"))
    assert (got.gravity[1], got.steps_per_second, got.sleep) == (0.5 * own.gravity[1], 120, True)
    assert (got.substeps, got.broad_phase) == (8, "quadtree")
    assert got.bodies[-1].density == 3 * own.bodies[-1].density
    assert got.material("default").static_friction == 2 * own.material("default").static_friction


def test_a_seed_moves_what_moves_and_leaves_springs_at_rest() -> None:
    jobs = settings.jobs(["bridge"], ["seed=0,1,2", "jitter=0.01"], [])
    first, second, third = (scene.parse(settings.changed(job), Path("x")) for job in jobs)
    assert second.bodies[0] == first.bodies[0] and first.bodies[0].static
    moves = [math.dist(a.position, b.position) for a, b in zip(first.bodies, second.bodies, strict=True)]
    assert 0.005 < max(moves) <= math.hypot(0.01, 0.01)
    assert second.bodies != third.bodies
    assert [s.rest_length for s in second.springs] == [s.rest_length for s in first.springs]


# ---- rows ----


@pytest.mark.parametrize("name", ["basic", "curtain_demo"])
def test_a_row_ends_in_the_state_of_the_runner(name: str) -> None:
    assert row_of(name).hash == engine.run(scene.load(scene.find(name)), "q16", "host", 120, 0).hash


def test_the_quadtree_costs_and_changes_no_bit_and_sleep_pays() -> None:
    plain, tree, asleep = (row_of("stack10", *vary, seconds=4.0, core="m0")
                           for vary in ([], ["quadtree=on"], ["sleep=on"]))  # fmt: skip
    assert plain.hash == tree.hash and plain.instructions_mean != tree.instructions_mean
    assert plain.instructions_mean is not None and asleep.instructions_mean is not None
    assert asleep.instructions_mean < plain.instructions_mean / 2


def test_a_stack_stands_and_rounding_is_small() -> None:
    got = row_of("stack10", seconds=4.0)
    assert (got.bodies, got.points, got.dropped, got.failure) == (11, 20, 0, "")
    assert 0 < got.penetration_mean < got.penetration_worst < 0.01
    assert 0 < got.drift < got.moved < 0.1
    assert 0 < got.error_rms < got.error_max < 1e-3


def test_energy_counts_springs() -> None:
    # Undamped: of the 50 J that go to and fro nothing is lost; position and velocity are half a sub-step apart.
    got = row_of("spring", "damping=0", "engine=f64", seconds=4.0)
    assert got.moved > 0.1
    assert abs(got.energy_gained) < 0.5 and abs(got.energy_lost) < 0.5
    assert got.error_max is None


def test_what_the_engine_refuses_is_a_row_with_a_reason() -> None:
    got = row_of("stack10", "mass=1e6")
    assert "density" in got.failure and got.hash == ""


# ---- the file ----


@pytest.mark.parametrize("ending", ["csv", "parquet"])
def test_rows_in_the_file_are_not_run_again(tmp_path: Path, scheduler: str, ending: str) -> None:
    whole, parts = tmp_path / f"whole.{ending}", tmp_path / f"parts.{ending}"
    first = swept(parts, scheduler, ["spring"], ["substeps=2,4"])
    second = swept(parts, scheduler, ["spring", "bounce"], ["substeps=4,8,2"])
    swept(whole, scheduler, ["bounce", "spring"], ["substeps=2,4,8"])
    assert (first.ran, second.ran, second.asked, second.rows) == (2, 4, 6, 6)
    assert whole.read_bytes() == parts.read_bytes()
    assert sorted(file.name for file in tmp_path.iterdir()) == [f"parts.{ending}", f"whole.{ending}"]


def test_a_torn_line_of_a_killed_sweep_is_run_again(tmp_path: Path, scheduler: str) -> None:
    file = tmp_path / "a.csv"
    journal = tmp_path / "a.csv.rows"
    jobs = settings.jobs(["spring"], ["substeps=2,4,8"], [])
    lines = [json.dumps(measure.row(job, 0.5).flat()) for job in jobs]
    journal.write_text(f"{lines[0]}\n{lines[1]}\n{lines[2][:40]}")
    assert swept(file, scheduler, ["spring"], ["substeps=2,4,8"]).ran == 1
    assert not journal.exists()
    assert [row["substeps"] for row in csv.DictReader(file.open())] == ["2", "4", "8"]


def test_a_killed_sweep_goes_on_where_it_was(tmp_path: Path) -> None:
    file, journal = tmp_path / "a.parquet", tmp_path / "a.parquet.rows"
    arguments = ["stack10", "--vary", "substeps=1..8", "seed=0..2", "--seconds", "20", "--out", str(file), "--json"]
    running = subprocess.Popen([ROOT / "tools" / "cairn", "sweep", *arguments], stderr=subprocess.DEVNULL)
    until = time.monotonic() + 60
    while not (journal.exists() and journal.read_text().count("\n") >= 3) and time.monotonic() < until:
        time.sleep(0.02)
    running.send_signal(signal.SIGKILL)
    running.wait()
    kept = journal.read_text().count("\n")
    assert 3 <= kept < 24
    got = json.loads(cairn(*arguments).stdout)
    assert (got["ran"], got["rows"]) == (24 - kept, 24)


def test_an_interrupted_sweep_writes_what_it_has(tmp_path: Path, scheduler: str) -> None:
    file = tmp_path / "a.csv"

    def stop(done: int, total: int) -> None:
        if done == 3:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        command.sweep(settings.jobs(["spring"], ["substeps=1..8"], []), file, 0.5, scheduler, 0, stop)
    assert len(table.read(file)) == 3
    assert swept(file, scheduler, ["spring"], ["substeps=1..8"]).ran == 5


# ---- bad input ----


def test_a_file_that_is_no_sweep_or_another_one_is_refused(tmp_path: Path, scheduler: str) -> None:
    with pytest.raises(UserError, match=r"\.csv or \.parquet"):
        swept(tmp_path / "a.txt", scheduler, ["spring"], [])
    file = tmp_path / "a.csv"
    file.write_text("a,b\n1,2\n")
    with pytest.raises(UserError, match="not a results file"):
        swept(file, scheduler, ["spring"], [])
    broken = tmp_path / "a.parquet"
    broken.write_text("nothing")
    with pytest.raises(UserError, match="not a results file"):
        swept(broken, scheduler, ["spring"], [])
    file.unlink()
    swept(file, scheduler, ["spring"], [])
    with pytest.raises(UserError, match=r"of 0\.5 s, not of 1 s"):
        swept(file, scheduler, ["spring"], [], seconds=1.0)
    other = tmp_path / "spring.json"
    other.write_text(scene.find("spring").read_text() + "\n")
    with pytest.raises(UserError, match="another scene named spring"):
        swept(file, scheduler, [str(other)], [])
    file.write_text(file.read_text().replace(measure.build(), "00000000"))
    with pytest.raises(UserError, match="another engine"):
        swept(file, scheduler, ["spring"], [])


def test_two_sweeps_into_one_file_at_a_time_are_refused(tmp_path: Path) -> None:
    jobs = settings.jobs(["spring"], [], [])
    with (
        table.Results(tmp_path / "a.csv", jobs, 1.0),
        pytest.raises(UserError, match="another sweep"),
        table.Results(tmp_path / "a.csv", jobs, 1.0),
    ):
        pass


@pytest.mark.parametrize(
    ("arguments", "what"),
    [
        (["nowhere", "--out", "a.csv"], "no such scene"),
        (["stack10"], "--out"),
        (["stack10", "--out", "/nowhere/a.csv"], "/nowhere"),
        (["stack10", "--out", "a.csv", "--scheduler", "tcp://127.0.0.1:9", "--jobs", "2"], "--jobs"),
        (["stack10", "--out", "a.csv", "--core", "m99"], "m99"),
    ],
)
def test_a_bad_call_gives_one_line_and_exit_code_2(arguments: list[str], what: str) -> None:
    done = cairn(*arguments)
    assert (done.returncode, done.stdout) == (2, "")
    assert len(done.stderr.splitlines()) == 1 and done.stderr.startswith("cairn: ")
    assert what in done.stderr


@pytest.mark.parametrize(
    ("value", "what"),
    [
        ("substeps", "NAME=VALUE"),
        ("substeps=", "NAME=VALUE"),
        ("substeps=17", "1 to 16"),
        ("substeps=2.5", "whole"),
        ("rate=5", "10 to 2000"),
        ("gravity=nan", "within"),
        ("gravity=1..2", "whole"),
        ("seed=9..0", "rises"),
        ("sleep=maybe", "on, off"),
        ("solver=hard", "soft, slides, small"),
        ("core=m0", "no such parameter"),
        ("height=3", "no such parameter"),
    ],
)
def test_a_bad_value_is_told(value: str, what: str) -> None:
    with pytest.raises(UserError, match=what):
        settings.read_values(value)


def test_a_sweep_too_large_or_with_a_parameter_twice_is_refused() -> None:
    with pytest.raises(UserError, match="at most"):
        settings.jobs(["stack10"], ["seed=0..999999", "substeps=1..16"], [])
    with pytest.raises(UserError, match="twice"):
        settings.jobs(["stack10"], ["seed=0", "seed=1"], [])


def test_a_scheduler_that_is_not_there_is_told(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(cluster, "SECONDS_TO_CONNECT", 1)
    with pytest.raises(UserError, match="no Dask scheduler"):
        swept(tmp_path / "a.csv", "tcp://127.0.0.1:9", ["spring"], [])


def test_a_scheduler_need_not_know_cairn_tools(tmp_path: Path) -> None:
    for function in (cluster._probe(), cluster._row()):
        code = "import cloudpickle, sys; cloudpickle.load(sys.stdin.buffer)"
        command = [sys.executable, "-c", code]
        done = subprocess.run(command, input=cloudpickle.dumps(function), cwd=tmp_path, env={}, check=False)
        assert done.returncode == 0


def test_a_scheduler_without_workers_is_told(tmp_path: Path) -> None:
    with (
        LocalCluster(n_workers=0, processes=False, protocol="tcp://", dashboard_address=":0") as empty,
        pytest.raises(UserError, match="no workers"),
    ):
        swept(tmp_path / "a.csv", empty.scheduler_address, ["spring"], [])
