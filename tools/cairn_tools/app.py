"""The verbs of tools/cairn: arguments in, tables for people or JSON for programs out."""

from __future__ import annotations

import json
import os
import re
import sys
from collections.abc import Callable
from dataclasses import asdict
from enum import Enum
from pathlib import Path
from statistics import mean
from time import monotonic
from typing import Annotated, Any, NoReturn

import typer
from rich.table import Table

from . import bench as bench_module
from . import bench_tables, draw, engine, scene
from . import compare_command as compare_module
from . import cycles as cycles_module
from . import footprint_command as footprint_module
from . import golden as golden_module
from . import growth as growth_module
from . import host_bench as host_module
from . import kept as kept_module
from . import memory as memory_module
from . import peers as peers_module
from . import profile as profile_module
from .accuracy import command as accuracy_module
from .errors import UserError
from .oracle import command as oracle_module
from .play import command as play_module
from .report.verb import report
from .stability import command as stability_module
from .stability import report as stability_report
from .sweep.verb import sweep
from .terminal import (
    Core,
    JsonOption,
    PassesOption,
    SceneArgument,
    Solver,
    SolverOption,
    SubstepsOption,
    folder,
    hold_to_record,
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
    "golden": {"--targets"},
    "stability": {"--case", "--engine", "--solver"},
    "sweep": {"--core", "--vary"},
    "trim": {"--keep"},
}

Show = Callable[[Table], None]


def main() -> NoReturn:
    """Runs the command; what is wrong with its input is said in one line, with exit code 2."""
    try:
        arguments = _spread(sys.argv[1:], SEVERAL.get(sys.argv[1], set()) if len(sys.argv) > 1 else set())
        code = app(prog_name="cairn", args=arguments, standalone_mode=False)
    except typer.Exit as end:
        code = end.exit_code
    except (UserError, typer.TyperException) as error:
        message = error.format_message() if isinstance(error, typer.TyperException) else str(error)
        print(f"cairn: {' '.join(message.split())}", file=sys.stderr)
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
    option = ""
    for argument in arguments:
        if argument.startswith("-"):
            option = argument if argument in several else ""
            if not option:
                given.append(argument)
        elif option:
            given += [option, argument]
        else:
            given.append(argument)
    return given


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


@app.command()
def bench(
    core: Annotated[list[Core] | None, typer.Option(help="Default: m0 m3 m4f.")] = None,
    scene_name: Annotated[list[str] | None, typer.Option("--scene", help="Names or files.")] = None,
    solver: SolverOption = None,
    substeps: SubstepsOption = None,
    passes: PassesOption = None,
    profile: Annotated[bool, typer.Option("--profile", help="What stages and functions take, too.")] = False,
    cycles: Annotated[bool, typer.Option("--cycles", help="Cycles and microseconds on four chips.")] = False,
    growth: Annotated[bool, typer.Option("--growth", help="Costs of 10 to 400 bodies, on the M0 or --core.")] = False,
    plot: Annotated[Path | None, typer.Option(metavar="FILE.png", help="With --growth: draw it too.")] = None,
    memory: Annotated[bool, typer.Option("--memory", help="Bytes of RAM and stack, with the goals.")] = False,
    check: Annotated[bool, typer.Option("--check", help="Only hold the costs to those on record.")] = False,
    keep: Annotated[bool, typer.Option("--keep", help="Only put the costs on record.")] = False,
    peers: Annotated[bool, typer.Option("--peers", help="Beside Chipmunk and Box2D; fetches their sources.")] = False,
    host: Annotated[bool, typer.Option("--host", help="Time on the host; installs both' libraries.")] = False,
    rounds: Annotated[int | None, typer.Option(min=1, max=100, help="With --host: runs of each engine.")] = None,
    markdown: Annotated[bool, typer.Option("--markdown", help="Print the tables as docs/SPEED.md has them.")] = False,
    as_json: JsonOption = False,
) -> None:
    """Instructions per step on the emulated cores, over steps 121 to 240."""
    show = bench_tables.print_markdown if markdown else out.print
    if memory:
        others = (scene_name, solver, substeps, passes, profile, cycles, growth, plot, peers, host, rounds)
        if any(others) or (keep and core):
            raise UserError("--memory takes --core or --keep, --check, --markdown and --json only")
        _bench_memory([c.value for c in core or ()] or list(memory_module.CORES), keep, check, as_json, show)
        return
    if keep or check:
        _bench_record(keep)
        return
    if host or rounds:
        others = (core, scene_name, solver, substeps, passes, profile, cycles, growth, plot, peers)
        if not host or any(others):
            raise UserError("--host takes --rounds, --markdown and --json only, and --rounds goes with --host")
        _bench_host(rounds or host_module.ROUNDS, as_json, show)
        return
    cores = [c.value for c in core] if core else list(bench_module.CORES)
    if peers:
        if profile or cycles or growth or plot or solver or substeps or passes:
            raise UserError("--peers takes --core, --scene, --markdown and --json only")
        if unfit := [name for name in cores if name not in peers_module.CORES]:
            raise UserError(f"--peers runs on {' '.join(peers_module.CORES)}, not on {unfit[0]}")
        wished = [load_scene(name, None, None, None) for name in scene_name or kept_module.SCENES]
        _bench_peers(wished, cores, as_json, show)
        return
    if growth or plot:
        if not growth or scene_name or solver or substeps or passes or cycles or profile:
            raise UserError("--growth takes --core, --plot and --json only, and --plot goes with --growth")
        _bench_growth([c.value for c in core or ()] or ["m0"], plot, as_json, show)
        return
    if cycles:
        wished = [load_scene(name, solver, substeps, passes) for name in scene_name or kept_module.SCENES]
        _bench_cycles(wished, [c.value for c in core or ()], profile, as_json, show)
        return
    scenes = [load_scene(name, solver, substeps, passes) for name in scene_name or bench_module.SCENES]
    results = []
    with working("bench") as say:
        for loaded in scenes:
            for name in cores:
                say(f"{loaded.name} on {name}")
                of = (bench_module.FIRST_STEP, bench_module.LAST_STEP)
                profiled = profile_module.measure(loaded, name, *of) if profile else None
                results.append((bench_module.measure(loaded, name), profiled))
    if as_json:
        record = [{**asdict(cost), **(asdict(shares) if shares else {})} for cost, shares in results]
        print(json.dumps(record, indent=2))
        return
    grid = Table(title="Instructions per step", caption="mean and worst of steps 121-240; worst of steps 1-240")
    for column in ("scene", "core", "mean", "worst", "worst from the start"):
        grid.add_column(column, justify="left" if column in ("scene", "core") else "right")
    for cost, _ in results:
        counts = (cost.mean_instructions, cost.worst_instructions, cost.worst_instructions_from_start)
        grid.add_row(cost.scene, cost.core, *(f"{count:,.0f}" for count in counts))
    show(grid)
    for cost, shares in results:
        if shares:
            show(_profile_table(f"{cost.scene} on {cost.core}", "instructions", shares))


