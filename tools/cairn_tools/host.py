"""The engine in this process: worlds that Python builds, steps and reads, in fixed point or in double.

A thin wrapper of tools/host/shim.h by ctypes. Many worlds may live at a time; stepping takes no Python per body.
"""

from __future__ import annotations

import ctypes
import math
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from functools import cache
from typing import Any

import numpy as np

from . import engine, geometry
from . import scene as scene_model
from .engine import EngineError
from .geometry import Point
from .scene import Scene

DYNAMIC, STATIC, KINEMATIC = 0, 1, 2
SENSOR, FIXED_ROTATION, FIXED_POSITION = 1, 2, 4
X, Y, ANGLE, VX, VY, OMEGA = range(6)
CONTACT_VALUES = 13
STATISTICS = ("steps", "dropped", "saturations", "bodies", "awake", "pairs", "arbiters", "points", "springs",
              "tree_cells", "tree_entries", "tree_full", "looked", "solved", "moved")  # fmt: skip

_INT, _LONG, _REAL, _PLACE = ctypes.c_int, ctypes.c_int64, ctypes.c_double, ctypes.c_void_p
# Result and arguments after the world, in the order of shim.h.
_CALLS: dict[str, tuple[Any, list[Any]]] = {
    "destroy": (None, []),
    "set_gravity": (_INT, [_REAL, _REAL]),
    "set_rate": (_INT, [_REAL]),
    "set_substeps": (_INT, [_INT]),
    "set_slop": (_INT, [_REAL]),
    "set_push_out": (_INT, [_REAL]),
    "set_sleep": (_INT, [_INT]),
    "use_slides_solver": (_INT, [_INT]),
    "use_small_solver": (_INT, [_INT]),
    "use_quadtree": (_INT, [_REAL, _REAL, _INT, _INT]),
    "speed_limit": (_REAL, []),
    "circle": (_INT, [_REAL]),
    "box": (_INT, [_REAL, _REAL]),
    "polygon": (_INT, [_PLACE, _INT]),
    "regular": (_INT, [_INT, _REAL]),
    "material": (_INT, [_REAL] * 4),
    "body": (_LONG, [_INT, _INT, _INT, _INT, *[_REAL] * 7]),
    "body_destroy": (_INT, [_LONG]),
    "body_set_transform": (_INT, [_LONG, _REAL, _REAL, _REAL]),
    "body_set_velocity": (_INT, [_LONG, _REAL, _REAL, _REAL]),
    "body_set_layers": (_INT, [_LONG, _INT, _INT]),
    "body_set_damping": (_INT, [_LONG, _REAL, _REAL]),
    "body_set_gravity_scale": (_INT, [_LONG, _REAL]),
    "body_force": (_INT, [_LONG, *[_REAL] * 4]),
    "body_impulse": (_INT, [_LONG, *[_REAL] * 4]),
    "body_mass": (_REAL, [_LONG]),
    "body_inertia": (_REAL, [_LONG]),
    "spring": (_LONG, [_LONG, _LONG, *[_REAL] * 7, _INT]),
    "use_meshes": (_INT, []),
    "spring_destroy": (_INT, [_LONG]),
    "step": (_INT, [_INT]),
    "record": (_INT, [_INT, _INT, _PLACE, _INT, _PLACE]),
    "states": (None, [_PLACE, _INT, _PLACE]),
    "contacts": (_INT, [_PLACE, _INT]),
    "stats": (None, [_PLACE]),
    "hash": (ctypes.c_uint32, []),
    "error": (_INT, []),
}


class HostError(EngineError):
    """The engine refused a call; `status` is its cairn_status."""

    def __init__(self, call: str, status: int) -> None:
        super().__init__(f"{call}: {engine.STATUS.get(status, f'status {status}')}")
        self.status = status


@cache
def _library(arithmetic: str) -> ctypes.CDLL:
    library = ctypes.CDLL(str(engine.host_library(engine.ARITHMETICS[arithmetic])))
    library.shim_create.restype = ctypes.c_void_p
    library.shim_create.argtypes = [_INT, _INT, _INT, _INT, _REAL, _REAL]
    for name, (result, arguments) in _CALLS.items():
        call = getattr(library, f"shim_{name}")
        call.restype = result
        call.argtypes = [ctypes.c_void_p, *arguments]
    return library


@dataclass(frozen=True)
class Shape:
    """A shape of one world: the engine's name of it, and its outline about the centre of mass for those who measure."""

    name: int
    radius: float
    corners: np.ndarray | None = None
    origin: Point = (0.0, 0.0)  # of the centre of mass, in the frame of the points given
    area: float = 0.0


