"""`geometric`, segmenter and joint predictor, on furniture of boards: what opens, how, and what stays."""

from dataclasses import dataclass
from typing import Any

import numpy as np
import pytest
import trimesh
from simart_kit_plugins.geometric.predictor import GeometricJoints
from simart_kit_plugins.geometric.scene import make_scene
from simart_kit_plugins.geometric.segmenter import Geometric

import simart_kit as sk
from simart_kit.arrays import FloatArray, IntArray
from simart_kit.assemble import assemble, checked
from simart_kit.kinematics import rest_to_posed, rotation
from simart_kit.mesh import Mesh
from simart_kit.testing.meshes import boxes_mesh

from .furniture import (
    BOARD,
    CABINET,
    HIGH,
    INSET,
    OPENING,
    STATIC,
    Box,
    box,
    cabinet_with_door,
    cabinet_with_two_doors,
    cart,
    joined,
    panel,
    stove,
    turned,
    turning,
)


@dataclass(frozen=True)
class Found:
    """What the segmenter and the predictor made of a mesh."""

    mesh: Mesh
    segmentation: sk.Segmentation
    joints: tuple[sk.Joint, ...]

    @property
    def kinds(self) -> dict[str, str]:
        return {joint.child: joint.kind for joint in self.joints}

    def joint(self, child: str) -> sk.Joint:
        return next(j for j in self.joints if j.child == child)

    def faces(self, child: str) -> IntArray:
        names = [p.name for p in self.segmentation.parts]
        return np.flatnonzero(self.segmentation.face_part == names.index(child))

    def travel(self, child: str, fraction: float = 0.3) -> FloatArray:
        """(N, 3) ways of a part's vertices when its joint goes a fraction of its range."""
        joint = self.joint(child)
        assert joint.limits is not None
        asset = assemble("thing", self.mesh, self.segmentation, self.joints, np.eye(4))
        posed = rest_to_posed(asset, {joint.name: fraction * joint.limits.upper})[child]
        points = self.mesh.triangles[self.faces(child)].reshape(-1, 3)
        return points @ posed[:3, :3].T + posed[:3, 3] - points


def found(source: Mesh | list[Box], **options: Any) -> Found:
    mesh = source if isinstance(source, Mesh) else boxes_mesh(source)
    segmentation = checked(Geometric(Geometric.Options(**options)).segment(mesh), mesh)
    return Found(mesh, segmentation, GeometricJoints().predict(mesh, segmentation))


def assert_hinge(joint: sk.Joint, through: tuple[float, float, float], along: str) -> None:
    """A revolute joint whose axis passes a point within 2 cm, along x, y or z."""
    assert joint.kind == "revolute"
    axis = np.array(joint.axis)
    np.testing.assert_allclose(np.abs(axis), np.eye(3)["xyz".index(along)], atol=1e-9)
    apart = np.array(joint.origin) - through
    assert np.linalg.norm(apart - axis * (apart @ axis)) < 0.02


def pot(hinge: bool) -> Mesh:
    """A round wall on a floor, with a round lid that has a knob; a hinge is a small block on both."""
    wall = trimesh.creation.annulus(r_min=0.118, r_max=0.12, height=0.16, sections=48)
    floor = trimesh.creation.cylinder(radius=0.118, height=0.004, sections=48)
    lid = trimesh.creation.cylinder(radius=0.122, height=0.006, sections=48)
    knob = trimesh.creation.cylinder(radius=0.015, height=0.03, sections=24)
    for part, height in ((wall, 0.08), (floor, 0.002), (lid, 0.1631), (knob, 0.1813)):
        part.apply_translation([0, 0, height])
    blocks = [boxes_mesh([box((-0.01, 0.01), (0.115, 0.135), (0.13, 0.16))])] if hinge else []
    return joined(*(Mesh(part.vertices, part.faces) for part in (wall, floor, lid, knob)), *blocks)


class TestLids:
    def test_the_round_lid_of_a_pot_lies_loose(self) -> None:
        assert found(pot(hinge=False)).kinds == {"lid": "free"}

    def test_with_a_hinge_it_opens_about_that(self) -> None:
        result = found(pot(hinge=True))
        assert list(result.kinds) == ["lid"]
        assert_hinge(result.joint("lid"), (0.0, 0.122, 0.163), "x")


