"""Slopes, rolling, bouncing, a gas of elastic circles, and motion that does not depend on the place."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from .. import scene
from ..host import ANGLE, VX, VY, X, Y
from .build import tilted
from .measure import kinetic_energy, potential_energy
from .model import Bench, Figure, case, least, most, stretch

MU = 0.5


def _on_slope(bench: Bench, degrees: float, shape: str, steps: int, every: int = 1) -> np.ndarray:
    """Place and speed along a slope of friction 0.5, counted downwards, of a box or disc let go on it."""
    angle = math.radians(degrees)
    world = bench.world(bodies=2, arbiters=4)
    rough = world.material(MU)
    world.fixed(world.box(200.0, 2.0), *tilted(angle, 0.0, -1.0), angle, rough)
    form = world.circle(0.5) if shape == "disc" else world.box(1.0, 1.0)
    body = world.add(form, *tilted(angle, 0.0, 0.5), angle, material=rough)
    states = world.record(steps, every, [body])[:, 0]
    c, s = math.cos(angle), math.sin(angle)
    return -np.stack([c * states[:, X] + s * states[:, Y], c * states[:, VX] + s * states[:, VY]], axis=1)


def slide_angle(bench: Bench) -> float:
    """The least angle in degrees at which the box still moves in the tenth of a minute after one minute."""
    low, high = 20.0, 33.0
    while high - low > 0.0005:
        middle = (low + high) / 2
        way = _on_slope(bench, middle, "box", 4200, 600)[:, 0]
        low, high = (low, middle) if way[-1] - way[-2] > 0.002 else (middle, high)
    return high


@case("slide angle at friction 0.5 within 0.01 degrees of 26.565, after 60 s", quick=True, baseline=True,
      peers="slides 2.4, box2d-lite 26.565, Chipmunk 26.564, Box2D 26.564")  # fmt: skip
def slide(bench: Bench) -> Iterator[Figure]:
    found = slide_angle(bench)
    yield most("slide angle off", abs(found - math.degrees(math.atan(MU))), 0.01, "degrees")


@case("box on a slope below the slide angle: no creep between 10 s and 60 s", quick=True)
def creep(bench: Bench) -> Iterator[Figure]:
    for degrees in (5.0, 15.0, 25.0, 26.5):
        way = _on_slope(bench, degrees, "box", 3600, 600)[:, 0]
        yield most(f"creep at {degrees:g} degrees", abs(way[-1] - way[1]), 0.0, "m")


def _acceleration(states: np.ndarray) -> float:
    """The slope of the speed from 0.5 s on."""
    t = np.arange(len(states)) / 60
    return float(np.polyfit(t[30:], states[30:, 1], 1)[0])


@case("accelerations of a sliding box and a rolling disc on slopes within 0.1 %", quick=True)
def accelerations(bench: Bench) -> Iterator[Figure]:
    for degrees in (30.0, 40.0, 50.0):
        angle = math.radians(degrees)
        right = 10.0 * (math.sin(angle) - MU * math.cos(angle))
        got = _acceleration(_on_slope(bench, degrees, "box", 150))
        yield most(f"box at {degrees:g} degrees", abs(got / right - 1), 0.001, "%")
    for degrees in (5.0, 20.0, 40.0):
        right = 10.0 * math.sin(math.radians(degrees)) * 2 / 3
        got = _acceleration(_on_slope(bench, degrees, "disc", 150))
        yield most(f"disc at {degrees:g} degrees", abs(got / right - 1), 0.001, "%")


def _ball(bench: Bench, e: float) -> tuple:
    """A ball whose lowest point is 5 m over the floor."""
    world = bench.world(bodies=2, arbiters=4)
    material = world.material(0.0, bounce=e)
    world.fixed(world.box(50.0, 1.0), 0.0, -0.5, material=material)
    return world, world.add(world.circle(0.5), 0.0, 5.5, material=material)


@case("ball from 5 m, e = {e:g}: five later apexes within 0.1 %", over={"e": [0.0, 0.5, 0.9, 1.0]}, quick=True,
      peers="e = 1: slides 17 m, Chipmunk 5.03, Box2D 4.89")  # fmt: skip
def ball(bench: Bench, e: float) -> Iterator[Figure]:
    world, body = _ball(bench, e)
    states = world.record(900, 1, [body])[:, 0]
    if e == 0:
        yield most("height after the first bounce over 5 m", abs(states[70:, Y] - 0.5).max() / 5, 0.001, "%")
        return
    # In flight the height to come is known at each step; a bounce is where the speed turns up.
    height = states[:, Y] - 0.5 + states[:, VY] ** 2 / 20
    turns = np.flatnonzero((states[:-1, VY] < 0) & (states[1:, VY] > 0)) + 1
    worst = math.nan
    if len(turns) >= 5:
        worst = max(abs(height[turn] / (5 * e ** (2 * (k + 1))) - 1) for k, turn in enumerate(turns[:5]))
    yield least("bounces seen", len(turns), 5)
    yield most("worst apex", worst, 0.001, "%")


@case("elastic ball from 5 m, 60 s: energy within 0.05 % of the start all along", quick=True,
      peers="later apexes of 5 m: slides 17, Chipmunk 5.03, Box2D 4.89")  # fmt: skip
def elastic_ball(bench: Bench) -> Iterator[Figure]:
    world, body = _ball(bench, 1.0)
    states = world.record(3600, 1, [body])
    energy = kinetic_energy(world, states) + potential_energy(world, states - np.array([0, 0.5, 0, 0, 0, 0]))
    worst = np.abs(energy / energy[0] - 1).max()
    yield most("energy off", worst, 0.0005, "%")
    yield stretch("energy off", worst, 0.0001, "%")


GAS = "energy left: slides 28/5.5, 38 escape; Chipmunk 1.00/0.62, 3 escape; Box2D 0.62/0.02"


@case("gas of 50 elastic circles at {speed:g} m/s, 60 s: energy, and none escapes", over={"speed": [3.0, 30.0]},
      quick=True, baseline=True, peers=GAS)  # fmt: skip
def gas(bench: Bench, speed: float) -> Iterator[Figure]:
    world = bench.world((0.0, 0.0))
    material = world.material(0.0, bounce=1.0)
    half = 5.0
    for side in (-1, 1):
        world.fixed(world.box(1.0, 2 * half + 2), side * (half + 0.5), 0.0, material=material)
        world.fixed(world.box(2 * half + 2, 1.0), 0.0, side * (half + 0.5), material=material)
    ball = world.circle(0.25)
    random = np.random.default_rng(1)
    for k in range(50):
        way = random.uniform(-math.pi, math.pi)
        x, y = (k % 8 - 3.5) * 1.15, (k // 8 - 3.0) * 1.15
        world.add(ball, x, y, velocity=(speed * math.cos(way), speed * math.sin(way)), material=material)
    states = world.record(3600, 10)
    energy = kinetic_energy(world, states)
    outside = ~((np.abs(states[-1, :, X]) < half) & (np.abs(states[-1, :, Y]) < half))
    yield most("energy off", np.abs(energy / energy[0] - 1).max(), 0.001 if speed < 10 else 0.01, "%")
    yield most("escaped", outside.sum(), 0)


@case("scene {name} moved by whole metres up to the edge of the world: the same motion, bit by bit", quick=True,
      over={"name": ["pyramid10", "mixed50", "circles100", "curtain150", "bridge"]}, engines=("q16",))  # fmt: skip
def translation(bench: Bench, name: str) -> Iterator[Figure]:
    loaded = scene.load(scene.find(name))
    start = bench.scene(loaded).record(300, 10)
    different = 0
    for dx, dy in ((1, 0), (-37, 1000), (-8000, 123), (15900, -15900)):
        bodies = [replace(body, position=(body.position[0] + dx, body.position[1] + dy)) for body in loaded.bodies]
        states = bench.scene(replace(loaded, bodies=bodies)).record(300, 10)
        # Exact in double: places are whole multiples of 2^-28 below 2^14.
        states[:, :, X] -= dx
        states[:, :, Y] -= dy
        different += int((states != start).any())
    yield most("places where it moves differently", different, 0)
    yield least("it moves, by", np.abs(start[-1, :, [X, Y, ANGLE]] - start[0, :, [X, Y, ANGLE]]).max(), 1e-3, "m")


@case("{what} sliding or rolling over a floor of tiles at {speed} m/s: it keeps its speed and height", quick=True,
      over={"what": ["box", "circle"], "speed": [0.1, 1, 5, 40]})  # fmt: skip
def tiles(bench: Bench, what: str, speed: float) -> Iterator[Figure]:
    world = bench.world()
    ice = world.material(0.0)
    tile = world.box(1.0, 1.0)
    for k in range(60):
        world.fixed(tile, k, -0.5)
    body = (world.add(world.box(0.8, 0.8), 1.2, 0.4, velocity=(speed, 0), material=ice) if what == "box"
            else world.add(world.circle(0.3), 1.2, 0.3, velocity=(speed, 0), omega=-speed / 0.3))  # fmt: skip
    path = world.record(int(min(600, 55 / speed * 60)), 1, [body])[:, 0]
    yield most("speed lost", 1 - path[:, VX].min() / speed, 0.01, "%")
    yield most("height off", np.abs(path[:, Y] - path[0, Y]).max(), 0.001, "m")
