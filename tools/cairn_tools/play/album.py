"""The pictures of the games in docs/pictures: each is a game's own frames on the emulated console."""

from __future__ import annotations

import tempfile
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from . import budget, headless, images, pictures

FOLDER = "docs/pictures"
SEED = 5
LAYERS = 450  # the frame in which a debug layer is looked at
LEVEL = 64  # the first one again, with a line so high that the game does not end
SUPPLY = 9


def layers(*directions: str) -> tuple[str, ...]:
    """Goes on with the kept game and switches layers; the first press lets a stone go, the next one hangs by then."""
    lines = ["5 select", "7 none", "200 select"]
    for i, direction in enumerate(directions):
        lines += [f"{220 + 20 * i} select+{direction}", f"{226 + 20 * i} select"]
    return *lines, f"{226 + 20 * len(directions)} none"


@dataclass(frozen=True)
class Picture:
    """One of them: a GIF of the frames from `first` to `last`, or a PNG of the last one."""

    name: str
    game: str
    last: int
    lines: tuple[str, ...] = ()
    first: int = 0
    every: int = 0  # frames of the game for one of the film
    scale: int = 3
    stones: int = 0  # of a kept game that is gone on with


RUN = tuple(f"{frame} right{'+select' if jumps else ''}" for frame, jumps in
            ((10, 0), (50, 1), (80, 0), (120, 1), (150, 0), (180, 1), (210, 0), (240, 1), (270, 0)))  # fmt: skip
ALBUM = (
    Picture("game.gif", "cairn", 1260, first=400, every=4),
    Picture("game-shapes.png", "cairn", LAYERS, layers("up"), stones=15),
    Picture("game-contacts.png", "cairn", LAYERS, layers("up", "left"), stones=15),
    Picture("game-cells.png", "cairn", LAYERS, layers("up", "right"), stones=15),
    Picture("game-springs.png", "cairn", LAYERS, layers("up", "down"), stones=15),
    Picture("game-pinball.png", "pinball", 150, ("10 select", "70 none")),
    Picture("game-platformer.png", "platformer", 270, RUN),
    Picture("game-show.png", "show", 200),
)


def draw(folder: Path, board: str, say: Callable[[str], None]) -> None:
    for one in ALBUM:
        say(f"{one.name} on {board}")
        _draw(one, folder / one.name, images.build(one.game, board))


def _draw(one: Picture, file: Path, image: images.Image) -> None:
    with tempfile.TemporaryDirectory(prefix="cairn-play-") as folder:
        script = Path(folder) / "script.txt"
        script.write_text("\n".join(one.lines) + "\n", encoding="utf-8")
        keep = Path(folder) / "kept" if one.stones else None
        if keep:
            keep.write_bytes(budget.kept_game(one.stones, LEVEL, SUPPLY))
        how = images.Play(one.last, script, SEED, keep)
        got = headless.play(image, how, pictures=one.every, last=not one.every).pictures
    if one.every:
        pictures.gif(file, (got[frame] for frame in got if frame >= one.first), one.every, one.scale)
    else:
        pictures.png(file, got[one.last], one.scale)
