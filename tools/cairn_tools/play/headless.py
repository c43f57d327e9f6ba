"""A game without a person: what its image prints, as numbers and pictures."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from .. import engine
from . import images

WIDTH, HEIGHT = 128, 64
Picture = NDArray[np.uint8]  # HEIGHT rows of WIDTH greys from 0 to 15


@dataclass(frozen=True)
class Hashes:
    """Of a frame: all that decides the game's future, and its picture."""

    frame: int
    state: str
    picture: str


@dataclass(frozen=True)
class Cost:
    """The worst frames, in instructions on the console and in nanoseconds on the host."""

    worst: int  # physics, drawing and flush of one frame
    frame: int  # that one
    mean: int
    step: int
    drawing: int
    flush: int
    stack: int  # bytes


@dataclass
class Result:
    """All that an image printed."""

    hashes: list[Hashes] = field(default_factory=list)
    pictures: dict[int, Picture] = field(default_factory=dict)
    cost: Cost | None = None
    held: list[str] = field(default_factory=list)  # lines of an input script
    end: Hashes | None = None


def play(image: images.Image, how: images.Play, every: int = 0, pictures: int = 0, last: bool = False) -> Result:
    """Plays to the end. Hashes each `every` frames, pictures each `pictures` frames and, if wished, of the last one."""
    step = math.gcd(pictures, how.frames) if last else pictures
    words = ["cost"]
    words += [f"every={every}"] if every else []
    words += [f"dump={step}"] if step else []
    got = parse(images.run(image, how, words))
    if got.end is None:
        raise engine.EngineError(f"{image.game} on {image.board}: its output breaks off")
    wished = {frame for frame in got.pictures if pictures and frame % pictures == 0}
    wished |= {how.frames} if last else set()
    got.pictures = {frame: picture for frame, picture in got.pictures.items() if frame in wished}
    return got


def parse(output: str) -> Result:
    """The lines of examples/shell/shell.c."""
    got = Result()
    lines = iter(output.splitlines())
    for line in lines:
        name, _, rest = line.partition(" ")
        match name:
            case "frame":
                got.hashes.append(_hashes(rest.split()))
            case "end":
                got.end = _hashes(rest.split())
            case "picture":
                got.pictures[int(rest)] = picture_of([next(lines, "") for _ in range(HEIGHT)])
            case "cost":
                got.cost = _cost(rest.split())
            case "held":
                got.held.append(rest)
    return got


def _hashes(words: Sequence[str]) -> Hashes:
    frame, _, state, _, picture = words
    return Hashes(int(frame), state, picture)


def _cost(words: Sequence[str]) -> Cost:
    numbers = [int(word) for word in words if word.isdigit()]
    return Cost(*numbers)


def picture_of(rows: Sequence[str]) -> Picture:
    """From rows of hexadecimal digits, one a pixel."""
    return np.array([[int(digit, 16) for digit in row] for row in rows], dtype=np.uint8)
