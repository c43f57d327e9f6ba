"""tools/cairn as a user calls it: its outputs, and its one line on bad input."""

import csv
import io
import json
import math
import os
import subprocess
from pathlib import Path

import pytest
from cairn_tools import engine, scene
from cairn_tools.errors import UserError

ROOT = Path(__file__).parents[2]


def cairn(*arguments: object) -> subprocess.CompletedProcess[str]:
    return subprocess.run([ROOT / "tools" / "cairn", *map(str, arguments)], capture_output=True, text=True, check=False)


def printed(*arguments: object) -> str:
    done = cairn(*arguments)
    assert done.returncode == 0, done.stderr
    return done.stdout


def rows_of(text: str) -> list[dict[str, float]]:
    return [{key: float(value) for key, value in row.items()} for row in csv.DictReader(io.StringIO(text))]


def test_csv_on_stdout_is_nothing_but_csv() -> None:
    text = printed("run", "spring", "--steps", 10, "--csv", "-")
    assert text.splitlines()[0] == "step,body,x,y,angle,vx,vy,omega"
    rows = rows_of(text)
    assert [(row["step"], row["body"]) for row in rows] == [(step, body) for step in range(11) for body in (0, 1)]


def test_a_reader_that_stops_early_is_no_error() -> None:
    command = f"'{ROOT}/tools/cairn' run pyramid10 --steps 200 --csv - | head -n 1"
    done = subprocess.run(["bash", "-o", "pipefail", "-c", command], capture_output=True, text=True, check=False)
    assert (done.returncode, done.stderr) == (0, "")
    assert done.stdout == "step,body,x,y,angle,vx,vy,omega\n"


def test_step_0_is_the_start_of_the_scene_file() -> None:
    rows = rows_of(printed("run", "mass_proportions", "--steps", 0, "--csv", "-"))
    bodies = scene.load(scene.find("mass_proportions")).bodies
    assert len(rows) == len(bodies)
    for row, body in zip(rows, bodies, strict=True):
        assert (row["x"], row["y"]) == pytest.approx(body.position, abs=2**-16)


def test_every_records_each_so_many_steps(tmp_path: Path) -> None:
    file = tmp_path / "run.csv"
    printed("run", "bounce", "--steps", 100, "--every", 30, "--csv", file)
    assert [row["step"] for row in rows_of(file.read_text()) if row["body"] == 1] == [0, 30, 60, 90]


def test_double_follows_the_parabola() -> None:
    last = rows_of(printed("run", "projectile", "--engine", "f64", "--steps", 60, "--csv", "-"))[-1]
    assert last["x"] == pytest.approx(10, abs=1e-6)
    assert last["vy"] == pytest.approx(2, abs=1e-6)
    # Symplectic Euler at 240 sub-steps a second falls g t dt / 2 below the parabola at most.
    assert last["y"] == pytest.approx(7, abs=10 / 240 / 2 + 1e-6)


@pytest.mark.parametrize("arithmetic", ["q16", "f64"])
def test_the_angle_of_a_rolling_disc_goes_on_beyond_half_a_turn(arithmetic: str) -> None:
    text = printed("run", "rolling", "--engine", arithmetic, "--steps", 120, "--every", 40, "--csv", "-")
    disc = [row for row in rows_of(text) if row["body"] == 1]
    way = math.hypot(disc[-1]["x"] - disc[0]["x"], disc[-1]["y"] - disc[0]["y"])
    assert way > 2 * math.pi * 0.5 / 2
    assert disc[-1]["angle"] - disc[0]["angle"] == pytest.approx(-way / 0.5, rel=0.01)


def test_the_hash_alone_is_that_of_the_json() -> None:
    record = json.loads(printed("run", "boxes3", "--steps", 60, "--json"))
    assert printed("run", "boxes3", "--steps", 60, "--hash") == record["hash"] + "\n"
    assert len(record["bodies"]) == 4
    assert record["statistics"]["points"] == 6


