"""Scene files: the model, and a strict reader whose every complaint names the file and the field."""

from __future__ import annotations

import itertools
import json
import math
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any, NoReturn

import jsonschema

from . import geometry
from .errors import UserError
from .geometry import Point

SCHEMA_FILE = Path(__file__).with_name("scene.schema.json")
SCENES_DIR = Path(__file__).parents[2] / "examples" / "scenes"
ALL_LAYERS = 0xFFFF

# The engine's limits (include/cairn/shape.h, body.h): metres of radius or thickness, kilograms.
SMALLEST_LENGTH = 1e-3
LARGEST_REACH = 125
MASSES = (1e-7, 1e9)


@dataclass(frozen=True)
class Material:
    """Friction and bounce of a surface. The threshold is an approach speed in m/s."""

    static_friction: float
    kinetic_friction: float
    restitution: float
    restitution_threshold: float = 1.0


# The same values as the presets in include/cairn/material.h.
PRESETS = {
    "default": Material(0.5, 0.4, 0.0),
    "ice": Material(0.05, 0.02, 0.0),
    "metal": Material(0.6, 0.4, 0.1, 0.5),
    "jelly": Material(0.9, 0.7, 0.6, 0.5),
}


@dataclass(frozen=True)
class Shape:
    """A circle (radius, no corners) or a convex polygon (corners anticlockwise). The origin is the body's position."""

    kind: str
    radius: float
    corners: tuple[Point, ...] = ()

    @property
    def centre(self) -> Point:
        """Centre of area: what the body turns about."""
        return geometry.centroid(list(self.corners)) if self.corners else (0.0, 0.0)

    @property
    def reach(self) -> float:
        """Distance of the farthest point from the origin."""
        return max((math.hypot(*p) for p in self.corners), default=self.radius)

    @property
    def area(self) -> float:
        return geometry.area(list(self.corners)) if self.corners else math.pi * self.radius**2


@dataclass(frozen=True)
class Body:
    shape: str
    position: Point
    name: str = ""
    material: str = "default"
    type: str = "dynamic"
    angle: float = 0.0
    velocity: Point = (0.0, 0.0)
    angular_velocity: float = 0.0
    density: float = 1.0
    sensor: bool = False
    fixed_rotation: bool = False
    fixed_position: bool = False
    layer: int = 1
    mask: int = ALL_LAYERS

    @property
    def static(self) -> bool:
        return self.type == "static"


@dataclass(frozen=True)
class Spring:
    """Exactly one of stiffness and frequency is set; the damping beside it likewise."""

    a: int
    b: int
    rest_length: float
    anchor_a: Point = (0.0, 0.0)
    anchor_b: Point = (0.0, 0.0)
    stiffness: float | None = None
    damping: float = 0.0
    frequency: float | None = None
    damping_ratio: float = 0.0
    collide: bool = True


EVENT_KINDS = ("spawn", "remove", "impulse", "velocity")  # in the order of cairn_scene_event_kind


@dataclass(frozen=True)
class Event:
    """Of a recorded run, after so many steps: spawn, remove, impulse (N s) or velocity (m/s) of a body."""

    step: int
    kind: str
    body: int
    value: Point = (0.0, 0.0)


@dataclass(frozen=True)
class Play:
    """What a game does while its scene runs: so many of the bodies are there at the start, the others are spawned."""

    present: int
    events: tuple[Event, ...]

    @property
    def most(self) -> int:
        """Bodies at a time."""
        changes = [(event.kind == "spawn") - (event.kind == "remove") for event in self.events]
        return max(itertools.accumulate([self.present, *changes]))


@dataclass(frozen=True)
class Scene:
    name: str
    shapes: dict[str, Shape]
    bodies: list[Body]
    path: Path
    springs: list[Spring] = field(default_factory=list)
    materials: dict[str, Material] = field(default_factory=dict)
    gravity: Point = (0.0, -10.0)
    steps_per_second: int = 60
    substeps: int = 4
    solver: str = "soft"
    passes: int = 10
    broad_phase: str = "pairs"
    sleep: bool = False
    play: Play | None = None  # of a recorded run, see trim_recording.py

    def material(self, name: str) -> Material:
        return self.materials[name] if name in self.materials else PRESETS[name]

    def shape_of(self, body: Body) -> Shape:
        return self.shapes[body.shape]


SOLVERS = ("soft", "slides", "small")
# The fields of a file that say how it is run, not what is in it.
SETTINGS = ("steps_per_second", "substeps", "solver", "passes", "broad_phase", "sleep")


def with_settings_of(scene: Scene, other: Scene) -> Scene:
    """The scene as the other is run."""
    return replace(scene, **{name: getattr(other, name) for name in SETTINGS})


