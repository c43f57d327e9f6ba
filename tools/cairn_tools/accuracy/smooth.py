"""Smooth scenes in metres: fixed point against double, and against closed forms."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from rich.table import Table

from ..errors import UserError


def measure(say: Callable[[str], None]) -> list[Any]:
    """The rows: dataclasses of plain numbers and texts."""
    raise UserError("--smooth: not built yet")


def tables(rows: list[Any]) -> list[Table]:
    """The same for people."""
    raise NotImplementedError
