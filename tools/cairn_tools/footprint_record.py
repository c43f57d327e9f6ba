"""The kept footprint: tests/bench/footprint.json, what tools/test holds to it, and the README's tables made from it."""

from __future__ import annotations

import json
from collections.abc import Iterator
from typing import Any

from . import engine, footprint
from .errors import UserError
from .footprint import BASE, FEATURES, SETS, Row

FILE = engine.ROOT / "tests" / "bench" / "footprint.json"
README = engine.ROOT / "README.md"
BEGIN, END = "<!-- by tools/cairn footprint --readme -->", "<!-- end -->"
RISE = 0.02  # more than this, or as much less, needs a new record
NUMBERS = ("flash", "constants", "ram", "stack")
HELD = ("flash", "ram")
SHOWN = 5  # names told of a game that has more than it may
# Of other engines on an M0, in KB of flash, as issue 6 gives them.
OTHERS = {"box2d-lite": 19, "ImpulseEngine": 27, "Chipmunk": 61, "Box2D v3": 167}

Record = dict[str, Any]


def read() -> Record:
    try:
        return json.loads(FILE.read_text(encoding="utf-8"))
    except FileNotFoundError:
        raise UserError(f"{FILE}: there is no record; tools/cairn footprint --keep makes it") from None
    except ValueError as error:
        raise UserError(f"{FILE}: no record: {error}") from None


def write(rows: list[Row], found: dict[str, dict[str, str]], types: dict[str, int]) -> None:
    """Sizes, and the shared names in each image of the first core; what was not measured stays as it is."""
    record: Record = read() if FILE.is_file() else {}
    for core in dict.fromkeys(row.core for row in rows):
        record[core] = {row.name: {what: getattr(row, what) for what in NUMBERS} for row in rows if row.core == core}
    record["names"] = {name: _shared(names) for name, names in found.items()}
    record["types"] = types
    FILE.parent.mkdir(exist_ok=True)
    FILE.write_text(json.dumps(record, indent=1) + "\n", encoding="utf-8")


def _shared(found: dict[str, str]) -> list[str]:
    """What the engine's files share; the others the compiler may split and merge as it likes."""
    return sorted(name for name, file in found.items() if name.startswith("cairn_") and file.endswith(".c"))


# ---- what is held ----

Check = tuple[str, str]  # what was looked at, and what is wrong with it: empty if nothing


def size_checks(rows: list[Row], record: Record) -> Iterator[Check]:
    """A gain needs a new record too."""
    for row in rows:
        kept = record.get(row.core, {}).get(row.name)
        if kept is None:
            yield f"{row.name} on {row.core}", "not on record"
            continue
        off = [f"{now:,} bytes of {what}, on record {kept[what]:,}" for what, now in
               ((what, getattr(row, what)) for what in HELD) if abs(now - kept[what]) > RISE * kept[what]]  # fmt: skip
        yield f"{row.name} on {row.core}", "; ".join(off)


def name_checks(found: dict[str, dict[str, str]], record: Record) -> Iterator[Check]:
    """No game contains what it does not use, nor what is not on record; and a stranger would be seen."""
    for entry in SETS[1:]:
        here = found[entry.name]
        wrong = [
            f"{name}, of a feature that it does not use"
            for name in footprint.strangers(entry.features, here, entry.options)
        ]
        new = set(_shared(here)) - set(record.get("names", {}).get(entry.name, ()))
        wrong += [f"{name}, not on record" for name in sorted(new)]
        more = f" and {len(wrong) - SHOWN} more" if len(wrong) > SHOWN else ""
        yield f"names in {entry.name}", f"contains {'; '.join(wrong[:SHOWN])}{more}" if wrong else ""
    for name, feature in FEATURES.items():
        if name not in BASE and (feature.files or feature.functions):
            seen = footprint.strangers(BASE, found[name.lower()])
            yield f"seeing {name.lower()}", "" if seen else "a game of it has no name that tells it from one without"
    unplaced = footprint.unplaced_files()
    yield "files of src/", f"of no feature in footprint.py, or gone: {', '.join(unplaced)}" if unplaced else ""


def world_check(rows: list[Row], types: dict[str, int]) -> Check:
    """The world of the game of balls takes what the formula says."""
    balls = next(row for row in rows if row.name == "balls")
    entry = next(entry for entry in SETS if entry.name == "balls")
    fixed, body, arbiter = world_bytes(types)
    said = fixed + entry.bodies * body + entry.arbiters * arbiter
    return "the world's formula", "" if said == balls.ram else f"says {said:,} bytes, and balls takes {balls.ram:,}"


def readme_check(record: Record) -> Check:
    right = _with_tables(README.read_text(encoding="utf-8"), record) == README.read_text(encoding="utf-8")
    return "README.md", "" if right else "is not what the record says: tools/cairn footprint --readme"


