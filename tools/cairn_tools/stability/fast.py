"""Continuous collision: throws at thin walls, at any speed there can be, and near misses past their ends."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from ..host import ANGLE, FIXED_ROTATION, VX, VY, Shape, World, X, Y
from .measure import Outlines, kinetic_energy, separations
from .model import Bench, Figure, case, most

PEERS = "safe speed, ball of 0.1 at 0.1 m: slides 9, box2d-lite 9, Chipmunk 9; Box2D any, with a flag for dynamic walls"
THROWS = 400
THICK = 0.1
LIMIT = math.inf  # stands for the largest speed that the world can have
SPEEDS = [10.0, 30.0, 60.0, 100.0, LIMIT]


@dataclass(frozen=True)
class Throw:
    world: World
    body: int
    wall: int
    shape: Shape
    half: float  # of the wall's height


def _form(world: World, kind: int) -> Shape:
    return (world.circle(0.1), world.box(0.2, 0.2), world.regular(3, 0.15))[kind % 3]


def _world(
    bench: Bench, kind: int, dynamic: bool, bounce: float, friction: float, height: float
) -> tuple[World, Shape, int]:
    """A world without gravity, a shape to throw and a wall at x = 0."""
    world = bench.world((0.0, 0.0), bodies=2, arbiters=4)
    material = world.material(friction, bounce=bounce)
    shape = _form(world, kind)
    plate = world.box(THICK, height)
    if dynamic:
        wall = world.add(plate, 0.0, 0.0, density=5 * shape.area / plate.area, material=material)
    else:
        wall = world.fixed(plate, 0.0, 0.0, material=material)
    return world, shape, wall


def _speed(bench: Bench, wanted: float) -> float:
    """The speed of the throws: the limit is one of each axis."""
    return min(wanted, 0.999 * bench.world(bodies=1, arbiters=1).speed_limit)


def throw(bench: Bench, seed: int, speed: float, dynamic: bool) -> Throw:
    """A seeded throw from the left at the wall, straight to grazing, spinning by up to 60 rad/s."""
    random = np.random.default_rng(seed)
    height = 2.0 if dynamic else 60.0
    world, shape, wall = _world(bench, seed, dynamic, float(random.uniform(0, 1)), float(random.uniform(0, 1)), height)
    slant = 0.0 if seed % 4 == 0 else math.radians(random.uniform(-80, 80))
    way = np.array([math.cos(slant), math.sin(slant)])
    # At some part of a step, one to three steps before the wall, aimed at its middle part.
    aim = np.array([0.0, random.uniform(-0.3, 0.3) * height])
    start = aim - way * (0.3 + speed / 60 * random.uniform(0.0, 3.0)) - np.array([0.2, 0.0])
    body = world.add(shape, *start, random.uniform(-3, 3), tuple(speed * way), random.uniform(-60, 60),
                     material=1)  # fmt: skip
    return Throw(world, body, wall, shape, height / 2)


def passes(states: np.ndarray, half: float) -> bool:
    """Whether the body's centre goes through the wall, both given by record: body first, wall second."""
    (bx, by), (wx, wy) = (states[:, k, [X, Y]].T for k in (0, 1))
    c, s = np.cos(states[:, 1, ANGLE]), np.sin(states[:, 1, ANGLE])
    # In the wall's own frame; where it crosses the middle plane, and how far up.
    x, y = c * (bx - wx) + s * (by - wy), -s * (bx - wx) + c * (by - wy)
    cross = np.flatnonzero((x[:-1] < 0) != (x[1:] < 0))
    for k in cross:
        part = x[k] / (x[k] - x[k + 1])
        if abs(y[k] + part * (y[k + 1] - y[k])) < half:
            return True
    return not np.isfinite(states).all()


@case("400 seeded throws of a circle, box or triangle at {speed:g} m/s (inf: the limit), {wall} wall of 0.1 m",
      over={"wall": ["static", "dynamic"], "speed": SPEEDS}, quick=True, peers=PEERS)  # fmt: skip
