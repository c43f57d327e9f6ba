"""The counts of a step by function and the record of what steps cost."""

from __future__ import annotations

import json
from dataclasses import replace

import pytest
from cairn_tools import bench, engine, kept, memory, profile, scene


@pytest.fixture(scope="module")
def stack() -> scene.Scene:
    return scene.load(scene.find("stack10"))


def test_the_functions_add_up_to_the_step(stack: scene.Scene) -> None:
    shares = profile.measure(stack, "m3", bench.FIRST_STEP, bench.LAST_STEP)
    cost = bench.measure(stack, "m3")
    # The step's own count begins before the call and ends behind it.
    assert sum(shares.functions.values()) == pytest.approx(cost.mean_instructions, rel=1e-3)
    assert sum(shares.stages.values()) == pytest.approx(sum(shares.functions.values()))


def test_a_profile_is_of_the_solver_that_is_asked_for(stack: scene.Scene) -> None:
    small = replace(stack, solver="small", passes=4)
    shares = profile.measure(small, "m3", 1, 30)
    costs = engine.run(small, "q16", "m3", 30, 0).costs
    assert sum(shares.functions.values()) == pytest.approx(sum(costs) / 30, rel=1e-3)
    assert not any(name.startswith(("biased", "relax")) for name in shares.functions)


def test_every_stage_of_a_step_is_seen(stack: scene.Scene) -> None:
    assert all(count > 0 for count in profile.measure(stack, "m3", 1, 60).stages.values())


def test_what_the_compiler_s_own_routines_take_is_counted_too() -> None:
    # Springs divide by libgcc on the M0.
    springs = scene.load(scene.find("curtain150"))
    shares = profile.measure(springs, "m0", 1, 4)
    costs = engine.run(springs, "q16", "m0", 4, 0).costs
    assert sum(shares.functions.values()) == pytest.approx(sum(costs) / 4, rel=1e-3)


def test_a_pyramid_that_sleeps_costs_next_to_nothing() -> None:
    assert bench.measure(memory.load("pyramid10 sleep"), "m0").worst_instructions <= 6000


def test_a_dearer_step_than_the_record_is_told_with_its_functions(
    monkeypatch: pytest.MonkeyPatch, tmp_path, stack: scene.Scene
) -> None:
    monkeypatch.setattr(kept, "CORES", ("m3",))
    monkeypatch.setattr(kept, "SCENES", (stack.name,))
    monkeypatch.setattr(kept, "FILE", tmp_path / "bench" / "counts.json")
    kept.write(lambda _: None)
    assert list(kept.troubles(lambda _: None)) == []
    record = json.loads(kept.FILE.read_text())
    entry = record[stack.name]["m3"]
    dearest = next(iter(entry["functions"]))
    entry["functions"][dearest] -= int(0.05 * entry["mean"])
    entry["mean"] = int(entry["mean"] * 0.95)
    kept.FILE.write_text(json.dumps(record))
    told = list(kept.troubles(lambda _: None))
    assert len(told) == 1 + kept.SHOWN
    assert "mean" in told[0]
    assert dearest in told[1]


def test_a_scene_that_is_not_on_record_is_told(monkeypatch: pytest.MonkeyPatch, tmp_path, stack: scene.Scene) -> None:
    monkeypatch.setattr(kept, "CORES", ("m3",))
    monkeypatch.setattr(kept, "SCENES", (stack.name,))
    monkeypatch.setattr(kept, "FILE", tmp_path / "counts.json")
    kept.FILE.write_text("{}")
    assert list(kept.troubles(lambda _: None)) == ["stack10 on m3: not on record"]
