"""The verb `fuzz`: what it makes of what the program says."""

from __future__ import annotations

import json
import subprocess
from collections.abc import Callable
from pathlib import Path

import pytest
from cairn_tools import engine, fuzz
from cairn_tools.fuzz import Result, play

ROOT = Path(__file__).parents[2]
Program = Callable[[str], Path]


@pytest.fixture
def program(tmp_path: Path) -> Program:
    """A program of a few lines of shell in place of the test's."""

    def written(lines: str) -> Path:
        file = tmp_path / "program"
        file.write_text(f"#!/bin/sh\n{lines}\n", encoding="utf-8")
        file.chmod(0o755)
        return file

    return written


EACH = 'for k in $(seq $CAIRN_FUZZ_WORLDS); do seed=$((CAIRN_FUZZ_SEED + k - 1)); echo "world $seed"; '


def test_sound_worlds_are_counted_and_told(program: Program) -> None:
    done: list[int] = []
    assert play(program(EACH + "done; echo OK"), 70, 5, done.append) == Result(70, 5)
    assert done == [0, 1, 2, 3, 4]


def test_the_first_failing_seed_is_told_with_what_the_sanitizer_says(program: Program) -> None:
    says = "echo noise; echo 'src/a.c:7:3: runtime error: wraps' >&2; echo '    #0 in step'; exit 1"
    result = play(program(EACH + f"if [ $seed = 72 ]; then {says}; fi; done"), 70, 5, lambda _: None)
    assert result == Result(70, 2, 72, ("src/a.c:7:3: runtime error: wraps", "    #0 in step"))


def test_a_world_without_end_is_a_failure(program: Program, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(fuzz, "PATIENCE", 0.3)
    result = play(program(EACH + "if [ $seed = 71 ]; then exec sleep 60; fi; done"), 70, 5, lambda _: None)
    assert (result.failed, result.said) == (71, ("does not end within 0.3 s",))


def test_a_program_that_cannot_begin_is_no_failing_world(program: Program) -> None:
    with pytest.raises(engine.EngineError, match="no library"):
        play(program("echo no library; exit 127"), 70, 5, lambda _: None)


def test_a_failure_is_printed_with_how_to_see_it_again(
    program: Program, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    unsound = program(EACH + "echo 'test.c:9:test_it:FAIL: Expected TRUE'; exit 1; done")
    monkeypatch.setattr(fuzz, "program", lambda _: unsound)
    for as_json in (False, True):
        with pytest.raises(fuzz.typer.Exit) as end:
            fuzz.fuzz(3, 70, fuzz.Sanitizer("memory"), as_json)
        assert end.value.exit_code == 1
        said = capsys.readouterr().out
        if as_json:
            assert json.loads(said)["failed"] == 70
        else:
            assert "test_it:FAIL" in said
            assert "tools/cairn fuzz --worlds 1 --seed 70 --sanitizer memory" in said


@pytest.mark.parametrize("words", [["--worlds", "0"], ["--sanitizer", "thread"]])
def test_bad_input_gives_one_line(words: list[str]) -> None:
    done = subprocess.run([ROOT / "tools" / "cairn", "fuzz", *words], capture_output=True, text=True, check=False)
    assert done.returncode == 2
    assert done.stderr.count("\n") == 1
