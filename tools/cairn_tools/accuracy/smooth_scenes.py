"""Smooth scenes without number: each family's scenes differ in size, speed, slope, mass, material, place and angle.

What no format of the API can say would count as rounding, so all numbers are multiples of its last bit, 2^-16, and
angles of theirs, a turn / 2^32. A body on a slope starts at such a place 0.7 to 1.7 um deep in it: whether one that
only just touches does so in the first step, and with which of its corners, is decided by a last bit.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ..geometry import Point, box
from ..scene import Body, Material, Scene, Shape, Spring

RATE = 60
GRAVITY = 10.0
DEEP = (0.7e-6, 1.7e-6)  # m
Random = np.random.Generator


@dataclass(frozen=True)
class Family:
    name: str
    seconds: str
    limit: float  # m: of rounding
    scene: Callable[[Random], tuple[Scene, float]]  # and for how many seconds
    total_limit: float = math.inf  # m: of the error against the closed form


def rounded(x: float) -> float:
    """To the API's last bit."""
    return math.floor(x * 65536 + 0.5) / 65536


def rounded_angle(x: float) -> float:
    turn = 2 * math.pi
    return round(x / turn * 2**32) / 2**32 * turn


def uniform(random: Random, low: float, high: float) -> float:
    return rounded(random.uniform(low, high))


def either(random: Random, x: float) -> float:
    return x if random.random() < 0.5 else -x


def _box(width: float, height: float) -> Shape:
    return Shape("box", 0.0, tuple(box(width, height)))


def _circle(radius: float) -> Shape:
    return Shape("circle", radius)


def _scene(name: str, shapes: dict[str, Shape], bodies: list[Body], springs: list[Spring] | None = None,
           material: Material | None = None, gravity: float = GRAVITY) -> Scene:  # fmt: skip
    materials = {"default": material or Material(0.5, 0.4, 0.0)}
    return Scene(name, shapes, bodies, Path(f"{name}.json"), springs or [], materials, (0.0, -gravity), RATE)


def _pair(x: Point, digits: int) -> str:
    return f"({x[0]:.{digits}f}, {x[1]:.{digits}f})"


def projectile(random: Random) -> tuple[Scene, float]:
    size = uniform(random, 0.1, 2)
    shape = _circle(size) if random.random() < 0.5 else _box(size, rounded(0.7 * size))
    place = (either(random, rounded(10 ** random.uniform(0, 4))), either(random, rounded(10 ** random.uniform(0, 4))))
    velocity = (uniform(random, -20, 20), uniform(random, -5, 20))
    body = Body("body", place, angle=rounded_angle(random.uniform(-3, 3)), velocity=velocity,
                angular_velocity=uniform(random, -10, 10), density=uniform(random, 0.2, 8))  # fmt: skip
    text = f"{shape.kind} of {size:.2f} m at {_pair(velocity, 1)} m/s from {_pair(place, 0)}"
    return _scene(text, {"body": shape}, [body]), 1.0


def spring(random: Random) -> tuple[Scene, float]:
    """Hanging from something static, or between two discs in free space."""
    hangs = random.random() < 0.6
    radius, place = uniform(random, 0.05, 1), (uniform(random, -100, 100), uniform(random, -100, 100))
    density, length, stretch = uniform(random, 0.2, 8), uniform(random, 1, 3), uniform(random, -0.3, 0.5)
    over_mass, damping_ratio = 10 ** random.uniform(1, 3), float(random.choice([0.0, 0.02, 0.1]))
    mass = density * math.pi * radius**2
    stiffness, damping = rounded(over_mass * mass), rounded(2 * damping_ratio * math.sqrt(over_mass) * mass)
    joined = Spring(0, 1, length, stiffness=stiffness, damping=damping, collide=False)
    other = rounded(length + stretch)
    disc = Body("disc", (place[0], place[1] - other) if hangs else (place[0] + other, place[1]), density=density)
    first = Body("disc", place, type="static") if hangs else Body("disc", place, density=density)
    kind = "hanging" if hangs else "two discs"
    text = f"{kind}, k/m {over_mass:.0f}, damping ratio {damping_ratio:g}, {length:.2f} m, stretched by {stretch:.2f} m"
    return _scene(text, {"disc": _circle(radius)}, [first, disc], [joined], gravity=GRAVITY if hangs else 0.0), 10.0


def _on_floor(text: str, shape: Shape, height: float, random: Random, speed: float, spin: float, mu: float) -> Scene:
    level = rounded(float(random.choice([0.0, 50.0, -300.25])))
    floor = Body("floor", (0.0, level - 0.5), type="static")
    body = Body("body", (uniform(random, -20, 20), level + height), velocity=(speed, 0.0), angular_velocity=spin,
                density=uniform(random, 0.2, 8))  # fmt: skip
    return _scene(text, {"floor": _box(100.0, 1.0), "body": shape}, [floor, body], material=Material(mu, mu, 0.0))


