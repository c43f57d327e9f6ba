"""include/cairn/config.h refuses what does not fit together, by #error."""

import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
FLAGS = ("SPRINGS", "BOUNCE", "CONTINUOUS", "BLOCKS", "SLEEP", "QUADTREE", "SLIDES_SOLVER", "SMALL_SOLVER",
         "FIXED_POSITION", "SENSORS",
         "DAMPING", "QUICK_WAYS", "SHORTCUTS", "HOLD", "POLYGONS", "FRICTION", "TURNING", "SLOPES", "MASSES",
         "SETTINGS", "GIANTS", "SORT", "GRAVITY_SCALE", "PINS")  # fmt: skip


def complaint(*options: str) -> str:
    command = ["gcc", "-std=c99", "-fsyntax-only", "-x", "c", f"-I{ROOT / 'include'}", "-"]
    command += [f"-D{option}" for option in options]
    done = subprocess.run(command, input="#include <cairn/cairn.h>\n", capture_output=True, text=True, check=False)
    assert (done.returncode == 0) == (done.stderr == "")
    return done.stderr


@pytest.mark.parametrize("name", (*FLAGS, "SOFT_SOLVER"))
def test_each_feature_is_on_or_off(name: str) -> None:
    beside = ("CAIRN_WITH_TURNING=0",) if name == "SLOPES" else ()
    assert complaint(f"CAIRN_WITH_{name}=0", *beside) == ""
    assert '#error "each CAIRN_WITH_... must be 0 or 1"' in complaint(f"CAIRN_WITH_{name}=2")


@pytest.mark.parametrize("count", [3, 17, -1])
def test_corners_are_four_to_sixteen(count: int) -> None:
    assert '#error "CAIRN_MAX_VERTICES must be 4 to 16"' in complaint(f"CAIRN_MAX_VERTICES={count}")


@pytest.mark.parametrize("count", [0, 3])
def test_points_are_one_or_two(count: int) -> None:
    assert '#error "CAIRN_MAX_POINTS must be 1 or 2"' in complaint(f"CAIRN_MAX_POINTS={count}", "CAIRN_WITH_BLOCKS=0")


def test_blocks_take_two_points() -> None:
    assert '#error "CAIRN_MAX_POINTS 1 needs CAIRN_WITH_BLOCKS 0"' in complaint("CAIRN_MAX_POINTS=1")
    assert complaint("CAIRN_MAX_POINTS=1", "CAIRN_WITH_BLOCKS=0") == ""


def test_a_build_has_a_solver() -> None:
    none = ("CAIRN_WITH_SOFT_SOLVER=0", "CAIRN_WITH_SLIDES_SOLVER=0", "CAIRN_WITH_SMALL_SOLVER=0")
    assert '#error "one of CAIRN_WITH_SOFT_SOLVER' in complaint(*none)
    for one in none:
        assert complaint(*(option if option != one else f"{one[:-1]}1" for option in none)) == ""


@pytest.mark.parametrize("name", ["BLOCKS", "HOLD", "SHORTCUTS", "QUICK_WAYS"])
def test_what_comes_with_the_soft_solver_takes_it(name: str) -> None:
    assert '#error "CAIRN_WITH_SOFT_SOLVER 0 needs' in complaint("CAIRN_WITH_SOFT_SOLVER=0", f"CAIRN_WITH_{name}=1")


@pytest.mark.parametrize("name", ["SLIDES_SOLVER", "SMALL_SOLVER"])
def test_settled_for_good_are_the_sub_steps_of_one_solver(name: str) -> None:
    other = (f"CAIRN_WITH_{name}=1", "CAIRN_WITH_SETTINGS=0")
    assert '#error "CAIRN_WITH_SETTINGS 0 needs CAIRN_WITH_SOFT_SOLVER alone' in complaint(*other)
    assert complaint(*other, "CAIRN_WITH_SOFT_SOLVER=0") == ""


def test_what_moves_and_stands_upright_does_not_turn() -> None:
    said = '#error "CAIRN_WITH_SLOPES 0 needs CAIRN_WITH_TURNING 0 or CAIRN_MAX_POINTS 1"'
    assert said in complaint("CAIRN_WITH_SLOPES=0")
    assert complaint("CAIRN_WITH_SLOPES=0", "CAIRN_MAX_POINTS=1", "CAIRN_WITH_BLOCKS=0") == ""


def test_all_that_can_be_left_out_can_be_left_out_at_once() -> None:
    assert complaint(*(f"CAIRN_WITH_{name}=0" for name in FLAGS), "CAIRN_MAX_POINTS=1", "CAIRN_MAX_VERTICES=4") == ""
