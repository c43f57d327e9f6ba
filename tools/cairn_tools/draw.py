"""Pictures of runs: one list of strokes in pixels, written either as SVG or by Pillow (PNG, GIF)."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageDraw

from . import geometry
from .geometry import Point
from .scene import Scene, Shape

WIDTH = 480
SMOOTHING = 3  # Pillow draws this many times larger, then scales down
FRAMES_PER_SECOND = 30

Colour = tuple[int, int, int]
BACKGROUND: Colour = (251, 250, 246)
STATIC_FILL: Colour = (214, 212, 205)
STATIC_LINE: Colour = (92, 90, 84)
HATCH_LINE: Colour = (182, 179, 170)
SPRING_LINE: Colour = (150, 84, 60)
CONTACT_LINE: Colour = (204, 30, 50)
# Fill and line of dynamic bodies, taken in turn so that neighbours differ.
BODY_COLOURS: list[tuple[Colour, Colour]] = [
    ((166, 202, 228), (38, 88, 130)),
    ((250, 207, 148), (150, 88, 14)),
    ((177, 217, 166), (48, 108, 44)),
    ((239, 179, 174), (148, 48, 46)),
    ((205, 190, 227), (90, 62, 138)),
]


@dataclass(frozen=True)
class Stroke:
    """A filled or open line (points), or a circle (one point and a radius). Pixels."""

    points: Sequence[Point]
    line: Colour
    width: float
    radius: float = 0.0
    fill: Colour | None = None
    closed: bool = False


@dataclass(frozen=True)
class View:
    """The part of the plane that is shown, and its size in pixels."""

    left: float
    top: float
    scale: float
    height: int

    def pixel(self, p: Point) -> Point:
        return ((p[0] - self.left) * self.scale, (self.top - p[1]) * self.scale)


def fit(scene: Scene, poses: NDArray[np.float64]) -> View:
    """The view that holds what moves during the run, and of the still bodies those near it."""
    reach = np.array([scene.shape_of(b).reach for b in scene.bodies])[None, :, None]
    low, high = poses[:, :, :2] - reach, poses[:, :, :2] + reach
    moving = np.array([not b.static for b in scene.bodies])
    if not moving.any():
        moving[:] = True
    x0, y0, x1, y1 = _bounds(low[:, moving], high[:, moving])
    margin = 0.06 * max(x1 - x0, y1 - y0)
    for i in np.flatnonzero(~moving):
        size = 2 * reach[0, i, 0]
        (sx0, sy0), (sx1, sy1) = low[0, i], high[0, i]
        near = sx0 < x1 + 2 * margin and sx1 > x0 - 2 * margin and sy0 < y1 + 2 * margin and sy1 > y0 - 2 * margin
        if near and size <= 1.2 * max(x1 - x0, y1 - y0):
            corners = _corners(scene.shape_of(scene.bodies[i]), poses[0, i])
            xs, ys = zip(*corners, strict=True)
            x0, x1 = min(x0, min(xs)), max(x1, max(xs))
            y0, y1 = min(y0, min(ys)), max(y1, max(ys))
    x0, x1, y0, y1 = x0 - margin, x1 + margin, y0 - margin, y1 + margin
    # Neither a strip nor a tower: between 0.45 and 1.5 times as high as wide.
    lacking_height = 0.45 * (x1 - x0) - (y1 - y0)
    lacking_width = (y1 - y0) / 1.5 - (x1 - x0)
    if lacking_height > 0:
        y0, y1 = y0 - lacking_height / 2, y1 + lacking_height / 2
    if lacking_width > 0:
        x0, x1 = x0 - lacking_width / 2, x1 + lacking_width / 2
    scale = WIDTH / (x1 - x0)
    return View(float(x0), float(y1), float(scale), round((y1 - y0) * scale))


def _bounds(low: NDArray[np.float64], high: NDArray[np.float64]) -> tuple[float, float, float, float]:
    """The box around all positions; without the farthest one in fifty where those would make all else tiny."""
    all_low, all_high = low.min(axis=(0, 1)), high.max(axis=(0, 1))
    most_low = np.minimum(np.quantile(low.reshape(-1, 2), 0.02, axis=0), low[0].min(axis=0))
    most_high = np.maximum(np.quantile(high.reshape(-1, 2), 0.98, axis=0), high[0].max(axis=0))
    flung = max(all_high - all_low) > 4 * max(most_high - most_low)
    (x0, y0), (x1, y1) = (most_low, most_high) if flung else (all_low, all_high)
    return float(x0), float(y0), float(x1), float(y1)


def svg(scene: Scene, poses: NDArray[np.float64], contacts: NDArray[np.float64] | None = None, ghosts: int = 3) -> str:
    """The last pose in full, over `ghosts` earlier ones drawn faintly, equally spaced from the start."""
    view = fit(scene, poses)
    strokes = _strokes(scene, view, poses, contacts, ghosts)
    lines = [
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{WIDTH}" height="{view.height}" '
        f'viewBox="0 0 {WIDTH} {view.height}" stroke-linejoin="round" stroke-linecap="round">',
        f"<title>{scene.name}</title>",
        f'<rect width="{WIDTH}" height="{view.height}" fill="{_hex(BACKGROUND)}"/>',
        *map(_svg_stroke, strokes),
        "</svg>",
    ]
    return "\n".join(lines) + "\n"


def png(
    file: Path,
    scene: Scene,
    poses: NDArray[np.float64],
    contacts: NDArray[np.float64] | None = None,
    ghosts: int = 3,
) -> None:
    """The same picture as svg(), as pixels."""
    view = fit(scene, poses)
    _image(view, _strokes(scene, view, poses, contacts, ghosts)).save(file, format="PNG", optimize=True)


def gif(file: Path, scene: Scene, poses: NDArray[np.float64], seconds_per_pose: float) -> None:
    """The run as a film in real time, FRAMES_PER_SECOND at most."""
    view = fit(scene, poses)
    stride = max(1, round(1 / (FRAMES_PER_SECOND * seconds_per_pose)))
    frames = [_image(view, _strokes(scene, view, poses[k : k + 1], None, 0)) for k in range(0, len(poses), stride)]
    palette = frames[0].quantize(colors=64, dither=Image.Dither.NONE)
    small = [frame.quantize(palette=palette, dither=Image.Dither.NONE) for frame in frames]
    # A GIF counts in hundredths of a second.
    duration = max(2, round(100 * stride * seconds_per_pose)) * 10
    small[0].save(file, format="GIF", save_all=True, append_images=small[1:], duration=duration, loop=0)


def _strokes(
    scene: Scene,
    view: View,
    poses: NDArray[np.float64],
    contacts: NDArray[np.float64] | None,
    ghosts: int,
) -> list[Stroke]:
    out: list[Stroke] = []
    last = len(poses) - 1
    for i, body in enumerate(scene.bodies):
        if body.static:
            out += _static_body(scene.shape_of(body), poses[last, i], view)
    earlier = [round(last * k / ghosts) for k in range(ghosts)] if last else []
    for k in earlier:
        for i, body in enumerate(scene.bodies):
            # A body that has not moved since would only thicken its own outline.
            if not body.static and math.dist(poses[k, i, :2], poses[last, i, :2]) * view.scale > 2:
                out += _moving_body(scene.shape_of(body), poses[k, i], i, view, 0.25)
    out += _springs(scene, view, poses[last])
    for i, body in enumerate(scene.bodies):
        if not body.static:
            out += _moving_body(scene.shape_of(body), poses[last, i], i, view, 1.0)
    for x, y, nx, ny in contacts if contacts is not None else ():
        centre = view.pixel((x, y))
        tip = (centre[0] + 9 * nx, centre[1] - 9 * ny)
        out.append(Stroke([centre, tip], CONTACT_LINE, 1.2))
        out.append(Stroke([centre], CONTACT_LINE, 1.0, radius=2.0, fill=CONTACT_LINE))
    return out


def _corners(shape: Shape, pose: NDArray[np.float64]) -> list[Point]:
    """Outline of a shape in space; a circle as a 32-gon."""
    local = list(shape.corners) or geometry.regular(32, shape.radius)
    return geometry.placed(local, *map(float, pose))


def _moving_body(shape: Shape, pose: NDArray[np.float64], index: int, view: View, strength: float) -> list[Stroke]:
    fill, line = (_faded(colour, strength) for colour in BODY_COLOURS[index % len(BODY_COLOURS)])
    x, y, angle = map(float, pose)
    x, y = geometry.placed([shape.centre], x, y, angle)[0]
    centre = view.pixel((x, y))
    if shape.corners:
        outline = [view.pixel(p) for p in _corners(shape, pose)]
        mark = 0.8 * geometry.inside_by(list(shape.corners), shape.centre)
        body = Stroke(outline, line, 1.4, fill=fill, closed=True)
    else:
        mark = shape.radius
        body = Stroke([centre], line, 1.4, radius=shape.radius * view.scale, fill=fill)
    tip = view.pixel((x + mark * math.cos(angle), y + mark * math.sin(angle)))
    return [body, Stroke([centre, tip], line, 1.2)]


def _static_body(shape: Shape, pose: NDArray[np.float64], view: View) -> list[Stroke]:
    """Grey with slanted hatching."""
    outline = [view.pixel(p) for p in _corners(shape, pose)]
    hatching = [Stroke(line, HATCH_LINE, 1.0) for line in _hatches(outline, 8.0, view)]
    fill = Stroke(outline, STATIC_FILL, 1.0, fill=STATIC_FILL, closed=True)
    return [fill, *hatching, Stroke(outline, STATIC_LINE, 1.4, closed=True)]


def _hatches(outline: list[Point], spacing: float, view: View) -> list[tuple[Point, Point]]:
    """The parts of the lines x + y = k * spacing (pixels) inside a convex outline and within the picture."""
    sums = [x + y for x, y in outline]
    first = math.ceil(max(min(sums), 0) / spacing)
    end = math.floor(min(max(sums), WIDTH + view.height) / spacing) + 1
    lines = []
    for k in range(first, end):
        level = k * spacing
        cuts: list[Point] = []
        for a, b in geometry.edges(outline):
            da, db = a[0] + a[1] - level, b[0] + b[1] - level
            if (da < 0) != (db < 0):
                t = da / (da - db)
                cuts.append((a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])))
        if len(cuts) == 2:
            lines.append((cuts[0], cuts[1]))
    return lines


def _springs(scene: Scene, view: View, poses: NDArray[np.float64]) -> list[Stroke]:
    out = []
    for spring in scene.springs:
        a = geometry.placed([spring.anchor_a], *map(float, poses[spring.a]))[0]
        b = geometry.placed([spring.anchor_b], *map(float, poses[spring.b]))[0]
        out.append(Stroke([view.pixel(a), view.pixel(b)], SPRING_LINE, 1.5))
    return out


def _faded(colour: Colour, strength: float) -> Colour:
    r, g, b = (round(w + (c - w) * strength) for c, w in zip(colour, BACKGROUND, strict=True))
    return (r, g, b)


def _hex(colour: Colour | None) -> str:
    return "none" if colour is None else "#{:02x}{:02x}{:02x}".format(*colour)


def _svg_stroke(stroke: Stroke) -> str:
    look = f'fill="{_hex(stroke.fill)}" stroke="{_hex(stroke.line)}" stroke-width="{stroke.width:g}"'
    if stroke.radius:
        x, y = stroke.points[0]
        return f'<circle cx="{x:.1f}" cy="{y:.1f}" r="{stroke.radius:.1f}" {look}/>'
    tag = "polygon" if stroke.closed else "polyline"
    points = " ".join(f"{x:.1f},{y:.1f}" for x, y in stroke.points)
    return f'<{tag} points="{points}" {look}/>'


def _image(view: View, strokes: list[Stroke]) -> Image.Image:
    big = Image.new("RGB", (WIDTH * SMOOTHING, view.height * SMOOTHING), BACKGROUND)
    pen = ImageDraw.Draw(big)
    for stroke in strokes:
        points = [(x * SMOOTHING, y * SMOOTHING) for x, y in stroke.points]
        width = max(1, round(stroke.width * SMOOTHING))
        if stroke.radius:
            x, y = points[0]
            r = stroke.radius * SMOOTHING
            pen.ellipse((x - r, y - r, x + r, y + r), fill=stroke.fill, outline=stroke.line, width=width)
            continue
        if stroke.fill:
            pen.polygon(points, fill=stroke.fill)
        if stroke.closed:
            points = [*points, points[0], points[1]]
        pen.line(points, fill=stroke.line, width=width, joint="curve")
    return big.resize((WIDTH, view.height), Image.Resampling.LANCZOS)