def test_settings_of_the_command_line_change_the_run() -> None:
    hashes = {
        printed("run", "boxes3", "--steps", 60, "--hash", *settings)
        for settings in (
            [],
            ["--substeps", 8],
            *(["--solver", solver, *more] for solver in ("slides", "small") for more in ([], ["--passes", 20])),
        )
    }
    assert len(hashes) == 6


def test_pictures_are_written(tmp_path: Path) -> None:
    printed(
        "run",
        "boxes3",
        "--steps",
        20,
        "--svg",
        tmp_path / "a.svg",
        "--png",
        tmp_path / "a.png",
        "--gif",
        tmp_path / "a.gif",
    )
    assert (tmp_path / "a.svg").read_text().startswith("<svg")
    assert (tmp_path / "a.png").read_bytes().startswith(b"\x89PNG")
    assert (tmp_path / "a.gif").read_bytes().startswith(b"GIF89a")


@pytest.mark.parametrize(
    ("arguments", "what"),
    [
        (["run", "nowhere"], "no such scene"),
        (["run", "tower", "--steps", "many"], "--steps"),
        (["run", "tower", "--substeps", "17"], "--substeps"),
        (["run", "tower", "--engine", "q32"], "--engine"),
        (["run", "tower", "--engine", "f64", "--on", "m0"], "host only"),
        (["run", "tower", "--csv", "-", "--hash"], "--csv -"),
        (["run", "tower", "--svg", "/nowhere/a.svg"], "no folder /nowhere"),
        (["bench", "--core", "m99"], "m99"),
        (["bench", "--peers", "--substeps", "8"], "--peers"),
        (["bench", "--peers", "--core", "m55"], "not on m55"),
        (["bench", "--host", "--core", "m0"], "--host"),
        (["bench", "--rounds", "3"], "--host"),
        (["bench", "--core", "rp2040"], "rp2040"),
        (["bench", "--cycles", "--core", "m7"], "no estimate"),
        (["bench", "--growth", "--scene", "tower"], "--growth"),
        (["bench", "--plot", "a.png"], "--growth"),
        (["bench", "--memory", "--scene", "tower"], "--memory"),
        (["table", "tower"], "--out"),
        (["table", "tower", "--out", "t.c", "--name", "a b"], "--name"),
        (["table", "tower", "--out", "t.c", "--name", "int"], "no name in C"),
        (["run", "tower", "--steps", "1", "--gif", "/proc/a.gif"], "/proc/a.gif"),
        (["run", "tower", "--json", "--hash"], "--json"),
        (["run", "tower", "--passes", "5"], "--solver slides or small"),
        (["run", "tower", "--solver", "hard"], "'small'"),
        (["run", "recorded.jsonl"], "recorded.jsonl"),
        (["bench", "--core"], "requires an argument"),
        (["bench", "--scene", "tower", "--keep"], "take no other option"),
        (["bench", "--keep", "--check"], "take no other option"),
        (["golden", "--scene", "nowhere"], "no such scene"),
        (["golden", "--scene", "tower", "--write", "x"], "--scene"),
        (["jump"], "jump"),
    ],
)
def test_a_bad_call_gives_one_line_and_exit_code_2(arguments: list[str], what: str) -> None:
    done = cairn(*arguments)
    assert done.returncode == 2
    assert done.stdout == ""
    assert len(done.stderr.splitlines()) == 1 and done.stderr.startswith("cairn: ")
    assert what in done.stderr


def test_a_bad_scene_gives_one_line_that_names_the_field(tmp_path: Path) -> None:
    file = tmp_path / "bad.json"
    file.write_text(scene.find("tower").read_text().replace('"plank", "position"', '"plonk", "position"'))
    done = cairn("run", file)
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr == f'cairn: {file}: bodies[4].shape: no shape named "plonk" in shapes\n'


def test_help_is_shown_where_nothing_is_asked_for() -> None:
    done = cairn()
    assert (done.returncode, done.stderr) == (2, "")
    assert "Usage" in done.stdout


