"""Overlap of collision shapes, measured exactly and parted where it is small."""

from __future__ import annotations

import time
from dataclasses import replace

import mujoco
import numpy as np
import pytest

import simart_kit as sk
from simart_kit.arrays import FloatArray, vec3
from simart_kit.asset import ConvexMesh
from simart_kit.clipping import pulled_in
from simart_kit.convex_overlap import Convex, gap
from simart_kit.fitting import aligned_box
from simart_kit.hulls import convex_hull
from simart_kit.kinematics import rotation
from simart_kit.primitive_meshes import pose, primitive_shape
from simart_kit.primitives import Primitive, PrimitiveKind
from simart_kit.separation import (
    CLEARANCE,
    overlaps,
    overlaps_on_the_way,
    rigid_bodies,
    separated,
    stopped_by_shapes,
)
from simart_kit.testing.meshes import boxes_mesh

Corner = tuple[float, float, float]


def block(lower: Corner, upper: Corner) -> ConvexMesh:
    return aligned_box(np.array(lower), np.array(upper))


def turned_block(size: Corner, vector: Corner, middle: Corner) -> ConvexMesh:
    return primitive_shape(Primitive("box", vec3(size), pose(rotation(np.array(vector)), np.array(middle))))


def round_shape(kind: PrimitiveKind, size: Corner, middle: Corner) -> ConvexMesh:
    return primitive_shape(Primitive(kind, size, pose(np.eye(3), np.array(middle))))


def measured(one: ConvexMesh, other: ConvexMesh) -> tuple[float, FloatArray]:
    return gap(Convex(one), Convex(other))


def pair(one: ConvexMesh, other: ConvexMesh, joint: sk.Joint | None = None) -> sk.Asset:
    """Two boxes of surface that hold one shape each, the second of which slides along x."""
    mesh = boxes_mesh([((0, 0, 0), (1, 1, 1)), ((2, 0, 0), (3, 1, 1))])
    slide = sk.Joint("slide", "prismatic", "one", "two", axis=(1, 0, 0), limits=sk.Limits(-0.2, 0.2))
    parts = (sk.Part("one", collision=(one,)), sk.Part("two", collision=(other,)))
    return sk.Asset("pair", mesh, np.repeat([0, 1], 12), parts, (joint or slide,))


def passing(lowest: float, start: float = 0.0, lift: float = 0.5) -> sk.Asset:
    """A box that slides by another, whose surface begins at a height; its shape, lower, is in the way.

    The first begins its way at x = `start`; the other goes up by `lift`, or down.
    """
    boxes = [((0, 0, -3), (1, 1, -2)), ((start, 0, 0), (start + 1, 1, 1)), ((2, 0, lowest), (3, 1, 4))]
    shapes = [block(*boxes[0]), block(*boxes[1]), block((2, 0, 0.9), (3, 1, 4))]
    names = ("body", "slider", "beside")
    parts = tuple(sk.Part(name, collision=(shape,)) for name, shape in zip(names, shapes, strict=True))
    up = sk.Limits(min(lift, 0.0), max(lift, 0.0))
    joints = (
        sk.Joint("slide", "prismatic", "body", "slider", axis=(1, 0, 0), limits=sk.Limits(0.0, 2.0)),
        sk.Joint("lift", "prismatic", "body", "beside", axis=(0, 0, 1), limits=up),
    )
    return sk.Asset("passing", boxes_mesh(boxes), np.repeat(range(3), 12), parts, joints)


def under(start: float) -> sk.Asset:
    """A step with a post at its far end, and a box above x >= `start` whose shape is lower than its surface.

    The step slides below the box by half its length; the box slides over the step, as far as to the post.
    """
    boxes = [((0, 0, -3), (1, 1, -2)), ((0, 0, 0), (1, 1, 1)), ((0, 0, 1), (0.2, 1, 4))]
    above = ((start, 0, 1.1), (start + 1, 1, 4))
    parts = (
        sk.Part("body", collision=(block(*boxes[0]),)),
        sk.Part("step", collision=(block(*boxes[1]), block(*boxes[2]))),
        sk.Part("above", collision=(block((start, 0, 0.9), above[1]),)),
    )
    joints = (
        sk.Joint("slide", "prismatic", "body", "step", axis=(1, 0, 0), limits=sk.Limits(0.0, 0.5)),
        sk.Joint("back", "prismatic", "body", "above", axis=(-1, 0, 0), limits=sk.Limits(0.0, start - 0.1)),
    )
    faces = np.repeat([0, 1, 1, 2], 12)
    return sk.Asset("under", boxes_mesh([*boxes, above]), faces, parts, joints)


