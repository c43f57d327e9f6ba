"""`bench --peers`: the scene for other engines, and what is read of their images. Builds and fetches none of them."""

from __future__ import annotations

import math
import subprocess
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import pytest
from cairn_tools import bench_tables, engine, kept, peers, scene
from cairn_tools.errors import UserError


def scene_of(name: str) -> scene.Scene:
    return scene.load(scene.find(name))


@pytest.fixture
def stack() -> scene.Scene:
    return scene_of("stack10")


def output_of(loaded: scene.Scene, moved: Callable[[float, float], tuple[float, float]]) -> peers.Output:
    """As if every moving body had ended where `moved` puts its start."""
    starts = [body.position for body in loaded.bodies]
    ends = [body.position if body.static else moved(*body.position) for body in loaded.bodies]
    return peers.Output(starts=starts, ends=ends)


@pytest.mark.parametrize("name", kept.SCENES)
def test_a_scene_becomes_a_table_that_compiles(name: str, tmp_path: Path) -> None:
    file = tmp_path / "peer.c"
    file.write_text(peers.table(scene_of(name)))
    call = ["gcc", "-std=c99", "-Wall", "-Wextra", "-Wpedantic", "-Wconversion", "-Werror", "-fsyntax-only"]
    subprocess.run([*call, f"-I{peers.HERE}", str(file)], check=True)


def test_the_table_holds_bodies_shapes_and_springs(stack: scene.Scene) -> None:
    text = peers.table(stack)
    assert f"2, {len(stack.bodies)}, 0," in text
    assert "peer_springs" not in text
    crate = text.splitlines()[-9]
    assert "{0.000000000e+00f, 9.500000000e+00f}" in crate
    # Mass 1, inertia (1 + 1) / 12, friction 0.6.
    assert crate.endswith("1.000000000e+00f, 1.666666667e-01f, 6.000000000e-01f, 0.000000000e+00f},")
    curtain = scene_of("curtain150")
    assert peers.table(curtain).count("2.000000000e+02f") == len(curtain.springs)


def test_mass_and_inertia_are_about_the_centre() -> None:
    disc = scene.Shape("circle", 0.5)
    assert peers.mass(disc, 2) == pytest.approx((math.pi / 2, math.pi / 2 * 0.25 / 2))
    # A box of 2 x 1 far from its origin.
    box = scene.Shape("polygon", 0.0, ((5.0, 5.0), (7.0, 5.0), (7.0, 6.0), (5.0, 6.0)))
    assert peers.mass(box, 3) == pytest.approx((6, 6 * (4 + 1) / 12))


@pytest.mark.parametrize("change", [{"sensor": True}, {"fixed_position": True}])
def test_a_body_that_not_all_engines_have_is_refused(stack: scene.Scene, change: dict[str, bool]) -> None:
    odd = replace(stack, bodies=[*stack.bodies, replace(stack.bodies[-1], **change)])
    with pytest.raises(UserError, match=next(iter(change))):
        peers.table(odd)


def test_sleep_and_springs_by_frequency_and_many_corners_are_refused(stack: scene.Scene) -> None:
    with pytest.raises(UserError, match="sleep"):
        peers.table(replace(stack, sleep=True))
    with pytest.raises(UserError, match=r"springs\[0\].frequency"):
        peers.table(replace(stack, springs=[scene.Spring(1, 2, 1.0, frequency=2.0)]))
    many = scene.Shape("polygon", 0.0, tuple((math.cos(k), math.sin(k)) for k in range(9)))
    with pytest.raises(UserError, match="corners"):
        peers.table(replace(stack, shapes={**stack.shapes, "many": many}))


def test_cairn_links_only_what_a_scene_uses(stack: scene.Scene) -> None:
    assert "{NULL}" in peers.features(stack, "")
    assert "{peer_use_springs, NULL}" in peers.features(scene_of("curtain150"), "")
    both = replace(stack, solver="slides", broad_phase="quadtree")
    assert "{peer_use_quadtree, peer_use_slides, NULL}" in peers.features(both, "")
    assert "{peer_use_small, NULL}" in peers.features(replace(stack, solver="small"), "")
    assert "{peer_use_blocks, NULL}" in peers.features(stack, "CAIRN_BLOCKS(world_blocks);")


def test_the_output_is_read_and_a_lost_body_is_told() -> None:
    text = "start 65536 -32768\ncost 7\ncost 9\nend -2147483648 0\nheap 4096\nstack 800\nspare 0\ndone\n"
    output = peers.parse(text)
    assert output.starts == [(1.0, -0.5)]
    assert output.ends == [None]
    assert output.costs == [7, 9]
    assert output.numbers == {"heap": 4096, "stack": 800, "spare": 0}


def test_output_that_breaks_off_is_an_error() -> None:
    with pytest.raises(engine.EngineError, match="breaks off"):
        peers.parse("start 0 0\ncost 7\n")


def test_the_farthest_move_is_that_of_a_moving_body(stack: scene.Scene) -> None:
    output = output_of(stack, lambda x, y: (x + 0.3, y - 0.4 if y > 9 else y))
    assert peers.farthest_move(stack, output) == pytest.approx(0.5)
    output.ends[3] = None
    assert peers.farthest_move(stack, output) == math.inf


def test_a_body_beyond_the_scene_has_left(stack: scene.Scene) -> None:
    assert not peers.left(stack, output_of(stack, lambda x, y: (x, y)))
    assert not peers.left(stack, output_of(stack, lambda x, y: (x + 24, y)))
    assert peers.left(stack, output_of(stack, lambda x, y: (x + 27, y)))
    assert peers.left(stack, output_of(stack, lambda x, y: (x, y - 20)))


def test_the_tables_name_a_fallen_heap() -> None:
    cost = peers.Cost("heap", "m0", "cairn", "", 1000e3, 1200000, 1.0, 0.01, True, 1, 2, 3, 4, 5)
    others = [replace(cost, engine=name, mean_instructions=2500e3, times_cairn=2.5) for name in peers.ENGINES[1:]]
    others[1] = replace(others[1], stands=False, farthest_move=3.0)
    row = [next(iter(column.cells)) for column in bench_tables.peer_tables([[cost, *others]])[0].columns]
    assert row == ["heap", "m0", "1,000", "2,500", "2.5", "2,500", "2.5", "0.01 0.01 3.00 FELL"]


def test_settings_name_the_versions() -> None:
    assert "chipmunk 7.0.3-5" in peers.settings({"chipmunk": "7.0.3-5", "box2d": "2.4.1-3"})
