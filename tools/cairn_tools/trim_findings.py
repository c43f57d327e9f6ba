"""What scenes have, for the summary of `tools/cairn trim`: also what no option leaves out is told."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from . import engine
from .scene import Body, Scene

NEARLY = 1.001  # masses within a thousandth are equal


@dataclass(frozen=True)
class Finding:
    """A line of the summary."""

    what: str
    found: str
    use: str  # what comes of it


def findings(scenes: list[Scene], runs: list[engine.Run], margin: float) -> list[Finding]:
    """Of all scenes together."""
    bodies = [(scene, body) for scene in scenes for body in scene.bodies]
    movers = [(scene, body) for scene, body in bodies if not body.static]
    return [
        _shapes(bodies),
        _friction(bodies),
        _bounce(bodies),
        _masses(movers),
        Finding("sizes", _span(scene.shape_of(body).reach for scene, body in bodies) + " m from the middle", "-"),
        _speeds(scenes, runs),
        Finding("margin", f"{margin:g} %", "beyond the most that the runs needed, where that can vary"),
    ]


def _shapes(bodies: list[tuple[Scene, Body]]) -> Finding:
    kinds = {"regular": "polygon"}
    found = sorted({kinds.get(kind, kind) for kind in (scene.shape_of(body).kind for scene, body in bodies)})
    return Finding("shapes", ", ".join(found), "the tables name no others, so the linker drops them")


def _friction(bodies: list[tuple[Scene, Body]]) -> Finding:
    rough = [scene.material(body.material).static_friction for scene, body in bodies]
    if not any(rough):
        return Finding("friction", "none", "CAIRN_WITH_FRICTION 0")
    return Finding("friction", _span(rough), "-")


def _bounce(bodies: list[tuple[Scene, Body]]) -> Finding:
    bounces = [scene.material(body.material).restitution for scene, body in bodies]
    if not any(bounces):
        return Finding("restitution", "none", "CAIRN_WITH_BOUNCE 0, and no impact phase is linked")
    return Finding("restitution", _span(bounces), "-")


def _masses(movers: list[tuple[Scene, Body]]) -> Finding:
    masses = [body.density * scene.shape_of(body).area for scene, body in movers]
    if not masses:
        return Finding("masses", "nothing moves", "-")
    if max(masses) <= NEARLY * min(masses):
        return Finding("masses", f"all {masses[0]:.3g} kg", "shares are halves: the quick ways of the sweeps")
    return Finding("masses", _span(masses) + " kg", "-")


def _speeds(scenes: list[Scene], runs: list[engine.Run]) -> Finding:
    speeds, spins = [0.0], [0.0]
    for scene, run in zip(scenes, runs, strict=True):
        states = run.trajectory.states[:, [not body.static for body in scene.bodies]]
        if states.size:
            speeds.append(float(np.linalg.norm(states[:, :, 3:5], axis=-1).max()))
            spins.append(float(np.abs(states[:, :, 5]).max()))
    return Finding("speeds", f"to {max(speeds):.3g} m/s, {max(spins):.3g} rad/s", "decide on continuous collision")


def _span(values: Iterable[float]) -> str:
    known = list(values)
    least, most = min(known), max(known)
    return f"{least:.3g}" if least == most else f"{least:.3g} to {most:.3g}"
