"""One point of error against run time: a scene, settings and a core in; what it costs and how wrong it is out.

Every engine is measured by the same code, of nothing but its poses at 30 frames a second (physics at 30, 60, 120 or 240
steps a second all have these), and of instructions counted in QEMU in the same run, from the first step to the last.
"""

from __future__ import annotations

import math
import tempfile
from dataclasses import dataclass
from pathlib import Path

from ..scene import Scene
from .reference import Reference

PEERS = ("chipmunk", "box2d")
SECONDS = 2.0  # of simulated time that a run takes, unless something else is said


@dataclass(frozen=True)
class Settings:
    """How a scene is run. Of a peer, passes are its iterations; solver, sub-steps, tree and sleep do not apply."""

    engine: str = "cairn"  # or one of the peers
    solver: str = "soft"
    steps_per_second: int = 60
    substeps: int = 4  # of the soft solver
    passes: int = 10  # of the other solvers
    quadtree: bool = False
    sleep: bool = False

    @staticmethod
    def of(scene: Scene) -> Settings:
        """The scene's own."""
        return Settings("cairn", scene.solver, scene.steps_per_second, scene.substeps, scene.passes,
                        scene.broad_phase == "quadtree", scene.sleep)  # fmt: skip

    @property
    def label(self) -> str:
        """For a table."""
        if self.engine != "cairn":
            text = f"{self.engine}, {self.passes} iterations"
        elif self.solver != "soft":
            text = f"{self.solver}, {self.passes} passes"
        else:
            text = f"{self.substeps} sub-step{'s' if self.substeps > 1 else ''}"
        options = [name for name, on in (("quadtree", self.quadtree), ("sleep", self.sleep)) if on]
        return ", ".join([text, f"{self.steps_per_second} Hz", *options])


@dataclass(frozen=True)
class Errors:
    """Of a run's poses, in metres. What there is no measure of is not a number.

    rms_error, largest_error: of the bodies' centres from the reference, over the frames up to the horizon.
    penetration, mean_penetration: the deepest overlap of any two bodies in any frame, and its mean over the frames.
    contact_error: over the last fifth of the run and the bodies that rest then, RMS of the distance to the nearest
    surface, inside or out: what rests on something touches it, and 0 is right.
    drift: the farthest that a body went over the last fifth of the run.
    energy_gained: J above the start, at most, in any frame.
    """

    rms_error: float = math.nan
    largest_error: float = math.nan
    penetration: float = math.nan
    mean_penetration: float = math.nan
    contact_error: float = math.nan
    drift: float = math.nan
    energy_gained: float = math.nan


@dataclass(frozen=True)
class Row:
    scene: str
    core: str
    settings: Settings
    is_default: bool
    seconds: float  # of simulated time
    compared_seconds: float  # of these, up to the horizon
    reference: str
    instructions_per_step: float  # mean of all steps
    worst_instructions: int
    instructions_per_frame: float  # mean of 1/60 s of simulated time: the same as a step's at 60 steps a second
    errors: Errors


def measure(scene: Scene, settings: Settings, core: str, seconds: float = SECONDS) -> Row:
    """A point alone; where there are many, images and reference are made once: see error_time."""
    # The rig imports what this module defines.
    from .rig import Rig

    with tempfile.TemporaryDirectory(prefix="cairn-") as folder:
        rig = Rig.build(scene, core, Path(folder), with_peers=settings.engine != "cairn")
        return rig.measure(settings, Reference.of(scene, seconds))