def _on_slope(text: str, shape: Shape, height: float, random: Random, angle: float, mu: float) -> Scene:
    """The body where a place of the API lies in the slope by DEEP."""
    c, s = math.cos(angle), math.sin(angle)
    while True:
        slope = Body("slope", (uniform(random, -1, 1), uniform(random, -1, 1)), type="static", angle=angle)
        along = random.uniform(-1, 1)
        x, y = slope.position
        place = (rounded(x + along * c - (1 + height) * s), rounded(y + along * s + (1 + height) * c))
        deep = s * (place[0] - x) - c * (place[1] - y) + 1 + height
        if DEEP[0] < deep < DEEP[1]:
            break
    body = Body("body", place, angle=angle, density=uniform(random, 0.2, 8))
    return _scene(text, {"slope": _box(200.0, 2.0), "body": shape}, [slope, body], material=Material(mu, mu, 0.0))


def rolling(random: Random) -> tuple[Scene, float]:
    radius, speed = uniform(random, 0.05, 1), either(random, uniform(random, 0.3, 5))
    text = f"radius {radius:.3f} m at {speed:.2f} m/s"
    return _on_floor(text, _circle(radius), radius, random, speed, rounded(-speed / radius), rounded(0.8)), 2.0


def rolling_down(random: Random) -> tuple[Scene, float]:
    radius, angle = uniform(random, 0.05, 1), rounded_angle(either(random, math.radians(random.uniform(5, 40))))
    text = f"radius {radius:.3f} m, slope of {math.degrees(angle):.1f} degrees"
    return _on_slope(text, _circle(radius), radius, random, angle, rounded(0.8)), 2.0


def sliding(random: Random) -> tuple[Scene, float]:
    width = uniform(random, 0.1, 2)
    height = rounded(0.5 * width * random.uniform(0.3, 0.8))
    speed, mu = either(random, uniform(random, 0.5, 5)), uniform(random, 0.1, 0.6)
    text = f"{width:.2f} x {2 * height:.2f} m at {speed:.2f} m/s, friction {mu:.2f}"
    return _on_floor(text, _box(width, 2 * height), height, random, speed, 0.0, mu), 2.0


def sliding_down(random: Random) -> tuple[Scene, float]:
    width = uniform(random, 0.1, 2)
    height = rounded(0.5 * width * random.uniform(0.3, 0.9))
    angle = rounded_angle(either(random, math.radians(random.uniform(15, 40))))
    mu = rounded(abs(math.tan(angle)) * random.uniform(0.2, 0.9))
    text = f"{width:.2f} x {2 * height:.2f} m, slope of {math.degrees(angle):.1f} degrees, friction {mu:.2f}"
    return _on_slope(text, _box(width, 2 * height), height, random, angle, mu), 2.0


def bounce(random: Random) -> tuple[Scene, float]:
    """To the third apex: three falls and climbs, each e times as long as the one before."""
    e, height, radius = uniform(random, 0.5, 1), uniform(random, 0.5, 5), uniform(random, 0.05, 0.5)
    floor = Body("floor", (0.0, -0.5), type="static")
    ball = Body("ball", (uniform(random, -20, 20), height + radius), velocity=(uniform(random, -2, 2), 0.0))
    shapes = {"floor": _box(100.0, 1.0), "ball": _circle(radius)}
    text = f"radius {radius:.2f} m from {height:.2f} m, e = {e:.2f}"
    scene = _scene(text, shapes, [floor, ball], material=Material(0.0, 0.0, e, 0.0))
    return scene, math.sqrt(2 * height / GRAVITY) * (1 + 2 * e + 2 * e**2 + e**3)


def impact(random: Random) -> tuple[Scene, float]:
    """Two discs, or boxes, head on or not; the second after. They part: what stays together would hit again."""
    size = (uniform(random, 0.1, 1), uniform(random, 0.1, 1))
    speed, gap = (uniform(random, 0.5, 5), uniform(random, -5, -0.5)), uniform(random, 0.2, 1)
    e = uniform(random, 0.1, 1)
    discs = random.random() < 0.7
    aside = rounded(float(random.choice([0.0, 0.3])) * sum(size))
    shapes = {name: _circle(s) if discs else _box(2 * s, 2 * s) for name, s in zip("ab", size, strict=True)}
    places: tuple[Point, Point] = ((0.0, 0.0), (rounded(sum(size) + gap), aside))
    bodies = [Body(name, place, velocity=(v, 0.0), density=uniform(random, 0.2, 8))
              for name, place, v in zip("ab", places, speed, strict=True)]  # fmt: skip
    text = f"{'discs' if discs else 'boxes'} of {_pair(size, 2)} m at {_pair(speed, 1)} m/s, e = {e:.2f}"
    text += ", off the line" if aside else ""
    mu = float(random.choice([0.0, rounded(0.3)]))
    scene = _scene(text, shapes, bodies, material=Material(mu, mu, e, 0.0), gravity=0.0)
    return scene, 1.0 + gap / (speed[0] - speed[1])


FAMILIES = (
    Family("projectile", "1", 8e-6, projectile, 1e-4),
    Family("spring", "10", 2e-4, spring),
    Family("disc that rolls", "2", 6e-5, rolling),
    Family("disc down a slope", "2", 1e-4, rolling_down),
    Family("sliding block", "2", 1e-4, sliding),
    Family("block down a slope", "2", 1e-4, sliding_down),
    Family("ball to its third apex", "1 to 7", 1e-3, bounce),
    Family("impact of two bodies", "1 after", 1e-4, impact),
)
