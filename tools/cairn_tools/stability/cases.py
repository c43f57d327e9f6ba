"""All cases: importing a file of cases registers them."""

from __future__ import annotations

from . import fast, heavy, mess, motion, scenes, springs, stands
from .model import CASES

FILES = (scenes, stands, heavy, springs, motion, fast, mess)

__all__ = ["CASES", "FILES"]