class World:
    """A world of the engine. Numbers are SI units; bodies and springs are ints."""

    def __init__(
        self,
        arithmetic: str = "q16",
        gravity: Point = (0.0, -10.0),
        bodies: int = 600,
        arbiters: int = 4000,
        springs: int = 0,
        cells: int = 0,
        meshes: bool = True,
    ) -> None:
        self.arithmetic = arithmetic
        self.gravity = gravity
        self.rate = 60.0
        self._library = _library(arithmetic)
        self._world = self._library.shim_create(bodies, arbiters, springs, cells, *gravity)
        if not self._world:
            raise EngineError("a world of these sizes and this gravity is refused")
        if springs and meshes:
            self._checked("use_meshes")
        self.shapes: dict[int, Shape] = {}  # by body
        self.types: dict[int, int] = {}
        self._made: dict[tuple[Any, ...], Shape] = {}

    def __del__(self) -> None:
        if getattr(self, "_world", None):
            self._library.shim_destroy(self._world)

    def call(self, name: str, *arguments: Any) -> Any:
        """A function of shim.h as it is."""
        return getattr(self._library, f"shim_{name}")(self._world, *arguments)

    def _checked(self, name: str, *arguments: Any) -> int:
        got = self.call(name, *arguments)
        if got < 0:
            raise HostError(name, got)
        return got

    # Settings

    def set_gravity(self, x: float, y: float) -> None:
        self._checked("set_gravity", x, y)
        self.gravity = (x, y)

    def set_rate(self, steps_per_second: float) -> None:
        self._checked("set_rate", steps_per_second)
        self.rate = steps_per_second

    def set_substeps(self, substeps: int) -> None:
        self._checked("set_substeps", substeps)

    def set_sleep(self, on: bool) -> None:
        self._checked("set_sleep", int(on))

    def use_slides_solver(self, passes: int = 10) -> None:
        self._checked("use_slides_solver", passes)

    def use_small_solver(self, passes: int = 10) -> None:
        self._checked("use_small_solver", passes)

    def use_quadtree(self, size_log2: int = 6, depth: int = 6, centre: Point = (0.0, 0.0)) -> None:
        self._checked("use_quadtree", *centre, size_log2, depth)

    @property
    def speed_limit(self) -> float:
        return self.call("speed_limit")

    # Shapes and materials. The same shape is made once.

    def circle(self, radius: float) -> Shape:
        return self._shape(("circle", radius), lambda name: Shape(name, radius, area=math.pi * radius**2))

    def box(self, width: float, height: float) -> Shape:
        return self._shape(("box", width, height), _outlined(geometry.box(width, height)))

    def regular(self, sides: int, radius: float) -> Shape:
        return self._shape(("regular", sides, radius), _outlined(geometry.regular(sides, radius)))

    def polygon(self, points: Sequence[Point]) -> Shape:
        flat = np.ascontiguousarray(points, dtype=np.float64).ravel()
        return self._shape(
            ("polygon", *map(float, flat)), _outlined(geometry.hull(list(points))), flat.ctypes.data, len(points)
        )

    def _shape(self, key: tuple[Any, ...], of: Callable[[int], Shape], *arguments: Any) -> Shape:
        if key not in self._made:
            self._made[key] = of(self._checked(key[0], *(arguments or key[1:])))
        return self._made[key]

    def material(
        self, static: float, kinetic: float | None = None, bounce: float | None = None, threshold: float = 0.0
    ) -> int:
        """Kinetic friction is the static one unless given. Without a bounce, not even 0, impacts are the sweeps'."""
        kinetic, bounce = static if kinetic is None else kinetic, -1.0 if bounce is None else bounce
        return self._checked("material", static, kinetic, bounce, threshold)

    # Bodies

    def add(
        self,
        shape: Shape,
        x: float,
        y: float,
        angle: float = 0.0,
        velocity: Point = (0.0, 0.0),
        omega: float = 0.0,
        density: float = 1.0,
        material: int = 0,
        kind: int = DYNAMIC,
        flags: int = 0,
    ) -> int:
        """A body with its shape's origin at x, y. Material 0 is the engine's default."""
        body = self._checked("body", shape.name, material, kind, flags, density, x, y, angle, *velocity, omega)
        self.shapes[body] = shape
        self.types[body] = kind
        return body

    def fixed(self, shape: Shape, x: float, y: float, angle: float = 0.0, material: int = 0) -> int:
        """A static body."""
        return self.add(shape, x, y, angle, material=material, kind=STATIC)

    def remove(self, body: int) -> None:
        self._checked("body_destroy", body)
        del self.shapes[body], self.types[body]

    def set_velocity(self, body: int, vx: float, vy: float, omega: float = 0.0) -> None:
        self._checked("body_set_velocity", body, vx, vy, omega)

    def set_layers(self, body: int, layer: int, mask: int) -> None:
        self._checked("body_set_layers", body, layer, mask)

    def set_damping(self, body: int, linear: float, angular: float) -> None:
        self._checked("body_set_damping", body, linear, angular)

    def mass(self, body: int) -> float:
        return self.call("body_mass", body)

    def inertia(self, body: int) -> float:
        return self.call("body_inertia", body)

    @property
    def moving(self) -> list[int]:
        """The dynamic bodies, in the order they were made."""
        return [body for body, kind in self.types.items() if kind == DYNAMIC]

    # Springs

    def spring(
        self,
        a: int,
        b: int,
        stiffness: float,
        damping: float = 0.0,
        rest_length: float = -1.0,
        anchor_a: Point = (0.0, 0.0),
        anchor_b: Point = (0.0, 0.0),
        no_contact: bool = False,
    ) -> int:
        return self._checked("spring", a, b, *anchor_a, *anchor_b, rest_length, stiffness, damping, int(no_contact))

    # Time

    def step(self, steps: int = 1) -> None:
        self._checked("step", steps)

    def record(self, steps: int, every: int = 1, bodies: Iterable[int] | None = None) -> np.ndarray:
        """Step; the states [record, body, value] at the start and after each `every` steps. Angles count on."""
        names = self._names(bodies)
        out = np.empty((steps // every + 1, len(names), 6))
        self._checked("record", steps, every, names.ctypes.data, len(names), out.ctypes.data)
        out[:, :, ANGLE] = np.unwrap(out[:, :, ANGLE], axis=0)
        return out

    def states(self, bodies: Iterable[int] | None = None) -> np.ndarray:
        """States [body, value] now: of the centres of mass, at the engine's full resolution."""
        names = self._names(bodies)
        out = np.empty((len(names), 6))
        self.call("states", names.ctypes.data, len(names), out.ctypes.data)
        return out

    def _names(self, bodies: Iterable[int] | None) -> np.ndarray:
        return np.fromiter(self.moving if bodies is None else bodies, dtype=np.int64)

    # What there is to know

    def contacts(self) -> np.ndarray:
        """One row a contact, see shim.h."""
        out = np.empty((max(self.statistics["arbiters"], 1), CONTACT_VALUES))
        return out[: self.call("contacts", out.ctypes.data, len(out))]

    @property
    def statistics(self) -> dict[str, int]:
        out = np.empty(len(STATISTICS), dtype=np.int64)
        self.call("stats", out.ctypes.data)
        return dict(zip(STATISTICS, map(int, out), strict=True))

    @property
    def hash(self) -> str:
        return f"{self.call('hash'):08x}"


def _outlined(points: list[Point]) -> Callable[[int], Shape]:
    """Makes the shape once the engine has accepted it."""

    def shape(name: int) -> Shape:
        centre = geometry.centroid(points)
        return Shape(name, 0.0, np.array(points) - centre, centre, geometry.area(points))

    return shape


def build(scene: Scene, arithmetic: str = "q16") -> tuple[World, list[int]]:
    """A scene file's world, with its own settings but without sleep, and its bodies in the file's order."""
    springs = len(scene.springs)
    world = World(arithmetic, scene.gravity, max(1, len(scene.bodies)), springs=springs, meshes=False)
    world.set_rate(scene.steps_per_second)
    world.set_substeps(scene.substeps)
    if scene.solver == "slides":
        world.use_slides_solver(scene.passes)
    elif scene.solver == "small":
        world.use_small_solver(scene.passes)
    materials = {
        name: _scene_material(world, scene, name) for name in dict.fromkeys(body.material for body in scene.bodies)
    }
    bodies = []
    for entry in scene.bodies:
        shape = _scene_shape(world, scene.shape_of(entry))
        flags = SENSOR * entry.sensor | FIXED_ROTATION * entry.fixed_rotation | FIXED_POSITION * entry.fixed_position
        kind = STATIC if entry.static else DYNAMIC
        body = world.add(shape, *entry.position, entry.angle, entry.velocity, entry.angular_velocity, entry.density,
                         materials[entry.material], kind, flags)  # fmt: skip
        world.set_layers(body, entry.layer, entry.mask)
        bodies.append(body)
    for spring in scene.springs:
        if spring.stiffness is None:
            raise EngineError(f"{scene.name}: springs by frequency are not built here")
        world.spring(bodies[spring.a], bodies[spring.b], spring.stiffness, spring.damping, spring.rest_length,
                     spring.anchor_a, spring.anchor_b, not spring.collide)  # fmt: skip
    return world, bodies


def _scene_material(world: World, scene: Scene, name: str) -> int:
    m = scene.material(name)
    return world.material(m.static_friction, m.kinetic_friction, m.restitution or None, m.restitution_threshold)


def _scene_shape(world: World, shape: scene_model.Shape) -> Shape:
    match shape.kind:
        case "circle":
            return world.circle(shape.radius)
        case "box":
            (left, low), (right, high) = shape.corners[0], shape.corners[2]
            return world.box(right - left, high - low)
        case "regular":
            return world.regular(len(shape.corners), shape.reach)
        case _:
            return world.polygon(shape.corners)
