"""Cycles of a step: measured for the RP2040 in rp2040js, estimated for other chips from published instruction timings.

An estimate is instructions counted by class (tools/profile/profile.c), times the cycles that the core's reference
manual gives for the class, with memory that never makes the core wait. Where the manual gives a range, the lowest and
the highest sum are told, and their middle is the estimate.
"""

from __future__ import annotations

import re
import subprocess
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path

from . import bench, engine, profile
from .scene import Scene


@dataclass(frozen=True)
class Weight:
    """Cycles of an instruction: lowest and highest, more for each register, and more where it jumps."""

    low: float
    high: float
    register: float = 0
    jump: tuple[float, float] = (0, 0)


@dataclass(frozen=True)
class Timing:
    """What a manual says of a core."""

    core: str
    source: str
    weights: dict[str, Weight]


@dataclass(frozen=True)
class Chip:
    """A microcontroller: the core its image is built and counted for, its timing, its usual clock."""

    name: str
    counted_on: str
    timing: str
    mhz: int
    memory: str  # what it makes the core wait for


@dataclass(frozen=True)
class Instruction:
    """A line of a disassembly."""

    address: int
    mnemonic: str  # without .n, .w and condition
    operands: str
    conditional: bool = False


# What an instruction is to a timing table. The plugin knows a class by its place here.
CLASSES = (
    "other", "load", "load behind load", "load behind address", "store", "store behind load", "store behind address",
    "multiple", "push with lr", "pop with pc",
    "multiply", "multiply-add", "long multiply", "long multiply-add", "divide", "branch", "jump", "call", "indirect",
    "jump by load", "jump by table", "it", "float",
)  # fmt: skip


def _v6m(taken: int, call: int, pop: int) -> dict[str, Weight]:
    """The cores without Thumb-2: loads and stores of 2 cycles, one more for each register after the first."""
    return {
        "other": Weight(1, 1),
        **dict.fromkeys((name for name in CLASSES if name.startswith(("load", "store"))), Weight(2, 2)),
        **dict.fromkeys(("multiple", "push with lr"), Weight(1, 1, register=1)),
        "pop with pc": Weight(pop, pop, register=1),
        "multiply": Weight(1, 1),
        "branch": Weight(1, 1, jump=(taken - 1, taken - 1)),
        **dict.fromkeys(("jump", "indirect"), Weight(taken, taken)),
        "call": Weight(call, call),
    }


def _v7m(multiply_add: int, long_multiply: tuple[int, int], long_add: tuple[int, int]) -> dict[str, Weight]:
    """M3 and M4. A refill of the pipeline takes 1 to 3 cycles. A load behind a load is a cycle shorter if all is well.
    A load or store behind what makes its address is a cycle longer. A store takes 1 cycle unless the buffer is full.
    An IT may be folded into the instruction before it."""
    return {
        "other": Weight(1, 1),
        "load": Weight(2, 2),
        "load behind load": Weight(1, 2),
        "load behind address": Weight(3, 3),
        **dict.fromkeys(("store", "store behind load"), Weight(1, 2)),
        "store behind address": Weight(2, 3),
        **dict.fromkeys(("multiple", "push with lr"), Weight(1, 1, register=1)),
        "pop with pc": Weight(2, 4, register=1),
        "multiply": Weight(1, 1),
        "multiply-add": Weight(multiply_add, multiply_add),
        "long multiply": Weight(*long_multiply),
        "long multiply-add": Weight(*long_add),
        "divide": Weight(2, 12),
        "branch": Weight(1, 1, jump=(1, 3)),
        **dict.fromkeys(("jump", "call", "indirect"), Weight(2, 4)),
        **dict.fromkeys(("jump by load", "jump by table"), Weight(3, 5)),
        "it": Weight(0, 1),
        "float": Weight(1, 14),
    }


_M0_PLUS = _v6m(taken=2, call=3, pop=3)
TIMINGS = {
    "m0+": Timing("Cortex-M0+", "Arm DDI 0484C, Cortex-M0+ TRM r0p1, table 3-1, fast multiplier; N counts lr and pc",
                  _M0_PLUS),
    "m3": Timing("Cortex-M3", "Arm DDI 0337I, Cortex-M3 TRM r2p1, table 3-1 and section 3.3.2",
                 _v7m(2, (3, 5), (4, 7))),
    "m4": Timing("Cortex-M4", "Arm 100166 0001, Cortex-M4 TRM r0p1, table 3-1 and section 3.3.2",
                 _v7m(1, (1, 1), (1, 1))),
    # The emulator's own: a cycle less where lr is pushed and where pc is popped. Its sum must be the measured one.
    "rp2040js": Timing("rp2040js", "rp2040js 1.4.1, cortex-m0-core.js", {
        **_M0_PLUS, "push with lr": Weight(0, 0, register=1), "pop with pc": Weight(2, 2, register=1)}),
}  # fmt: skip

