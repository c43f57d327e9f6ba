"""What must stand: stacks, pyramids and other buildings, and boxes of all sizes."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from .. import scene
from ..host import ANGLE, KINEMATIC, X, Y
from .build import floor, pyramid, stack
from .measure import Outlines, fastest, moved
from .model import Bench, Figure, case, most, stretch

EVERY = 10
MINUTE = 3600
SECOND = 60 // EVERY


def deepest(outlines: Outlines, states: np.ndarray, every: int = 6) -> float:
    """The deepest penetration in some of these records of all bodies."""
    return max(outlines.penetration(record) for record in states[:: -max(1, every)])


def watched(bench_world: object, steps: int = MINUTE, every: int = EVERY) -> tuple[np.ndarray, float]:
    """Runs a world; the states of what moves, and the deepest penetration."""
    world = bench_world
    outlines = Outlines(world)
    places = [outlines.bodies.index(body) for body in world.moving]
    states = world.record(steps, every, outlines.bodies)
    return states[:, places], deepest(outlines, states)


def _stack_figures(states: np.ndarray, depth: float, limit: float) -> Iterator[Figure]:
    speed = fastest(states[-SECOND:])
    yield most("penetration", depth, limit, "m")
    yield most("top sank", states[0, -1, Y] - states[-1, -1, Y], 0.05, "m")
    yield most("drift", np.abs(states[-1, :, X] - states[0, :, X]).max(), 0.001, "m")
    yield most("speed in the last second", speed, 1e-4, "m/s")
    yield stretch("speed", speed, 0.0, "m/s")


@case("stack of 20, {how}, 60 s, n = 4", over={"how": ["aligned", "offset"]}, quick=True, baseline=True,
      peers="tallest: slides 2, box2d-lite 11/16, Chipmunk 12/13, Box2D >=60/43 (14 without recycling)")  # fmt: skip
def stack20(bench: Bench, how: str) -> Iterator[Figure]:
    world = bench.world()
    floor(world)
    stack(world, 20, offset=how == "offset")
    yield from _stack_figures(*watched(world), 0.005)


@case("stack of 30, {how}, 60 s, n = 8", over={"how": ["aligned", "offset"]}, quick=True,
      peers="tallest: Box2D >=60/43 (14/14 without recycling)")  # fmt: skip
def stack30(bench: Bench, how: str) -> Iterator[Figure]:
    world = bench.world(substeps=8)
    floor(world)
    stack(world, 30, offset=how == "offset")
    states, depth = watched(world)
    yield most("moved sideways", moved(states, axes=(X,)), 0.5, "m")
    yield most("penetration", depth, 0.004, "m")


@case("stack of 10, one hour: drift at most 1 mm in the first minute, none in the second half hour")
def hour_stack10(bench: Bench) -> Iterator[Figure]:
    world = bench.world()
    floor(world)
    stack(world, 10)
    states = world.record(60 * MINUTE, 60)
    yield most("drift in the first minute", np.abs(states[60, :, X] - states[0, :, X]).max(), 0.001, "m")
    yield most("drift in the second half hour", moved(states, 1800), 0.0, "m")


@case("pyramid of {boxes}, 60 s", over={"boxes": [55, 210]}, quick=True, baseline=True,
      peers="210, depth, drift, mm: slides fall, box2d-lite 4.1, 1.7, Chipmunk 5, 7, Box2D 3.7, 4.3")  # fmt: skip
def pyramid_of(bench: Bench, boxes: int) -> Iterator[Figure]:
    world = bench.world()
    floor(world)
    pyramid(world, {55: 10, 210: 20}[boxes])
    states, depth = watched(world, every=20)
    speed = fastest(states[-3:])
    yield most("penetration", depth, 0.003, "m")
    yield most("drift", np.abs(states[-1, :, X] - states[0, :, X]).max(), 0.0005, "m")
    yield most("speed in the last second", speed, 1e-4, "m/s")
    yield stretch("speed", speed, 0.0, "m/s")


def _still(bench_world: object, steps: int = MINUTE) -> Iterator[Figure]:
    """The figures of what stands on its own for a minute."""
    states, depth = watched(bench_world, steps, every=20)
    yield most("penetration", depth, 0.003, "m")
    yield most("drift", np.abs(states[-1, :, X] - states[0, :, X]).max(), 0.0005, "m")
    yield most("speed in the last second", fastest(states[-3:]), 1e-4, "m/s")


@case("wall of bricks, {rows} rows of ten in bond, 60 s", over={"rows": [10]}, quick=True)
def brick_wall(bench: Bench, rows: int) -> Iterator[Figure]:
    world = bench.world()
    floor(world)
    brick, half = world.box(1.0, 0.5), world.box(0.495, 0.5)
    for row in range(rows):
        y, shift = 0.25 + 0.5 * row, 0.5 * (row % 2)
        for k in range(10 - row % 2):
            world.add(brick, 1.01 * (k - 4.5 + shift), y)
        if row % 2:
            for side in (-1, 1):
                world.add(half, side * (1.01 * 4.5 + 0.2525), y)
    yield from _still(world)


@case("eight hexagons on one another, 60 s", quick=True)
def hexagons(bench: Bench) -> Iterator[Figure]:
    world = bench.world()
    floor(world)
    stone = world.regular(6, 0.5)
    rise = math.sqrt(3) / 2
    for k in range(8):
        world.add(stone, 0.0, rise * (k + 0.5))
    yield from _still(world)


@case(
    "stack of 8 on a platform moving at {speed} m/s, 20 s: goes with it within 1 mm",
    over={"speed": [0.03, 0.5]},
    quick=True,
)
def platform(bench: Bench, speed: float) -> Iterator[Figure]:
    world = bench.world()
    deck = world.add(world.box(6.0, 0.4), 0.0, -0.2, velocity=(speed, 0.0), kind=KINEMATIC)
    box = world.box(1.0, 1.0)
    bodies = [world.add(box, 0.0, k + 0.5, velocity=(speed, 0.0)) for k in range(8)]
    states = world.record(1200, EVERY, [deck, *bodies])
    apart = states[:, 1:, X] - states[:, :1, X]
    yield most("left behind", np.abs(apart[-1] - apart[0]).max(), 0.001, "m")
    yield most("against it in the last second", np.abs(apart[-1] - apart[-SECOND]).max(), 1e-4, "m")


@case("the slides' tower: no centre more than 50 mm from its place, penetration at most 5 mm, at rest", quick=True)
def tower(bench: Bench) -> Iterator[Figure]:
    states, depth = watched(bench.scene(scene.load(scene.find("tower"))))
    yield most("moved", moved(states), 0.05, "m")
    yield most("penetration", depth, 0.005, "m")
    yield most("speed in the last second", fastest(states[-SECOND:]), 1e-4, "m/s")


@case(
    "card house of three storeys, friction 0.8: no card moves by more than 20 mm or turns by more than 2 degrees",
    quick=True,
)
def card_house(bench: Bench) -> Iterator[Figure]:
    world = bench.world()
    paper = world.material(0.8)
    floor(world, material=paper)
    length, thick, lean, storeys = 1.0, 0.04, math.radians(20), 3
    c, s = math.cos(lean), math.sin(lean)
    out, up = thick / 2 * c + length / 2 * s, thick / 2 * s + length / 2 * c
    pitch = 2 * (thick * c + length * s) + 0.04
    card, roof = world.box(thick, length), world.box(pitch - 0.02, thick)
    base = 0.0
    for storey in range(storeys):
        pairs = storeys - storey
        tops = [pitch * (k - (pairs - 1) / 2) for k in range(pairs)]
        for x in tops:
            world.add(card, x - out, base + up, -lean, material=paper)
            world.add(card, x + out, base + up, lean, material=paper)
        base += 2 * up
        for x in tops[1:]:
            world.add(roof, x - pitch / 2, base + thick / 2, material=paper)
        base += thick
    states, _ = watched(world)
    yield most("moved", moved(states), 0.02, "m")
    yield most("turned", np.degrees(np.abs(states[:, :, ANGLE] - states[0, :, ANGLE])).max(), 2.0, "degrees")
    yield most("speed in the last second", fastest(states[-SECOND:]), 1e-3, "m/s")


@case(
    "arch of 11 wedges, thickness 0.3 of its radius, friction 0.8: no wedge moves by more than 20 mm; at rest",
    quick=True,
)
def arch(bench: Bench) -> Iterator[Figure]:
    world = bench.world()
    stone = world.material(0.8)
    floor(world, material=stone)
    inner, outer, count = 3.4, 4.6, 11
    for k in range(count):
        a, b = math.pi * k / count, math.pi * (k + 1) / count
        corners = [(r * math.cos(t), r * math.sin(t)) for r, t in ((inner, a), (outer, a), (outer, b), (inner, b))]
        world.add(world.polygon(corners), 0.0, 0.0, material=stone)
    states, depth = watched(world)
    yield most("moved", moved(states), 0.02, "m")
    yield most("penetration", depth, 0.01, "m")
    yield most("speed in the last second", fastest(states[-SECOND:]), 1e-3, "m/s")


@case("20 dominoes: the first is pushed, each falls after the one before it, then all lie still", quick=True)
def dominoes(bench: Bench) -> Iterator[Figure]:
    world = bench.world()
    floor(world)
    domino, count = world.box(0.2, 1.0), 20
    bodies = [world.add(domino, 0.5 * k - 5.0, 0.5) for k in range(count)]
    world.step(120)
    stood = np.abs(world.states(bodies)[:, ANGLE]).max()
    world.set_velocity(bodies[0], 0.5, 0.0, -1.5)
    states = world.record(1200, 1, bodies)
    fallen = states[:, :, ANGLE] < -math.radians(30)
    when = np.where(fallen.any(axis=0), fallen.argmax(axis=0), 10**6)
    yield most("tilt before the push", math.degrees(stood), 0.1, "degrees")
    yield most("that do not fall", float((when == 10**6).sum()), 0)
    yield most("that fall before their neighbour", float((np.diff(when) <= 0).sum()), 0)
    yield most("speed in the last second", fastest(states[-60:]), 1e-3, "m/s")


BRIDGE = "bridge of 16 planks on springs under a crate of ten, air damping 1/s: hangs as statics say, at rest"


@case(BRIDGE, quick=True)
def bridge(bench: Bench) -> Iterator[Figure]:
    world = bench.world(springs=17)
    planks, stiffness = 16, 2e4
    post, plank = world.box(1.0, 4.0), world.box(0.5, 0.16)
    ends = [world.fixed(post, side * 5.35, 2.0) for side in (-1, 1)]
    bodies = [world.add(plank, 0.6 * (k - (planks - 1) / 2), 3.9, density=4.0) for k in range(planks)]
    chain = [ends[0], *bodies, ends[1]]
    for k in range(planks + 1):
        left = (0.5, 1.9) if k == 0 else (0.25, 0.0)
        right = (-0.5, 1.9) if k == planks else (-0.25, 0.0)
        world.spring(chain[k], chain[k + 1], stiffness, 40.0, 0.1, left, right, no_contact=True)
    crate = world.box(0.6, 0.6)
    load = world.add(crate, 0.0, 4.3, density=10 * world.mass(bodies[0]) / crate.area)
    # A chain's springs damp its length only: the air ends the swinging.
    for body in (*bodies, load):
        world.set_damping(body, 1.0, 1.0)
    states = world.record(MINUTE, EVERY)
    # The two ends carry all of the weight, by the springs' pulls there.
    weight = 10.0 * (planks * world.mass(bodies[0]) + world.mass(load))
    last = states[-10 * SECOND :]
    carried = sum(_upward_pull(last[:, k], side, stiffness) for k, side in ((0, -1), (planks - 1, 1)))
    yield most("ends' upward pull against the weight", abs(carried / weight - 1), 0.01, "%")
    yield most("load off the middle", abs(states[-1, -1, X]), 0.5, "m")
    yield most("speed in the last second", fastest(states[-SECOND:]), 0.01, "m/s")


def _upward_pull(plank: np.ndarray, side: int, stiffness: float) -> float:
    """Of the spring between a bridge's post and the plank beside it, the mean over these records."""
    c, s = np.cos(plank[:, ANGLE]), np.sin(plank[:, ANGLE])
    x, y = plank[:, X] + side * 0.25 * c - side * 4.85, plank[:, Y] + side * 0.25 * s - 3.9
    length = np.hypot(x, y)
    return float(np.mean(stiffness * (length - 0.1) * -y / length))


