"""Instructions by class, the estimate of their cycles, and the emulator that measures them."""

from __future__ import annotations

import pytest
from cairn_tools import bench, bench_tables, cycles, engine, profile, scene
from cairn_tools.cycles import Chip, Estimate, Instruction, Tally, Timing, Weight

LISTING = """
build/runner.elf:     file format elf32-littlearm

00000100 <cairn_world_step>:
     100:\tpush\t{r4, r5, lr}
     102:\tldr.w\tr3, [r0, #4]
     106:\tldr\tr2, [r0, #8]
     108:\tstr\tr2, [r3, r2]
     10a:\tcmp\tr2, #0
     10c:\titte\tgt
     10e:\tmovgt\tr1, #1
     110:\tldrgt.w\tr1, [r1]
     114:\tmulle\tr1, r2
     116:\tbne.n\t102 <cairn_world_step+0x2>
     118:\tsmull\tr4, r5, r2, r3
     11c:\tldmia.w\tsp!, {r4-r9, pc}
     120:\t.word\t0x20000000
""".splitlines()


def classes(lines: list[str]) -> list[tuple[str, int]]:
    code = list(cycles.parse(lines))
    return [cycles.classify(it, code[i - 1] if i else None) for i, it in enumerate(code)]


def test_a_listing_is_sorted_into_classes() -> None:
    assert classes(LISTING) == [
        ("push with lr", 3), ("load", 1), ("load behind load", 1), ("store", 1), ("other", 0), ("it", 0), ("other", 0),
        ("load behind address", 1), ("multiply", 0), ("branch", 0), ("long multiply", 0), ("pop with pc", 7),
    ]  # fmt: skip


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("b.n\t10 <x>", ("jump", 0)),
        ("bl\t10 <x>", ("call", 0)),
        ("bic.w\tr0, r1, r2", ("other", 0)),
        ("bls.n\t10 <x>", ("branch", 0)),
        ("blt.w\t10 <x>", ("branch", 0)),
        ("cbnz\tr0, 10 <x>", ("branch", 0)),
        ("bx\tlr", ("indirect", 0)),
        ("blx\tr3", ("indirect", 0)),
        ("mov\tpc, r3", ("indirect", 0)),
        ("ldr.w\tpc, [r3, r0, lsl #2]", ("jump by load", 1)),
        ("tbb\t[pc, r3]", ("jump by table", 0)),
        ("ldrd\tr0, r1, [r2]", ("multiple", 2)),
        ("strd\tr0, r1, [r2, #8]", ("multiple", 2)),
        ("ldrsh.w\tr0, [r2, #8]", ("load", 1)),
        ("ldr\tr0, [pc, #24]\t@ (10 <x>)", ("load", 1)),
        ("strb\tr0, [r2, #8]", ("store", 1)),
        ("stmia\tr2!, {r0, r1, r4}", ("multiple", 3)),
        ("push\t{r4, r5}", ("multiple", 2)),
        ("pop\t{r4, r5}", ("multiple", 2)),
        ("vpush\t{d8}", ("multiple", 1)),
        ("muls\tr0, r1", ("multiply", 0)),
        ("mla\tr0, r1, r2, r3", ("multiply-add", 0)),
        ("smlal\tr0, r1, r2, r3", ("long multiply-add", 0)),
        ("smlabb\tr0, r1, r2, r3", ("multiply", 0)),
        ("smmulr\tr0, r1, r2", ("multiply", 0)),
        ("udiv\tr0, r1, r2", ("divide", 0)),
        ("adds\tr0, r1, r2", ("other", 0)),
        ("uadd8\tr0, r1, r2", ("other", 0)),
        ("vmov\ts0, r2", ("float", 0)),
    ],
)
def test_an_instruction_has_its_class(text: str, expected: tuple[str, int]) -> None:
    assert classes([f"      10:\t{text}"]) == [expected]


def test_a_load_whose_address_was_just_loaded_is_not_behind_a_load() -> None:
    first = Instruction(0, "ldr", "r3, [r0, #4]")
    assert cycles.classify(Instruction(2, "ldr", "r1, [r3]"), first) == ("load", 1)
    assert cycles.classify(Instruction(2, "str", "r1, [r0, r3]"), first) == ("store", 1)
    assert cycles.classify(Instruction(2, "str", "r3, [r0, #8]"), first) == ("store behind load", 1)
    assert cycles.classify(Instruction(2, "ldr", "r1, [r0]"), Instruction(0, "ldrd", "r3, r4, [r0]")) == ("load", 1)