MEASURED = "RP2040"
CHIPS = (
    Chip(MEASURED, "m0", "m0+", 125, "misses of the 16 KB cache before the flash are not counted"),
    Chip("SAMD21", "m0", "m0+", 48, "the flash's wait state at 48 MHz is not counted"),
    Chip("STM32F103", "m3", "m3", 72, "the flash's 2 wait states behind a prefetch buffer are not counted"),
    Chip("SAMD51", "m4f", "m4", 120, "misses of the 4 KB cache before the flash are not counted"),
)
NOT_ESTIMATED = "m7, m33 and rv32 have no estimate: no instruction timings are published for the M7 and the M33."

_LINE = re.compile(r"^ *([0-9a-f]+):\t([a-z][a-z0-9.]*)(?:\t(.*))?$")
_SINGLE = re.compile(r"^v?(ldr|str)(b|h|sb|sh|ex|t)?$")
_BRANCH = re.compile(r"^b(eq|ne|cs|cc|hs|lo|mi|pl|vs|vc|hi|ls|ge|lt|gt|le)$")
_COMPARES = ("cmp", "cmn", "tst", "teq")
_REGISTER_RANGE = re.compile(r"\b[rsd](\d+)-[rsd](\d+)\b")


@dataclass(frozen=True)
class Tally:
    """Mean instructions of one class a step, the registers they load or store, how often they jumped."""

    count: float = 0
    registers: float = 0
    jumps: float = 0


@dataclass(frozen=True)
class Estimate:
    """Cycles a step: the table's lowest and highest."""

    low: float
    high: float

    @property
    def middle(self) -> float:
        return (self.low + self.high) / 2


def estimate(tallies: dict[str, Tally], timing: Timing) -> Estimate:
    """What the instructions take by a core's table; it must have a weight for each class that occurs."""
    low = high = 0.0
    for name, tally in tallies.items():
        weight = timing.weights[name]
        low += tally.count * weight.low + tally.registers * weight.register + tally.jumps * weight.jump[0]
        high += tally.count * weight.high + tally.registers * weight.register + tally.jumps * weight.jump[1]
    return Estimate(low, high)


