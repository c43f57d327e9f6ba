"""Scene files: what the reader accepts, and that it names the field of what it refuses."""

import json
import math
import re
from copy import deepcopy
from itertools import combinations
from pathlib import Path
from typing import Any

import pytest
from cairn_tools import geometry, scene, trim_recording
from cairn_tools.errors import UserError
from cairn_tools.geometry import Point

GOOD: dict[str, Any] = {
    "cairn_scene": 1,
    "name": "good",
    "gravity": [0, -10],
    "steps_per_second": 60,
    "substeps": 4,
    "solver": "slides",
    "passes": 12,
    "broad_phase": "quadtree",
    "sleep": False,
    "materials": {
        "default": {"static_friction": 0.5, "kinetic_friction": 0.4, "restitution": 0, "restitution_threshold": 0.5}
    },
    "shapes": {
        "ball": {"circle": 0.5},
        "crumb": {"circle": 0.01},
        "crate": {"box": [1, 2]},
        "hexagon": {"regular": {"sides": 6, "radius": 1}},
        "wedge": {"polygon": [[0, 0], [0, 1], [1, 0]]},
    },
    "bodies": [
        {"shape": "crate", "position": [0, 0], "type": "static"},
        {
            "name": "one",
            "shape": "ball",
            "position": [0, 5],
            "angle": 0.1,
            "velocity": [1, 2],
            "angular_velocity": 3,
            "density": 2,
            "sensor": True,
            "fixed_rotation": True,
            "fixed_position": True,
            "layer": 2,
            "mask": 3,
            "material": "ice",
        },
        {"shape": "wedge", "position": [3, 4]},
    ],
    "springs": [
        {"a": 0, "b": 1, "stiffness": 10, "damping": 1, "rest_length": 2, "collide": False},
        {"a": 1, "b": 2, "frequency": 2, "damping_ratio": 0.1, "anchor_a": [0, 0.5], "anchor_b": [0.1, 0]},
    ],
}


def read(data: Any) -> scene.Scene:
    return scene.parse(json.dumps(data), Path("good.json"))


def changed(path: str, value: Any) -> dict[str, Any]:
    """The good scene with one field set; a value of ... removes the field."""
    data = deepcopy(GOOD)
    *parents, last = [int(part) if part.isdigit() else part for part in path.split("/")]
    place = data
    for part in parents:
        place = place[part]
    if value is ...:
        del place[last]
    else:
        place[last] = value
    return data


def test_every_field_is_read() -> None:
    got = read(GOOD)
    one = got.bodies[1]
    assert (got.solver, got.passes, got.broad_phase, got.sleep) == ("slides", 12, "quadtree", False)
    assert got.material("default").restitution_threshold == 0.5
    assert (one.name, one.angle, one.velocity, one.angular_velocity) == ("one", 0.1, (1, 2), 3)
    assert (one.density, one.sensor, one.fixed_rotation, one.fixed_position) == (2, True, True, True)
    assert (one.layer, one.mask, one.material) == (2, 3, "ice")
    assert got.springs[0].stiffness == 10 and not got.springs[0].collide
    assert got.springs[1].frequency == 2 and got.springs[1].anchor_b == (0.1, 0)


def test_what_is_left_out_has_its_default() -> None:
    got = read(
        {"cairn_scene": 1, "name": "s", "shapes": {"b": {"circle": 1}}, "bodies": [{"shape": "b", "position": [0, 0]}]}
    )
    assert (got.gravity, got.steps_per_second, got.substeps) == ((0, -10), 60, 4)
    assert (got.solver, got.passes, got.broad_phase, got.sleep) == ("soft", 10, "pairs", False)
    body = got.bodies[0]
    assert (body.type, body.density, body.layer, body.mask) == ("dynamic", 1, 1, scene.ALL_LAYERS)
    assert got.material(body.material) == scene.Material(0.5, 0.4, 0, 1)


def test_rest_length_defaults_to_the_distance_of_the_anchors() -> None:
    data = changed("springs/0/rest_length", ...)
    data["springs"][0]["anchor_a"] = [0, 1]
    assert read(data).springs[0].rest_length == pytest.approx(4)


def test_a_clockwise_polygon_is_turned_round_in_place() -> None:
    wedge = read(GOOD).shapes["wedge"]
    assert wedge.area == pytest.approx(0.5)
    assert wedge.centre == pytest.approx((1 / 3, 1 / 3))
    assert set(wedge.corners) == {(0, 0), (1, 0), (0, 1)}


