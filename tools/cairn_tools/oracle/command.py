"""`tools/cairn oracle`: how well the oracle converges on a scene; and the runs that are kept of it."""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import asdict, dataclass
from time import monotonic
from typing import Annotated

import numpy as np
import typer
from rich.table import Table

from .. import engine, terminal
from ..errors import UserError
from ..scene import Scene
from ..terminal import JsonOption, out, working
from . import closed_forms

ALIKE = 1e-3  # m


@dataclass(frozen=True)
class Fine:
    """A run at one fineness, and how far it is from the one before. A time is never the same twice: not in the JSON."""

    fineness: int
    residual: float
    not_converged: int
    solves: int
    rounds: int
    impacts: int
    moved_apart: float
    deepest_penetration: float
    energy: float
    difference_at_end: float | None
    alike_for_steps: int | None  # steps in which no body was a millimetre from the coarser run


def oracle(
    scene_file: Annotated[str, typer.Argument(metavar="[SCENE.json]", help="A file, or a name.")] = "",
    steps: Annotated[int, typer.Option(min=1, max=100_000)] = 120,
    fineness: Annotated[int, typer.Option(min=1, max=4096, help="Its steps in one of the scene's.")] = 64,
    keep: Annotated[bool, typer.Option("--keep", help="Only make the kept runs anew (tests/oracle).")] = False,
    check: Annotated[bool, typer.Option("--check", help="Only run the kept ones' first steps again.")] = False,
    as_json: JsonOption = False,
) -> None:
    """Run a scene on the oracle at two finenesses, the second twice the first, and tell how well it solved."""
    if keep or check:
        if keep == check or scene_file:
            raise UserError("--keep and --check are given alone")
        _keep() if keep else _check()
        return
    if not scene_file:
        raise UserError("name a scene")
    loaded = terminal.load_scene(scene_file, None, None, None)
    started = monotonic()
    with working(f"{loaded.name} on the oracle") as say:
        rows = halved(loaded, steps, fineness, say)
    if as_json:
        print(json.dumps({"scene": loaded.name, "steps": steps, "runs": [asdict(row) for row in rows]}, indent=2))
        return
    form = closed_forms.find(loaded)
    grid = Table(title=f"{loaded.name}: {steps} steps on the oracle", show_header=False)
    grid.caption = f"{monotonic() - started:.0f} s; closed form: {form.name if form else 'none'}"
    for name in asdict(rows[0]):
        values = [getattr(row, name) for row in rows]
        grid.add_row(name.replace("_", " "), *(_text(v) for v in values))
    out.print(grid)


def _text(value: float | None) -> str:
    return "" if value is None else f"{value:,}" if isinstance(value, int) else f"{value:.6g}"


def halved(scene: Scene, steps: int, fineness: int, say: Callable[[str], None]) -> list[Fine]:
    """A run, and one of half its steps' length."""
    from .simulate import run

    rows: list[Fine] = []
    coarser = None
    for fine in (fineness, 2 * fineness):
        say(f"{scene.name} on the oracle, 1/{fine} of a step")
        got = run(scene, steps, fineness=fine)
        apart = None
        if coarser is not None:
            gap = (got.trajectory.states - coarser)[:, :, :2]
            apart = np.hypot(gap[:, :, 0], gap[:, :, 1]).max(axis=1)
        coarser = got.trajectory.states
        rows.append(Fine(fine, got.residual, got.not_converged, got.solves, got.rounds, got.impacts, got.moved_apart,
                         float(got.penetration.max()), float(got.energy[-1]),
                         None if apart is None else float(apart[-1]),
                         None if apart is None else _first(apart > ALIKE, steps)))  # fmt: skip
    return rows


def _first(is_so: np.ndarray, none: int) -> int:
    return int(is_so.argmax()) if is_so.any() else none


def _keep() -> None:
    from . import kept

    with working("oracle") as say:
        files = kept.keep(say)
    print(f"{len(files)} runs kept, {sum(file.stat().st_size for file in files) / 1e6:.1f} MB")


def _check() -> None:
    from .. import scene as scenes
    from . import kept

    worst = 0.0
    with working("oracle") as say:
        for name in kept.STEPS:
            say(name)
            worst = max(worst, kept.differs(scenes.load(scenes.find(name)), kept.EVERY * 3))
    print(f"{len(kept.STEPS)} kept runs: the first {kept.EVERY * 3} steps are equal to {worst:.1e}")
    if worst > kept.EQUAL:
        raise typer.Exit(1)


def as_run(scene: Scene, steps: int, every: int) -> engine.Run:
    """What `tools/cairn run --engine oracle` shows: the closed form where there is one for so long."""
    form = closed_forms.find(scene)
    if form and form.horizon >= steps / scene.steps_per_second:
        return engine.Run("oracle", "host", steps, form.trajectory(scene, steps, every), "", {"closed_form": form.name})
    from .simulate import run

    got = run(scene, steps, every)
    told = {"residual": got.residual, "not_converged": got.not_converged, "solves": got.solves,
            "rounds": got.rounds, "impacts": got.impacts}  # fmt: skip
    return engine.Run("oracle", "host", steps, got.trajectory, "", told)
