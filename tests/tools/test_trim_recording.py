"""Recorded runs for tools/cairn trim: what a file of JSON lines means, that it happens, and each complaint."""

import json
import subprocess
from pathlib import Path

import pytest
from cairn_tools import engine, trim, trim_findings, trim_recording
from cairn_tools.errors import UserError

ROOT = Path(__file__).parents[2]
BEGIN = {"cairn_run": 1, "scene": "stack10", "shapes": {"ball": {"circle": 0.3}}}  # a floor and ten crates
BALL = {"shape": "ball", "position": [5, 1]}
EVENTS = [
    {"step": 0, "spawn": BALL},
    {"step": 10, "velocity": [2, 0], "body": 11},
    {"step": 20, "spawn": {"shape": "crate", "position": [-5, 0.5]}},
    {"step": 30, "impulse": [1, 0], "body": 12},
    {"step": 40, "remove": 11},
]


def recording(folder: Path, *lines: object) -> Path:
    file = folder / "rain.jsonl"
    text = "".join(line if isinstance(line, str) else json.dumps(line) + "\n" for line in lines)
    file.write_text(text, encoding="utf-8")
    return file


def test_what_happens_in_a_run_happens_on_the_host(tmp_path: Path) -> None:
    scene = trim_recording.load(recording(tmp_path, BEGIN, *EVENTS), tmp_path)
    assert (len(scene.bodies), scene.play.present, scene.play.most) == (13, 11, 13)
    for arithmetic in engine.ARITHMETICS:
        run = engine.run(scene, arithmetic, "host", 60, 1)
        ball, crate = run.trajectory.states[:, 11], run.trajectory.states[:, 12]
        assert ball[1, 0] == pytest.approx(5, abs=1e-4)  # there, and falling
        assert ball[11, 3] == pytest.approx(2, abs=1e-4)
        assert not ball[41:].any()  # gone
        assert not crate[:20].any()  # not there yet
        assert crate[20:, 0].min() == pytest.approx(-5, abs=1e-3)
        assert crate[31, 3] == pytest.approx(1, rel=0.1)  # 1 kg, less what friction took
        assert run.statistics["most_bodies"] == 13


def test_the_needs_of_a_run_are_of_all_that_ever_is_there(tmp_path: Path) -> None:
    scene = trim_recording.load(recording(tmp_path, BEGIN, *EVENTS), tmp_path)
    wish = trim.Wish(60, 20, None, (), None, None)
    found = trim.needs_of([scene], [engine.run(scene, "q16", "host", 60, 1)], wish)
    assert found.pools["bodies"] == 16  # 13 and a fifth
    by_name = {finding.what: finding.found for finding in found.found}
    assert (by_name["shapes"], by_name["restitution"]) == ("box, circle", "none")
    assert by_name["masses"] == "0.283 to 1 kg"


def test_the_table_counts_the_bodies_of_the_start_and_the_events_name_those_behind(tmp_path: Path) -> None:
    scene = trim_recording.load(recording(tmp_path, BEGIN, *EVENTS), tmp_path)
    table = trim_recording.cut(engine.table(scene, "rain"), scene.play)
    assert ".body_count = 11," in table
    assert "CAIRN_WORLD(world, 13, 68);" in table
    events = trim_recording.table(scene.play, "play_rain", 13)
    assert "{ 0, CAIRN_SCENE_SPAWN, 11, { 0, 0 } }," in events
    assert "{ 30, CAIRN_SCENE_IMPULSE, 12, { 65536, 0 } }," in events
    assert "{ 5, events };" in events


def test_equal_masses_and_no_friction_are_noticed(tmp_path: Path) -> None:
    ice = {"static_friction": 0, "kinetic_friction": 0, "restitution": 0}
    scene = trim_recording.load(recording(tmp_path, BEGIN | {"materials": {"default": ice}}), tmp_path)
    found = trim_findings.findings([scene], [engine.run(scene, "q16", "host", 5, 1)], 20)
    by_name = {finding.what: finding.found for finding in found}
    assert (by_name["friction"], by_name["masses"], by_name["margin"]) == ("none", "all 1 kg", "20 %")


@pytest.mark.parametrize(
    ("lines", "said"),
    [
        ([], "is empty"),
        (["{\n"], "line 1: not JSON"),
        ([{"cairn_run": 2, "scene": "stack10"}], "line 1: cairn_run: must be 1"),
        ([{"cairn_run": 1}], "line 1: scene: missing"),
        ([BEGIN | {"scene": "none"}], "no such scene file"),
        ([BEGIN | {"speed": 1}], "line 1: speed: unknown field"),
        ([BEGIN | {"shapes": {"ball": {"circle": -1}}}], "line 1: shapes.ball.circle: must be at least"),
        ([BEGIN, {"spawn": BALL}], "line 2: step: missing"),
        ([BEGIN, {"step": 1.5, "spawn": BALL}], "line 2: step: must be a whole number"),
        ([BEGIN, {"step": 1, "spawn": BALL | {"shape": "cube"}}], 'line 2: spawn.shape: no shape named "cube"'),
        ([BEGIN, {"step": 1, "spawn": BALL | {"colour": 1}}], "line 2: spawn.colour: unknown field"),
        ([BEGIN, {"step": 1, "spawn": BALL, "remove": 1}], "line 2: must have one of"),
        ([BEGIN, {"step": 1, "spawn": BALL, "body": 1}], "line 2: must have one of"),
        ([BEGIN, {"step": 1, "body": 1}], "line 2: must have one of"),
        ([BEGIN, {"step": 1}], "line 2: must have one of spawn, remove"),
        ([BEGIN, {"step": 1, "impulse": [1, 2]}], "line 2: body: missing"),
        ([BEGIN, {"step": 1, "impulse": [1], "body": 1}], "line 2: impulse: must have at least 2"),
        ([BEGIN, {"step": 1, "impulse": [1, 2], "body": 11}], "line 2: there is no body 11 yet; there are 11"),
        ([BEGIN, {"step": 1, "velocity": [1, 2], "body": 0}], "line 2: body 0 is static"),
        ([BEGIN, {"step": 2, "remove": 1}, {"step": 3, "remove": 1}], "line 3: body 1 was removed before"),
        ([BEGIN, {"step": 2, "remove": 1}, {"step": 1, "remove": 2}], "line 3: step 1 comes after step 2"),
    ],
)
def test_what_is_wrong_is_said_with_its_line(tmp_path: Path, lines: list[object], said: str) -> None:
    with pytest.raises(UserError) as error:
        trim_recording.load(recording(tmp_path, *lines), tmp_path)
    assert said in str(error.value)


def test_a_run_that_goes_on_beyond_the_steps_is_refused_and_nothing_written(tmp_path: Path) -> None:
    file = recording(tmp_path, BEGIN, {"step": 100, "spawn": BALL})
    command = [ROOT / "tools" / "cairn", "trim", file, "--steps", "100", "--out", tmp_path / "trimmed"]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert (done.returncode, len(done.stderr.splitlines())) == (2, 1)
    assert "its last event is after 100 steps: --steps must be more, not 100" in done.stderr
    assert not (tmp_path / "trimmed").exists()


def test_what_the_engine_refuses_is_told_by_its_event(tmp_path: Path) -> None:
    far = {"step": 2, "spawn": BALL | {"position": [20000, 0]}}
    loaded = trim_recording.load(recording(tmp_path, BEGIN, {"step": 1, "remove": 1}, far), tmp_path)
    with pytest.raises(UserError, match="event 2, after step 2: refused by the engine: a number out of range"):
        engine.run(loaded, "q16", "host", 5, 0)
