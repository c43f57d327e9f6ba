"""The smooth scenes: what they are made of, and the limits of a few scenes of each family."""

from __future__ import annotations

import dataclasses
import math

import numpy as np
import pytest
from cairn_tools.accuracy import smooth
from cairn_tools.accuracy.smooth_scenes import DEEP, FAMILIES, rounded, rounded_angle
from cairn_tools.oracle import closed_forms

FEW = 10


@pytest.fixture(scope="module")
def rows() -> list[smooth.Row]:
    return smooth.measure(lambda text: None, FEW)


def test_no_family_is_beyond_its_limits(rows):
    assert [row.family for row in rows] == [family.name for family in FAMILIES]
    assert [(row.family, row.rounding, row.share, row.worst) for row in rows if not row.passes] == []


def test_the_same_scenes_give_the_same_numbers(rows):
    assert smooth.measure(lambda text: None, FEW)[:2] == rows[:2]


def test_a_table_has_a_line_a_family(rows):
    (grid,) = smooth.tables(rows)
    assert grid.row_count == len(FAMILIES)


def test_too_much_rounding_does_not_pass(rows):
    row = rows[0]
    assert not dataclasses.replace(row, rounding=2 * row.limit).passes
    assert not dataclasses.replace(row, share=0.2).passes
    assert not dataclasses.replace(row, total=2 * row.total_limit).passes


def test_a_share_counts_only_where_the_total_is_not_small():
    assert smooth.Run("scene", 5e-5, 9e-5).share == 0
    assert smooth.Run("scene", 5e-5, math.nan).share == 0
    assert smooth.Run("scene", 5e-5, 1e-3).share == pytest.approx(0.05)


@pytest.mark.parametrize("number", range(len(FAMILIES)))
def test_scenes_are_of_numbers_that_the_engine_can_say(number):
    for k in range(5):
        scene, seconds = FAMILIES[number].scene(np.random.default_rng(k))
        assert 0.5 < seconds <= 10
        for body in scene.bodies:
            for value in (*body.position, *body.velocity, body.angular_velocity, body.density):
                assert value == rounded(value)
            assert body.angle == rounded_angle(body.angle)


@pytest.mark.parametrize("number", [k for k, family in enumerate(FAMILIES) if "slope" in family.name])
def test_what_starts_on_a_slope_lies_in_it_by_a_micrometre(number):
    for k in range(5):
        scene, _ = FAMILIES[number].scene(np.random.default_rng(k))
        slope, body = scene.bodies
        normal = np.array([-math.sin(slope.angle), math.cos(slope.angle)])
        shape = scene.shape_of(body)
        height = shape.radius or shape.corners[2][1]
        above = (np.array(body.position) - slope.position) @ normal - 1 - height
        assert DEEP[0] < -above < DEEP[1]
        assert closed_forms.find(scene) is not None
