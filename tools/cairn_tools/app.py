"""The verbs of tools/cairn: arguments in, tables for people or JSON for programs out."""

from __future__ import annotations

import json
import os
import re
import sys
from dataclasses import asdict
from enum import Enum
from pathlib import Path
from statistics import mean
from time import monotonic
from typing import Annotated, Any, NoReturn

import typer
from rich.table import Table

from . import bench_command as bench_module
from . import compare_command as compare_module
from . import draw, engine, scene
from . import footprint_command as footprint_module
from . import golden as golden_module
from .accuracy import command as accuracy_module
from .errors import UserError
from .fuzz import fuzz
from .oracle import command as oracle_module
from .play import command as play_module
from .report.verb import report
from .stability import command as stability_module
from .stability import report as stability_report
from .sweep.verb import sweep
from .terminal import (
    JsonOption,
    PassesOption,
    SceneArgument,
    Solver,
    SolverOption,
    SubstepsOption,
    folder,
    load_scene,
    out,
    working,
    writable,
)
from .trajectory import Trajectory
from .trim_command import command as trim_command

app = typer.Typer(
    help="Cairn: 2-D rigid-body physics for microcontrollers. Runs, compares and measures scenes.",
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
)

Arithmetic = Enum("Arithmetic", {name: name for name in engine.ARITHMETICS}, type=str)
RunEngine = Enum("RunEngine", {name: name for name in (*engine.ARITHMETICS, "oracle")}, type=str)
Target = Enum("Target", {name: name for name in engine.TARGETS}, type=str)
GoldenTarget = Enum("GoldenTarget", {name: name for name in golden_module.TARGETS}, type=str)

# Options of a verb that take several values at once.
SEVERAL = {
    "accuracy": {"--core", "--scene"},
    "bench": {"--core", "--scene"},
    "footprint": {"--core"},
    "golden": {"--targets", "--scene"},
    "stability": {"--case", "--engine", "--solver"},
    "sweep": {"--core", "--vary"},
    "trim": {"--keep"},
}


# Of C, which are no names.
KEYWORD = re.compile(
    "auto|break|case|char|const|continue|default|do|double|else|enum|extern|float|for|goto|if|inline|int|long|register"
    "|restrict|return|short|signed|sizeof|static|struct|switch|typedef|union|unsigned|void|volatile|while"
)


def main() -> NoReturn:
    """Runs the command; what is wrong with its input is said in one line, with exit code 2."""
    try:
        arguments = _spread(sys.argv[1:], SEVERAL.get(sys.argv[1], set()) if len(sys.argv) > 1 else set())
        code = app(prog_name="cairn", args=arguments, standalone_mode=False)
    except typer.Exit as end:
        code = end.exit_code
    except (UserError, typer.TyperException) as error:
        message = error.format_message() if isinstance(error, typer.TyperException) else str(error)
        if message:  # there is none where nothing was asked for, and the help is shown
            print(f"cairn: {' '.join(message.replace('Value error, ', '').split())}", file=sys.stderr)
        code = 2
    except BrokenPipeError:
        _drop_stdout()
        code = 141  # as the shell tells of a program that SIGPIPE ended
    except OSError as error:  # a folder that may not be written, a full disk
        place = f"{error.filename}: " if error.filename else ""
        print(f"cairn: {place}{error.strerror or error}", file=sys.stderr)
        code = 2
    except engine.EngineError as error:
        print(f"cairn: {error}", file=sys.stderr)
        code = 1
    except (KeyboardInterrupt, typer.Abort):
        code = 130
    sys.exit(code or 0)


def _spread(arguments: list[str], several: set[str]) -> list[str]:
    """`--core m0 m3` as `--core m0 --core m3`: the parser itself takes one value an option."""
    given: list[str] = []
    option, waits = "", False  # for its first value: without one the parser is told, and complains
    for argument in arguments:
        if argument.startswith("-"):
            given += [option] if waits else []
            option = argument if argument in several else ""
            waits = bool(option)
            if not option:
                given.append(argument)
        elif option:
            given += [option, argument]
            waits = False
        else:
            given.append(argument)
    return [*given, option] if waits else given


