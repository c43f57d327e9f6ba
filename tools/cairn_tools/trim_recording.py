"""Recorded runs: a scene, and what a game did to it while it ran; files of JSON lines, see recording.schema.json.

    {"cairn_run": 1, "scene": "pyramid10"}
    {"step": 30, "spawn": {"shape": "box", "position": [0, 12]}}
    {"step": 90, "impulse": [20, 0], "body": 3}
    {"step": 200, "remove": 56}

Bodies that are spawned become bodies of the scene, behind its own, so that tables have them; `Scene.play` says when
they come.
"""

from __future__ import annotations

import json
import re
from dataclasses import replace
from pathlib import Path
from typing import Any

from . import scene as scenes
from .errors import UserError
from .scene import EVENT_KINDS as KINDS
from .scene import Event, FieldError, Play, Scene

SCHEMA = json.loads(Path(__file__).with_name("recording.schema.json").read_text(encoding="utf-8"))
ENDING = ".jsonl"
MOVED = KINDS[2:]
ONE = 65536  # 1 in Q16.16


def load(path: Path, folder: Path) -> Scene:
    """The scene with all bodies that the run ever has, put into a file of the folder, and what happens to them."""
    try:
        lines = path.read_text(encoding="utf-8-sig").splitlines()
    except (OSError, UnicodeDecodeError) as error:
        raise UserError(f"{path}: {getattr(error, 'strerror', None) or 'not UTF-8 text'}") from error
    data = [(i, _line(path, i, line)) for i, line in enumerate(lines, 1) if line.strip()]
    if not data:
        raise UserError(f"{path}: is empty: the first line names the scene")
    begin = _checked(path, *data[0], "begin")
    base = _scene(path, begin["scene"])
    whole = json.loads(base.path.read_text(encoding="utf-8-sig"))
    for part in ("shapes", "materials"):
        if part in begin:
            whole[part] = {**whole.get(part, {}), **begin[part]}
    _parse(path, data[0][0], whole)
    whole["name"] = begin.get("name", path.stem.replace(".", "_"))
    events: list[Event] = []
    for i, values in data[1:]:
        _checked(path, i, values, "event")
        events.append(_event(path, i, values, whole["bodies"]))
        if "spawn" in values:
            whole["bodies"].append(values["spawn"])
            _parse(path, i, whole)
    _check_order(path, [i for i, _ in data[1:]], events)
    file = folder / f"{whole['name']}-all.json"
    file.write_text(json.dumps(whole), encoding="utf-8")
    return replace(scenes.load(file), play=Play(len(base.bodies), tuple(events)))


def _line(path: Path, number: int, line: str) -> Any:
    try:
        return json.loads(line)
    except (json.JSONDecodeError, RecursionError) as error:
        raise UserError(f"{path}: line {number}: not JSON: {getattr(error, 'msg', 'nested too deeply')}") from error


def _checked(path: Path, number: int, values: Any, kind: str) -> Any:
    try:
        scenes.check_against({"$ref": f"#/$defs/{kind}", "$defs": SCHEMA["$defs"]}, values)
    except FieldError as error:
        raise UserError(f"{path}: line {number}: {error}") from error
    return values


def _scene(path: Path, name: str) -> Scene:
    beside = path.parent / name
    return scenes.load(beside if beside.is_file() else scenes.find(name))


def _parse(path: Path, number: int, whole: dict[str, Any]) -> None:
    try:
        scenes.parse(json.dumps(whole), path)
    except FieldError as error:
        last = f"bodies[{len(whole['bodies']) - 1}]"
        raise UserError(f"{path}: line {number}: {str(error).replace(last, 'spawn')}") from error


def _event(path: Path, number: int, values: dict[str, Any], bodies: list[Any]) -> Event:
    kinds = [kind for kind in KINDS if kind in values]
    if len(kinds) != 1 or ("body" in values and kinds[0] not in MOVED):
        raise UserError(f"{path}: line {number}: must have one of {', '.join(KINDS)}, the last two with body")
    kind = kinds[0]
    body = len(bodies) if kind == "spawn" else values["remove"] if kind == "remove" else values["body"]
    if kind != "spawn" and body >= len(bodies):
        raise UserError(f"{path}: line {number}: there is no body {body} yet; there are {len(bodies)}")
    if kind in MOVED and bodies[body].get("type") == "static":
        raise UserError(f"{path}: line {number}: body {body} is static")
    return Event(values["step"], kind, body, tuple(values[kind]) if kind in MOVED else (0.0, 0.0))


def _check_order(path: Path, numbers: list[int], events: list[Event]) -> None:
    """Steps do not go back, and what is gone stays away."""
    gone: set[int] = set()
    for number, before, event in zip(numbers, [None, *events], events, strict=False):
        if before and event.step < before.step:
            raise UserError(f"{path}: line {number}: step {event.step} comes after step {before.step}")
        if event.body in gone:
            raise UserError(f"{path}: line {number}: body {event.body} was removed before")
        if event.kind == "remove":
            gone.add(event.body)


def table(play: Play, name: str, bodies: int) -> str:
    """The events in C, and room for the ids of all bodies, for images."""
    rows = []
    for event in play.events:
        x, y = (round(value * ONE) for value in event.value)
        rows.append(f"    {{ {event.step}, CAIRN_SCENE_{event.kind.upper()}, {event.body}, {{ {x}, {y} }} }},")
    lines = ['#include "scene_play.h"', "", f"static const cairn_scene_event events[{len(rows) + 1}] = {{", *rows]
    lines += ["    { 0, CAIRN_SCENE_SPAWN, 0, { 0, 0 } } /* not counted */", "};", ""]
    lines += [f"extern cairn_body_id {name}_ids[{bodies}];", f"cairn_body_id {name}_ids[{bodies}];", ""]
    lines += [f"extern const cairn_scene_play {name};", f"const cairn_scene_play {name} = {{ {len(rows)}, events }};"]
    return "\n".join([*lines, ""])


def cut(table: str, play: Play) -> str:
    """A scene's table that counts the bodies of the start alone, with the runner's pools for the most there are."""
    table = re.sub(r"\.body_count = \d+,", f".body_count = {play.present},", table)
    most = play.most
    table = re.sub(r"CAIRN_WORLD\(world, \d+, \d+\)", f"CAIRN_WORLD(world, {most}, {4 * most + 16})", table)
    tree = f"CAIRN_QUADTREE(world_quadtree, {most}, {2 * most + 16}, {8 * most + 16})"
    return re.sub(r"CAIRN_QUADTREE\(world_quadtree, \d+, \d+, \d+\)", tree, table)