class TestStatic:
    @pytest.mark.parametrize("name", STATIC)
    def test_nothing_moves_whichever_way_it_stands(self, name: str) -> None:
        for quarter in range(4):
            result = found(turned(boxes_mesh(STATIC[name]), 90.0 * quarter))
            assert [p.name for p in result.segmentation.parts] == ["body"]
            assert result.joints == ()

    def test_slats_are_no_doors(self) -> None:
        """A cabinet behind nine slats a side, which close a cavity; a board beside them may be a door."""
        sides = ((-0.3, -0.28), (0.28, 0.3))
        boards = [box((-0.3, 0.3), (-0.28, 0.28), z) for z in ((0.0, 0.02), (0.58, 0.6))]
        boards += [box(x, (-0.28, 0.28), (0.02, 0.58)) for x in sides]
        slats = [box((x, x + 0.052), y, (0.0, 0.6)) for x in np.linspace(-0.3, 0.248, 9) for y in sides]
        result = found([*boards, *slats])
        moving = [face for child in result.kinds for face in result.faces(child)]
        assert not [face for face in moving if face >= 12 * len(boards)]

    def test_that_is_told(self) -> None:
        texts = [note.text for note in found(STATIC["television"]).segmentation.notes]
        assert texts == [
            "4 connected components",
            "nothing was found that moves: the object is taken as static",
        ]


class TestDoors:
    @pytest.mark.parametrize(("handle", "edge"), [("right", INSET[0]), ("left", INSET[1])])
    def test_the_hinge_is_opposite_the_handle(self, handle: str, edge: float) -> None:
        result = found(cabinet_with_door(handle))
        assert list(result.kinds) == ["door"]
        assert_hinge(result.joint("door"), (edge, -0.19, 0.0), "z")
        np.testing.assert_array_equal(result.faces("door"), np.arange(60, 84))  # the panel and its handle

    def test_without_a_handle_it_still_opens(self) -> None:
        result = found(cabinet_with_door(None))
        assert result.kinds == {"door": "revolute"}
        assert abs(result.joint("door").axis[2]) == 1.0

    @pytest.mark.parametrize("handles", [True, False])
    def test_two_doors_have_their_hinges_outside(self, handles: bool) -> None:
        result = found(cabinet_with_two_doors(handles))
        assert result.kinds == {"left_door": "revolute", "right_door": "revolute"}
        assert_hinge(result.joint("left_door"), (-0.448, -0.21, 0.0), "z")
        assert_hinge(result.joint("right_door"), (0.448, -0.21, 0.0), "z")

    def test_an_oven_has_a_flap_hinged_below(self) -> None:
        result = found(OPENING["oven"])
        assert list(result.kinds) == ["door"]
        assert_hinge(result.joint("door"), (0.0, -0.29, 0.002), "x")

    def test_the_controls_of_a_microwave_stay(self) -> None:
        result = found(OPENING["microwave"])
        assert list(result.kinds) == ["door"]
        assert_hinge(result.joint("door"), (-0.248, -0.19, 0.0), "z")
        np.testing.assert_array_equal(result.faces("door"), np.arange(72, 96))

    def test_a_chest_has_a_lid_hinged_at_the_back(self) -> None:
        result = found(OPENING["chest"])
        assert list(result.kinds) == ["lid"]
        assert_hinge(result.joint("lid"), (0.0, 0.26, 0.41), "x")

    @pytest.mark.parametrize(
        ("name", "child", "outward"),
        [
            ("cabinet", "door", (0, -1, 0)),
            ("two_doors", "left_door", (0, -1, 0)),
            ("two_doors", "right_door", (0, -1, 0)),
            ("oven", "door", (0, -1, 0)),
            ("microwave", "door", (0, -1, 0)),
            ("chest", "lid", (0, 0, 1)),
        ],
    )
    def test_positive_positions_open(
        self, name: str, child: str, outward: tuple[float, float, float]
    ) -> None:
        """A third of the way, the free edge has come far out, and nothing has gone far in."""
        result = found(OPENING[name])
        way = result.travel(child) @ np.array(outward)
        assert way.max() > 0.1
        assert way.min() > -0.03

    def test_a_deep_lid_turns_about_the_seam_below_it(self) -> None:
        walls = [
            box((-0.3, 0.3), (-0.2, 0.2), (0.0, BOARD)),
            box((-0.3, 0.3), (-0.2, -0.2 + BOARD), (BOARD, 0.3)),
            box((-0.3, 0.3), (0.2 - BOARD, 0.2), (BOARD, 0.3)),
            box((-0.3, -0.3 + BOARD), (-0.2 + BOARD, 0.2 - BOARD), (BOARD, 0.3)),
            box((0.3 - BOARD, 0.3), (-0.2 + BOARD, 0.2 - BOARD), (BOARD, 0.3)),
        ]
        lid = box((-0.3, 0.3), (-0.2, 0.2), (0.302, 0.4))
        assert_hinge(found([*walls, lid]).joint("lid"), (0.0, 0.2, 0.302), "x")

    def test_doors_open_by_a_quarter_turn_unless_told(self) -> None:
        mesh = boxes_mesh(OPENING["cabinet"])
        segmentation = checked(Geometric().segment(mesh), mesh)
        for degrees in (90.0, 120.0):
            predictor = GeometricJoints(GeometricJoints.Options(open_angle=degrees))
            (joint,) = predictor.predict(mesh, segmentation)
            assert joint.limits == sk.Limits(0.0, float(np.radians(degrees)))

    def test_reasons_are_given(self) -> None:
        result = found(cabinet_with_door("right"))
        assert "handle on the opposite side" in result.joint("door").evidence
        assert 0.0 < result.joint("door").confidence <= 1.0
        assert "1 piece(s) like a handle on it" in result.segmentation.parts[1].description


