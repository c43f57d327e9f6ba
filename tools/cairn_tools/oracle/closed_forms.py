"""Scenes whose motion a formula gives: free flight, one spring, a disc or block on a face, two discs that meet.

find(scene) looks at the scene itself. All but the spring is made of pieces of constant acceleration.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from .. import geometry
from ..scene import Scene
from ..trajectory import Trajectory
from .model import (
    OMEGA,
    VX,
    VY,
    Array,
    Bodies,
    Contact,
    X,
    Y,
    anchors_of,
    bodies_of,
    contact_of,
    hooke,
    pairs_that_meet,
)

TOUCHING = 2e-6  # m: what a scene file's digits leave between bodies that are meant to touch
STILL = 1e-12  # m/s
MOST_PIECES = 2000


@dataclass(frozen=True)
class Piece:
    """From a time on: a state and a constant acceleration (x, y, angle)."""

    start: float
    state: Array
    acceleration: Array

    def at(self, time: float) -> Array:
        t = time - self.start
        move = self.state[3:] * t + self.acceleration * (t * t / 2)
        return np.concatenate([self.state[:3] + move, self.state[3:] + self.acceleration * t])


@dataclass(frozen=True)
class ClosedForm:
    """`states(t)` of all bodies' centres of mass; it holds until `horizon`, in seconds."""

    name: str
    horizon: float
    bodies: Bodies
    states: Callable[[float], Array]

    def trajectory(self, scene: Scene, steps: int, every: int = 1) -> Trajectory:
        """The trajectory at the engine's steps, as `oracle.run` gives it."""
        numbers = np.arange(0, steps + 1, every)
        states = np.array([self.states(n / scene.steps_per_second) for n in numbers])
        return Trajectory(numbers.astype(np.int64), self.bodies.placed(states))


def find(scene: Scene) -> ClosedForm | None:
    """The scene's closed form, if it is one of those known here."""
    bodies = bodies_of(scene)
    meeting = pairs_that_meet(scene)
    moving = [i for i in range(len(scene.bodies)) if bodies.inverse_mass[i] > 0 or bodies.inverse_inertia[i] > 0]
    if any(bodies.inverse_mass[i] == 0 for i in moving):
        return None
    if scene.springs:
        return None if meeting else _spring(scene, bodies, moving)
    if not meeting:
        return _pieces("projectile", bodies, math.inf, {i: [_free(scene, bodies.states[i])] for i in moving})
    if len(meeting) > 1 or len(moving) > 2:
        return None
    if len(moving) == 2:
        return _two_discs(scene, bodies, *moving)
    still = next(i for i in meeting[0] if i not in moving)
    return _on_face(scene, bodies, moving[0], still)


def _pieces(name: str, bodies: Bodies, horizon: float, pieces: dict[int, list[Piece]]) -> ClosedForm:
    def states(time: float) -> Array:
        out = bodies.states.copy()
        for body, own in pieces.items():
            latest = [piece for piece in own if piece.start <= time]
            out[body] = (latest[-1] if latest else own[0]).at(time)
        return out

    return ClosedForm(name, horizon, bodies, states)


def _free(scene: Scene, state: Array, start: float = 0.0) -> Piece:
    return Piece(start, state, np.array([*scene.gravity, 0.0]))


# ---- one spring, along its line ----


