"""What a world takes of RAM and stack."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import pytest
from cairn_tools import bench_tables, engine, memory, scene
from cairn_tools.memory import Row


def rows() -> list[Row]:
    return [
        Row("size", "a body", "m0", 72, 72),
        Row("size", "a body", "m3", 76, 72),
        Row("size", "a spring", "m0", 128),
        Row("size", "a spring", "m3", 128),
        Row("stack", "tower", "m0", 1000, 1024),
        Row("stack", "tower", "m3", 900, 1024),
    ]


@pytest.fixture(scope="module")
def image(tmp_path_factory: pytest.TempPathFactory) -> Path:
    file = tmp_path_factory.mktemp("memory") / "runner.elf"
    engine.build_image(memory.load("pyramid10 quadtree"), "m3", file)
    return file


@pytest.mark.parametrize("name", memory.SCENES)
def test_every_scene_can_be_read(name: str) -> None:
    loaded = memory.load(name)
    assert loaded.solver == next((solver for solver in ("slides", "small") if name.endswith(solver)), "soft")
    if "quadtree" in name:
        assert loaded.broad_phase == "quadtree"


def test_the_sizes_of_types_are_those_that_the_image_tells(image: Path) -> None:
    types, pools = memory.type_sizes(image), memory.pool_sizes(image)
    assert set(types) == {f"cairn_{name}" for name in memory.TYPES}
    bodies = len(memory.load("pyramid10").bodies)
    assert pools["world_bodies"] == bodies * types["cairn_body"]
    assert pools["world_world"] == types["cairn_world"]
    assert pools["world_arbiters"] % types["cairn_arbiter"] == 0
    assert pools["world_quadtree_tree"] == types["cairn_quadtree"]
    assert pools["world_quadtree_boxes"] == bodies * types["cairn_quadtree_box"]
    # CAIRN_WORLD's six and CAIRN_QUADTREE's four; the constants that tell where they lie are in flash.
    assert len(pools) == 10


def test_an_image_without_the_engine_tells_no_sizes(image: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(memory, "TYPES", ("body", "unicorn"))
    with pytest.raises(engine.EngineError, match="cairn_unicorn"):
        memory.type_sizes(image)


def test_pools_are_cut_in_the_table() -> None:
    text = "a;\nCAIRN_WORLD(world, 56, 240);\nb;"
    assert memory.cut(text, {"CAIRN_WORLD(world": (56, 101)}) == "a;\nCAIRN_WORLD(world, 56, 101);\nb;"
    with pytest.raises(engine.EngineError, match="CAIRN_SPRINGS"):
        memory.cut(text, {"CAIRN_SPRINGS(world_springs": (1, 2)})


def test_the_stack_of_the_step_is_measured_alone() -> None:
    one, other = (engine.run(scene.load(scene.find(name)), "q16", "m3", 60, 0) for name in ("projectile", "mixed50"))
    lone, heap = (got.stack - got.stack_before for got in (one, other))
    # A step takes its own frame at least; building the world would be deeper than a body alone.
    assert 16 < lone < 600 < heap


def test_the_world_is_linked_with_pools_that_just_suffice() -> None:
    found = memory.measure(["m3"], [], lambda _: None)
    assert {row.kind for row in found} == {"size"}
    sizes = {row.name: row.bytes for row in found}
    world = sizes["pyramid10's world with its tree"]
    assert 56 * sizes["a body"] + 55 * sizes["an arbiter"] < world < 20_000
    assert [row.goal for row in found if row.name == "an arbiter"] == [80]


def test_the_goals_have_verdicts() -> None:
    assert [row.verdict for row in rows()] == ["ok", "4 over", "-", "-", "ok", "ok"]


def test_memory_is_told_with_the_verdict_of_the_worst_core() -> None:
    sizes, stacks = (bench_tables.as_markdown(grid).splitlines() for grid in bench_tables.memory_tables(rows()))
    assert sizes[:4] == ["| what | m0 | m3 | goal | verdict |", "| --- | ---: | ---: | ---: | --- |",
                         "| a body | 72 | 76 | 72 | 4 over |", "| a spring | 128 | 128 | - | - |"]  # fmt: skip
    assert stacks[2] == "| tower | 1,000 | 900 | 1,024 | ok |"
    assert bench_tables.memory_record(rows())[1] == {
        "kind": "size", "name": "a body", "core": "m3", "bytes": 76, "goal": 72, "verdict": "4 over"}  # fmt: skip


def test_only_what_has_risen_above_the_record_is_trouble(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setattr(memory, "FILE", tmp_path / "bench" / "memory.json")
    memory.write(rows())
    assert json.loads(memory.FILE.read_text())["m3"]["stack"] == {"tower": 900}
    now = [replace(row, bytes=row.bytes - 4) for row in rows()]
    assert list(memory.troubles(now)) == []
    now[0] = replace(now[0], bytes=73)
    now.append(Row("stack", "bridge", "m0", 10, 1024))
    assert list(memory.troubles(now)) == ["size of a body on m0: 73 bytes, on record 72",
                                          "stack of bridge on m0: not on record"]  # fmt: skip
