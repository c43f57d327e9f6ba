"""All cases: importing a file of cases registers them."""

from __future__ import annotations

from . import scenes
from .model import CASES

FILES = (scenes,)

__all__ = ["CASES", "FILES"]