def test_a_scene_may_have_the_mark_that_some_editors_write_and_any_rate(tmp_path: Path) -> None:
    file = tmp_path / "tower.json"
    data = {**json.loads(scene.find("tower").read_text()), "steps_per_second": 2000}
    file.write_text(json.dumps(data), encoding="utf-8-sig")
    assert len(printed("run", file, "--steps", 3, "--hash")) == 9


def test_a_recorded_run_is_told_from_a_scene(tmp_path: Path) -> None:
    file = tmp_path / "a.jsonl"
    file.write_text('{"cairn_run": 1, "scene": "tower"}\n')
    with pytest.raises(UserError, match="only tools/cairn trim plays"):
        scene.load(file)


def test_own_scenes_are_held_to_the_state_of_the_host() -> None:
    said = json.loads(printed("golden", "--scene", "boxes3", "bounce", "--targets", "host", "m0", "--json"))
    assert said["record"] == []
    assert [(row["case"], row["got"] == row["expected"]) for row in said["results"]] == 2 * [("boxes3", True)] + 2 * [
        ("bounce", True)
    ]


def test_a_narrow_terminal_hides_no_figure() -> None:
    command = [ROOT / "tools" / "cairn", "compare", "boxes3", "--rounding", "--steps", "3"]
    for columns in ("40", "80"):
        environment = {**os.environ, "COLUMNS": columns}
        done = subprocess.run(command, capture_output=True, text=True, check=True, env=environment)
        assert "…" not in done.stdout
        assert max(map(len, done.stdout.splitlines()[:20])) <= int(columns)


# The largest distances that issue 2 allows; the second bounce is at step 168.
@pytest.mark.parametrize("name", ["projectile", "rolling", "bounce", "spring"])
def test_fixed_point_stays_within_a_millimetre_of_double(name: str) -> None:
    record = json.loads(printed("compare", name, "--steps", 120, "--rounding", "--json"))
    assert record["overall"]["max_position"] < 1e-3
    assert [row["step"] for row in record["selected"]][::9] == [0, 120]


@pytest.mark.parametrize("core", ["m0", "m3", "m4f", "lm3s6965evb"])
def test_an_emulated_core_ends_in_the_same_state_as_the_host(core: str) -> None:
    loaded = scene.load(scene.find("bridge"))
    on_core, on_host = (engine.run(loaded, "q16", target, 60, 20) for target in (core, "host"))
    assert on_core.hash == on_host.hash
    assert (on_core.trajectory.states == on_host.trajectory.states).all()
    assert len(on_core.costs) == 60 and min(on_core.costs) > 1000
    assert on_core.stack > 0


def test_bench_counts_the_same_instructions_twice() -> None:
    arguments = ("bench", "--core", "m0", "m3", "--scene", "boxes3", scene.find("stack10"), "--json")
    first, second = json.loads(printed(*arguments)), json.loads(printed(*arguments))
    assert first == second
    assert [(row["scene"], row["core"]) for row in first] == [
        ("boxes3", "m0"), ("boxes3", "m3"), ("stack10", "m0"), ("stack10", "m3"),
    ]  # fmt: skip
    for row in first:
        assert row["mean_instructions"] <= row["worst_instructions"] <= row["worst_instructions_from_start"]


def test_a_table_is_strict_c99_and_holds_the_scene(tmp_path: Path) -> None:
    file = tmp_path / "bridge.c"
    printed("table", "bridge", "--out", file, "--name", "the_bridge")
    text = file.read_text()
    assert "const cairn_scene the_bridge = {" in text
    assert ".body_count = 23," in text and ".spring_count = 17," in text
    strict = ["-std=c99", "-Wall", "-Wextra", "-Wpedantic", "-Wconversion", "-Wshadow", "-Werror"]
    folders = [f"-I{ROOT}/include", f"-I{ROOT}/examples/scene"]
    for compiler in ("gcc", "clang"):
        subprocess.run([compiler, *strict, *folders, "-c", file, "-o", tmp_path / "bridge.o"], check=True)