class TestDrawers:
    def test_a_drawer_slides_forward_with_all_its_boards(self) -> None:
        result = found(OPENING["sideboard"])
        assert result.kinds == {"door": "revolute", "drawer": "prismatic"}
        assert result.joint("drawer").axis == (0.0, -1.0, 0.0)
        np.testing.assert_array_equal(result.faces("drawer"), np.arange(96, 180))
        assert_hinge(result.joint("door"), (INSET[1], -0.19, 0.0), "z")

    def test_it_comes_out_by_most_of_its_depth_and_never_falls_out(self) -> None:
        limits = found(OPENING["sideboard"]).joint("drawer").limits
        assert limits is not None
        assert limits.lower == 0.0
        assert 0.5 * 0.35 < limits.upper < 0.35

    def test_plain_fronts_with_knobs_are_drawers(self) -> None:
        """The boxes behind were left out of the model: low, wide fronts with knobs in the middle."""
        result = found(OPENING["dresser"])
        assert result.kinds == dict.fromkeys(("drawer_1", "drawer_2", "drawer_3"), "prismatic")
        for number, row in enumerate((2, 1, 0), start=1):  # numbered from the top
            joint = result.joint(f"drawer_{number}")
            assert joint.axis == (0.0, -1.0, 0.0)
            panel, knob = 12 * (1 + row), 12 * (4 + row)
            np.testing.assert_array_equal(
                result.faces(joint.child), [*range(panel, panel + 12), *range(knob, knob + 12)]
            )

    def test_the_surest_are_kept_when_there_are_too_many(self) -> None:
        kept = found(OPENING["dresser"], max_parts=2)
        assert len(kept.joints) == 2
        warnings = [note.text for note in kept.segmentation.notes if note.level == "warning"]
        assert warnings == ["1 more that seem to move stay with the body, as max_parts has it"]


class TestRoundThings:
    @pytest.mark.parametrize("axis", [0, 1])
    def test_wheels_roll(self, axis: int) -> None:
        result = found(cart(axis))
        assert result.kinds == {f"wheel_{n}": "continuous" for n in (1, 2, 3, 4)}
        centers = {tuple(np.round(np.array(j.origin) * 100).astype(int)) for j in result.joints}
        assert centers == {(x, y, 5) for x in (-35, 35) for y in (-20, 20)}
        for joint in result.joints:
            np.testing.assert_allclose(np.abs(joint.axis), np.eye(3)[axis], atol=1e-9)

    def test_knobs_in_a_row_turn(self) -> None:
        result = found(stove())
        assert result.kinds == {f"knob_{n}": "revolute" for n in (1, 2, 3, 4)}
        for joint in result.joints:
            np.testing.assert_allclose(np.abs(joint.axis), (0, 1, 0), atol=1e-9)

    @pytest.mark.parametrize("turns", [(0, 0.13, 0.26, 0.39), (0, 0, 0, 0.3)])
    def test_coarse_knobs_are_alike_however_they_are_turned(self, turns: tuple[float, ...]) -> None:
        def knob(k: int) -> Mesh:
            disc = trimesh.creation.cylinder(radius=0.02, height=0.02, sections=8)
            points = disc.vertices @ rotation(np.array([0, 0, turns[k]])).T
            points = points @ rotation(np.array([np.pi / 2, 0, 0])).T + (0.1 * k - 0.15, -0.31, 0.8)
            return Mesh(points, disc.faces)

        block = boxes_mesh([box((-0.3, 0.3), (-0.3, 0.3), (0.0, 0.85))])
        assert found(joined(block, *map(knob, range(4)))).kinds == {
            f"knob_{n}": "revolute" for n in (1, 2, 3, 4)
        }