def _bench_peers(scenes: list[scene.Scene], cores: list[str], as_json: bool, show: Show) -> None:
    """Measures all engines; exit code 1 if one does not stand, for then its cost means nothing."""
    rows: list[list[peers_module.Cost]] = []
    with working("peers") as say:
        versions = peers_module.fetch()
        for loaded in scenes:
            for name in cores:
                say(f"{loaded.name} on {name}")
                rows.append(list(peers_module.measure(loaded, name, versions)))
    if as_json:
        record = {"settings": peers_module.settings(versions), "costs": [asdict(cost) for row in rows for cost in row]}
        print(json.dumps(record, indent=2))
    else:
        for grid in bench_tables.peer_tables(rows):
            show(grid)
        for name, settings in peers_module.settings(versions).items():
            print(f"- {name}: {settings}")
    if not all(cost.stands for row in rows for cost in row):
        raise typer.Exit(1)


def _bench_host(rounds: int, as_json: bool, show: Show) -> None:
    """Times all engines; exit code 1 if one does not stand."""
    times: list[host_module.Time] = []
    with working("bench --host") as say:
        versions = host_module.fetch()
        for name in host_module.SCENES:
            times += host_module.measure(host_module.load(name), versions, rounds, say)
    settings = host_module.settings(versions)
    if as_json:
        record = {"settings": settings, "rounds": rounds, "times": [asdict(time) for time in times]}
        print(json.dumps(record, indent=2))
    else:
        show(bench_tables.host_table(times))
        for name, text in settings.items():
            print(f"- {name}: {text}")
    if not all(time.stands for time in times):
        raise typer.Exit(1)


def _bench_memory(cores: list[str], keep: bool, check: bool, as_json: bool, show: Show) -> None:
    """Exit code 1 only where --check finds more than is on record: a goal that is missed is only told."""
    started = monotonic()
    with working("bench --memory") as say:
        rows = memory_module.measure(cores, memory_module.SCENES, say)
    if as_json:
        print(json.dumps(bench_tables.memory_record(rows), indent=2))
    else:
        for grid in bench_tables.memory_tables(rows):
            show(grid)
    if keep:
        memory_module.write(rows)
    if check:
        hold_to_record(list(memory_module.troubles(rows)), len(rows), started, as_json)


def _bench_record(keep: bool) -> None:
    """Writes the record, or checks it."""
    started = monotonic()
    with working("bench") as say:
        if keep:
            kept_module.write(say)
            print(f"{kept_module.FILE.relative_to(engine.ROOT)} is written")
            return
        lines = list(kept_module.troubles(say))
    hold_to_record(lines, 2 * len(kept_module.CORES) * len(kept_module.SCENES), started)


