"""What the verbs of tools/cairn share: two consoles, options, a spinner, bars, paths, and how a record is held."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import replace
from enum import Enum
from pathlib import Path
from time import monotonic
from typing import Annotated, Any

import typer
from rich.console import Console
from rich.progress import (
    BarColumn,
    MofNCompleteColumn,
    Progress,
    SpinnerColumn,
    TaskProgressColumn,
    TextColumn,
    TimeElapsedColumn,
    TimeRemainingColumn,
)
from rich.table import Table

from . import engine, scene
from .errors import UserError


class Screen(Console):
    """A console that hides nothing of a table: where it is narrow, a figure goes on in the next line."""

    def print(self, *objects: Any, **options: Any) -> None:
        for grid in objects:
            if isinstance(grid, Table):
                for column in grid.columns:
                    column.overflow = "fold"
        super().print(*objects, **options)


out = Screen()
err = Console(stderr=True)

Core = Enum("Core", {name: name for name in engine.COUNTED}, type=str)
Solver = Enum("Solver", {name: name for name in scene.SOLVERS}, type=str)
JsonOption = Annotated[bool, typer.Option("--json", help="Print JSON instead of a table.")]
SceneArgument = Annotated[str, typer.Argument(metavar="SCENE.json", help="A scene file, or a name in examples/scenes.")]
SolverOption = Annotated[Solver | None, typer.Option(help="Instead of the scene's own.")]
SubstepsOption = Annotated[int | None, typer.Option(min=1, max=16, help="Sub-steps of the soft solver.")]
PassesOption = Annotated[int | None, typer.Option(min=1, max=100, help="Passes of the slides' or the small solver.")]


@contextmanager
def working(what: str) -> Iterator[Any]:
    """A spinner on stderr while something runs; gives a function that changes its text."""
    columns = (SpinnerColumn(), TextColumn("{task.description}"), TimeElapsedColumn())
    with Progress(*columns, console=err, transient=True, disable=not err.is_terminal) as progress:
        task = progress.add_task(what)
        yield lambda text: progress.update(task, description=text)


@contextmanager
def bar(what: str) -> Iterator[Callable[[int, int], None]]:
    """A bar on stderr while something long runs; gives a function that says how much of how much is done."""
    columns = (SpinnerColumn(), TextColumn("{task.description}"), BarColumn(), MofNCompleteColumn())
    times = (TimeElapsedColumn(), TimeRemainingColumn())
    with Progress(*columns, *times, console=err, transient=True, disable=not err.is_terminal) as progress:
        task = progress.add_task(what, total=None)
        yield lambda done, total: progress.update(task, completed=done, total=total)


@contextmanager
def share(what: str) -> Iterator[Callable[[float, float, str], None]]:
    """A bar of percents; gives a function that says how much of how much is done, and what ended last."""
    columns = (SpinnerColumn(), BarColumn(), TaskProgressColumn(), TimeElapsedColumn(), TimeRemainingColumn())
    with Progress(*columns, TextColumn("{task.description}"), console=err, transient=True,
                  disable=not err.is_terminal) as progress:  # fmt: skip
        task = progress.add_task(what, total=None)
        yield lambda done, total, at: progress.update(task, completed=done, total=total, description=at)


def folder(path: Path) -> Path:
    """A folder to write into, made where it is missing."""
    try:
        path.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise UserError(f"{path}: {error.strerror}") from error
    return path


def writable(file: Path | str) -> Path:
    """A path in a folder that exists."""
    path = Path(file)
    if not path.parent.is_dir():
        raise UserError(f"{path}: no folder {path.parent}")
    if path.is_dir():
        raise UserError(f"{path}: is a folder")
    return path


def hold_to_record(lines: list[str], count: int, started: float, as_json: bool = False) -> None:
    """Says which of so many figures the record does not allow; exit code 1 if any. tools/test reads the last line."""
    for line in lines:
        print(line, file=sys.stderr if as_json else sys.stdout)
    bad = sum(not line.startswith(" ") for line in lines)  # what is indented says more of the line before
    if not as_json:
        print(f"{count - bad} passed, {bad} failed in {monotonic() - started:.1f}s")
    if lines:
        raise typer.Exit(1)


def load_scene(name: str, solver: Solver | None, substeps: int | None, passes: int | None) -> scene.Scene:
    """The scene with the settings of the command line in place of its own."""
    loaded = scene.load(scene.find(name))
    if passes and (solver.value if solver else loaded.solver) == "soft":
        raise UserError("--passes are of the slides' and the small solver: add --solver slides or small")
    given = {"solver": solver.value if solver else None, "substeps": substeps, "passes": passes}
    return replace(loaded, **{key: value for key, value in given.items() if value is not None})
