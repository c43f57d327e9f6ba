"""The same game twice: on the console and on the host a long scripted play must give the same states and pictures."""

from __future__ import annotations

import json
import tempfile
from concurrent.futures import ThreadPoolExecutor
from dataclasses import asdict, dataclass
from pathlib import Path
from time import monotonic

import typer

from ..terminal import working
from . import headless, images, script

FRAMES = 36_000  # ten minutes
SEED = 20_26
EVERY = 600


@dataclass(frozen=True)
class Verdict:
    """What a long play ended in."""

    game: str
    frames: int
    console: headless.Hashes
    host: headless.Hashes
    first_difference: int | None  # the frame by which they differ
    cost: headless.Cost

    @property
    def equal(self) -> bool:
        return self.first_difference is None and self.console == self.host


def compare(game: str, frames: int) -> Verdict:
    """Plays on both boards at a time."""
    consoles = [images.build(game, board) for board in images.BOARDS]
    with tempfile.TemporaryDirectory(prefix="cairn-play-") as folder:
        file = Path(folder) / "long.txt"
        file.write_text("\n".join(script.long_play(frames, SEED)) + "\n", encoding="utf-8")
        how = images.Play(frames, file, SEED)
        with ThreadPoolExecutor(len(consoles)) as pool:
            console, host = pool.map(lambda image: headless.play(image, how, EVERY), consoles)
    pairs = zip(console.hashes, host.hashes, strict=True)
    first = next((ours.frame for ours, theirs in pairs if ours != theirs), None)
    return Verdict(game, frames, console.end, host.end, first, console.cost)


def run(game: str, frames: int, as_json: bool) -> None:
    """Exit code 1 if they differ."""
    started = monotonic()
    with working(f"{game}, {frames} frames on both boards"):
        got = compare(game, frames)
    if as_json:
        print(json.dumps({**asdict(got), "equal": got.equal}, indent=2))
    else:
        for board, end in ((images.CONSOLE, got.console), ("host", got.host)):
            print(f"{game} on {board}: frame {end.frame}, state {end.state}, picture {end.picture}")
        if got.first_difference:
            print(f"they differ by frame {got.first_difference}")
        print(f"worst frame {got.cost.worst:,} instructions (frame {got.cost.frame:,}), mean {got.cost.mean:,}")
        print(f"{int(got.equal)} passed, {int(not got.equal)} failed in {monotonic() - started:.1f}s")
    if not got.equal:
        raise typer.Exit(1)
