"""The depth of the stack by gcc's call graph."""

from __future__ import annotations

from pathlib import Path

import pytest
from cairn_tools import call_graph, engine


def node(name: str, size: int | None = None) -> str:
    label = f"{name}\\nsrc/a.c:1:1" + ("" if size is None else f"\\n{size} bytes (static)\\n0 dynamic objects")
    return f'node: {{ title: "{name}" label: "{label}" }}\n'


def edge(source: str, target: str, place: str = "src/world.c:1:1") -> str:
    return f'edge: {{ sourcename: "{source}" targetname: "{target}" label: "{place}" }}\n'


def graph_of(folder: Path, *lines: str) -> call_graph.Graph:
    file = folder / "a.ci"
    file.write_text('graph: { title: "a.c"\n' + "".join(lines) + "}\n", encoding="utf-8")
    return call_graph.read([file])


def test_the_deepest_way_counts_and_what_is_outside_has_a_bound(tmp_path: Path) -> None:
    nodes = [node("top", 16), node("left", 100), node("right", 40), node("below", 70), node("memcpy")]
    edges = [edge("top", "left"), edge("top", "right"), edge("right", "below"), edge("left", "memcpy")]
    graph = graph_of(tmp_path, *nodes, *edges)
    assert graph.depth("top") == (16 + 100 + call_graph.OUTSIDE, ("top 16", "left 100", "memcpy 32"))
    assert graph.depth("right")[0] == 110


def test_a_function_that_calls_itself_has_no_bound(tmp_path: Path) -> None:
    graph = graph_of(tmp_path, node("top", 16), node("again", 8), edge("top", "again"), edge("again", "top"))
    with pytest.raises(engine.EngineError, match="top > again > top"):
        graph.depth("top")


def test_a_pointer_must_be_known_and_lead_somewhere(tmp_path: Path) -> None:
    with pytest.raises(engine.EngineError, match=r"world\.c:1:1"):
        graph_of(tmp_path, node("top", 16), edge("top", "__indirect_call"))
    lines = (engine.ROOT / "src" / "world.c").read_text(encoding="utf-8").splitlines()
    number = next(i for i, line in enumerate(lines, 1) if "solver(world)->solve(" in line)
    place = f"src/world.c:{number}:1"
    with pytest.raises(engine.EngineError, match="solver_soft:solve"):
        graph_of(tmp_path, node("top", 16), edge("top", "__indirect_call", place))
    solvers = [node("src/solver_soft.c:solve", 100), node("src/solver_small.c:solve.part.0", 120)]
    graph = graph_of(tmp_path, node("top", 16), *solvers, edge("top", "__indirect_call", place))
    assert graph.depth("top")[0] == 136


def test_public_functions_are_those_of_the_headers() -> None:
    found = set(call_graph.public_functions())
    assert {"cairn_world_step", "cairn_query_ray", "cairn_blocks_enable"} <= found
    assert "cairn_vec2_of" not in found
