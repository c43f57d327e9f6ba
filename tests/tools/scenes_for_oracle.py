"""Small scenes that the tests of the oracle share."""

import json
import math
from pathlib import Path
from typing import Any

from cairn_tools import scene


def made(bodies: list[dict[str, Any]], **more: Any) -> scene.Scene:
    """A scene of the bodies, on shapes that go by what they are."""
    shapes = {"floor": {"box": [50, 1]}, "box": {"box": [1, 1]}, "disc": {"circle": 0.5}, "pea": {"circle": 0.25}}
    record = {"cairn_scene": 1, "name": "made", "shapes": shapes, "bodies": bodies, **more}
    return scene.parse(json.dumps(record), Path("made.json"))


def material(static: float, kinetic: float | None = None, restitution: float = 0.0, threshold: float = 1.0) -> dict:
    return {"default": {"static_friction": static, "kinetic_friction": static if kinetic is None else kinetic,
                        "restitution": restitution, "restitution_threshold": threshold}}  # fmt: skip


def on_slope(angle: float, shape: str = "box", **more: Any) -> list[dict[str, Any]]:
    """A floor that goes down to the right, and something with a height of 1 on the middle of it."""
    s, c = math.sin(angle), math.cos(angle)
    return [
        {"shape": "floor", "type": "static", "position": [-s * 0.5, -c * 0.5], "angle": -angle},
        {"shape": shape, "position": [s * 0.5, c * 0.5], "angle": -angle, **more},
    ]