def throws(bench: Bench, wall: str, speed: float) -> Iterator[Figure]:
    through, missed, gained = 0, 0, 0.0
    for seed in range(THROWS):
        thrown = throw(bench, seed, _speed(bench, speed), wall == "dynamic")
        states = thrown.world.record(20, 1, [thrown.body, thrown.wall])
        through += passes(states, thrown.half)
        missed += bool((states[-1, 0, [VX, VY]] == states[0, 0, [VX, VY]]).all())
        count = len(thrown.world.moving)
        energy = kinetic_energy(thrown.world, states[:, :count], [thrown.body, thrown.wall][:count])
        gained = max(gained, float(energy.max() / energy[0] - 1))
    yield most("pass", through, 0)
    yield most("meet nothing", missed, 0)
    yield most("energy gained", gained, 1e-3, "%")


@case("square hits at {speed:g} m/s (inf: the limit): speed after within 1 % of restitution", quick=True,
      over={"wall": ["static", "dynamic"], "speed": SPEEDS})  # fmt: skip
def square_hits(bench: Bench, wall: str, speed: float) -> Iterator[Figure]:
    speed = _speed(bench, speed)
    worst = 0.0
    for seed in range(60):
        random = np.random.default_rng(seed)
        e = (0.0, 0.3, 0.7, 1.0)[seed % 4]
        world, shape, plate = _world(bench, seed % 2, wall == "dynamic", e, 0.0, 2.0)
        start = -(0.3 + speed / 60 * random.uniform(0.0, 3.0))
        body = world.add(shape, start, 0.0, velocity=(speed, 0.0), material=1)
        world.step(20)
        after = world.states([body, plate])[:, VX]
        mass, other = world.mass(body), world.mass(plate) if wall == "dynamic" else math.inf
        middle = 0.0 if math.isinf(other) else mass * speed / (mass + other)
        right = (middle - e * (speed - middle), 0.0 if math.isinf(other) else middle + e * middle)
        worst = max(worst, float(np.abs(after - right).max()) / speed)
    yield most("speed after, over that before", worst, 0.01, "%")


def _clearance(world: World, body: int, wall: int, start: np.ndarray) -> float:
    """The least gap from the wall on a straight path, by separating axes at many moments; 0 or less is a hit."""
    speed = float(np.hypot(start[VX], start[VY]))
    middle, reach = -float(start[X] * start[VX] + start[Y] * start[VY]) / speed**2, 1.5 / speed
    gap = math.inf
    # Each 3 mm of the way; where that comes near, each 0.03 mm of the 6 cm about the nearest place.
    for count in (1000, 2000):
        t = np.linspace(middle - reach, middle + reach, count)
        gaps = separations(world.shapes[body], world.shapes[wall], start + np.outer(t, [*start[3:], 0, 0, 0]))
        gap, middle, reach = float(gaps.min()), float(t[gaps.argmin()]), 0.03 / speed
        if not -0.02 < gap < 0.1:
            break
    return gap


@case("near misses of a wall's end at {speed:g} m/s (inf: the limit): no ghost hit", quick=True,
      over={"speed": SPEEDS})  # fmt: skip
def near_misses(bench: Bench, speed: float) -> Iterator[Figure]:
    speed = _speed(bench, speed)
    ghosts = tried = 0
    seed = 0
    while tried < 60 and seed < 600:
        random = np.random.default_rng(seed)
        world, shape, wall = _world(bench, seed, False, 0.5, 0.5, 2.0)
        slant = math.radians(random.uniform(-60, 60))
        way = np.array([math.cos(slant), math.sin(slant)])
        aim = np.array([0.0, 1.0 + random.uniform(0.05, 0.35)])
        start = aim - way * (0.3 + speed / 60 * random.uniform(0.0, 3.0))
        body = world.add(shape, *start, random.uniform(-3, 3), tuple(speed * way), random.uniform(-60, 60), material=1)
        seed += 1
        (before,) = world.states([body])
        if not 0.0005 < _clearance(world, body, wall, before) < 0.05:
            continue
        tried += 1
        world.step(8)
        after = world.states([body])[0]
        ghosts += bool(np.hypot(*(after - before)[[VX, VY]]) > 0.001 * speed)
    yield most("ghost hits", ghosts, 0)
    yield Figure("near misses tried", tried, 60, least=True)


def _shot(world: World, kind: int) -> Shape:
    return (world.circle(0.1), world.box(0.2, 0.2), world.box(0.4, 0.1))[kind]