def _spring(scene: Scene, bodies: Bodies, moving: list[int]) -> ClosedForm | None:
    """The damped oscillator, where nothing pulls the ends off the line between them."""
    if len(scene.springs) != 1:
        return None
    spring = scene.springs[0]
    a, b = spring.a, spring.b
    if any(np.abs(anchor).max() > 0 and bodies.inverse_inertia[body] > 0
           for anchor, body in zip(anchors_of(spring, bodies), (a, b), strict=True)):  # fmt: skip
        return None
    ends = [np.array(geometry.placed([tuple(anchor)], *bodies.states[body][:3])[0])
            for anchor, body in zip(anchors_of(spring, bodies), (a, b), strict=True)]  # fmt: skip
    inverse = bodies.inverse_mass[[a, b]]
    if inverse.sum() == 0:
        return _pieces("spring", bodies, math.inf, {i: [_free(scene, bodies.states[i])] for i in moving})
    line = ends[1] - ends[0]
    length = math.hypot(*line)
    if length == 0:
        return None
    line = line / length
    speed = bodies.states[b, VX : VY + 1] - bodies.states[a, VX : VY + 1]
    pull = np.array(scene.gravity) * (np.sign(inverse[1]) - np.sign(inverse[0]))
    across = np.array([-line[1], line[0]])
    if abs(across @ speed) > STILL or abs(across @ pull) > STILL:
        return None
    stiffness, damping = hooke(spring, bodies)
    swing = _oscillator(stiffness * inverse.sum(), damping * inverse.sum(), line @ pull,
                        length - spring.rest_length, line @ speed)  # fmt: skip
    slowest = 2 * math.pi / math.sqrt(stiffness * inverse.sum()) if stiffness else 1.0
    if min(swing(t)[0] for t in np.linspace(0, 20 * slowest, 4001)) + spring.rest_length <= 0:
        return None  # the anchors pass one another
    shares = inverse / inverse.sum()  # of the change of length that each end takes
    frees = {i: _free(scene, bodies.states[i]) for i in moving}

    def states(time: float) -> Array:
        out = bodies.states.copy()
        for i, free in frees.items():
            out[i] = free.at(time)
        stretch, rate = swing(time)
        # Beyond what the ends do without the spring.
        more = stretch + spring.rest_length - length - (line @ speed) * time - (line @ pull) * time**2 / 2
        faster = rate - line @ speed - (line @ pull) * time
        for sign, body, share in ((-1, a, shares[0]), (1, b, shares[1])):
            out[body, X : Y + 1] += sign * share * more * line
            out[body, VX : VY + 1] += sign * share * faster * line
        return out

    return ClosedForm("spring", math.inf, bodies, states)


def _oscillator(stiffness: float, damping: float, pull: float, x: float, v: float) -> Callable[[float], Array]:
    """Of x'' = -stiffness x - damping x' + pull: x and x' at a time."""

    def at(t: float) -> Array:
        if stiffness == 0:
            if damping == 0:
                return np.array([x + v * t + pull * t * t / 2, v + pull * t])
            end = pull / damping
            return np.array([x + end * t + (v - end) * -math.expm1(-damping * t) / damping,
                             end + (v - end) * math.exp(-damping * t)])  # fmt: skip
        rest, half = pull / stiffness, damping / 2
        root = stiffness - half * half
        first, slope = x - rest, v + half * (x - rest)
        if root > 0:
            w = math.sqrt(root)
            c, s = math.cos(w * t), math.sin(w * t) / w
        elif root < 0:
            w = math.sqrt(-root)
            c, s = math.cosh(w * t), math.sinh(w * t) / w
        else:
            c, s = 1.0, t
        fade = math.exp(-half * t)
        value = fade * (first * c + slope * s)
        return np.array([rest + value, -half * value + fade * (-root * first * s + slope * c)])

    return at


# ---- a disc or a block on the face of something that does not move ----


@dataclass(frozen=True)
class _Face:
    """Coordinates of a contact, along t and n from the face's start (t runs round its outline); mass is 1."""

    n: Array
    t: Array
    start: Array
    length: float
    contact: Contact
    pull: float  # of gravity along t
    press: float  # of gravity against n
    radius: float  # of the disc, or of the block's centre above the face
    k: float  # inertia over mass and radius squared; infinite for what cannot turn

    def height(self, state: Array) -> float:
        return float((state[X : Y + 1] - self.start) @ self.n) - self.radius

    def slip(self, state: Array) -> float:
        turning = 0.0 if math.isinf(self.k) else state[OMEGA] * self.radius
        return float(state[VX : VY + 1] @ self.t) - turning


def _on_face(scene: Scene, bodies: Bodies, body: int, still: int) -> ClosedForm | None:
    sides = int(bodies.corner_counts[still])
    if sides == 0:
        return None
    contact = contact_of(scene, scene.bodies[body], scene.bodies[still])
    x, y, angle = bodies.states[still, :3]
    outline = geometry.placed([tuple(p) for p in bodies.corners[still, :sides]], x, y, angle)
    inertia = bodies.inverse_mass[body] / bodies.inverse_inertia[body] if bodies.inverse_inertia[body] else math.inf
    for a, b in geometry.edges(outline):
        along = np.array(b) - np.array(a)
        length = math.hypot(*along)
        normal = np.array([along[1], -along[0]]) / length
        t = np.array([-normal[1], normal[0]])
        gravity = np.array(scene.gravity)
        radius, half = _stands(bodies, body, normal)
        face = _Face(normal, t, np.array(a), length, contact, float(gravity @ t), float(-gravity @ normal),
                     radius, inertia / radius**2 if radius else math.inf)  # fmt: skip
        if bodies.corner_counts[body] and half is not None:
            found = _block(scene, bodies, body, face, half)
        elif not bodies.corner_counts[body]:
            found = _disc(scene, bodies, body, face)
        else:
            found = None
        if found:
            return found
    return None


