"""Cutting shapes out of shapes: what is left, where it is, and that nothing overlaps."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from simart_kit.asset import Asset, Joint, Limits, Part
from simart_kit.carving import carved, carved_apart
from simart_kit.convex_overlap import Convex, gap
from simart_kit.fitting import aligned_box
from simart_kit.hulls import hull_of, volume
from simart_kit.mesh import Mesh
from simart_kit.primitive_meshes import primitive_shape
from simart_kit.primitives import Primitive
from simart_kit.separation import CLEARANCE, overlaps

CUBE = aligned_box(np.zeros(3), np.ones(3))


def box(lower, upper):
    return aligned_box(np.array(lower, dtype=float), np.array(upper, dtype=float))


def asset_of(**shapes):
    """Parts with given shapes; each after the first slides along z."""
    tetrahedron = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1.0]])
    faces = np.array([[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])
    names = list(shapes)
    mesh = Mesh(
        np.concatenate([tetrahedron] * len(names)),
        np.concatenate([faces + 4 * index for index in range(len(names))]),
    )
    joints = tuple(
        Joint(f"{name}_slide", "prismatic", names[0], name, limits=Limits(0, 1)) for name in names[1:]
    )
    parts = tuple(Part(name, collision=tuple(row)) for name, row in shapes.items())
    return Asset("thing", mesh, np.repeat(np.arange(len(names)), 4), parts, joints)


def test_a_corner_is_cut_out_in_boxes():
    pieces = carved(CUBE, box([0.5, 0.5, 0.5], [2, 2, 2]), clearance=0.0)
    assert sum(map(volume, pieces)) == pytest.approx(1 - 0.5**3)
    assert [piece.primitive.kind for piece in pieces] == ["box"] * 3


def test_a_hole_through_the_middle_leaves_four_sides():
    pieces = carved(CUBE, box([0.4, 0.4, -1], [0.6, 0.6, 2]), clearance=0.0)
    assert len(pieces) == 4
    assert sum(map(volume, pieces)) == pytest.approx(1 - 0.2**2)


def test_one_cut_is_made_where_it_leaves_as_much_as_many():
    (piece,) = carved(CUBE, box([0.9, -1, -1], [2, 2, 2]), clearance=0.0)
    assert volume(piece) == pytest.approx(0.9)


def test_a_clearance_is_left():
    (piece,) = carved(CUBE, box([0.9, -1, -1], [2, 2, 2]), clearance=0.05)
    assert piece.vertices[:, 0].max() == pytest.approx(0.85)


def test_what_lies_inside_is_gone_and_what_lies_beside_stays_whole():
    assert carved(CUBE, box([-1, -1, -1], [2, 2, 2])) == ()
    (whole,) = carved(CUBE, box([2, 0, 0], [3, 1, 1]))
    assert volume(whole) == pytest.approx(1)


def test_a_cylinder_is_cut_out_as_its_box():
    pole = primitive_shape(Primitive("cylinder", (0.2, 0.2, 4.0), _at([0.5, 0.5, 0.5])))
    pieces = carved(CUBE, pole, clearance=0.0)
    assert sum(map(volume, pieces)) == pytest.approx(1 - 0.2**2, abs=1e-3)


@settings(max_examples=40, deadline=None)
@given(st.integers(0, 10**6))
def test_pieces_of_any_hull_lie_in_it_clear_of_the_other_and_of_each_other(seed):
    rng = np.random.default_rng(seed)
    one, other = hull_of(rng.random((12, 3))), hull_of(0.3 + rng.random((6, 3)))
    pieces = carved(one, other, clearance=0.001)
    planes = [Convex(one), Convex(other)]
    for number, piece in enumerate(pieces):
        assert gap(Convex(piece), planes[1])[0] > -1e-7
        assert volume(hull_of(np.concatenate([one.vertices, piece.vertices]))) < volume(one) + 1e-6
        for later in pieces[number + 1 :]:
            assert gap(Convex(piece), Convex(later))[0] > -1e-7


class TestParts:
    def test_parts_that_overlap_do_so_no_more(self):
        asset = asset_of(body=[CUBE], drawer=[box([0.1, -0.1, 0.1], [0.9, 0.8, 0.5])])
        assert overlaps(asset)
        done = carved_apart(asset)
        assert overlaps(done) == ()
        # The drawer would lose nearly all, so the body gives way.
        assert done.part("drawer").collision == asset.part("drawer").collision

    def test_the_part_gives_way_that_loses_the_smaller_share(self):
        asset = asset_of(body=[box([0, 0, 0], [0.1, 0.1, 0.1])], door=[box([0.05, 0, 0], [3, 1, 1])])
        done = carved_apart(asset)
        assert done.part("body").collision == asset.part("body").collision
        lost = 0.0505 * 0.1005 * 0.1005  # with the clearance on three sides
        assert volume_of(done.part("door")) >= 2.95 - lost - 0.06

    def test_a_wheel_stays_round_where_the_fork_can_give_way(self):
        fork = [box([0.4, 0.4, 0.96], [0.6, 0.6, 1.5])]
        asset = asset_of(body=[box([5, 0, 0], [6, 1, 1])], wheel=[CUBE], fork=fork)
        turning = [replace(j, kind="continuous", limits=None) for j in asset.joints if j.child == "wheel"]
        rolling = replace(asset, joints=(*turning, *(j for j in asset.joints if j.child == "fork")))
        assert carved_apart(asset).part("fork").collision == asset.part("fork").collision
        done = carved_apart(rolling)
        assert done.part("wheel").collision == asset.part("wheel").collision
        assert overlaps(done) == ()

    def test_no_part_gives_way_that_would_lose_its_extent(self):
        # The pivot is a smaller share of its part than what it takes of the blade, which gives way even so.
        handle, pivot = box([0, 0, 0], [1, 1, 1]), box([1.9, 0.4, 0], [2, 0.5, 0.1])
        asset = asset_of(handle=[handle, pivot], blade=[box([1.8, 0.3, 0], [2.1, 0.6, 0.1])])
        done = carved_apart(asset)
        assert overlaps(done) == ()
        assert done.part("handle").collision == asset.part("handle").collision
        hole = 0.1 * (0.1 + 2 * CLEARANCE) ** 2
        assert volume_of(done.part("blade")) == pytest.approx(0.3 * 0.3 * 0.1 - hole)

    def test_parts_are_apart_even_where_very_many_pieces_would_be_left(self):
        places = [(0.08 + 0.18 * i, 0.08 + 0.18 * j) for i in range(5) for j in range(5)]
        keys = {f"key_{n}": [box([x, y, -2], [x + 0.1, y + 0.1, 2])] for n, (x, y) in enumerate(places)}
        asset = asset_of(case=[CUBE], **keys)
        done = carved_apart(asset, work=10_000)
        assert overlaps(done) == ()
        assert all(done.part(name).collision == tuple(row) for name, row in keys.items())
        assert 30 < len(done.part("case").collision) < 60
        assert volume_of(done.part("case")) > 0.4

    def test_parts_that_would_both_lose_all_stay_as_they_are(self):
        done = carved_apart(asset_of(body=[CUBE], door=[CUBE]))
        assert [p.collision for p in done.parts] == [(CUBE,), (CUBE,)]

    def test_parts_that_are_apart_stay_as_they_are(self):
        asset = asset_of(body=[CUBE], door=[box([2, 0, 0], [3, 1, 1])])
        done = carved_apart(asset)
        assert [p.collision for p in done.parts] == [p.collision for p in asset.parts]


def volume_of(part):
    return sum(map(volume, part.collision))


def _at(middle):
    matrix = np.eye(4)
    matrix[:3, 3] = middle
    return matrix


def test_pairs_stay_as_they_are_once_the_work_is_done():
    asset = asset_of(rail=[CUBE], one=[box([0.97, 0, 0], [2, 1, 1])], two=[box([-1, 0, 0], [0.03, 1, 1])])
    assert {overlap.other for overlap in overlaps(carved_apart(asset, work=1))} == {"two"}
