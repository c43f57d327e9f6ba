"""Instructions per step on the emulated cores."""

from __future__ import annotations

from dataclasses import dataclass

from . import engine
from .scene import Scene

CORES = ("m0", "m3", "m4f")
SCENES = ("stack10", "pyramid10", "circles100", "mixed50", "curtain150", "tower", "bridge", "balls50")

# The scenes' bodies have met by then, and move little: the steady cost of a game.
FIRST_STEP, LAST_STEP = 121, 240


@dataclass(frozen=True)
class Cost:
    """Of cairn_world_step() alone. The first two over steps 121 to 240, the third over steps 1 to 240."""

    scene: str
    core: str
    engine: str
    mean_instructions: float
    worst_instructions: int
    worst_instructions_from_start: int
    bodies: int
    points: int
    dropped_contacts: int
    stack_bytes: int  # of the whole image
    step_stack_bytes: int
    hash: str


def measure(scene: Scene, core: str) -> Cost:
    """Runs a scene on a core in QEMU and counts."""
    got = engine.run(scene, "q16", core, LAST_STEP, 0)
    steady = got.costs[FIRST_STEP - 1 : LAST_STEP]
    return Cost(
        scene=scene.name,
        core=core,
        engine="cairn",
        mean_instructions=sum(steady) / len(steady),
        worst_instructions=max(steady),
        worst_instructions_from_start=max(got.costs),
        bodies=len(scene.bodies),
        points=got.statistics["points"],
        dropped_contacts=got.statistics["dropped_contacts"],
        stack_bytes=got.stack,
        step_stack_bytes=got.stack - got.stack_before,
        hash=got.hash,
    )
