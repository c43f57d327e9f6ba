"""Heavy on light, light on heavy, heaps under slabs and drops of mixed masses."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from ..host import X, Y
from .build import floor, pit
from .measure import fastest, kinetic_energy, moved
from .model import Bench, Figure, case, most, stretch
from .stands import SECOND, watched

RATIOS = [1e2, 1e3, 1e4, 1e5]
SLAB = "slab of {ratio:g} on a heap of 18 boxes of 1, n = {n}"
PEERS = "largest ratio that holds: slides 1, box2d-lite 10, Chipmunk 10, Box2D 100 at 36 mm"


def column(bench: Bench, densities: list[float], offset: float = 0.0, substeps: int = 4) -> tuple[np.ndarray, float]:
    """Unit boxes on one another, from the lowest up; the offset is the last one's."""
    world = bench.world(substeps=substeps)
    floor(world)
    box = world.box(1.0, 1.0)
    for k, density in enumerate(densities):
        world.add(box, offset if k == len(densities) - 1 else 0.0, k + 0.5, density=density)
    return watched(world, 1200)


def _stands(states: np.ndarray, depth: float, limit: float) -> Iterator[Figure]:
    yield most("penetration", depth, limit, "m")
    yield most("moved", moved(states), 0.1, "m")
    yield most("speed in the last second", fastest(states[-SECOND:]), 1e-3, "m/s")


@case("box of mass {ratio:g} on one of 1, offset {offset}, n = 4: penetration at most 1 mm", quick=True, peers=PEERS,
      over={"ratio": RATIOS, "offset": [0.0, 0.3]}, baseline=True)  # fmt: skip
def heavy(bench: Bench, ratio: float, offset: float) -> Iterator[Figure]:
    yield from _stands(*column(bench, [1.0, ratio], offset), 0.001)


@case("heavy ({ratio:g}), light, light from the top", over={"ratio": RATIOS}, quick=True, peers=PEERS)
def heavy_light_light(bench: Bench, ratio: float) -> Iterator[Figure]:
    yield from _stands(*column(bench, [1.0, 1.0, ratio]), 0.001)


@case("heavy ({ratio:g}), light, heavy from the top", over={"ratio": RATIOS}, quick=True, peers=PEERS)
def heavy_light_heavy(bench: Bench, ratio: float) -> Iterator[Figure]:
    yield from _stands(*column(bench, [ratio, 1.0, ratio]), 0.001)


@case(
    "eight alternating, light at the foot, ratio {ratio:g}: at most 3 mm",
    over={"ratio": RATIOS},
    quick=True,
    peers=PEERS,
)
def alternating(bench: Bench, ratio: float) -> Iterator[Figure]:
    yield from _stands(*column(bench, [1.0, ratio] * 4), 0.003)


@case("light on heavy, ratio {ratio:g}", over={"ratio": RATIOS}, quick=True)
def light_on_heavy(bench: Bench, ratio: float) -> Iterator[Figure]:
    yield from _stands(*column(bench, [ratio, 1.0]), 0.005)


def _slab(bench: Bench, ratio: float, substeps: int) -> tuple[np.ndarray, float]:
    """A slab of so many boxes' mass on three rows of six boxes, the middle row half a box aside."""
    world = bench.world(substeps=substeps)
    floor(world)
    box = world.box(1.0, 1.0)
    for row in range(3):
        for k in range(6):
            world.add(box, 1.05 * (k - 2.5) + (0.25 if row == 1 else -0.25), row + 0.5)
    width, height = 6.5, 0.5
    world.add(world.box(width, height), 0.0, 3.0 + height / 2, density=ratio / (width * height))
    return watched(world, 1200)


@case(SLAB, over={"ratio": [1e2], "n": [4]}, quick=True, peers=PEERS)
def slab(bench: Bench, ratio: float, n: int) -> Iterator[Figure]:
    yield from _stands(*_slab(bench, ratio, n), 0.005)