def shifted(scene: Scene, ways: Sequence[Point], folder: Path) -> Scene:
    """The scene with its bodies so far elsewhere, with the same settings, in a file of that folder."""
    data = json.loads(scene.path.read_text(encoding="utf-8-sig"))
    for entry, (x, y) in zip(data["bodies"], ways, strict=True):
        entry["position"] = [entry["position"][0] + x, entry["position"][1] + y]
    path = folder / scene.path.name
    path.write_text(json.dumps(data), encoding="utf-8")
    return with_settings_of(load(path), scene)


def find(name_or_file: str) -> Path:
    """The scene file meant by a path, or by the name of one in examples/scenes."""
    path = Path(name_or_file)
    if path.is_file():
        return path
    named = SCENES_DIR / f"{name_or_file}.json"
    if "/" not in name_or_file and named.is_file():
        return named
    raise UserError(f"{name_or_file}: no such scene file, and no scene of that name in examples/scenes")


def load(path: Path) -> Scene:
    """Reads and checks a scene file."""
    if path.suffix == ".jsonl":
        raise UserError(f"{path}: a recorded run, which only tools/cairn trim plays; a scene is a .json file")
    try:
        text = path.read_text(encoding="utf-8-sig")  # some editors write the mark
    except OSError as error:
        raise UserError(f"{path}: {error.strerror}") from error
    except UnicodeDecodeError as error:
        raise UserError(f"{path}: not UTF-8 text (byte {error.start})") from error
    try:
        return parse(text, path)
    except FieldError as error:
        raise UserError(f"{path}: {error}") from error


def parse(text: str, path: Path) -> Scene:
    """The scene in a JSON text; raises FieldError."""
    try:
        data = json.loads(text, object_pairs_hook=_without_duplicates)
    except json.JSONDecodeError as error:
        raise FieldError(f"line {error.lineno} column {error.colno}", f"not JSON: {error.msg}") from error
    except RecursionError as error:
        raise FieldError("(file)", "not a scene: nested too deeply") from error
    _check_finite(data, [])
    check_against(json.loads(SCHEMA_FILE.read_text(encoding="utf-8")), data)
    return _build(data, path)


class FieldError(Exception):
    """What is wrong with which field of a scene."""

    def __init__(self, where: str, what: str) -> None:
        super().__init__(f"{where}: {what}")


def _fail(path: list[Any], what: str) -> NoReturn:
    raise FieldError(_path_text(path), what)


def _path_text(path: list[Any]) -> str:
    text = ""
    for part in path:
        text += f"[{part}]" if isinstance(part, int) else f".{part}"
    return text.removeprefix(".") or "(file)"


def _shown(value: Any) -> str:
    text = json.dumps(value, ensure_ascii=False)
    return text if len(text) <= 40 else text[:37] + "..."