@case("box of {side} m on the floor: penetration at most 1 % of its size", quick=True,
      over={"side": [0.01, 0.05, 0.1, 1.0, 10.0, 50.0]},
      peers="1 cm: slides 30 %, box2d-lite 19, Chipmunk 28, Box2D 0.9")  # fmt: skip
def box(bench: Bench, side: float) -> Iterator[Figure]:
    world = bench.world()
    world.fixed(world.box(200.0, 10.0), 0.0, -5.0)
    stack(world, 1, side)
    states, depth = watched(world, 600)
    yield most("penetration over size", depth / side, 0.01, "%")
    yield most("moved over size", moved(states) / side, 0.02, "%")
    yield most("speed in the last second", fastest(states[-SECOND:]), 1e-4, "m/s")


@case("five boxes of {side} m stand, n = {n}", over={"side": [0.05], "n": [4]}, name="five", quick=True)
@case("five boxes of {side} m stand, n = {n}", over={"side": [0.01], "n": [8]}, name="five", quick=True)
def five(bench: Bench, side: float, n: int) -> Iterator[Figure]:
    world = bench.world(substeps=n)
    floor(world)
    stack(world, 5, side)
    states, depth = watched(world)
    yield most("moved over size", moved(states) / side, 0.25, "%")
    yield most("penetration over size", depth / side, 0.05, "%")
    yield most("speed in the last second", fastest(states[-SECOND:]), 1e-3, "m/s")
