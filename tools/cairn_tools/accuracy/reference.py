"""What the runs of a scene are compared with, and for how long."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .. import engine, horizon, reference
from ..scene import Scene

FRAMES = 30  # a second


@dataclass(frozen=True)
class Reference:
    """Poses [frame, body, 3] of the first frames, as far as there is no chaos."""

    name: str
    seconds: float  # that a run takes
    compared_seconds: float
    poses: np.ndarray

    @staticmethod
    def of(scene: Scene, seconds: float) -> Reference:
        """The horizon is the scene's own: of twins by the file's settings, and the same for all engines."""
        steps = round(seconds * scene.steps_per_second)
        runs = {name: engine.run(scene, name, "host", steps, 1).trajectory for name in engine.ARITHMETICS}
        every = scene.steps_per_second // FRAMES
        last = horizon.find(scene, runs).step // every * every
        name, trajectory = reference.best(scene, last, every)
        return Reference(name, seconds, last / scene.steps_per_second, trajectory.poses)
