"""Input scripts (examples/shell/script.h): written from a play, with what is needed to play it again in comments."""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from random import Random

from ..errors import UserError
from .headless import Hashes

BUTTONS = ("up", "down", "left", "right", "select")
AFTER_LAST = 60  # frames played after a script's last line where nothing says how many


@dataclass(frozen=True)
class About:
    """What a script's comments and lines say of the play it was recorded from."""

    seed: int | None
    frames: int
    end: Hashes | None


def text(game: str, seed: int, lines: Iterable[str], end: Hashes | None) -> str:
    """A recorded play."""
    head = [f"# game {game}", f"# seed {seed}"]
    if end:
        head.append(f"# end {end.frame} state {end.state} picture {end.picture}")
    return "\n".join([*head, *lines]) + "\n"


def about(file: Path) -> About:
    """Reads the comments; the lines themselves are the image's to judge."""
    try:
        content = file.read_text(encoding="utf-8")
    except UnicodeDecodeError as error:
        raise UserError(f"{file}: this is no text") from error
    except OSError as error:
        raise UserError(f"{file}: {error.strerror}") from error
    seed = re.search(r"^# seed (\d{1,9})$", content, re.MULTILINE)
    end = re.search(r"^# end (\d{1,9}) state ([0-9a-f]{8}) picture ([0-9a-f]{8})$", content, re.MULTILINE)
    numbers = [int(number) for number in re.findall(r"^\s*(\d{1,9})\b", content, re.MULTILINE)]
    frames = int(end[1]) if end else max(numbers, default=0) + AFTER_LAST
    return About(int(seed[1]) if seed else None, frames, Hashes(int(end[1]), end[2], end[3]) if end else None)


def long_play(frames: int, seed: int) -> list[str]:
    """A player who never rests: moves, turns, drops, now and then opens the menu or switches a debug layer."""
    random = Random(seed)
    lines, frame, last = ["1 none"], 30, "none"
    while frame < frames:
        moves = random.choices(("none", "left", "right", "up", "down"), (4, 3, 3, 2, 2))[0]
        held = moves if random.random() < 0.6 else "select" if moves == "none" else f"{moves}+select"
        if held != last:
            lines.append(f"{frame} {held}")
            last = held
        # SELECT is a tap most of the time: held for long it opens the menu.
        frame += random.randint(2, 8) if "select" in held and random.random() < 0.97 else random.randint(6, 50)
    return lines