def behind(lowest: float) -> sk.Asset:
    """A drawer behind a shutter that slides up by 2; its shape reaches down to `lowest`, its surface to 0."""
    boxes = [((0, 0, -3), (1, 1, -2)), ((0, 0, 0), (1, 1, 1)), ((1.1, 0, 0), (1.2, 1, 2))]
    parts = (
        sk.Part("body", collision=(block(*boxes[0]),)),
        sk.Part("drawer", collision=(block(*boxes[1]),)),
        sk.Part("shutter", collision=(block((1.1, 0, lowest), (1.2, 1, 2)),)),
    )
    joints = (
        sk.Joint("slide", "prismatic", "body", "drawer", axis=(1, 0, 0), limits=sk.Limits(0.0, 0.5)),
        sk.Joint("up", "prismatic", "body", "shutter", axis=(0, 0, 1), limits=sk.Limits(0.0, 2.0)),
    )
    return sk.Asset("behind", boxes_mesh(boxes), np.repeat([0, 1, 2], 12), parts, joints)


UNIT = block((0, 0, 0), (1, 1, 1))


class TestGap:
    @pytest.mark.parametrize("shift", [0.3, 0.0, -0.01])
    def test_blocks_face_to_face(self, shift: float) -> None:
        found, axis = measured(UNIT, block((1 + shift, 0.2, 0.2), (2, 0.8, 0.8)))
        assert found == pytest.approx(shift, abs=1e-12)
        np.testing.assert_allclose(axis, [1, 0, 0])

    def test_a_block_on_its_edge_over_another_across(self) -> None:
        # Two unit cubes, each on an edge, the edges across each other: only edges against edges part them.
        quarter = np.pi / 4
        one = turned_block((1, 1, 1), (quarter, 0, 0), (0, 0, 0))
        two = turned_block((1, 1, 1), (0, quarter, 0), (0, 0, np.sqrt(2) - 0.01))
        found, axis = measured(one, two)
        assert found == pytest.approx(-0.01)
        np.testing.assert_allclose(axis, [0, 0, 1], atol=1e-9)

    def test_the_axis_leads_from_one_to_the_other(self) -> None:
        other = block((0.99, 0, 0), (2, 1, 1))
        assert measured(UNIT, other)[1] @ [1, 0, 0] == pytest.approx(1)
        assert measured(other, UNIT)[1] @ [1, 0, 0] == pytest.approx(-1)

    def test_round_primitives_are_round(self) -> None:
        ball = round_shape("sphere", (0.2, 0.2, 0.2), (0.5, 0.5, 1.099))
        assert measured(UNIT, ball)[0] == pytest.approx(-0.001)
        other = round_shape("sphere", (0.2, 0.2, 0.2), (0.5, 0.612, 1.259))
        assert measured(ball, other)[0] == pytest.approx(np.hypot(0.112, 0.16) - 0.2)
        rod = round_shape("cylinder", (0.2, 0.2, 0.6), (1.095, 0.5, 0.5))
        assert measured(UNIT, rod)[0] == pytest.approx(-0.005)

    def test_inside_is_as_deep_as_the_shortest_way_out(self) -> None:
        assert measured(UNIT, block((0.4, 0.4, 0.7), (0.6, 0.6, 0.8)))[0] == pytest.approx(-0.3)

    @pytest.mark.parametrize("seed", range(20))
    def test_overlaps_less_deep_than_asked_for_are_known_to_be_so(self, seed: int) -> None:
        rng = np.random.default_rng(seed)
        one = turned_block((1.0, 0.6, 0.4), tuple(rng.normal(size=3)), (0.0, 0.0, 0.0))
        other = turned_block((0.5, 0.7, 0.3), tuple(rng.normal(size=3)), tuple(rng.uniform(0.1, 0.5, 3)))
        exact, way = gap(Convex(one), Convex(other))
        for deep in (0.01, 0.05, 0.1, 0.2):
            found, axis = gap(Convex(one), Convex(other), deep)
            if exact < -deep:
                assert found == pytest.approx(exact)
                np.testing.assert_allclose(axis, way)
            else:
                assert found > -deep

    def test_boxes_tell_of_shapes_that_hardly_share_space(self) -> None:
        one = Convex(block((0.0, 0.0, 0.0), (1.0, 1.0, 1.0)))
        other = Convex(turned_block((0.4, 0.4, 0.4), (0.3, 0.2, 0.1), (-0.2, 0.5, 0.5)))
        found, axis = gap(one, other, 0.1)
        assert found == pytest.approx(-other.bounds[1, 0])
        np.testing.assert_array_equal(axis, [-1.0, 0.0, 0.0])
        assert not {"normals", "edges"} & {*vars(one), *vars(other)}

    @pytest.mark.parametrize("seed", range(6))
    def test_mujoco_measures_the_same_depth(self, seed: int) -> None:
        rng = np.random.default_rng(seed)
        shapes = [convex_hull(rng.normal(size=(12, 3)) * 0.1 + [shift, 0, 0], 64) for shift in (0.0, 0.15)]
        spec = mujoco.MjSpec()
        for index, shape in enumerate(shapes):
            mesh = spec.add_mesh(
                name=f"mesh{index}", uservert=shape.vertices.ravel(), userface=shape.faces.ravel()
            )
            spec.worldbody.add_geom(type=mujoco.mjtGeom.mjGEOM_MESH, meshname=mesh.name)
        model = spec.compile()
        data = mujoco.MjData(model)
        mujoco.mj_forward(model, data)
        depth = mujoco.mj_geomDistance(model, data, 0, 1, 1.0, np.zeros(6))
        assert depth < 0
        assert measured(*shapes)[0] == pytest.approx(depth, abs=2e-5)


