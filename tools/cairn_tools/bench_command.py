"""`cairn bench`: what a step costs, in instructions, cycles and time, in RAM, with more bodies and beside others."""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import asdict
from pathlib import Path
from time import monotonic
from typing import Annotated

import typer
from rich.table import Table

from . import bench as bench_module
from . import bench_tables, engine, scene
from . import copies as copies_module
from . import cycles as cycles_module
from . import growth as growth_module
from . import host_bench as host_module
from . import kept as kept_module
from . import memory as memory_module
from . import peers as peers_module
from . import profile as profile_module
from .errors import UserError
from .terminal import (
    Core,
    JsonOption,
    PassesOption,
    SolverOption,
    SubstepsOption,
    hold_to_record,
    load_scene,
    out,
    working,
    writable,
)

Show = Callable[[Table], None]


def bench(
    core: Annotated[list[Core] | None, typer.Option(help="Default: m0 m3 m4f.")] = None,
    scene_name: Annotated[list[str] | None, typer.Option("--scene", help="Names or files.")] = None,
    solver: SolverOption = None,
    substeps: SubstepsOption = None,
    passes: PassesOption = None,
    profile: Annotated[bool, typer.Option("--profile", help="What stages and functions take, too.")] = False,
    cycles: Annotated[bool, typer.Option("--cycles", help="Cycles and microseconds on four chips.")] = False,
    copies: Annotated[int | None, typer.Option(min=1, max=1000, help="Of so many copies, moved by up to 2 mm.")] = None,
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
    emulated = (scene_name, solver, substeps, passes, profile, cycles, copies, growth, plot, peers)
    if memory:
        if any((*emulated, host, rounds)) or (keep and core):
            raise UserError("--memory takes --core or --keep, --check, --markdown and --json only")
        _memory([c.value for c in core or ()] or list(memory_module.CORES), keep, check, as_json, show)
        return
    if keep or check:
        if any((core, *emulated, host, rounds)) or as_json or markdown or (keep and check):
            raise UserError("--keep and --check are of all scenes on record and take no other option")
        _record(keep)
        return
    if host or rounds:
        if not host or any((core, *emulated)):
            raise UserError("--host takes --rounds, --markdown and --json only, and --rounds goes with --host")
        _host(rounds or host_module.ROUNDS, as_json, show)
        return
    cores = [c.value for c in core] if core else list(bench_module.CORES)
    if peers:
        if profile or cycles or copies or growth or plot or solver or substeps or passes:
            raise UserError("--peers takes --core, --scene, --markdown and --json only")
        if unfit := [name for name in cores if name not in peers_module.CORES]:
            raise UserError(f"--peers runs on {' '.join(peers_module.CORES)}, not on {unfit[0]}")
        wished = [load_scene(name, None, None, None) for name in scene_name or kept_module.SCENES]
        _peers(wished, cores, as_json, show)
        return
    if growth or plot:
        if not growth or scene_name or solver or substeps or passes or cycles or copies or profile:
            raise UserError("--growth takes --core, --plot and --json only, and --plot goes with --growth")
        _growth([c.value for c in core or ()] or ["m0"], plot, as_json, show)
        return
    if cycles:
        if copies:
            raise UserError("--copies and --cycles do not go together")
        wished = [load_scene(name, solver, substeps, passes) for name in scene_name or kept_module.SCENES]
        _cycles(wished, [c.value for c in core or ()], profile, as_json, show)
        return
    scenes = [load_scene(name, solver, substeps, passes) for name in scene_name or bench_module.SCENES]
    if copies:
        if profile:
            raise UserError("--copies and --profile do not go together")
        _copies(scenes, cores, copies, as_json, show)
        return
    _instructions(scenes, cores, profile, as_json, show)


def _instructions(scenes: list[scene.Scene], cores: list[str], profile: bool, as_json: bool, show: Show) -> None:
    """The settled mean and the worst steps, with a profile if wished."""
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


def _copies(scenes: list[scene.Scene], cores: list[str], count: int, as_json: bool, show: Show) -> None:
    """The spread over copies of each scene."""
    with working("bench --copies") as say:
        rows = [copies_module.measure(loaded, name, count, say) for loaded in scenes for name in cores]
    if as_json:
        print(json.dumps([asdict(row) for row in rows], indent=2))
        return
    show(bench_tables.copies_table(rows))


def _peers(scenes: list[scene.Scene], cores: list[str], as_json: bool, show: Show) -> None:
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


def _host(rounds: int, as_json: bool, show: Show) -> None:
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


def _memory(cores: list[str], keep: bool, check: bool, as_json: bool, show: Show) -> None:
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


def _record(keep: bool) -> None:
    """Writes the record, or checks it."""
    started = monotonic()
    with working("bench") as say:
        if keep:
            kept_module.write(say)
            print(f"{kept_module.FILE.relative_to(engine.ROOT)} is written")
            return
        lines = list(kept_module.troubles(say))
    hold_to_record(lines, 2 * len(kept_module.CORES) * len(kept_module.SCENES), started)


def _cycles(scenes: list[scene.Scene], cores: list[str], profile: bool, as_json: bool, show: Show) -> None:
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


def _growth(cores: list[str], plot: Path | None, as_json: bool, show: Show) -> None:
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