@app.command()
def run(
    scene_file: SceneArgument,
    arithmetic: Annotated[
        RunEngine, typer.Option("--engine", help="Fixed point, the same in double, or the oracle.")
    ] = "q16",
    on: Annotated[Target, typer.Option(help="The host, or a core in QEMU.")] = "host",
    steps: Annotated[int, typer.Option(min=0, max=1_000_000)] = 600,
    every: Annotated[int, typer.Option(min=1, help="Record each so many steps.")] = 1,
    csv: Annotated[str, typer.Option(metavar="FILE|-", help="Write the states; - is stdout and nothing else.")] = "",
    hash_only: Annotated[bool, typer.Option("--hash", help="Print only the hash of the last state.")] = False,
    svg: Annotated[Path | None, typer.Option(help="Draw the end over the way there.")] = None,
    png: Annotated[Path | None, typer.Option(help="The same picture as pixels.")] = None,
    gif: Annotated[Path | None, typer.Option(help="A film in real time.")] = None,
    solver: SolverOption = None,
    substeps: SubstepsOption = None,
    passes: PassesOption = None,
    as_json: JsonOption = False,
) -> None:
    """Simulate a scene, on the host or on an emulated core."""
    loaded = load_scene(scene_file, solver, substeps, passes)
    by_oracle = arithmetic.value == "oracle"
    if arithmetic.value != "q16" and on.value != "host":
        raise UserError(f"--engine {arithmetic.value} runs on the host only")
    if by_oracle and (hash_only or solver or substeps or passes):
        raise UserError("--engine oracle has no --hash, --solver, --substeps or --passes")
    if csv == "-" and (hash_only or as_json):
        raise UserError("--csv - prints nothing else: leave out --hash and --json")
    if hash_only and as_json:
        raise UserError("--hash prints nothing else: leave out --json, which has it too")
    only_hash = hash_only and not (csv or svg or png or gif or as_json)
    with working(f"{loaded.name} on {on.value}"):
        if by_oracle:
            got = oracle_module.as_run(loaded, steps, every)
        else:
            got = engine.run(loaded, arithmetic.value, on.value, steps, 0 if only_hash else every)
    poses = got.trajectory.poses
    if csv == "-":
        _print_csv(got.trajectory)
    elif csv:
        with writable(csv).open("w", encoding="utf-8") as file:
            got.trajectory.write_csv(file)
    if svg:
        writable(svg).write_text(draw.svg(loaded, poses, got.contacts), encoding="utf-8")
    if png:
        draw.png(writable(png), loaded, poses, got.contacts)
    if gif:
        draw.gif(writable(gif), loaded, poses, every / loaded.steps_per_second)
    if csv == "-":
        return
    if hash_only:
        print(got.hash)
    elif as_json:
        print(json.dumps(_run_record(loaded, got), indent=2))
    else:
        out.print(_run_table(loaded, got))


app.command()(compare_module.compare)


app.command()(bench_module.bench)


@app.command()
def stability(
    quick: Annotated[bool, typer.Option("--quick", help="Only the quick cases.")] = False,
    long: Annotated[bool, typer.Option("--long", help="Only the long ones.")] = False,
    case: Annotated[list[str] | None, typer.Option(help="Names of cases; * stands for anything.")] = None,
    arithmetic: Annotated[list[Arithmetic] | None, typer.Option("--engine", help="Default: q16 f64.")] = None,
    solver: Annotated[list[Solver] | None, typer.Option(help="Default: soft; the others where they fall.")] = None,
    plots: Annotated[Path | None, typer.Option(metavar="DIR", help="Draw the sweeps and the cases too.")] = None,
    workers: Annotated[int, typer.Option("--jobs", min=1, max=64, help="Processes.")] = stability_module.WORKERS,
    markdown: Annotated[bool, typer.Option("--markdown", help="Print the tables of docs/STABILITY.md.")] = False,
    as_json: JsonOption = False,
) -> None:
    """Stiff and extreme cases, one verdict a row; exit code 1 if one falls short."""
    part = "quick" if quick and not long else "long" if long and not quick else "all"
    wished = ([value.value for value in values or ()] for values in (arithmetic, solver))
    jobs = stability_module.jobs(part, case or [], *wished)
    with working("stability") as say:
        results = list(stability_module.results(jobs, workers, say))
        if plots:
            say("plots")
            stability_module.draw(folder(plots), workers)
    if as_json:
        print(stability_module.as_json(results))
    elif markdown:
        print(stability_report.markdown(results))
    else:
        stability_report.show(results, out)
    if not all(result.ok for result in results if result.decides):
        raise typer.Exit(1)


app.command()(accuracy_module.accuracy)
app.command("trim")(trim_command)
app.command()(oracle_module.oracle)
app.command()(play_module.play)
app.command("footprint")(footprint_module.command)