class TestPulledIn:
    def test_a_block_loses_one_side(self) -> None:
        shape = pulled_in(UNIT, np.array([0.0, -1.0, 0.0]), 0.1)
        np.testing.assert_allclose(shape.vertices.min(axis=0), [0, 0.1, 0])
        np.testing.assert_allclose(shape.vertices.max(axis=0), [1, 1, 1])
        assert shape.primitive is not None
        assert shape.primitive.size == pytest.approx((1, 0.9, 1))

    def test_a_cylinder_loses_an_end_or_grows_thinner(self) -> None:
        rod = round_shape("cylinder", (0.2, 0.2, 0.6), (0, 0, 0))
        shorter = pulled_in(rod, np.array([0.0, 0.0, 1.0]), 0.1)
        assert shorter.primitive is not None
        assert shorter.primitive.size == pytest.approx((0.2, 0.2, 0.5))
        assert shorter.primitive.asset_T_shape[2, 3] == pytest.approx(-0.05)
        thinner = pulled_in(rod, np.array([1.0, 0.0, 0.0]), 0.01)
        assert thinner.primitive is not None
        assert thinner.primitive.size == pytest.approx((0.18, 0.18, 0.6))

    @pytest.mark.parametrize("kind", ["cylinder", "sphere"])
    def test_what_is_round_is_cut_where_little_would_be_left_of_it(self, kind: PrimitiveKind) -> None:
        round_ = round_shape(kind, (0.2, 0.2, 0.2), (0, 0, 0))
        shape = pulled_in(round_, np.array([1.0, 0.0, 0.0]), 0.15)
        assert shape.primitive is None
        assert shape.vertices[:, 0].max() == pytest.approx(-0.05)
        assert shape.vertices[:, 0].min() == pytest.approx(round_.vertices[:, 0].min())

    def test_across_its_axes_a_block_becomes_a_hull_without_its_corner(self) -> None:
        diagonal = np.ones(3) / np.sqrt(3)
        shape = pulled_in(UNIT, diagonal, 0.1)
        assert shape.primitive is None
        assert (shape.vertices @ diagonal).max() == pytest.approx(np.sqrt(3) - 0.1)
        np.testing.assert_allclose(shape.vertices.max(axis=0), 1)


