"""Costs of copies of a scene that are moved by next to nothing: of one that is chaotic, a single run says little."""

from __future__ import annotations

import math
import tempfile
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from . import bench, scene
from .scene import Scene

MOST = 0.002  # metres along each axis


@dataclass(frozen=True)
class Spread:
    """Runs on a core, in instructions: the copies' means of steps 121 to 240, and their worst steps of 1 to 240."""

    scene: str
    core: str
    copies: int
    mean: float
    standard_error: float | None  # of the mean; of one copy there is none
    least: float
    most: float
    mean_worst: float
    most_worst: int


def moved(loaded: Scene, seed: int, folder: Path) -> Scene:
    """Each body that moves lies up to MOST elsewhere, by the same ways for the same seed; in a file of that folder."""
    ways = np.random.default_rng(seed).uniform(-MOST, MOST, (len(loaded.bodies), 2))
    ways[[body.static for body in loaded.bodies]] = 0
    return scene.shifted(loaded, ways.tolist(), folder)


def measure(loaded: Scene, core: str, count: int, say: Callable[[str], None]) -> Spread:
    """Copies of the seeds 1 to count."""
    costs = []
    with tempfile.TemporaryDirectory(prefix="cairn-") as folder:
        for seed in range(1, count + 1):
            say(f"{loaded.name} on {core}, copy {seed} of {count}")
            costs.append(bench.measure(moved(loaded, seed, Path(folder)), core))
    means = np.array([cost.mean_instructions for cost in costs])
    worst = [cost.worst_instructions_from_start for cost in costs]
    return Spread(
        scene=loaded.name,
        core=core,
        copies=count,
        mean=float(means.mean()),
        standard_error=float(means.std(ddof=1)) / math.sqrt(count) if count > 1 else None,
        least=float(means.min()),
        most=float(means.max()),
        mean_worst=float(np.mean(worst)),
        most_worst=max(worst),
    )
