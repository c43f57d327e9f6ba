"""What must not fall again: cases that hold, as case:engine. tools/test runs them; the set may only grow."""

from __future__ import annotations

_BOTH = (
    "scene-stack10",
    "scene-tower",
    "scene-pyramid10",
    "scene-stack20",
    "scene-heavy100",
    "scene-circles100",
    "scene-mixed50",
    "scene-curtain150",
)

HOLD = frozenset(f"{name}:{engine}" for name in _BOTH for engine in ("q16", "f64"))