@app.command()
def golden(
    targets: Annotated[
        list[GoldenTarget] | None, typer.Option(help=f"Default: {' '.join(golden_module.EVERY_TIME)}.")
    ] = None,
    scene_name: Annotated[
        list[str] | None, typer.Option("--scene", help="Only these, names or files of yours, held to the host's state.")
    ] = None,
    write: Annotated[
        str | None, typer.Option(metavar="REASON", help="Record the host's hashes, the reason in CHANGELOG.md.")
    ] = None,
    as_json: JsonOption = False,
) -> None:
    """Hold every scene to the same state after 600 steps, on all compilers and cores, and to the one on record."""
    started = monotonic()
    if write is not None and (targets or scene_name):
        raise UserError("--write records all scenes of the host: leave out --targets and --scene")
    own = [golden_module.Case(it.name, it) for it in (scene.load(scene.find(name)) for name in scene_name or [])]
    with working("golden hashes") as say:
        if write is not None:
            changed = golden_module.write(write, say)
            print("the hashes and CHANGELOG.md are written" if changed else "the hashes are those on record")
            return
        troubles = [] if own else golden_module.record_troubles()
        chosen = [target.value for target in targets] if targets else list(golden_module.EVERY_TIME)
        results = golden_module.check(chosen, say, own)
    failed = [result for result in results if not result.passed]
    if as_json:
        print(json.dumps({"record": troubles, "results": [asdict(result) for result in results]}, indent=2))
    else:
        grid = Table("target", "equal", "different", title=f"Hashes after {golden_module.STEPS} steps")
        for target, own in golden_module.by_target(results):
            equal = sum(result.passed for result in own)
            grid.add_row(target, str(equal), str(len(own) - equal))
        out.print(grid)
        for line in [*troubles, *map(str, failed)]:
            print(line)
        # The record's own check is one more; tools/test reads this line.
        bad = len(failed) + bool(troubles)
        print(f"{len(results) + (not own) - bad} passed, {bad} failed in {monotonic() - started:.1f}s")
    if failed or troubles:
        raise typer.Exit(1)


@app.command("table")
def table_command(
    scene_file: SceneArgument,
    out_file: Annotated[Path, typer.Option("--out", metavar="FILE.c", help="The C file to write.")],
    name: Annotated[str, typer.Option(help="Name of the C constant; default scene_ and the scene's name.")] = "",
) -> None:
    """Convert a scene to a const C table for firmware."""
    loaded = load_scene(scene_file, None, None, None)
    if name and (not re.fullmatch(r"[A-Za-z_][A-Za-z0-9_]*", name) or KEYWORD.fullmatch(name)):
        raise UserError(f"--name {name}: is no name in C")
    text = engine.table(loaded, name or "scene_" + re.sub(r"[^A-Za-z0-9]", "_", loaded.name))
    writable(out_file).write_text(text, encoding="utf-8")


app.command()(fuzz)
app.command()(report)
app.command()(sweep)


def _print_csv(trajectory: Trajectory) -> None:
    """CSV on stdout; a reader that has seen enough (head, less) is no error."""
    try:
        trajectory.write_csv(sys.stdout)
        sys.stdout.flush()
    except BrokenPipeError:
        _drop_stdout()


def _drop_stdout() -> None:
    """What is left in the buffer has nowhere to go."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


def _unit(got: engine.Run) -> str:
    """Of the costs of a run."""
    return "cycles" if got.target not in engine.COUNTED and got.target != "host" else "instructions"


def _run_record(loaded: scene.Scene, got: engine.Run) -> dict[str, Any]:
    names = ("x", "y", "angle", "vx", "vy", "omega")
    return {
        "scene": loaded.name,
        "engine": got.arithmetic,
        "on": got.target,
        "steps": got.steps,
        "hash": got.hash,
        "statistics": got.statistics,
        f"mean_{_unit(got)}": mean(got.costs) if got.costs else None,
        f"worst_{_unit(got)}": max(got.costs) if got.costs else None,
        "bodies": [
            {"body": i, "name": body.name, **dict(zip(names, map(float, state), strict=True))}
            for i, (body, state) in enumerate(zip(loaded.bodies, got.trajectory.states[-1], strict=True))
        ],
    }


def _run_table(loaded: scene.Scene, got: engine.Run) -> Table:
    grid = Table(title=f"{loaded.name}: {got.arithmetic} on {got.target}, {got.steps} steps", show_header=False)
    grid.add_column("what")
    grid.add_column("value", justify="right")
    moved = got.trajectory.poses[-1, :, :2] - got.trajectory.poses[0, :, :2]
    rows = {
        "bodies": len(loaded.bodies),
        "springs": len(loaded.springs),
        **got.statistics,
        "largest distance from start, m": f"{max(float((d**2).sum()) for d in moved) ** 0.5:.6f}",
        "hash": got.hash,
    }
    if got.costs:
        rows[f"{_unit(got)} per step, mean"] = f"{mean(got.costs):,.0f}"
        rows[f"{_unit(got)} per step, worst"] = f"{max(got.costs):,}"
        rows["stack, bytes"] = f"{got.stack:,}"
    for name, value in rows.items():
        grid.add_row(name.replace("_", " "), str(value))
    return grid
