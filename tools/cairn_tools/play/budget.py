"""What the game takes on the console: instructions a frame, RAM and flash, with limits and a record."""

from __future__ import annotations

import importlib.util
import json
import tempfile
from collections.abc import Callable, Iterator
from dataclasses import asdict, dataclass
from pathlib import Path
from time import monotonic

from elftools.elf.elffile import ELFFile
from rich.table import Table

from .. import engine
from ..terminal import hold_to_record, out, working
from . import headless, images, script

FILE = engine.ROOT / "tests" / "bench" / "game.json"
GAME = "cairn"
RISE = 0.02  # more than this needs a new record, as with `bench --check`
FRAME = 833_000  # instructions of 1/60 s at 50 MHz
RAM, FLASH = 48 * 1024, 64 * 1024
SEED = 7
# Three kinds of a game: the frames of each.
PLAYS = {"24 stones": 600, "a script": 3600, "by itself": 3600}
WITH_STONES = "24 stones"
STONES = 24

Say = Callable[[str], None]


@dataclass(frozen=True)
class Row:
    """A figure, and the limit that it has to keep."""

    name: str
    now: int
    limit: int | None = None
    unit: str = "instructions"

    @property
    def fits(self) -> bool:
        return self.limit is None or self.now <= self.limit


def measure(say: Say) -> list[Row]:
    """All figures of the game."""
    say(f"building {GAME}")
    image = images.build(GAME, images.CONSOLE)
    rows = []
    for name, frames in PLAYS.items():
        say(name)
        cost = _cost(image, name, frames)
        rows.append(Row(f"worst frame, {name}", cost.worst, FRAME))
        rows.append(Row(f"mean frame, {name}", cost.mean))
        parts = {"physics": cost.step, "drawing": cost.drawing, "flush": cost.flush}
        rows += [Row(f"worst {part}, {name}", count) for part, count in parts.items()]
    return rows + _memory(image.path)


def _cost(image: images.Image, name: str, frames: int) -> headless.Cost:
    with tempfile.TemporaryDirectory(prefix="cairn-play-") as folder:
        keep, lines = None, []
        if name == WITH_STONES:
            keep = Path(folder) / "kept"
            keep.write_bytes(kept_game(STONES))
            lines = ["5 select", "7 none"]
        elif name == "a script":
            lines = script.long_play(frames, SEED)
        file = Path(folder) / "script.txt"
        file.write_text("\n".join(lines) + "\n", encoding="utf-8")
        got = headless.play(image, images.Play(frames, file, SEED, keep))
    if got.cost is None:
        raise engine.EngineError(f"{image.game}: its output has no cost")
    return got.cost


def kept_game(stones: int, level: int = 0, supply: int = 0) -> bytes:
    """A kept game with stones in the air above its level; the console's test knows how it is laid out."""
    place = engine.ROOT / "tests" / "qemu" / "check_games.py"
    spec = importlib.util.spec_from_file_location("check_games", place)
    if spec is None or spec.loader is None:
        raise engine.EngineError(f"{place} is not there")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module.kept_game(module.three_piles()[:stones], level, supply)


def _memory(image: Path) -> list[Row]:
    """What the image takes: its stack, 8 KB of which nothing is known to be free, is part of its RAM."""
    with image.open("rb") as binary:
        segments = [segment for segment in ELFFile(binary).iter_segments() if segment["p_type"] == "PT_LOAD"]
        flash = sum(segment["p_filesz"] for segment in segments)
        ram = sum(segment["p_memsz"] for segment in segments if segment["p_vaddr"] >= 0x20000000)
    return [Row("RAM with 8 KB of stack", ram, RAM, "bytes"), Row("flash", flash, FLASH, "bytes")]


def troubles(rows: list[Row]) -> Iterator[str]:
    """What is over its limit, or more than 2 % over the record."""
    record = json.loads(FILE.read_text(encoding="utf-8"))
    for row in rows:
        kept = record.get(row.name)
        if kept is None:
            yield f"{row.name}: not on record"
        elif row.now > kept * (1 + RISE):
            yield f"{row.name}: {row.now:,} {row.unit}, on record {kept:,}"


def run(keep: bool, check: bool, as_json: bool) -> None:
    """Exit code 1 where --check finds more than is on record: a limit that is missed is only told."""
    started = monotonic()
    with working("play --budget") as say:
        rows = measure(say)
    if as_json:
        print(json.dumps([{**asdict(row), "fits": row.fits} for row in rows], indent=2))
    else:
        out.print(_table(rows))
    if keep:
        FILE.write_text(json.dumps({row.name: row.now for row in rows}, indent=1) + "\n", encoding="utf-8")
    if check:
        hold_to_record(list(troubles(rows)), len(rows), started, as_json)


def _table(rows: list[Row]) -> Table:
    grid = Table(title=f"{GAME} on {images.CONSOLE}")
    for column in ("what", "now", "limit", ""):
        grid.add_column(column, justify="left" if column in ("what", "") else "right")
    for row in rows:
        limit = f"{row.limit:,}" if row.limit is not None else "-"
        verdict = "" if row.limit is None else "ok" if row.fits else f"{row.now - row.limit:,} over"
        grid.add_row(row.name, f"{row.now:,} {row.unit}", limit, verdict)
    return grid