class TestAjar:
    @pytest.mark.parametrize(("edge", "sense"), [(INSET[0], -1.0), (INSET[1], 1.0)])
    def test_a_door_that_stands_open_closes(self, edge: float, sense: float) -> None:
        """Modelled open by 8 degrees about a vertical edge: the lower limit is closed, the axis that edge."""
        swing = turning(8.0 * sense)
        swing[:3, 3] = np.array([edge, -0.2, 0.0]) - swing[:3, :3] @ [edge, -0.2, 0.0]
        door = boxes_mesh([panel(INSET, -0.2, HIGH)])
        mesh = joined(boxes_mesh(CABINET), door.transformed(swing))
        labels = np.repeat([0, 1], [60, 12]).astype(np.int32)
        segmentation = sk.Segmentation(labels, (sk.PartGuess("body"), sk.PartGuess("door")))
        result = Found(mesh, segmentation, GeometricJoints().predict(mesh, segmentation))
        joint = result.joint("door")
        assert joint.limits is not None
        assert np.degrees(joint.limits.lower) == pytest.approx(-8.0, abs=0.1)
        assert abs(joint.origin[0] - edge) < 0.02
        closed = result.travel("door", joint.limits.lower / joint.limits.upper)
        faces = mesh.triangles[60:].reshape(-1, 3) + closed
        assert np.ptp(faces[:, 1]) == pytest.approx(BOARD, abs=0.001)


# A plain panel before an open box, square to the eye: by its shape alone a door.
@pytest.mark.parametrize("degrees", [2.0, 8.0])
@pytest.mark.parametrize("side", [-1, 1])
def test_a_door_ajar_turns_about_its_own_edge_and_can_be_closed(degrees: float, side: int) -> None:
    hinge = np.array([0.297 * side, -0.262, 0.0])
    board = boxes_mesh([((-0.297, -0.272, 0.003), (0.297, -0.252, 0.797))])
    ajar = np.eye(4)
    ajar[:3, :3] = rotation(np.array([0.0, 0.0, side * np.radians(degrees)]))
    ajar[:3, 3] = hinge - ajar[:3, :3] @ hinge
    walls = [
        ((-0.3, -0.25, 0.0), (-0.28, 0.25, 0.8)),
        ((0.28, -0.25, 0.0), (0.3, 0.25, 0.8)),
        ((-0.28, -0.25, 0.0), (0.28, 0.25, 0.02)),
        ((-0.28, -0.25, 0.78), (0.28, 0.25, 0.8)),
        ((-0.28, 0.23, 0.02), (0.28, 0.25, 0.78)),
    ]
    (joint,) = found(joined(boxes_mesh(walls), board.transformed(ajar))).joints
    np.testing.assert_allclose(joint.origin[:2], hinge[:2], atol=0.011)  # within half the board's thickness
    assert joint.axis == (0.0, 0.0, float(side))
    assert joint.limits is not None
    assert np.degrees(joint.limits.lower) == pytest.approx(-degrees, abs=0.01)


def test_a_noisy_skin_is_told_and_taken_as_static() -> None:
    skin = trimesh.creation.box((0.6, 0.5, 0.9)).subdivide().subdivide().subdivide().subdivide()
    rough = skin.vertices + np.random.default_rng(0).normal(scale=0.02, size=skin.vertices.shape)
    segmentation = Geometric().segment(Mesh(rough, skin.faces))
    assert len(segmentation.parts) == 1
    assert [n.level for n in segmentation.notes if "fused skin" in n.text] == ["warning"]


def test_scenes_of_one_mesh_share_its_faces() -> None:
    """What takes long about them does not depend on the pieces."""
    mesh = boxes_mesh([((0, 0, 0), (1, 1, 1)), ((2, 0, 0), (3, 1, 1))])
    whole = make_scene(mesh, np.zeros(24, dtype=np.int32))
    parted = make_scene(mesh, np.repeat(np.array([0, 1], dtype=np.int32), 12))
    assert parted.rays is whole.rays
    assert parted.triangles is whole.triangles
    assert (whole.count, parted.count) == (1, 2)
    np.testing.assert_allclose(whole.areas, [12 / whole.size**2])
    np.testing.assert_allclose(parted.areas, np.full(2, 6 / whole.size**2))