def _without_duplicates(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    seen: dict[str, Any] = {}
    for key, value in pairs:
        if key in seen:
            raise FieldError(key, "given twice in one object")
        seen[key] = value
    return seen


def _check_finite(value: Any, path: list[Any]) -> None:
    """Python reads NaN, Infinity and 1e999; no quantity of a scene may be one of them."""
    if isinstance(value, float) and not math.isfinite(value):
        _fail(path, "must be a finite number")
    items = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
    for key, item in items:
        _check_finite(item, [*path, key])


def check_against(schema: dict[str, Any], data: Any) -> None:
    """Raises FieldError with the first thing that is wrong."""
    # jsonschema calls 4.0 an integer; an index or a count is written without a point here.
    types = jsonschema.Draft202012Validator.TYPE_CHECKER.redefine(
        "integer", lambda _, value: isinstance(value, int) and not isinstance(value, bool)
    )
    validator = jsonschema.validators.extend(jsonschema.Draft202012Validator, type_checker=types)
    errors = sorted(validator(schema).iter_errors(data), key=lambda e: [str(p).zfill(8) for p in e.absolute_path])
    if errors:
        error = errors[0]
        path = list(error.absolute_path)
        _fail(*_explained(error, path))


def _explained(error: jsonschema.ValidationError, path: list[Any]) -> tuple[list[Any], str]:
    """The path to blame, and a sentence, for one violation of the schema."""
    value, limit = error.instance, error.validator_value
    names = {"number": "a number", "integer": "a whole number", "object": "an object", "array": "a list",
             "string": "a text", "boolean": "true or false"}  # fmt: skip
    match error.validator:
        case "additionalProperties":
            known = error.schema["properties"]
            unknown = next(key for key in value if key not in known)
            return [*path, unknown], f"unknown field; known here: {', '.join(known)}"
        case "required":
            missing = next(key for key in limit if key not in value)
            return [*path, missing], "missing"
        case "type":
            return path, f"must be {names[limit]}, not {_shown(value)}"
        case "const":
            return path, f"must be {_shown(limit)}, not {_shown(value)}"
        case "enum":
            return path, f"must be one of {', '.join(map(_shown, limit))}, not {_shown(value)}"
        case "minimum":
            return path, f"must be at least {limit:g}, not {_shown(value)}"
        case "maximum":
            return path, f"must be at most {limit:g}, not {_shown(value)}"
        case "minItems":
            return path, f"must have at least {limit} {'entry' if limit == 1 else 'entries'}, not {len(value)}"
        case "maxItems":
            return path, f"must have at most {limit} entries, not {len(value)}"
        case "dependentRequired":
            missing = next(key for field, needs in limit.items() if field in value for key in needs if key not in value)
            return [*path, missing], "missing"
        case "minProperties" | "maxProperties" if limit == 1:
            return path, f"must have exactly one of {', '.join(error.schema['properties'])}"
        case "pattern" | "minLength" | "maxLength":
            return path, f"must be 1 to 63 letters, digits or _ . -, not {_shown(value)}"
        case "oneOf":
            return path, "must have either stiffness (and damping) or frequency (and damping_ratio)"
    return path, error.message.splitlines()[0]


def _build(data: dict[str, Any], path: Path) -> Scene:
    materials = {name: Material(**values) for name, values in data.get("materials", {}).items()}
    for name, material in materials.items():
        if material.kinetic_friction > material.static_friction:
            _fail(["materials", name, "kinetic_friction"], "must be at most static_friction")
    shapes = {name: _shape(values, ["shapes", name]) for name, values in data["shapes"].items()}
    bodies = []
    for i, values in enumerate(data["bodies"]):
        body = Body(**{key: _pair(value) for key, value in values.items()})
        if body.shape not in shapes:
            _fail(["bodies", i, "shape"], f"no shape named {_shown(body.shape)} in shapes")
        if body.material not in materials and body.material not in PRESETS:
            _fail(["bodies", i, "material"], f"no material named {_shown(body.material)} in materials or built in")
        mass = body.density * shapes[body.shape].area
        if not body.static and not MASSES[0] <= mass <= MASSES[1]:
            _fail(["bodies", i, "density"], f"gives a mass of {mass:g} kg; it must be {MASSES[0]:g} to {MASSES[1]:g}")
        bodies.append(body)
    springs = [_spring(values, bodies, ["springs", i]) for i, values in enumerate(data.get("springs", []))]
    return Scene(
        name=data["name"],
        path=path,
        materials=materials,
        shapes=shapes,
        bodies=bodies,
        springs=springs,
        gravity=_pair(data.get("gravity", [0.0, -10.0])),
        **{key: data[key] for key in SETTINGS if key in data},
    )


def _pair(value: Any) -> Any:
    return (value[0], value[1]) if isinstance(value, list) else value


def _shape(values: dict[str, Any], path: list[Any]) -> Shape:
    ((kind, value),) = values.items()
    path = [*path, kind]
    if kind == "circle":
        return Shape("circle", value)
    if kind == "box":
        shape = Shape("box", 0.0, tuple(geometry.box(*value)))
    elif kind == "regular":
        corners = geometry.regular(value["sides"], value["radius"])
        shape = Shape("regular", 0.0, tuple(corners))
    else:
        shape = Shape("polygon", 0.0, tuple(_convex([_pair(p) for p in value], path)))
    if shape.reach > LARGEST_REACH:
        _fail(path, f"reaches {shape.reach:.12g} m from its origin; at most {LARGEST_REACH} m")
    return shape


def _convex(points: list[Point], path: list[Any]) -> list[Point]:
    """The hull of points that must all be on it and span an area."""
    for i, p in enumerate(points):
        for q in points[:i]:
            if math.dist(p, q) < SMALLEST_LENGTH:
                _fail([*path, i], f"the same point as an earlier one (nearer than {SMALLEST_LENGTH:g} m)")
    corners = geometry.hull(points)
    width = 2 * geometry.area(corners) / max(math.dist(p, q) for p in corners for q in corners)
    if len(corners) < 3 or width < SMALLEST_LENGTH:
        _fail(path, "degenerate: the points lie on one line")
    for i, p in enumerate(points):
        if geometry.inside_by(corners, p) > SMALLEST_LENGTH:
            _fail([*path, i], "concave: this point lies inside the others' hull")
        if p not in corners:
            _fail([*path, i], "not a corner: it lies on the line of two others")
    if abs(abs(geometry.area(points)) - geometry.area(corners)) > 1e-9 * geometry.area(corners):
        _fail(path, "self-crossing: the points must go round, in either direction")
    return corners


def _spring(values: dict[str, Any], bodies: list[Body], path: list[Any]) -> Spring:
    fields = {key: _pair(value) for key, value in values.items()}
    for end in ("a", "b"):
        if fields[end] >= len(bodies):
            _fail([*path, end], f"no body {fields[end]}: there are {len(bodies)}, counted from 0")
    if fields["a"] == fields["b"]:
        _fail([*path, "b"], "the same body as a")
    if "rest_length" not in fields:
        ends = [_anchor(bodies[fields[end]], fields.get(f"anchor_{end}", (0.0, 0.0))) for end in ("a", "b")]
        fields["rest_length"] = math.dist(*ends)
    return Spring(**fields)


def _anchor(body: Body, local: Point) -> Point:
    return geometry.placed([local], *body.position, body.angle)[0]
