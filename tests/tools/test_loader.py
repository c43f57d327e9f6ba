"""The host's loader in C, which must be safe alone: it refuses what the command's own check refuses."""

import json
import math
import random
import subprocess
from pathlib import Path
from typing import Any

import pytest
from cairn_tools import engine, scene
from test_scene import BAD_FIELDS, GOOD, changed


def loader(text: str) -> subprocess.CompletedProcess[str]:
    program = engine.host_program("host", "cairn-runner")
    return subprocess.run([program, "-", "steps=0"], input=text, capture_output=True, text=True, check=False)


def test_every_field_is_accepted() -> None:
    assert loader(json.dumps(GOOD)).returncode == 0


# 1.0 is a whole number to the loader, which knows only doubles.
REFUSED = [
    case for case in BAD_FIELDS if not (isinstance(case[1], float) and case[1] == 1 and case[3] == "whole number")
]


@pytest.mark.parametrize(("path", "value", "where", "what"), REFUSED)
def test_a_bad_field_is_refused_in_one_line_that_leads_to_it(path: str, value: Any, where: str, what: str) -> None:
    done = loader(json.dumps(changed(path, value)))
    if what == "mass":  # the engine itself refuses the body
        assert done.returncode == 1 and "error status -3" in done.stdout and "error place 1" in done.stdout
        return
    assert (done.returncode, done.stdout) == (2, "")
    (line,) = done.stderr.splitlines()
    place = line.split(": ")[1]
    not_json = "not JSON" in line and not isinstance(value, str) and not all(map(math.isfinite, value))
    assert where.startswith(place) or not_json, line


@pytest.mark.parametrize("solver", scene.SOLVERS)
def test_every_solver_is_read_written_and_the_runners_word(solver: str, tmp_path: Path) -> None:
    text = json.dumps(changed("solver", solver) | {"springs": []})
    assert loader(text).returncode == 0
    file = tmp_path / "scene.json"
    file.write_text(text, encoding="utf-8")
    table = engine.table(scene.load(file), "it")
    assert f".solver = CAIRN_SCENE_{solver.upper()}," in table
    run = [engine.host_program("host", "cairn-runner"), "-", "steps=60"]
    of_file = subprocess.run(run, input=text, capture_output=True, text=True, check=True)
    of_word = subprocess.run([*run, f"solver={solver}"], input=json.dumps(changed("solver", "soft") | {"springs": []}),
                             capture_output=True, text=True, check=True)  # fmt: skip
    assert of_word.stdout == of_file.stdout


def test_what_no_solver_is_called_is_told_with_their_names() -> None:
    assert '"soft", "slides" or "small"' in loader(json.dumps(changed("solver", "hard"))).stderr


def test_a_scene_in_tatters_is_refused_or_read_and_nothing_worse() -> None:
    good = json.dumps(GOOD)
    dice = random.Random(1)
    for _ in range(300):
        text = list(good)
        for _ in range(dice.randint(1, 4)):
            place = dice.randrange(len(text))
            text[place : place + dice.randint(0, 1)] = dice.choice('{}[]",:0129-e. ')
        done = loader("".join(text))
        assert done.returncode in (0, 1, 2), "".join(text)
        if done.returncode == 2:
            assert len(done.stderr.splitlines()) == 1


def test_a_spring_between_two_static_bodies_is_allowed() -> None:
    data = changed("bodies/1/type", "static")
    data["springs"] = [
        {"a": 0, "b": 1, "frequency": 2, "damping_ratio": 1},
        {"a": 0, "b": 1, "stiffness": 5},
    ]
    assert scene.parse(json.dumps(data), scene.find("tower")).springs[0].frequency == 2
    assert loader(json.dumps(data)).returncode == 0
