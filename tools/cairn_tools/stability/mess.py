"""Bad days: everything in one place, full pools, extreme settings. Defined, bounded and the same on each run."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from ..host import HostError, World, X, Y
from .build import floor, pit, stack
from .measure import Outlines, fastest, moved
from .model import Bench, Figure, case, least, most

FULL = -4


def _sane(world: World, states: np.ndarray) -> Iterator[Figure]:
    """Nothing wrapped or blew up: numbers, inside of the world, no faster than the cap of each axis."""
    cap = world.speed_limit
    speed = np.abs(states[:, :, 3:5]).max()
    yield most("speed over the cap", speed / cap, 1.0001)
    yield most("farthest from the middle", np.abs(states[:, :, [X, Y]]).max(), 16000.0, "m")


def _twice(hashes: list[str]) -> Figure:
    return most("runs that differ", len(set(hashes)) - 1, 0)


@case("64 boxes and circles made at one point: they separate and come to rest", quick=True)
def one_point(bench: Bench) -> Iterator[Figure]:
    hashes = []
    for _ in range(2):
        world = bench.world()
        pit(world, 12.0, 40.0)
        for k in range(64):
            form = world.box(0.5, 0.5) if k % 2 else world.circle(0.25)
            world.add(form, 0.0, 3.0, 0.1 * k)
        states = world.record(1800, 5)
        hashes.append(world.hash)
    yield from _sane(world, states)
    inside = (np.abs(states[-1, :, X]) < 6.0) & (states[-1, :, Y] > 0.0)
    yield most("outside of the pit", (~inside).sum(), 0)
    yield most("penetration at the end", Outlines(world).penetration(), 0.01, "m")
    yield most("speed in the last second", fastest(states[-12:]), 0.01, "m/s")
    yield _twice(hashes)


@case("pools full in the middle of a pile: errors where defined, drops counted, nothing wild", quick=True)
def full_pools(bench: Bench) -> Iterator[Figure]:
    hashes, refused, statuses = [], 0, set()
    for _ in range(2):
        world = bench.world(bodies=43, arbiters=50)
        pit(world, 4.0, 20.0)
        box, refused = world.box(0.6, 0.6), 0
        for k in range(50):
            world.step(10)
            try:
                world.add(box, 0.4 * (k % 5 - 2), 14.0, 0.3 * k)
            except HostError as error:
                refused += 1
                statuses.add(error.status)
        states = world.record(600, 5)
        hashes.append(world.hash)
    yield from _sane(world, states)
    yield most("bodies refused off the ten beyond the pool", abs(refused - 10), 0)
    yield most("refusals that do not say full", len(statuses - {FULL}), 0)
    yield least("contacts dropped and counted", world.statistics["dropped"], 1)
    yield _twice(hashes)


@case("stack of 5 at gravity {gravity:g}, n = {n}", quick=True, over={"gravity": [0.0, 1000.0], "n": [4, 16]})
def gravity(bench: Bench, gravity: float, n: int) -> Iterator[Figure]:
    yield from _holds(bench, gravity=gravity, n=n)


@case("stack of 5 at {rate:g} steps a second", quick=True, over={"rate": [15.0, 30.0, 120.0, 1000.0]})
def rate(bench: Bench, rate: float) -> Iterator[Figure]:
    yield from _holds(bench, rate=rate)


@case("stack of 5 boxes of {mass:g} kg", quick=True, over={"mass": [1e-3, 1e4]})
def mass(bench: Bench, mass: float) -> Iterator[Figure]:
    yield from _holds(bench, mass=mass)


@case("stack of 5 at n = {n}", quick=True, over={"n": [1, 2, 3, 8, 16]})
def substeps(bench: Bench, n: int) -> Iterator[Figure]:
    yield from _holds(bench, n=n)


def _holds(bench: Bench, gravity: float = 10.0, rate: float = 60.0, mass: float = 1.0, n: int = 4) -> Iterator[Figure]:
    hashes = []
    for _ in range(2):
        world = bench.world((0.0, -gravity), substeps=n)
        world.set_rate(rate)
        floor(world)
        box = world.box(1.0, 1.0)
        for k in range(5):
            world.add(box, 0.0, k + 0.5, density=mass)
        states = world.record(int(10 * rate), max(1, int(rate / 15)))
        hashes.append(world.hash)
    yield from _sane(world, states)
    yield most("moved", moved(states), 0.5, "m")
    # Seen as the share of a box: a heavier pull may press deeper.
    yield most("penetration at the end", Outlines(world).penetration(), 0.05, "m")
    yield _twice(hashes)


@case("200 seeded heaps in a pit, all at once: gravity 0 to 1000, dt 1/15 to 1/1000, 1 g to 10 t, n 1 to 16",
      quick=True)  # fmt: skip
def anything(bench: Bench) -> Iterator[Figure]:
    wild = differ = 0
    fastest_of_all = 0.0
    for seed in range(200):
        hashes = []
        for _ in range(2):
            world = _anything(bench, seed)
            states = world.record(300, 5)
            hashes.append(world.hash)
        differ += hashes[0] != hashes[1]
        ratio = float(np.abs(states[:, :, 3:5]).max() / world.speed_limit)
        wild += not (ratio <= 1.0001 and np.isfinite(states).all() and np.abs(states[:, :, [X, Y]]).max() <= 16000)
        fastest_of_all = max(fastest_of_all, ratio)
    yield most("runs that are not sane", wild, 0)
    yield most("runs that differ", differ, 0)
    yield most("speed over the cap", fastest_of_all, 1.0001)


def _anything(bench: Bench, seed: int) -> World:
    random = np.random.default_rng(seed)
    pull = 0.0 if seed % 10 == 0 else 10 ** random.uniform(-1, 3)
    world = bench.world((0.0, -pull), substeps=int(random.integers(1, 17)), bodies=16, arbiters=100)
    world.set_rate(float(10 ** random.uniform(math.log10(15), 3)))
    pit(world, 6.0, 12.0)
    for _ in range(10):
        kind, size = random.integers(0, 3), float(random.uniform(0.3, 0.8))
        form = (world.circle(size / 2), world.box(size, size), world.regular(5, size / 2))[kind]
        mass = 10 ** random.uniform(-3, 4)
        place = (random.uniform(-2, 2), random.uniform(0.5, 8))
        world.add(form, *place, random.uniform(-3, 3), tuple(random.uniform(-10, 10, 2)), random.uniform(-10, 10),
                  density=mass / form.area)  # fmt: skip
    return world


@case("24 heaps of 30 bouncing bodies, threshold 0, so that no touch is too slow: they do not sink into one another",
      quick=True)  # fmt: skip
def bouncing_heaps(bench: Bench) -> Iterator[Figure]:
    deepest, lost = [], 0
    for seed in range(24):
        world = _bouncing_heap(bench, seed)
        outlines, depths = Outlines(world), []
        world.step(480)
        for _ in range(12):
            world.step(10)
            depths.append(outlines.penetration())
        deepest.append(max(depths))
        states = world.states(world.moving)
        lost += int(((np.abs(states[:, X]) > 4.0) | (states[:, Y] < 0.0)).sum())
    yield most("penetration after 8 s, mean of the heaps", float(np.mean(deepest)), 0.005, "m")
    yield most("deepest", max(deepest), 0.03, "m")  # a heap in which bodies are wedged: 8 to 22 mm by a last bit
    yield most("bodies lost", lost, 0)


def _bouncing_heap(bench: Bench, seed: int) -> World:
    random = np.random.default_rng(seed)
    world = bench.world(bodies=40, arbiters=300)
    material = world.material(float(random.uniform(0, 1)), None, float(random.uniform(0.3, 0.9)))
    pit(world, 8.0, 24.0, material)
    for k in range(30):
        kind, sides, size = random.integers(0, 3), int(random.integers(3, 8)), float(random.uniform(0.3, 1.0))
        form = (world.circle(size / 2), world.box(size, size / 2), world.regular(sides, size / 2))[kind]
        x, y, angle = 1.15 * (k % 6 - 2.5), 0.8 + 1.2 * (k // 6), float(random.uniform(-3, 3))
        velocity, density = tuple(random.uniform(-5, 5, 2)), float(10 ** random.uniform(0, 1))
        world.add(form, x, y, angle, velocity, density=density, material=material)
    return world


@case("stack of 5 on sub-steps, rate and gravity changed every second: no jump", quick=True)
def changing(bench: Bench) -> Iterator[Figure]:
    world = bench.world()
    floor(world)
    stack(world, 5)
    start = world.states()
    for n, steps_per_second, pull in ((8, 60, 10), (2, 120, 10), (16, 30, 20), (4, 60, 5), (4, 200, 10), (4, 60, 10)):
        world.set_substeps(n)
        world.set_rate(steps_per_second)
        world.set_gravity(0.0, -pull)
        world.step(steps_per_second)
    yield most("moved", np.abs(world.states() - start)[:, [X, Y]].max(), 0.05, "m")
