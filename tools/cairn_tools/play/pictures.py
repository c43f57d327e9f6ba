"""Frames of the console as files: PNG, and GIF in real time."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

import numpy as np
from PIL import Image

from .headless import HEIGHT, WIDTH, Picture

GREYS = 16
MOST = 255 // (GREYS - 1)  # 17: the greys of QEMU's display too
STEPS_A_SECOND = 60


def png(file: Path, picture: Picture, scale: int) -> None:
    _enlarged(picture, scale).save(file, format="PNG", optimize=True)


def gif(file: Path, frames: Iterable[Picture], steps_a_frame: int, scale: int) -> None:
    """A film that runs as fast as the game."""
    first, *others = [_enlarged(picture, scale) for picture in frames]
    # A GIF counts in hundredths of a second, and viewers take less than two for "slowly".
    duration = max(2, round(100 * steps_a_frame / STEPS_A_SECOND)) * 10
    first.save(file, format="GIF", save_all=True, append_images=others, duration=duration, loop=0, optimize=True)


def _enlarged(picture: Picture, scale: int) -> Image.Image:
    image = Image.fromarray(picture).convert("P")
    image.putdata(picture.reshape(-1).tolist())
    image.putpalette([value for grey in range(GREYS) for value in (MOST * grey,) * 3])
    return image.resize((WIDTH * scale, HEIGHT * scale), Image.Resampling.NEAREST)


def of_dump(file: Path, scale: int) -> Picture | None:
    """The console's picture from a screen dump of its emulator; None if it is not one of whole pixels in 16 greys."""
    with Image.open(file) as image:
        pixels = np.asarray(image.convert("RGB"))
    if pixels.shape != (HEIGHT * scale, WIDTH * scale, 3):
        return None
    small = pixels[::scale, ::scale]
    whole = np.repeat(np.repeat(small, scale, axis=0), scale, axis=1)
    grey = (small == small[:, :, :1]).all() and (small % MOST == 0).all()
    return (small[:, :, 0] // MOST).astype(np.uint8) if grey and (whole == pixels).all() else None