@case(
    "slab of {ratio:g} on a heap of 18 boxes of 1, n = {n}", over={"ratio": [1e3], "n": [16]}, name="slab", quick=True
)
def slab_deeper(bench: Bench, ratio: float, n: int) -> Iterator[Figure]:
    states, depth = _slab(bench, ratio, n)
    yield most("penetration", depth, 0.010, "m")
    yield most("moved", moved(states), 0.1, "m")


@case("the same comes to rest (stretch)", over={"ratio": [1e3], "n": [16]}, quick=True)
def slab_calm(bench: Bench, ratio: float, n: int) -> Iterator[Figure]:
    states, _ = _slab(bench, ratio, n)
    yield stretch("speed in the last second", fastest(states[-SECOND:]), 1e-3, "m/s")


@case(
    "slab of {ratio:g} on a heap of 18 boxes of 1, n = {n} (stretch)",
    over={"ratio": [1e4], "n": [16]},
    name="slab",
    quick=True,
)
def slab_stretch(bench: Bench, ratio: float, n: int) -> Iterator[Figure]:
    for figure in _stands(*_slab(bench, ratio, n), 0.010):
        yield stretch(figure.what, figure.value, figure.limit, figure.unit)


def _drops(bench: Bench, largest: float) -> tuple[int, int, float]:
    """Of 60 drops: from how many something left the pit, how many were too fast, and the worst speed over free fall."""
    left = fast = 0
    worst = 0.0
    for seed in range(60):
        random = np.random.default_rng(seed)
        world = bench.world(bodies=16, arbiters=200)
        pit(world, 4.0, 12.0)
        for k in range(6):
            side = random.uniform(0.5, 1.0)
            mass = largest ** random.uniform(0.0, 1.0)
            x, angle = random.uniform(-1.2, 1.2), random.uniform(-math.pi, math.pi)
            world.add(world.box(side, side), x, 1.0 + 1.4 * k, angle, density=mass / side**2)
        free_fall = math.sqrt(2 * 10.0 * (1.0 + 1.4 * 5))
        states = world.record(600, 1)
        ratio = float(np.hypot(states[:, :, 3], states[:, :, 4]).max()) / free_fall
        outside = (np.abs(states[:, :, X]) > 2.0) | (states[:, :, Y] < 0.0) | (states[:, :, Y] > 12.0)
        # What is not a number is outside too.
        left += bool(outside.any() or not np.isfinite(states).all())
        fast += not ratio <= 2.0
        worst = max(worst, ratio)
    return left, fast, worst


@case("60 seeded drops of six boxes of masses 1 to 1e3 into a pit", quick=True)
def drops(bench: Bench) -> Iterator[Figure]:
    left, fast, worst = _drops(bench, 1e3)
    yield most("drops that something left", left, 0)
    yield most("drops faster than twice the free fall", fast, 3)
    yield stretch("worst speed over free fall", worst, 2.0)


@case("60 seeded drops of six boxes of masses 1 to 1e5 into a pit (stretch)", name="drops-1e5", quick=True)
def drops_wider(bench: Bench) -> Iterator[Figure]:
    left, fast, worst = _drops(bench, 1e5)
    yield stretch("drops that something left", left, 0)
    yield stretch("drops faster than twice the free fall", fast, 0)
    yield stretch("worst speed over free fall", worst, 2.0)


@case("impact of two {shape}s, ratios 1 to 1e5, e = {e}: velocities and momentum within 0.1 %", quick=True,
      over={"shape": ["circle", "box"], "e": [0.0, 0.5, 1.0]})  # fmt: skip
def impact(bench: Bench, shape: str, e: float) -> Iterator[Figure]:
    for who in ("heavy", "light"):
        errors, losses = [], []
        for ratio in (1.0, 10.0, *RATIOS):
            masses = (ratio, 1.0) if who == "heavy" else (1.0, ratio)
            speed, momentum = _impact_errors(bench, shape, e, masses)
            errors.append(speed)
            losses.append(momentum)
        yield most(f"velocity, the {who} one strikes", max(errors), 1e-3, "%")
        yield most(f"momentum, the {who} one strikes", max(losses), 1e-3, "%")


