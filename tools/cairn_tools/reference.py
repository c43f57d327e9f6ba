"""What runs are measured against: a closed form where the scene has one, else the oracle at 1/64 of a step."""

from __future__ import annotations

from . import oracle
from .oracle import closed_forms
from .scene import Scene
from .trajectory import Trajectory

FINENESS = 64  # parts of a step


def best(scene: Scene, steps: int, every: int = 1) -> tuple[str, Trajectory]:
    """What it is, and its states."""
    known = closed_forms.find(scene)
    if known and known.horizon >= steps / scene.steps_per_second:
        return f"closed form: {known.name}", known.trajectory(scene, steps, every)
    return f"run of the oracle at dt/{FINENESS}", oracle.run(scene, steps, every, FINENESS).trajectory


def converged(scene: Scene, steps: int, every: int = 1) -> Trajectory:
    """At the scene's own sub-steps and integrated as the engine does, all constraints solved in each of them."""
    # The slides' solver takes a step whole.
    fineness = scene.substeps if scene.solver == "soft" else 1
    return oracle.run(scene, steps, every, fineness, method="as-engine").trajectory
