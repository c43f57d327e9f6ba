"""One point of error against run time: a scene, settings and a core in, what it costs and how wrong it is out."""

from __future__ import annotations

import math
from dataclasses import dataclass

from ..scene import Scene

PEERS = ("chipmunk", "box2d")


@dataclass(frozen=True)
class Settings:
    """How a scene is run. Of a peer, passes are its iterations, and sub-steps, tree and sleep are not asked."""

    engine: str = "cairn"
    solver: str = "soft"
    steps_per_second: int = 60
    substeps: int = 4  # of the soft solver
    passes: int = 10  # of the slides' solver
    quadtree: bool = False
    sleep: bool = False

    @staticmethod
    def of(scene: Scene) -> Settings:
        """The scene's own."""
        return Settings("cairn", scene.solver, scene.steps_per_second, scene.substeps, scene.passes,
                        scene.broad_phase == "quadtree", scene.sleep)  # fmt: skip


@dataclass(frozen=True)
class Row:
    """Lengths are metres, over what moves. What does not exist (no reference, no horizon) is not a number."""

    scene: str
    core: str
    settings: Settings
    is_default: bool
    instructions_per_step: float
    instructions_per_second: float  # of simulated time
    worst_instructions: int
    compared_seconds: float  # of the run: up to here positions are compared with the reference
    rms_error: float = math.nan
    largest_error: float = math.nan
    penetration: float = math.nan  # the deepest
    mean_penetration: float = math.nan
    contact_error: float = math.nan  # RMS over bodies at rest of how far the nearest surface is from touching
    energy_gained: float = math.nan  # above all that went in, of the greatest energy there was


def measure(scene: Scene, settings: Settings, core: str) -> Row:
    """Runs the scene with these settings instead of its own."""
    raise NotImplementedError
