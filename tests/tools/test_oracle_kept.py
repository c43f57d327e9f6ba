"""Kept runs of the oracle come out again, and its command."""

import json
from dataclasses import replace

import pytest
from cairn_tools import scene
from cairn_tools.oracle import command, kept
from cairn_tools.scene import UserError
from typer.testing import CliRunner


def loaded(name: str) -> scene.Scene:
    return scene.load(scene.find(name))


@pytest.mark.parametrize("name", ["pyramid10", "curtain150", "mixed50", "basic"])
def test_a_sample_of_a_kept_run_comes_out_equal(name: str) -> None:
    assert kept.differs(loaded(name), 2 * kept.EVERY) < kept.EQUAL


def test_every_kept_run_is_of_the_scene_as_it_is_and_all_are_small() -> None:
    for name, steps in kept.STEPS.items():
        got = kept.load(loaded(name))
        assert got is not None
        assert list(got.steps) == list(range(0, steps + 1, kept.EVERY))
        assert got.states.shape == (len(got.steps), len(loaded(name).bodies), 6)
    assert sum(file.stat().st_size for file in kept.FOLDER.glob("*.npz")) < 5e6


def test_a_changed_scene_has_no_kept_run() -> None:
    assert kept.load(replace(loaded("tower"), gravity=(0.0, -9.0))) is None
    assert kept.load(replace(loaded("tower"), substeps=9)) is not None
    with pytest.raises(UserError, match="no kept run"):
        kept.differs(replace(loaded("tower"), gravity=(0.0, -9.0)), 4)


def test_runs_are_kept_where_they_are_found(tmp_path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(kept, "FOLDER", tmp_path)
    monkeypatch.setattr(kept, "STEPS", {"stack10": 4})
    assert kept.keep(lambda _: None) == [tmp_path / "stack10.npz"]
    assert kept.differs(loaded("stack10"), 4) == 0


def test_halving_tells_how_far_both_runs_are_apart() -> None:
    rows = command.halved(loaded("boxes3"), 20, 8, lambda _: None)
    assert [row.fineness for row in rows] == [8, 16]
    assert rows[0].difference_at_end is None
    assert rows[1].difference_at_end is not None
    assert rows[1].difference_at_end < 1e-6
    assert rows[1].alike_for_steps == 20


def test_run_takes_the_oracle_as_an_engine() -> None:
    from cairn_tools.app import app

    runner = CliRunner()
    done = runner.invoke(app, ["run", "spring", "--engine", "oracle", "--steps", "6", "--json"])
    assert json.loads(done.stdout)["statistics"] == {"closed_form": "spring"}
    done = runner.invoke(app, ["run", "boxes3", "--engine", "oracle", "--steps", "2", "--csv", "-"])
    assert len(done.stdout.splitlines()) == 1 + 3 * 4
    for wrong in (["--hash"], ["--on", "m0"], ["--substeps", "2"]):
        done = runner.invoke(app, ["run", "boxes3", "--engine", "oracle", *wrong])
        assert isinstance(done.exception, UserError)


@pytest.mark.parametrize("wrong", [[], ["--keep", "--check"], ["stack10", "--keep"], ["none-such"]])
def test_bad_arguments_of_the_command_are_refused(wrong: list[str]) -> None:
    from cairn_tools.app import app

    assert isinstance(CliRunner().invoke(app, ["oracle", *wrong]).exception, UserError)