class TestOverlaps:
    def test_pairs_and_depths(self) -> None:
        (found,) = overlaps(pair(UNIT, block((0.97, 0, 0), (2, 1, 1))))
        assert (found.one, found.other) == ("one", "two")
        assert found.depth == pytest.approx(0.03)
        assert overlaps(pair(UNIT, block((1, 0, 0), (2, 1, 1)))) == ()

    def test_positions_move_shapes(self) -> None:
        asset = pair(UNIT, block((1.1, 0, 0), (2, 1, 1)))
        assert overlaps(asset) == ()
        assert overlaps(asset, {"slide": -0.15})[0].depth == pytest.approx(0.05)
        assert overlaps_on_the_way(asset)[0].depth == pytest.approx(0.1)

    def test_a_corner_that_grazes_its_frame_as_it_turns_out_is_met(self) -> None:
        """The far corner is 0.401124 from the hinge, and beyond 0.4011 from 3.66 to 4.36 degrees alone."""
        hinge = sk.Joint("hinge", "revolute", "one", "two", axis=(0, 0, -1), limits=sk.Limits(0, np.pi / 2))
        frame, door = block((0.4011, -0.0005, 0), (0.5, 0.03, 1)), block((0, 0, 0), (0.4, 0.03, 1))
        (found,) = overlaps_on_the_way(pair(frame, door, hinge))
        assert 0 < found.depth < 0.401124 - 0.4011
        assert overlaps_on_the_way(pair(block((0.4012, -0.0005, 0), (0.5, 0.03, 1)), door, hinge)) == ()

    def test_a_face_that_turns_flush_below_another_is_met(self) -> None:
        """A caster's plate slides along the foot of a post that it is clear of at rest."""
        spin = sk.Joint("spin", "continuous", "one", "two", axis=(0, 0, 1))
        post, plate = block((0.3, -0.05, 1), (0.4, 0.05, 2)), block((-0.5, -0.1, 0.9), (0.1, 0.1, 1))
        asset = pair(post, plate, spin)
        assert overlaps(asset) == ()
        (found,) = overlaps_on_the_way(asset)
        assert (found.one, found.other, found.depth) == ("one", "two", 0.0)
        lower = block((-0.5, -0.1, 0.9), (0.1, 0.1, 0.9999))
        assert overlaps_on_the_way(pair(post, lower, spin)) == ()

    def test_parts_that_cannot_move_against_each_other_are_one(self) -> None:
        for joint in (
            sk.Joint("fix", "fixed", "one", "two"),
            sk.Joint("stuck", "prismatic", "one", "two", limits=sk.Limits(0.0, 0.0)),
        ):
            asset = pair(UNIT, UNIT, joint)
            assert overlaps(asset) == ()
            assert len(set(rigid_bodies(asset).tolist())) == 1

    def test_parts_without_shapes_do_not_overlap(self) -> None:
        asset = pair(UNIT, UNIT)
        bare = asset.with_parts({"two": replace(asset.part("two"), collision=())})
        assert overlaps(bare) == overlaps_on_the_way(bare) == ()

    def test_shapes_of_what_stands_beside_are_met_on_the_way_where_its_surface_is_not(self) -> None:
        for lowest, met in ((1.1, {("slider", "beside")}), (0.5, set())):
            asset = passing(lowest)
            assert {(o.one, o.other) for o in stopped_by_shapes(asset)} == met
            assert overlaps(asset) == overlaps_on_the_way(asset) == ()

    def test_a_pair_whose_surfaces_stop_one_of_its_joints_is_none_of_them(self) -> None:
        """The upper box is lifted off the one half below it, or pressed onto it."""
        assert len(stopped_by_shapes(passing(1.1, start=1.5, lift=0.5))) == 1
        assert stopped_by_shapes(passing(1.1, start=1.5, lift=-0.5)) == ()

    def test_what_shapes_alone_keep_from_leaving_rest_passes_even_what_its_surface_stops(self) -> None:
        """A step with a post slides under a shape that is lower than its surface, and that the post stops."""
        for start, met in ((1.01, {("step", "above")}), (1.21, set())):
            asset = under(start)
            assert {(o.one, o.other) for o in stopped_by_shapes(asset)} == met
            assert overlaps(asset) == overlaps_on_the_way(asset) == ()

    def test_what_shapes_alone_stop_once_the_other_is_out_of_the_way_passes_it(self) -> None:
        for lowest, met in ((-1.5, {("drawer", "shutter")}), (0.0, set())):
            assert {(o.one, o.other) for o in stopped_by_shapes(behind(lowest))} == met

    def test_what_stands_in_another_at_rest_slides_on_in_it_though_shapes_were_cut_around_it(self) -> None:
        """A rod goes down in a block that has no hole for it; so `sweep` lets it, too."""
        boxes = [((0, 0, -3), (1, 1, -2)), ((0.4, 0.4, 0.5), (0.6, 0.6, 1.5)), ((0, 0, 0), (1, 1, 1))]
        around = [((0, 0, 0), (1, 1, 0.4995)), ((0, 0, 0.5), (0.3995, 1, 1)), ((0.6005, 0, 0.5), (1, 1, 1))]
        shapes = [[block(*boxes[0])], [block(*boxes[1])], [block(*box) for box in around]]
        names = ("body", "rod", "block")
        parts = tuple(sk.Part(name, collision=tuple(row)) for name, row in zip(names, shapes, strict=True))
        joints = (
            sk.Joint("slide", "prismatic", "body", "rod", axis=(0, 0, 1), limits=sk.Limits(-0.4, 0.0)),
            sk.Joint("pull", "prismatic", "body", "block", axis=(0, 1, 0), limits=sk.Limits(0.0, 0.3)),
        )
        asset = sk.Asset("rod", boxes_mesh(boxes), np.repeat(range(3), 12), parts, joints)
        assert overlaps(asset) == ()
        (found,) = stopped_by_shapes(asset)
        assert (found.one, found.other) == ("rod", "block")