def _pile(world: World, target: str, density: float, material: int) -> list[int]:
    """Light things without rotation, so that it can be told whether something went through them."""
    if target == "stack":
        form, places = world.box(0.5, 0.5), [(0.0, 0.5 * k - 2) for k in range(8)]
    elif target == "planks":
        form, places = world.box(0.05, 0.5), [(0.0, 0.55 * k - 2) for k in range(8)]
    else:
        form = world.box(0.3, 0.3)
        places = [(0.31 * (k - (5 - row) / 2), 0.3 * row - 0.9) for row in range(6) for k in range(6 - row)]
    return [world.add(form, x, y, density=density, material=material, flags=FIXED_ROTATION) for x, y in places]


def _through(path: np.ndarray, shape: Shape) -> bool:
    """Whether a path, relative to a box that does not turn, crosses the box's middle line along its longer side."""
    assert shape.corners is not None
    thin, long = sorted((0, 1), key=lambda axis: shape.corners[:, axis].max())
    reach = shape.corners[:, long].max()
    before, after = path[:-1], path[1:]
    part = before[:, thin] / np.where(before[:, thin] == after[:, thin], 1.0, before[:, thin] - after[:, thin])
    at = before[:, long] + part * (after[:, long] - before[:, long])
    beside = (np.abs(before[:, long]) < reach) & (np.abs(after[:, long]) < reach) & (np.abs(at) < 0.9 * reach)
    return bool(((before[:, thin] * after[:, thin] < 0) & beside).any())


@case("60 times 3 shots at {speed:g} m/s (inf: the limit) at light {target} in free space: none goes through",
      quick=True, over={"target": ["stack", "pyramid", "planks"], "speed": [20.0, 60.0, LIMIT]})  # fmt: skip
def shots(bench: Bench, target: str, speed: float) -> Iterator[Figure]:
    speed = _speed(bench, speed)
    through, gained, lost = 0, 0.0, 0.0
    for seed in range(60):
        random = np.random.default_rng(seed)
        world = bench.world((0.0, 0.0), bodies=40, arbiters=400)
        material = world.material(0.5, bounce=(0.0, 0.3, 0.8, 1.0)[seed % 4])
        pile = _pile(world, target, float(10 ** random.uniform(-2, 0)), material)
        for k in range(3):
            slant = math.radians(random.uniform(-50, 50))
            way = np.array([math.cos(slant), math.sin(slant)])
            start = np.array([0.0, random.uniform(-1.5, 1.5)]) - way * (1.5 + k + speed / 60 * random.uniform(0, 2))
            world.add(_shot(world, int(random.integers(0, 3))), *start, random.uniform(-3, 3), tuple(speed * way),
                      random.uniform(-60, 60), material=material)  # fmt: skip
        states = world.record(40, 1)
        count = len(pile)
        through += any(
            _through(states[:, shot, [X, Y]] - states[:, k, [X, Y]], world.shapes[pile[k]])
            for shot in range(count, count + 3)
            for k in range(count)
        )
        energy = kinetic_energy(world, states)
        gained = max(gained, float(energy.max() / energy[0] - 1))
        # At the limit itself, what is struck by more than its mass is cut within the passes, where nothing counts it.
        if world.statistics["saturations"] == 0 and speed < 0.5 * world.speed_limit:
            lost = max(lost, _momentum_off(world, states))
    yield most("runs in which one goes through", through, 0)
    yield most("energy gained", gained, 1e-3, "%")
    yield most("momentum off, where nothing met a limit", lost, 1e-3, "%")


def _momentum_off(world: World, states: np.ndarray) -> float:
    mass = np.array([world.mass(body) for body in world.moving])
    momentum = (mass[:, None] * states[:, :, [VX, VY]]).sum(axis=1)
    return float(np.abs(momentum - momentum[0]).max() / np.abs(mass[:, None] * states[0, :, [VX, VY]].T).sum())


@case("200 pairs head-on, each at {speed:g} m/s (inf: the limit), masses to 10:1: none swaps sides", quick=True,
      over={"speed": SPEEDS})  # fmt: skip