# Field of the good scene, its bad value, the field that is to be named, and what is to be said of it.
BAD_FIELDS: list[tuple[str, Any, str, str]] = [
    ("cairn_scene", 2, "cairn_scene", "must be 1"),
    ("name", ..., "name", "missing"),
    ("name", "a b", "name", "letters"),
    ("bodies", [], "bodies", "at least 1"),
    ("bodies", ..., "bodies", "missing"),
    ("colour", 3, "colour", "unknown field"),
    ("gravity", [0], "gravity", "at least 2"),
    ("gravity", [0, "x"], "gravity[1]", "must be a number"),
    ("gravity", [0, math.nan], "gravity[1]", "finite"),
    ("gravity", [0, math.inf], "gravity[1]", "finite"),
    ("gravity", [0, 1e6], "gravity[1]", "at most 2000"),
    ("steps_per_second", 0, "steps_per_second", "at least 10"),
    ("steps_per_second", 59.5, "steps_per_second", "whole number"),
    ("substeps", 0, "substeps", "at least 1"),
    ("substeps", 17, "substeps", "at most 16"),
    ("substeps", True, "substeps", "whole number"),
    ("solver", "magic", "solver", "must be one of"),
    ("passes", 0, "passes", "at least 1"),
    ("broad_phase", "grid", "broad_phase", "must be one of"),
    ("sleep", 1, "sleep", "true or false"),
    ("materials/default/restitution", 1.1, "materials.default.restitution", "at most 1"),
    ("materials/default/static_friction", -0.1, "materials.default.static_friction", "at least 0"),
    ("materials/default/kinetic_friction", 9, "materials.default.kinetic_friction", "at most 8"),
    ("materials/default/kinetic_friction", ..., "materials.default.kinetic_friction", "missing"),
    ("materials/default/bounce", 1, "materials.default.bounce", "unknown field"),
    ("shapes/ball/circle", 0, "shapes.ball.circle", "at least 0.001"),
    ("shapes/ball/circle", 126, "shapes.ball.circle", "at most 125"),
    ("shapes/crate/box", [200, 200], "shapes.crate.box", "reaches 141"),
    ("shapes/ball/circle", "big", "shapes.ball.circle", "must be a number"),
    ("shapes/ball", {}, "shapes.ball", "exactly one of"),
    ("shapes/ball/box", [1, 1], "shapes.ball", "exactly one of"),
    ("shapes/ball/capsule", 1, "shapes.ball.capsule", "unknown field"),
    ("shapes/crate/box", [1, -1], "shapes.crate.box[1]", "at least 0.001"),
    ("shapes/hexagon/regular/sides", 9, "shapes.hexagon.regular.sides", "at most 8"),
    ("shapes/hexagon/regular/sides", 2, "shapes.hexagon.regular.sides", "at least 3"),
    ("shapes/hexagon/regular/radius", ..., "shapes.hexagon.regular.radius", "missing"),
    ("shapes/wedge/polygon", [[0, 0], [1, 0]], "shapes.wedge.polygon", "at least 3"),
    ("shapes/wedge/polygon", [[k, k * k] for k in range(9)], "shapes.wedge.polygon", "at most 8"),
    ("shapes/wedge/polygon", [[0, 0], [1, 1], [2, 2]], "shapes.wedge.polygon", "degenerate"),
    ("shapes/wedge/polygon", [[0, 0], [4, 0], [2, 1], [2, 4]], "shapes.wedge.polygon[2]", "concave"),
    ("shapes/wedge/polygon", [[0, 0], [1, 1], [1, 0], [0, 1]], "shapes.wedge.polygon", "self-crossing"),
    ("shapes/wedge/polygon", [[0, 0], [1, 0], [2, 0], [0, 1]], "shapes.wedge.polygon[1]", "not a corner"),
    ("shapes/wedge/polygon", [[0, 0], [1, 0], [1, 0], [0, 1]], "shapes.wedge.polygon[2]", "same point"),
    ("bodies/0/shape", "egg", "bodies[0].shape", 'no shape named "egg"'),
    ("bodies/0/shape", ..., "bodies[0].shape", "missing"),
    ("bodies/0/position", ..., "bodies[0].position", "missing"),
    ("bodies/0/material", "butter", "bodies[0].material", 'no material named "butter"'),
    ("bodies/0/type", "kinematic", "bodies[0].type", "must be one of"),
    ("bodies/1/density", 0, "bodies[1].density", "at least 1e-06"),
    ("bodies/1/density", 1e-9, "bodies[1].density", "at least 1e-06"),
    ("bodies/1", {"shape": "crumb", "position": [0, 0], "density": 1e-6}, "bodies[1].density", "mass"),
    ("materials/default/kinetic_friction", 0.6, "materials.default.kinetic_friction", "at most static_friction"),
    ("bodies/1/layer", -1, "bodies[1].layer", "at least 0"),
    ("bodies/1/mask", 0.5, "bodies[1].mask", "whole number"),
    ("bodies/1/weight", 3, "bodies[1].weight", "unknown field"),
    ("bodies/1", 3, "bodies[1]", "must be an object"),
    ("springs/0/a", 3, "springs[0].a", "no body 3"),
    ("springs/0/b", -1, "springs[0].b", "at least 0"),
    ("springs/0/b", 0, "springs[0].b", "same body"),
    ("springs/0/b", 1.0, "springs[0].b", "whole number"),
    ("springs/0/stiffness", ..., "springs[0]", "either stiffness"),
    ("springs/0/frequency", 3, "springs[0]", "either stiffness"),
    ("springs/1/stiffness", 3, "springs[1]", "either stiffness"),
    ("springs/0/rest_length", -1, "springs[0].rest_length", "at least 0"),
]