class TestSeparated:
    def test_both_give_way_alike_and_only_where_they_meet(self) -> None:
        asset = separated(pair(UNIT, block((0.998, 0, 0), (2, 1, 1))), 0.002)
        one, two = (part.collision[0].vertices for part in asset.parts)
        half = (0.002 + CLEARANCE) / 2
        np.testing.assert_allclose(one.max(axis=0), [1 - half, 1, 1])
        np.testing.assert_allclose(one.min(axis=0), 0)
        np.testing.assert_allclose(two.min(axis=0), [0.998 + half, 0, 0])
        np.testing.assert_allclose(two.max(axis=0), [2, 1, 1])

    def test_shapes_that_touch_get_a_clearance(self) -> None:
        asset = separated(pair(UNIT, block((1, 0, 0), (2, 1, 1))), 0.002)
        one, two = (Convex(part.collision[0]) for part in asset.parts)
        assert gap(one, two)[0] == pytest.approx(CLEARANCE)

    def test_a_thin_sheet_keeps_most_of_itself(self) -> None:
        sheet = block((0.999, 0, 0), (1.001, 1, 1))
        asset = separated(pair(UNIT, sheet), 0.002)
        one, two = (part.collision[0] for part in asset.parts)
        assert np.ptp(two.vertices[:, 0]) == pytest.approx(0.75 * 0.002)
        assert gap(Convex(one), Convex(two))[0] == pytest.approx(CLEARANCE)

    def test_deep_overlaps_stay(self) -> None:
        before = pair(UNIT, block((0.9, 0, 0), (2, 1, 1)))
        after = separated(before, 0.002)
        assert [p.collision[0] for p in after.parts] == [p.collision[0] for p in before.parts]
        assert overlaps(after)[0].depth == pytest.approx(0.1)

    def test_shapes_apart_stay_as_they_are(self) -> None:
        before = pair(UNIT, block((1.01, 0, 0), (2, 1, 1)))
        after = separated(before, 0.002)
        assert [p.collision[0] for p in after.parts] == [p.collision[0] for p in before.parts]


def keyboard(count: int) -> sk.Asset:
    """Keys in rows of ten over a plate; each a little into the plate when pressed, and none at rest."""
    plate = ((0.0, 0.0, 0.0), (0.2, 0.02 * (count // 10 + 1), 0.01))
    places = [(0.02 * (k % 10), 0.02 * (k // 10)) for k in range(count)]
    keys = [((x, y, 0.012), (x + 0.018, y + 0.018, 0.02)) for x, y in places]
    parts = tuple(
        sk.Part(name, collision=(block(*box),))
        for name, box in zip(["plate", *(f"key_{k}" for k in range(count))], [plate, *keys], strict=True)
    )
    joints = tuple(
        sk.Joint(f"press_{k}", "prismatic", "plate", f"key_{k}", axis=(0, 0, -1), limits=sk.Limits(0, 0.003))
        for k in range(count)
    )
    faces = np.repeat(range(count + 1), 12)
    return sk.Asset("keyboard", boxes_mesh([plate, *keys]), faces, parts, joints)


@pytest.mark.slow
def test_overlaps_of_two_hundred_keys_are_found_in_seconds() -> None:
    # Each joint is looked at with what it reaches, not with all that there is.
    asset = keyboard(200)
    start = time.process_time()
    met = overlaps_on_the_way(asset)
    assert stopped_by_shapes(asset) == ()
    assert time.process_time() - start < 10
    assert [(pair.one, pair.other) for pair in met] == [("plate", f"key_{k}") for k in range(200)]
    assert [pair.depth for pair in met] == pytest.approx([0.001] * 200)
