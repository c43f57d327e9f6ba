"""What a page is made of: parts that measure, and the sections that they give."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field, fields, is_dataclass
from enum import Enum
from typing import Any

import numpy as np
from rich.table import Table
from rich.text import Text

# Tones of a cell or a finding: colours on the page, and never the colour alone.
GOOD, BAD, OPEN = "good", "bad", "open"
_WORDS = {"ok": GOOD, "holds": GOOD, "equal": GOOD}
_TONES = {"green": GOOD, "red": BAD, "yellow": OPEN}


@dataclass(frozen=True)
class Options:
    """What was asked for."""

    quick: bool = False  # a few rows of each part, for tests
    peers: bool = False  # Chipmunk and Box2D too


@dataclass(frozen=True)
class Cell:
    text: str
    tone: str = ""


@dataclass(frozen=True)
class Grid:
    """A table; numbers to the right."""

    title: str
    columns: list[str]
    right: list[bool]
    rows: list[list[Cell]]
    caption: str = ""


@dataclass(frozen=True)
class Figure:
    """A picture as a data URI, and the same for dark screens where it differs."""

    title: str
    light: str
    dark: str = ""
    caption: str = ""
    wide: bool = False  # the whole width of the page


@dataclass(frozen=True)
class Section:
    """What one part has to say."""

    key: str
    title: str
    command: str  # that prints the same
    finding: str  # in one sentence
    meaning: str = ""  # to a firmware developer
    tone: str = ""
    grids: list[Grid] = field(default_factory=list)
    figures: list[Figure] = field(default_factory=list)
    data: Any = None  # every number, for report.json


@dataclass(frozen=True)
class Task:
    """One call in a process of its own; the weight is about its seconds."""

    name: str
    call: Callable[..., Any]
    arguments: tuple[Any, ...] = ()
    weight: float = 1.0


@dataclass(frozen=True)
class Part:
    """Tasks, and the section that is made of their results, given in the order of the tasks."""

    key: str
    title: str
    command: str
    tasks: Callable[[Options], list[Task]]
    section: Callable[[list[Any]], Section]


# ---- from what the commands print ----


def grid_of(table: Table) -> Grid:
    """A table for a terminal as one for the page."""
    columns = [Text.from_markup(str(column.header)).plain for column in table.columns]
    cells = [[_cell(cell) for cell in column.cells] for column in table.columns]
    title, caption = (_cell(text).text if text else "" for text in (table.title, table.caption))
    return Grid(title, columns, [column.justify == "right" for column in table.columns],
                [list(row) for row in zip(*cells, strict=True)], caption)  # fmt: skip


def _cell(value: Any) -> Cell:
    text = value if isinstance(value, Text) else Text.from_markup(str(value))
    styles = " ".join([str(text.style), *(str(span.style) for span in text.spans)])
    tones = (tone for colour, tone in _TONES.items() if colour in styles)
    return Cell(text.plain, next(tones, _WORDS.get(text.plain, "")))


# ---- to JSON ----


def plain(value: Any) -> Any:
    """Dataclasses and arrays as JSON has them: what is not a number is null, an infinity a text."""
    if is_dataclass(value) and not isinstance(value, type):
        return {part.name: plain(getattr(value, part.name)) for part in fields(value)}
    if isinstance(value, dict):
        return {str(key): plain(item) for key, item in value.items()}
    if isinstance(value, list | tuple):
        return [plain(item) for item in value]
    if isinstance(value, np.ndarray | np.generic):
        return plain(value.tolist())
    if isinstance(value, Enum):
        return plain(value.value)
    if isinstance(value, float) and not math.isfinite(value):
        return None if math.isnan(value) else str(value)
    return value