def _impact_errors(bench: Bench, shape: str, e: float, masses: tuple[float, float]) -> tuple[float, float]:
    """The first strikes the second at 5 m/s. Errors over the approach speed, and over the momentum there was."""
    approach = 5.0
    world = bench.world((0.0, 0.0), bodies=2, arbiters=4)
    material = world.material(0.0, bounce=e)
    form = world.circle(0.5) if shape == "circle" else world.box(1.0, 1.0)
    a = world.add(form, 0.0, 0.0, velocity=(approach, 0.0), density=masses[0] / form.area, material=material)
    b = world.add(form, 2.03, 0.0, density=masses[1] / form.area, material=material)
    world.step(60)
    (va, vb), (ma, mb) = world.states([a, b])[:, 3], masses
    momentum = ma * approach
    middle = momentum / (ma + mb)
    right_a, right_b = middle - e * mb * approach / (ma + mb), middle + e * ma * approach / (ma + mb)
    error = max(abs(va - right_a), abs(vb - right_b)) / approach
    return error, abs(ma * va + mb * vb - momentum) / momentum


@case("free collision of two polygons, 200 seeded: momentum and angular momentum", quick=True)
def polygons_collide(bench: Bench) -> Iterator[Figure]:
    worst_momentum = worst_angular = gained = 0.0
    for seed in range(200):
        random = np.random.default_rng(seed)
        world = bench.world((0.0, 0.0), bodies=2, arbiters=4)
        material = world.material(0.4, bounce=float(random.uniform(0, 1)))
        for side in (-1, 1):
            form = world.regular(int(random.integers(3, 9)), float(random.uniform(0.3, 1.0)))
            velocity = (-side * float(random.uniform(1, 5)), float(random.uniform(-1, 1)))
            world.add(form, side * 1.5, float(random.uniform(-0.5, 0.5)), float(random.uniform(-3, 3)), velocity,
                      float(random.uniform(-5, 5)), float(random.uniform(0.5, 2)), material)  # fmt: skip
        before = world.states()
        world.step(90)
        after = world.states()
        mass = np.array([world.mass(body) for body in world.moving])
        inertia = np.array([world.inertia(body) for body in world.moving])
        change = (mass[:, None] * (after - before)[:, 3:5]).sum(axis=0)
        worst_momentum = max(worst_momentum, np.hypot(*change) / (mass * np.hypot(before[:, 3], before[:, 4])).sum())
        spins = [_angular(mass, inertia, states) for states in (before, after)]
        scale = (mass * np.hypot(*before[:, :2].T) * np.hypot(*before[:, 3:5].T)).sum() + (
            inertia * abs(before[:, 5])
        ).sum()
        worst_angular = max(worst_angular, abs(spins[1] - spins[0]) / scale)
        energy = [kinetic_energy(world, states[None])[0] for states in (before, after)]
        gained = max(gained, energy[1] / energy[0] - 1)
    yield most("momentum", worst_momentum, 1e-6)
    yield most("angular momentum over its scale", worst_angular, 1e-4)
    yield most("energy gained", gained, 1e-3, "%")


def _angular(mass: np.ndarray, inertia: np.ndarray, states: np.ndarray) -> float:
    x, y, _, vx, vy, omega = states.T
    return float((mass * (x * vy - y * vx) + inertia * omega).sum())


@case("Newton's cradle of five, touching: {strikers} strike, as many leave with at least 99 % of the speed", quick=True,
      over={"strikers": [1, 2]})  # fmt: skip
def cradle(bench: Bench, strikers: int) -> Iterator[Figure]:
    world = bench.world((0.0, 0.0))
    material = world.material(0.0, bounce=1.0)
    ball, speed = world.circle(0.5), 2.0
    for k in range(5):
        moves = k < strikers
        world.add(ball, k - (0.73 if moves else 0.0), 0.0, velocity=(speed if moves else 0.0, 0.0), material=material)
    world.step(120)
    velocities = world.states()[:, 3] / speed
    yield most("speed that the last lack", 1 - velocities[-strikers:].min(), 0.01, "%")
    yield most("speed left with the others", np.abs(velocities[:-strikers]).max(), 0.01, "%")