def _stands(bodies: Bodies, body: int, normal: Array) -> tuple[float, tuple[float, float] | None]:
    """How far the centre is over a face of that normal, and between where along it a block's own face reaches."""
    count = int(bodies.corner_counts[body])
    if count == 0:
        return float(bodies.radius[body]), None
    corners = geometry.placed([tuple(p) for p in bodies.corners[body, :count]], 0, 0, bodies.states[body, 2])
    down = np.array(corners) @ normal
    lowest = np.flatnonzero(down < down.min() + TOUCHING)
    along = np.array(corners)[lowest] @ np.array([-normal[1], normal[0]])
    return float(-down.min()), (float(along.min()), float(along.max())) if len(lowest) == 2 else None


def _lateral(face: _Face, state: Array) -> float:
    """From the face's start, along t."""
    return float((state[X : Y + 1] - face.start) @ face.t)


def _leaves(face: _Face, pieces: list[Piece], low: float, high: float) -> float:
    """When the place along the face first leaves [low, high]; infinity if it never does."""
    for piece, following in zip(pieces, [*pieces[1:], None], strict=True):
        end = following.start if following else math.inf
        place, speed = _lateral(face, piece.state), float(piece.state[VX : VY + 1] @ face.t)
        pull = float(piece.acceleration[:2] @ face.t)
        times = [piece.start + t for limit in (low, high) for t in _roots(pull / 2, speed, place - limit) if t > 0]
        if times and min(times) < end:
            return min(times)
    return math.inf


def _roots(a: float, b: float, c: float) -> list[float]:
    """Real roots of a t^2 + b t + c, in order, without cancellation."""
    if a == 0:
        return [-c / b] if b else []
    square = b * b - 4 * a * c
    if square < 0:
        return []
    q = -(b + math.copysign(math.sqrt(square), b)) / 2
    return sorted({q / a, c / q} if q else {0.0})


def _disc(scene: Scene, bodies: Bodies, body: int, face: _Face) -> ClosedForm | None:
    state = bodies.states[body]
    on_it = 0.0 <= _lateral(face, state) <= face.length
    if face.press <= 0 or not on_it or face.height(state) < -TOUCHING:
        return None
    pieces: list[Piece] = []
    name = "rolling" if face.height(state) <= TOUCHING else "bounce"
    time, horizon = 0.0, math.inf
    while len(pieces) < MOST_PIECES:
        falling = float(state[VX : VY + 1] @ face.n)
        if face.height(state) <= TOUCHING and abs(falling) <= STILL:
            pieces += _rest_of_way(face, state, time)
            break
        piece = _free(scene, state, time)
        pieces.append(piece)
        after = [t for t in _roots(-face.press / 2, falling, face.height(state)) if t > 0]
        time += after[-1]
        state = _struck(face, piece.at(time))
    else:
        horizon = time
    return _pieces(name, bodies, min(horizon, _leaves(face, pieces, 0.0, face.length)), {body: pieces})


def _struck(face: _Face, state: Array) -> Array:
    """After the impact of a disc on the face: Newton's law and Coulomb's, for a mass of 1."""
    speed = -float(state[VX : VY + 1] @ face.n)
    rebound = face.contact.restitution * speed if speed > face.contact.threshold else 0.0
    normal = speed + rebound
    slip = face.slip(state)
    stick = slip / (1 + 1 / face.k)
    most = face.contact.static_friction * normal
    rub = stick if abs(stick) <= most else math.copysign(face.contact.kinetic_friction * normal, stick)
    out = state.copy()
    out[X : Y + 1] -= face.height(state) * face.n
    along = float(state[VX : VY + 1] @ face.t) - rub
    out[VX : VY + 1] = rebound * face.n + along * face.t
    if not math.isinf(face.k):
        out[OMEGA] += rub / (face.k * face.radius)
    return out


