"""Pictures of runs."""

import math
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest
from cairn_tools import draw, scene
from PIL import Image

SVG = "{http://www.w3.org/2000/svg}"


def start(name: str, poses: int = 1) -> tuple[scene.Scene, np.ndarray]:
    loaded = scene.load(scene.find(name))
    return loaded, np.array([[(*b.position, b.angle) for b in loaded.bodies]] * poses)


def test_every_body_and_spring_is_drawn() -> None:
    loaded, poses = start("curtain_demo")
    root = ElementTree.fromstring(draw.svg(loaded, poses))
    moving = sum(not b.static for b in loaded.bodies)
    assert len(root.findall(f"{SVG}circle")) == moving
    springs = [e for e in root.findall(f"{SVG}polyline") if e.get("stroke") == "#96543c"]
    assert len(springs) == len(loaded.springs)


def test_a_body_is_drawn_to_scale_at_its_place() -> None:
    loaded, poses = start("projectile")
    view = draw.fit(loaded, poses)
    (circle,) = ElementTree.fromstring(draw.svg(loaded, poses)).findall(f"{SVG}circle")
    assert float(circle.get("r", "")) == pytest.approx(0.25 * view.scale, abs=0.1)
    assert float(circle.get("cx", "")) == pytest.approx(draw.WIDTH / 2, abs=0.1)


def test_the_view_holds_all_that_moves() -> None:
    loaded, poses = start("projectile", 2)
    poses[1, 0, :2] = (20, 7)
    view = draw.fit(loaded, np.repeat(poses, 50, axis=0))
    for pose in poses[:, 0]:
        x, y = view.pixel((pose[0], pose[1]))
        assert 0 < x < draw.WIDTH and 0 < y < view.height


def test_earlier_poses_are_drawn_faintly_only_of_what_moved() -> None:
    loaded, poses = start("boxes3", 10)
    poses[:, 1, 0] += np.linspace(0, 3, 10)
    still = len(ElementTree.fromstring(draw.svg(loaded, poses, ghosts=0)).findall(f"{SVG}polygon"))
    ghosts = len(ElementTree.fromstring(draw.svg(loaded, poses, ghosts=3)).findall(f"{SVG}polygon"))
    # The first of the three earlier poses is the start itself.
    assert ghosts == still + 3


def test_contacts_are_marked() -> None:
    loaded, poses = start("boxes3")
    root = ElementTree.fromstring(draw.svg(loaded, poses, contacts=np.array([[0.0, 1.0, 0.0, 1.0]])))
    assert len(root.findall(f"{SVG}circle")) == 1


def test_png_and_gif_are_as_wide_as_said(tmp_path: Path) -> None:
    loaded, poses = start("boxes3", 60)
    poses[:, 3, 2] = np.linspace(0, math.pi, 60)
    draw.png(tmp_path / "still.png", loaded, poses)
    draw.gif(tmp_path / "film.gif", loaded, poses, 1 / 60)
    with Image.open(tmp_path / "still.png") as still, Image.open(tmp_path / "film.gif") as film:
        assert still.size[0] == film.size[0] == draw.WIDTH
        assert film.n_frames == 30