def head_on(bench: Bench, speed: float) -> Iterator[Figure]:
    speed = _speed(bench, speed)
    swapped, gained, lost = 0, 0.0, 0.0
    for seed in range(200):
        random = np.random.default_rng(seed)
        world = bench.world((0.0, 0.0), bodies=2, arbiters=4)
        material = world.material(0.3, bounce=(0.0, 0.5, 1.0)[seed % 3])
        flags = FIXED_ROTATION if seed % 4 == 0 else 0
        offset = float(random.uniform(-0.1, 0.1)) if seed % 2 else 0.0
        for side in (-1, 1):
            form, away = _form(world, int(random.integers(3))), 1 + random.uniform(0, speed / 60)
            density = float(10 ** random.uniform(-0.5, 0.5))
            world.add(form, side * away, max(side, 0) * offset, random.uniform(-3, 3), (-side * speed, 0.0),
                      random.uniform(-60, 60), density, material, flags=flags)  # fmt: skip
        states = world.record(15 + int(120 / speed), 1)
        path = states[:, 0, [X, Y]] - states[:, 1, [X, Y]]
        for k in np.flatnonzero(path[:-1, 0] * path[1:, 0] < 0):
            part = path[k, 0] / (path[k, 0] - path[k + 1, 0])
            swapped += bool(abs(path[k, 1] + part * (path[k + 1, 1] - path[k, 1])) < 0.09)
        energy = kinetic_energy(world, states)
        gained = max(gained, float(energy.max() / energy[0] - 1))
        if world.statistics["saturations"] == 0:
            lost = max(lost, _momentum_off(world, states))
    yield most("swap sides", swapped, 0)
    yield most("energy gained", gained, 1e-3, "%")
    yield most("momentum off, where nothing met a limit", lost, 1e-4, "%")


@case("120 shots at {speed:g} m/s (inf: the limit) into the corner of two thin walls: none gets out", quick=True,
      over={"speed": [10.0, 60.0, LIMIT]})  # fmt: skip
def into_corners(bench: Bench, speed: float) -> Iterator[Figure]:
    speed = _speed(bench, speed)
    out, gained = 0, 0.0
    for seed in range(120):
        random = np.random.default_rng(seed)
        world = bench.world((0.0, 0.0), bodies=3, arbiters=8)
        material = world.material(float(random.uniform(0, 1)), bounce=(0.0, 0.5, 1.0)[seed % 3])
        half = float(random.uniform(0.3, 1.4))  # of the corner's angle
        c, s = math.cos(half), math.sin(half)
        for side in (1, -1):
            world.fixed(world.box(4.0, THICK), -2 * c + 0.05 * s, side * (2 * s + 0.05 * c), -side * half, material)
        slant = 0.3 * float(random.uniform(-0.5, 0.5))
        y = float(random.uniform(-0.3, 0.3)) * min(1.5 * math.tan(half), 1.0)
        velocity, flags = (speed * math.cos(slant), speed * math.sin(slant)), FIXED_ROTATION if seed % 5 == 0 else 0
        shot = world.add(_form(world, seed), -1.5, y, random.uniform(-3, 3), velocity, random.uniform(-60, 60),
                         material=material, flags=flags)  # fmt: skip
        states = world.record(60, 1, [shot])
        x, y = states[:, 0, X], states[:, 0, Y]
        out += bool(((np.abs(y) * c + x * s > THICK) & (np.hypot(x, y) < 3)).any())
        energy = kinetic_energy(world, states)
        gained = max(gained, float(energy.max() / energy[0] - 1))
    yield most("get out", out, 0)
    yield most("energy gained", gained, 1e-3, "%")


@case("120 bodies made within a thin wall or a box, at {speed:g} m/s (inf: the limit): they get out", quick=True,
      over={"speed": [10.0, 60.0, LIMIT]})  # fmt: skip
def made_inside(bench: Bench, speed: float) -> Iterator[Figure]:
    speed = _speed(bench, speed)
    left, gained = 0, 0.0
    for seed in range(120):
        random = np.random.default_rng(seed)
        world = bench.world((0.0, 0.0), bodies=2, arbiters=4)
        material = world.material(0.3, bounce=(0.0, 0.5, 1.0)[seed % 3])
        if seed % 2:
            world.fixed(world.box(THICK, 4.0), 0.0, 0.0, material=material)
        else:
            world.add(world.box(1.0, 1.0), 0.0, 0.0, material=material)
        way = float(random.uniform(-3, 3))
        place = float(random.uniform(-0.1, 0.1)), float(random.uniform(-0.4, 0.4))
        world.add(_form(world, seed), *place, random.uniform(-3, 3), (speed * math.cos(way), speed * math.sin(way)),
                  random.uniform(-60, 60), material=material)  # fmt: skip
        energy = kinetic_energy(world, world.record(120, 1))
        gained = max(gained, float(energy.max() / energy[0] - 1))
        left += bool(Outlines(world).penetration() > 0.01)
    yield most("still inside after 2 s", left, 0)
    yield most("energy gained", gained, 0.01, "%")