def _rest_of_way(face: _Face, state: Array, time: float) -> list[Piece]:
    """Sliding, then rolling (or, what does not turn, standing): pieces from a time on."""
    pieces = []
    for _ in range(3):
        slip = face.slip(state)
        # What friction has to give so that the slip stays zero.
        hold = face.pull / (1 + 1 / face.k)
        if abs(slip) <= STILL:
            if abs(hold) <= face.contact.static_friction * face.press:
                return [*pieces, _under(face, state, time, hold)]
            rub = math.copysign(face.contact.kinetic_friction * face.press, hold)
        else:
            rub = math.copysign(face.contact.kinetic_friction * face.press, slip)
        piece = _under(face, state, time, rub)
        pieces.append(piece)
        change = face.pull - rub * (1 + 1 / face.k)
        if slip * change >= 0:
            return pieces
        time += -slip / change
        state = piece.at(time)
        if math.isinf(face.k):
            state[VX : VY + 1] = 0.0
        else:
            state[OMEGA] = float(state[VX : VY + 1] @ face.t) / face.radius
    return pieces


def _under(face: _Face, state: Array, time: float, rub: float) -> Piece:
    """The piece in which friction takes `rub` off the pull along t."""
    turn = 0.0 if math.isinf(face.k) else rub / (face.k * face.radius)
    return Piece(time, state, np.array([*((face.pull - rub) * face.t), turn]))


def _block(scene: Scene, bodies: Bodies, body: int, face: _Face, half: tuple[float, float]) -> ClosedForm | None:
    """A block flat on the face, which must not tip over: where the face bears it has to lie below it."""
    state = bodies.states[body]
    lies = abs(face.height(state)) <= TOUCHING and abs(state[VX : VY + 1] @ face.n) <= STILL
    if face.press <= 0 or not lies or state[OMEGA] != 0:
        return None
    flat = replace(face, k=math.inf)
    pieces = _rest_of_way(flat, state, 0.0)
    if bodies.inverse_inertia[body] > 0:
        for piece in pieces:
            rub = face.pull - float(piece.acceleration[:2] @ face.t)
            if not half[0] <= -rub / face.press * face.radius <= half[1]:
                return None
    horizon = _leaves(face, pieces, -half[0], face.length - half[1])
    return _pieces("sliding", bodies, horizon, {body: pieces})


# ---- two discs in free flight ----


def _two_discs(scene: Scene, bodies: Bodies, a: int, b: int) -> ClosedForm | None:
    if bodies.corner_counts[a] or bodies.corner_counts[b]:
        return None
    one, other = bodies.states[a], bodies.states[b]
    way, speed = other[X : Y + 1] - one[X : Y + 1], other[VX : VY + 1] - one[VX : VY + 1]
    reach = bodies.radius[a] + bodies.radius[b]
    if math.hypot(*way) < reach - TOUCHING:
        return None
    pieces = {i: [_free(scene, bodies.states[i])] for i in (a, b)}
    times = _roots(float(speed @ speed), 2 * float(way @ speed), float(way @ way) - reach * reach)
    if times and way @ speed < 0:
        time = max(times[0], 0.0)
        before = [pieces[i][0].at(time) for i in (a, b)]
        contact = contact_of(scene, scene.bodies[a], scene.bodies[b])
        for i, after in zip((a, b), _collided(bodies, contact, a, b, *before), strict=True):
            pieces[i].append(_free(scene, after, time))
    return _pieces("impact", bodies, math.inf, pieces)


def _collided(bodies: Bodies, contact: Contact, a: int, b: int, one: Array, other: Array) -> tuple[Array, Array]:
    way = other[X : Y + 1] - one[X : Y + 1]
    n = way / math.hypot(*way)
    t = np.array([-n[1], n[0]])
    inverse = bodies.inverse_mass[a] + bodies.inverse_mass[b]
    lever = np.array([bodies.radius[a], bodies.radius[b]])
    turn = bodies.inverse_inertia[[a, b]]
    speed = other[VX : VY + 1] - one[VX : VY + 1]
    approach = -float(speed @ n)
    rebound = contact.restitution if approach > contact.threshold else 0.0
    normal = (1 + rebound) * approach / inverse
    # Surfaces at the contact: one's is at +radius n from its centre, the other's at -radius n.
    slip = float(speed @ t) - other[OMEGA] * lever[1] - one[OMEGA] * lever[0]
    stick = -slip / (inverse + float((lever * lever * turn).sum()))
    most = contact.static_friction * normal
    rub = stick if abs(stick) <= most else math.copysign(contact.kinetic_friction * normal, stick)
    push = normal * n + rub * t
    first, second = one.copy(), other.copy()
    first[VX : VY + 1] -= push * bodies.inverse_mass[a]
    second[VX : VY + 1] += push * bodies.inverse_mass[b]
    first[OMEGA] -= lever[0] * rub * turn[0]
    second[OMEGA] -= lever[1] * rub * turn[1]
    return first, second