def test_a_load_whose_address_was_just_made_is_held_up() -> None:
    load, store = Instruction(2, "ldr", "r1, [r0, #4]"), Instruction(2, "strh", "r1, [r3, r0]")
    made = Instruction(0, "adds", "r0, r2, r1")
    assert cycles.classify(load, made) == ("load behind address", 1)
    assert cycles.classify(store, made) == ("store behind address", 1)
    assert cycles.classify(store, Instruction(0, "smull", "r4, r0, r2, r1")) == ("store behind address", 1)
    assert cycles.classify(load, Instruction(0, "adds", "r1, r2, r0")) == ("load", 1)
    assert cycles.classify(load, Instruction(0, "cmp", "r0, r2")) == ("load", 1)
    assert cycles.classify(load, Instruction(0, "bl", "0 <r0>")) == ("load", 1)


def test_an_estimate_is_counts_times_weights_with_its_range() -> None:
    timing = Timing("core", "here", {
        "other": Weight(1, 1), "multiple": Weight(1, 1, register=1), "divide": Weight(2, 12),
        "branch": Weight(1, 1, jump=(1, 3)),
    })  # fmt: skip
    tallies = {"other": Tally(100), "multiple": Tally(10, 30), "divide": Tally(2), "branch": Tally(20, 0, 5)}
    got = cycles.estimate(tallies, timing)
    assert got == Estimate(100 + 40 + 4 + 25, 100 + 40 + 24 + 35)
    assert got.middle == 184


def test_a_class_that_a_table_does_not_know_is_an_error() -> None:
    with pytest.raises(KeyError):
        cycles.estimate({"divide": Tally(1)}, cycles.TIMINGS["m0+"])


def test_every_weight_is_of_a_class_and_every_chip_has_its_timing() -> None:
    for timing in cycles.TIMINGS.values():
        assert set(timing.weights) <= set(cycles.CLASSES)
        assert all(0 <= w.low <= w.high and w.jump[0] <= w.jump[1] for w in timing.weights.values())
    for chip in cycles.CHIPS:
        assert chip.timing in cycles.TIMINGS and chip.counted_on in engine.COUNTED


@pytest.mark.parametrize(
    ("weight", "text"),
    [
        (Weight(2, 2), "2"),
        (Weight(2, 12), "2-12"),
        (Weight(2, 4, register=1), "2-4 + N"),
        (Weight(1, 1, jump=(1, 3)), "1, taken 2-4"),
    ],
)
def test_a_weight_reads_as_in_a_manual(weight: Weight, text: str) -> None:
    assert bench_tables.weight_text(weight) == text


@pytest.mark.parametrize("core", ["m0", "m4f"])
def test_the_classes_add_up_to_the_step(core: str) -> None:
    loaded = scene.load(scene.find("stack10"))
    tallies = cycles.count(loaded, core, bench.FIRST_STEP, bench.LAST_STEP)
    cost = bench.measure(loaded, core)
    assert sum(tally.count for tally in tallies.values()) == pytest.approx(cost.mean_instructions, rel=1e-3)
    for name in ("jump", "call"):  # nothing else can follow
        assert tallies[name].jumps == pytest.approx(tallies[name].count)
    assert 0 < tallies["branch"].jumps < tallies["branch"].count
    assert "float" not in tallies


RP2040JS = engine.ROOT / "build" / "rp2040" / "node_modules"


@pytest.mark.skipif(not RP2040JS.is_dir(), reason="tools/setup --rp2040 has not been asked for")
def test_the_rp2040_ends_in_the_same_state_and_its_rules_give_its_cycles() -> None:
    loaded = scene.load(scene.find("stack10"))
    rows, check = cycles.measure(loaded, [chip for chip in cycles.CHIPS if chip.name == cycles.MEASURED])
    assert check is not None and abs(check.percent_by_its_rules) < 0.05 and abs(check.percent) < 3
    assert rows[0].hash == engine.run(loaded, "q16", "host", bench.LAST_STEP, 0).hash
    assert rows[0].microseconds == pytest.approx(rows[0].cycles / 125)
    shares = profile.measure_cycles(loaded, 1, 3)
    first = engine.run(loaded, "q16", "rp2040", 3, 0).costs
    assert sum(shares.stages.values()) == pytest.approx(sum(first) / 3, rel=1e-3)


def test_a_chip_that_is_not_measured_has_an_estimate_with_a_range() -> None:
    chip = Chip("none", "m3", "m3", 100, "")
    rows, check = cycles.measure(scene.load(scene.find("bounce")), [chip])
    assert check is None
    assert rows[0].cycles_low < rows[0].cycles < rows[0].cycles_high
    assert rows[0].how == "estimate"
    record = bench_tables.cycles_record(rows, [])
    assert list(record["weights"]) == ["Cortex-M3"] and record["results"][0]["microseconds"] == rows[0].cycles / 100