@pytest.mark.parametrize(("path", "value", "where", "what"), BAD_FIELDS)
def test_a_bad_field_is_named(path: str, value: Any, where: str, what: str, tmp_path: Path) -> None:
    file = tmp_path / "bad.json"
    file.write_text(json.dumps(changed(path, value)))
    with pytest.raises(UserError) as caught:
        scene.load(file)
    line = str(caught.value)
    assert line.startswith(f"{file}: {where}: ")
    assert what in line
    assert "\n" not in line


@pytest.mark.parametrize(
    ("text", "what"),
    [
        ("", "line 1 column 1: not JSON"),
        ("{", "line 1 column 2: not JSON"),
        ("[]", "(file): must be an object"),
        ('{"name": 1, "name": 2}', "name: given twice"),
        ("[" * 100000, "nested too deeply"),
    ],
)
def test_a_text_that_is_no_scene_gives_one_line(text: str, what: str, tmp_path: Path) -> None:
    file = tmp_path / "bad.json"
    file.write_text(text)
    with pytest.raises(UserError, match=r"^[^\n]*$") as caught:
        scene.load(file)
    assert what in str(caught.value)


def test_a_missing_file_is_named() -> None:
    with pytest.raises(UserError, match="nowhere"):
        scene.find("nowhere")


def test_a_scene_is_found_by_name() -> None:
    assert scene.find("pyramid10") == scene.SCENES_DIR / "pyramid10.json"


SCENES = sorted(scene.SCENES_DIR.glob("*.json"))


@pytest.mark.parametrize("file", SCENES, ids=lambda file: file.stem)
def test_an_example_scene_is_named_as_its_file(file: Path) -> None:
    assert scene.load(file).name == file.stem


@pytest.mark.parametrize("file", SCENES, ids=lambda file: file.stem)
def test_no_example_scene_starts_in_overlap(file: Path) -> None:
    loaded = scene.load(file)
    for a, b in combinations(loaded.bodies, 2):
        if a.layer & b.mask and b.layer & a.mask and not (a.static and b.static):
            assert overlap(loaded, a, b) < 0.003, f"{a} and {b}"


def overlap(loaded: scene.Scene, a: scene.Body, b: scene.Body) -> float:
    """Least overlap of the two outlines over the normals of their sides and the line of their centres."""
    outlines = [outline(loaded.shape_of(body), body) for body in (a, b)]
    directions = [(q[1] - p[1], p[0] - q[0]) for points in outlines for p, q in geometry.edges(points)]
    directions.append((b.position[0] - a.position[0], b.position[1] - a.position[1]))
    least = math.inf
    for dx, dy in directions:
        length = math.hypot(dx, dy)
        if length == 0:
            continue
        spans = [[(x * dx + y * dy) / length for x, y in points] for points in outlines]
        least = min(least, min(max(s) for s in spans) - max(min(s) for s in spans))
    return least


def outline(shape: scene.Shape, body: scene.Body) -> list[Point]:
    local = list(shape.corners) or geometry.regular(64, shape.radius)
    return geometry.placed(local, *body.position, body.angle)


def test_the_scene_and_the_run_of_the_docs_are_right(tmp_path: Path) -> None:
    text = (Path(__file__).parents[2] / "docs" / "SCENES.md").read_text(encoding="utf-8")
    blocks = re.findall(r"```(?:json)?\n(\{\"?.*?)```", text, re.DOTALL)
    (tmp_path / "level1.json").write_text(blocks[0], encoding="utf-8")
    (tmp_path / "shots.jsonl").write_text(blocks[1], encoding="utf-8")
    assert len(scene.load(tmp_path / "level1.json").bodies) == 6
    assert trim_recording.load(tmp_path / "shots.jsonl", tmp_path).play.most == 7