def count(scene: Scene, core: str, first: int, last: int) -> dict[str, Tally]:
    """The instructions of a step by class."""
    rows = profile.rows(scene, core, first, last, listing=lambda image: list(_code_lines(disassemble(image))))
    steps = last - first + 1
    sums: dict[str, list[float]] = {}
    for _, numbers in rows:
        for i in range((len(numbers) - 1) // 3):
            one = sums.setdefault(CLASSES[i], [0, 0, 0])
            for k in range(3):
                one[k] += numbers[1 + 3 * i + k] / steps
    return {name: Tally(*one) for name, one in sums.items() if one[0]}


def disassemble(image: Path) -> list[Instruction]:
    """All instructions of an image."""
    line = ["arm-none-eabi-objdump", "-d", "--no-show-raw-insn", str(image)]
    text = subprocess.run(line, capture_output=True, text=True, check=True).stdout
    return list(parse(text.splitlines()))


def parse(lines: Iterable[str]) -> Iterator[Instruction]:
    """The instructions in objdump's lines."""
    conditional = 0
    for line in lines:
        match = _LINE.match(line)
        if not match:
            continue
        name = match[2].removesuffix(".n").removesuffix(".w")
        operands = re.split(r"\t|@|;", match[3] or "")[0].strip()
        if re.fullmatch("it[te]*", name):
            conditional = len(name) - 1
            yield Instruction(int(match[1], 16), "it", operands)
        elif conditional:
            conditional -= 1
            yield Instruction(int(match[1], 16), name[:-2], operands, conditional=True)
        else:
            yield Instruction(int(match[1], 16), name, operands)


def classify(it: Instruction, before: Instruction | None = None) -> tuple[str, int]:
    """The class of an instruction that lies behind another, and how many registers it loads or stores."""
    name, first = it.mnemonic, it.operands.split(",")[0].strip(" {}")
    if name.startswith(("ldm", "stm", "push", "pop", "vldm", "vstm", "vpush", "vpop")):
        registers = _registers(it.operands)
        if name == "push" and "lr" in registers:
            return "push with lr", len(registers)
        return ("pop with pc" if "pc" in registers else "multiple"), len(registers)
    if name in ("ldrd", "strd"):
        return "multiple", 2
    if _SINGLE.match(name):
        kind = "load" if "ldr" in name else "store"
        if first == "pc":
            return "jump by load", 1
        return kind + (_behind(before, it) if before is not None else ""), 1
    return _other_class(name, first), 0


def _other_class(name: str, first: str) -> str:
    if _BRANCH.match(name) or name in ("cbz", "cbnz"):
        return "branch"
    exact = {"b": "jump", "bl": "call", "bx": "indirect", "blx": "indirect",
             "tbb": "jump by table", "tbh": "jump by table",
             "mla": "multiply-add", "mls": "multiply-add", "sdiv": "divide", "udiv": "divide", "it": "it",
             "smull": "long multiply", "umull": "long multiply", "smlal": "long multiply-add",
             "umlal": "long multiply-add", "umaal": "long multiply-add",
             "mul": "multiply", "muls": "multiply"}  # fmt: skip
    if name in exact:
        return exact[name]
    if first == "pc" and name in ("mov", "add"):
        return "indirect"
    return "float" if name.startswith("v") else "multiply" if name.startswith(("smul", "smla", "smm")) else "other"


def _behind(before: Instruction, it: Instruction) -> str:
    """What the instruction before it means to a single load or store: a load can overlap it unless it loads what the
    address is made of; what makes the address holds it up."""
    written = [word.strip() for word in before.operands.split(",")[: 2 if "mull" in before.mnemonic else 1]]
    needed = set(re.findall(r"[a-z]+\d*", it.operands.partition("[")[2])) & set(written)
    if _SINGLE.match(before.mnemonic):
        return " behind load" if before.mnemonic.startswith("ldr") and written != ["pc"] and not needed else ""
    computes = classify(before)[0] in ("other", "multiply", "multiply-add", "long multiply", "divide")
    return " behind address" if needed and computes and before.mnemonic not in _COMPARES else ""


def _registers(operands: str) -> list[str]:
    """The registers in braces, ranges spelled out."""
    inner = operands[operands.index("{") + 1 : operands.index("}")]
    spelled = _REGISTER_RANGE.sub(lambda m: ",".join(f"r{i}" for i in range(int(m[1]), int(m[2]) + 1)), inner)
    return [name.strip() for name in spelled.split(",")]


def _code_lines(code: list[Instruction]) -> Iterator[str]:
    """The plugin's list: an instruction is as long as the way to the next, at most 4 bytes."""
    before: Instruction | None = None
    for i, it in enumerate(code):
        name, registers = classify(it, before)
        size = min(code[i + 1].address - it.address, 4) if i + 1 < len(code) else 4
        yield f"{it.address:x} {size} {CLASSES.index(name)} {registers}"
        before = it


@dataclass(frozen=True)
class Cycles:
    """Of a step on a chip, over the bench's steps; the worst one of all steps from the start."""

    scene: str
    chip: str
    core: str
    mhz: int
    how: str  # "measured" or "estimate"
    instructions: float
    cycles: float
    cycles_low: float
    cycles_high: float
    worst_cycles: float
    microseconds: float
    worst_microseconds: float
    hash: str


@dataclass(frozen=True)
class Deviation:
    """The M0+ estimate beside the cycles of rp2040js, and beside them the sum by rp2040js' own rules."""

    scene: str
    measured: float
    estimated: float
    by_its_rules: float

    @property
    def percent(self) -> float:
        return 100 * (self.estimated / self.measured - 1)

    @property
    def percent_by_its_rules(self) -> float:
        return 100 * (self.by_its_rules / self.measured - 1)


def measure(scene: Scene, chips: Iterable[Chip]) -> tuple[list[Cycles], Deviation | None]:
    """Each chip's cycles, and the check of the estimate where the measured chip is among them."""
    rows: list[Cycles] = []
    deviation = None
    counts: dict[str, tuple[bench.Cost, dict[str, Tally]]] = {}
    for chip in chips:
        if chip.counted_on not in counts:
            tallies = count(scene, chip.counted_on, bench.FIRST_STEP, bench.LAST_STEP)
            counts[chip.counted_on] = bench.measure(scene, chip.counted_on), tallies
        cost, tallies = counts[chip.counted_on]
        timing = TIMINGS[chip.timing]
        by_table = estimate(tallies, timing)
        if chip.name == MEASURED:
            got = engine.run(scene, "q16", "rp2040", bench.LAST_STEP, 0)
            steady = got.costs[bench.FIRST_STEP - 1 : bench.LAST_STEP]
            mean = sum(steady) / len(steady)
            by_its_rules = estimate(tallies, TIMINGS["rp2040js"])
            deviation = Deviation(scene.name, mean, by_table.middle, by_its_rules.middle)
            if got.hash != cost.hash:
                raise engine.EngineError(f"{scene.name}: {got.hash} on the RP2040, {cost.hash} on the M0")
            low, middle, high, worst, how = mean, mean, mean, float(max(got.costs)), "measured"
        else:
            low, middle, high, how = by_table.low, by_table.middle, by_table.high, "estimate"
            # The worst step is of the same kind of work: it has the mean's cycles an instruction.
            worst = cost.worst_instructions_from_start * middle / cost.mean_instructions
        rows.append(Cycles(
            scene.name, chip.name, timing.core, chip.mhz, how, cost.mean_instructions, middle, low, high, worst,
            middle / chip.mhz, worst / chip.mhz, cost.hash))  # fmt: skip
    return rows, deviation
