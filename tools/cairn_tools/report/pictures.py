"""Pictures as data URIs, so that the page needs no other file."""

from __future__ import annotations

import tempfile
from base64 import b64encode
from collections.abc import Callable
from pathlib import Path

from .model import Figure

# As the page's cards are.
DARK = ["dark_background", {f"{part}.facecolor": "#1e2124" for part in ("figure", "axes", "savefig", "legend")}]


def data_uri(content: bytes, kind: str) -> str:
    return f"data:{kind};base64,{b64encode(content).decode()}"


def of_files(titles: list[str], draw: Callable[[Path], list[Path]]) -> list[Figure]:
    """The pictures that are written into a folder, for light and for dark screens."""
    import matplotlib.pyplot as plt

    pictures = []
    for style in ("default", DARK):
        with tempfile.TemporaryDirectory(prefix="cairn-") as folder, plt.style.context(style):
            pictures.append([data_uri(file.read_bytes(), "image/png") for file in draw(Path(folder))])
    return [Figure(title, light, dark, wide=True) for title, light, dark in zip(titles, *pictures, strict=True)]
