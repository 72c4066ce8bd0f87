"""Candidates drawn for the model: the true line is among them, and opens the way that things open."""

import numpy as np
import pytest
from simart_kit_plugins.marks.limits import usual_limits
from simart_kit_plugins.marks.lines import (
    contact_point,
    groups,
    same_line,
    shape_of,
    sliding_lines,
    turning_lines,
)

from simart_kit.mesh import Mesh
from simart_kit.testing.meshes import cabinet_asset


@pytest.fixture(scope="module")
def cabinet():
    return cabinet_asset()


def shape(asset, part):
    return shape_of(asset.mesh, asset.face_part == asset.part_index(part), asset.face_part == 0)


def distance(line, point):
    return float(np.linalg.norm(np.cross(np.subtract(point, line.origin), line.axis)))


def test_the_hinge_of_a_door_is_drawn_and_opens_outward(cabinet):
    # The door spans x -0.275..0.275 at the front, y -0.2..-0.18: hinged on its left it opens about -z.
    lines = turning_lines(shape(cabinet, "door"))
    upright = [line for line in lines if abs(line.axis[2]) > 0.999]
    left = min(upright, key=lambda line: distance(line, (-0.275, -0.19, 0)))
    right = min(upright, key=lambda line: distance(line, (0.275, -0.19, 0)))
    assert distance(left, (-0.275, -0.19, 0)) < 0.015
    assert left.axis[2] == pytest.approx(-1)
    assert distance(right, (0.275, -0.19, 0)) < 0.015
    assert right.axis[2] == pytest.approx(1)


def test_every_line_has_its_own_letter_and_is_drawn_once(cabinet):
    found = shape(cabinet, "door")
    lines = turning_lines(found)
    assert len({line.letter for line in lines}) == len(lines)
    assert sorted(i for group in groups(lines).values() for i in group) == list(range(len(lines)))
    pairs = [(a, b) for i, a in enumerate(lines) for b in lines[:i]]
    assert not any(same_line(a, b, found) for a, b in pairs)
    assert all(same_line(line, line, found) for line in lines)


def test_a_drawer_can_slide_both_ways_along_every_axis(cabinet):
    ways = [tuple(np.round(line.axis, 6)) for line in sliding_lines(shape(cabinet, "drawer"))]
    axes = np.eye(3)
    assert sorted(ways) == sorted(tuple(sign * axis) for axis in axes for sign in (1.0, -1.0))


def test_a_wheel_turns_about_its_middle():
    angles = np.linspace(0, 2 * np.pi, 24, endpoint=False)
    rim = np.stack([np.zeros(24), 0.1 * np.cos(angles), 0.1 + 0.1 * np.sin(angles)], axis=1)
    vertices = np.concatenate([rim, rim + [0.03, 0, 0], [[-1, -1, 0.5], [1, -1, 0.5], [0, 1, 0.5]]])
    around = np.arange(24)
    after = (around + 1) % 24
    sides = np.stack([around, after, around + 24], axis=1)
    mesh = Mesh(vertices, np.concatenate([sides, [[48, 49, 50]]]))
    wheel = np.arange(25) < 24
    lines = turning_lines(shape_of(mesh, wheel, ~wheel))
    spins = [line for line in lines if abs(line.axis[0]) > 0.999]
    assert min(distance(line, (0, 0, 0.1)) for line in spins) < 0.005


def test_what_touches_nothing_meets_at_its_own_middle(cabinet):
    found = shape_of(cabinet.mesh, cabinet.face_part == 2, np.zeros(len(cabinet.mesh.faces), bool))
    middle = np.mean([found.points.min(axis=0), found.points.max(axis=0)], axis=0)
    assert contact_point(found) == pytest.approx(middle)


@pytest.mark.parametrize(
    ("kind", "words", "length", "expected"),
    [
        ("revolute", "upper left door", 0.5, (0, np.deg2rad(110))),
        ("revolute", "thing", 0.5, (0, np.pi / 2)),
        ("prismatic", "drawer", 0.5, (0, 0.4)),  # 0.8 of its own depth
        ("prismatic", "panel", 0.01, (0, 0.3)),  # flat: half of the parent's 0.6
        ("prismatic", "red button", 0.01, (0, 0.008)),  # pressed in by its own height
    ],
)
def test_usual_limits(kind, words, length, expected):
    found = usual_limits(kind, words, length, 0.6, 1.0)
    assert (found.lower, found.upper) == pytest.approx(expected)


def test_kinds_without_limits_have_none():
    assert usual_limits("continuous", "wheel", 0.1, 0.6, 1.0) is None
    assert usual_limits("ball", "joint", 0.1, 0.6, 1.0) is None