def _bench_cycles(scenes: list[scene.Scene], cores: list[str], profile: bool, as_json: bool, show: Show) -> None:
    """The chips of the cores asked for, or all."""
    chips = [chip for chip in cycles_module.CHIPS if not cores or chip.counted_on in cores]
    if not chips:
        raise UserError(f"--cycles --core {' '.join(cores)}: {cycles_module.NOT_ESTIMATED}")
    rows, checks, profiles = [], [], {}
    with working("bench --cycles") as say:
        for loaded in scenes:
            say(f"{loaded.name} on {', '.join(chip.name for chip in chips)}")
            of_scene, check = cycles_module.measure(loaded, chips)
            rows += of_scene
            checks += [check] if check else []
            if check and profile:
                of = (bench_module.FIRST_STEP, bench_module.LAST_STEP)
                profiles[loaded.name] = profile_module.measure_cycles(loaded, *of)
    if as_json:
        shares = {"profiles": {name: asdict(shares) for name, shares in profiles.items()}} if profile else {}
        print(json.dumps(bench_tables.cycles_record(rows, checks) | shares, indent=2))
        return
    for grid in bench_tables.cycles_tables(rows, checks):
        show(grid)
    for name, shares in profiles.items():
        show(_profile_table(f"{name} on the {cycles_module.MEASURED}", "cycles", shares))


def _bench_growth(cores: list[str], plot: Path | None, as_json: bool, show: Show) -> None:
    """Worlds of growing size."""
    file = writable(plot) if plot else None
    with working("bench --growth") as say:
        points = growth_module.measure(cores, growth_module.SIZES, say)
    if file:
        growth_module.plot(points, cores[0], file)
    if as_json:
        print(json.dumps(bench_tables.growth_record(points), indent=2))
        return
    for grid in bench_tables.growth_tables(points):
        show(grid)


def _profile_table(title: str, unit: str, shares: profile_module.Profile) -> Table:
    caption = "mean of steps 121-240; the compiler's own routines count as their caller's"
    grid = Table(title=title, caption=caption)
    for column in ("stage or function", unit, "share"):
        grid.add_column(column, justify="left" if column == "stage or function" else "right")
    total = sum(shares.stages.values())
    dearest = list(shares.functions.items())[:24]
    for i, (name, count) in enumerate([*shares.stages.items(), *dearest]):
        if i == len(shares.stages):
            grid.add_section()
        grid.add_row(name, f"{count:,.0f}", f"{100 * count / total:.1f} %")
    return grid


@app.command()
def stability(
    quick: Annotated[bool, typer.Option("--quick", help="Only the quick cases.")] = False,
    long: Annotated[bool, typer.Option("--long", help="Only the long ones.")] = False,
    case: Annotated[list[str] | None, typer.Option(help="Names of cases; * stands for anything.")] = None,
    arithmetic: Annotated[list[Arithmetic] | None, typer.Option("--engine", help="Default: q16 f64.")] = None,
    solver: Annotated[list[Solver] | None, typer.Option(help="Default: soft; slides beside it where it falls.")] = None,
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
    write: Annotated[
        str | None, typer.Option(metavar="REASON", help="Record the host's hashes, the reason in CHANGELOG.md.")
    ] = None,
    as_json: JsonOption = False,
) -> None:
    """Hold every scene to the same state after 600 steps, on all compilers and cores, and to the one on record."""
    started = monotonic()
    with working("golden hashes") as say:
        if write is not None:
            changed = golden_module.write(write, say)
            print("the hashes and CHANGELOG.md are written" if changed else "the hashes are those on record")
            return
        troubles = golden_module.record_troubles()
        chosen = [target.value for target in targets] if targets else list(golden_module.EVERY_TIME)
        results = golden_module.check(chosen, say)
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
        print(f"{len(results) + 1 - bad} passed, {bad} failed in {monotonic() - started:.1f}s")
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
    if name and not re.fullmatch(r"[A-Za-z_][A-Za-z0-9_]*", name):
        raise UserError(f"--name {name}: is no name in C")
    text = engine.table(loaded, name or "scene_" + re.sub(r"[^A-Za-z0-9]", "_", loaded.name))
    writable(out_file).write_text(text, encoding="utf-8")


app.command()(report)
app.command()(sweep)


def _print_csv(trajectory: Trajectory) -> None:
    """CSV on stdout; a reader that has seen enough (head, less) is no error."""
    try:
        trajectory.write_csv(sys.stdout)
        sys.stdout.flush()
    except BrokenPipeError:
        # What is left in the buffer has nowhere to go.
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