# ---- the README ----


def write_readme(record: Record) -> None:
    README.write_text(_with_tables(README.read_text(encoding="utf-8"), record), encoding="utf-8")


def _with_tables(text: str, record: Record) -> str:
    before, begin, rest = text.partition(BEGIN)
    _, end, after = rest.partition(END)
    if not begin or not end:
        raise UserError(f"{README}: has no lines {BEGIN} and {END}")
    return f"{before}{BEGIN}\n{markdown(record)}\n{END}{after}"


def markdown(record: Record) -> str:
    cores = [core for core in footprint.CORES if core in record]
    first = record[cores[0]]
    columns = ("goal on m0", "constants in it", "RAM", "goal", "stack")
    sets = [["feature set", "bodies, arbiters", *(f"flash {core}" for core in cores), *columns]]
    adds = [["feature", *cores, "RAM"]]
    for entry in SETS[1:]:
        if not all(entry.name in record[core] for core in cores):
            continue
        flash = [record[core][entry.name]["flash"] for core in cores]
        kept = first[entry.name]
        if entry.what.startswith("+"):
            base = [record[core]["base"]["flash"] for core in cores]
            more = [f"{of - without:,}" for of, without in zip(flash, base, strict=True)]
            adds.append([entry.what.removeprefix("+ "), *more, f"{kept['ram'] - first['base']['ram']:,}"])
        else:
            sets.append([entry.what, f"{entry.bodies}, {entry.arbiters}", *(f"{size:,}" for size in flash),
                         _goal(entry.flash_goal), f"{kept['constants']:,}", f"{kept['ram']:,}", _goal(entry.ram_goal),
                         f"{kept['stack']:,}"])  # fmt: skip
    others = ", ".join(f"{name} {size}" for name, size in OTHERS.items())
    return "\n".join([
        "Bytes of a tiny game beyond the same image without Cairn, `-Os -flto`, the options of `config.h` as they are,",
        "but where it says *by options*: there all is off that the game can do without, holding and shortcuts as well;",
        "constants, RAM and stack on the M0. RAM is the world's pools; stack, of `main()` and all that it calls, is",
        f"the most that there can be, by the compiler's call graph. Other engines on an M0, in KB of flash: {others}.",
        "", *_table(sets), "",
        "What a feature adds to balls, walls and boxes; RAM is what the tiny game declares for it:",
        "", *_table(adds), "",
        *formula(record["types"]),
    ])  # fmt: skip


def _goal(value: int | None) -> str:
    return "-" if value is None else f"{value:,}"


def _table(rows: list[list[str]]) -> list[str]:
    """Numbers to the right."""
    head, *body = rows
    rule = ["---" if i == 0 else "---:" for i in range(len(head))]
    return [f"| {' | '.join(cells)} |" for cells in (head, rule, *body)]


def world_bytes(types: dict[str, int]) -> tuple[int, int, int]:
    """Of a world, each body and each arbiter: CAIRN_WORLD_BYTES."""
    return types["cairn_world"], types["cairn_body"] + 2, types["cairn_arbiter"] + 4


def formula(types: dict[str, int]) -> list[str]:
    world, body, arbiter = world_bytes(types)
    sizes = {name.removeprefix("cairn_"): size for name, size in types.items()}
    tree_parts = {"bodies": "quadtree_box", "cells": "quadtree_cell", "entries": "quadtree_entry"}
    tree = [f"{sizes['quadtree']}", *(f"{sizes[part]} x {of}" for of, part in tree_parts.items())]
    mesh_body = sizes["mesh_part"] + sizes["mesh_node"] + 3 * sizes["mesh_row"]
    mesh_parts = {"bodies": mesh_body, "springs": sizes["mesh_link"], "entries": sizes["share"]}
    mesh = [f"{sizes['mesh']}", *(f"{size} x {of}" for of, size in mesh_parts.items())]
    rows = [
        ["declared by", "bytes of RAM on a 32-bit core", "the same in C"],
        ["`CAIRN_WORLD`", f"{world} + {body} x bodies + {arbiter} x arbiters", "`CAIRN_WORLD_BYTES`"],
        ["`CAIRN_SPRINGS`", f"{sizes['spring_pool']} + {sizes['spring']} x springs", "`CAIRN_SPRINGS_BYTES`"],
        ["`CAIRN_QUADTREE`", " + ".join(tree), "`CAIRN_QUADTREE_BYTES`"],
        ["`CAIRN_BLOCKS`", f"{sizes['block']}", "`CAIRN_BLOCKS_BYTES`"],
        ["`CAIRN_SPRING_MESHES`", " + ".join(mesh), "`CAIRN_SPRING_MESHES_BYTES`"],
    ]
    return ["A world's RAM; `tests/unit/test_memory.c` holds the macros to it:", "", *_table(rows)]
