"""From a segmentation and joints to an Asset: what is cleaned, refused and added."""

from typing import Any

import numpy as np
import pytest

import simart_kit as sk
from simart_kit.assemble import assemble, checked
from simart_kit.errors import BadInputError
from simart_kit.mesh import Mesh, Note
from simart_kit.physics import DEFAULT_MATERIAL
from simart_kit.testing.meshes import boxes_mesh

# Three cubes: a small one, the largest, a middle one.
MESH = boxes_mesh([((0, 0, 0), (1, 1, 1)), ((2, 0, 0), (5, 3, 3)), ((6, 0, 0), (8, 2, 2))])
LABELS = np.repeat([0, 1, 2], 12).astype(np.int32)


def guesses(*names: str) -> tuple[sk.PartGuess, ...]:
    return tuple(sk.PartGuess(name) for name in names)


def put_together(segmentation: sk.Segmentation, *joints: sk.Joint, mesh: Mesh = MESH) -> sk.Asset:
    return assemble("thing", mesh, segmentation, joints, np.eye(4))


class TestChecked:
    @pytest.mark.parametrize(
        ("labels", "said"),
        [
            (LABELS[:-1], r"face_part has shape \(35,\), expected \(36,\): one label a face"),
            (LABELS[:, None], r"face_part has shape \(36, 1\)"),
            (LABELS.astype(float), "face_part has dtype float64, expected int32"),
            (LABELS > 0, "face_part has dtype bool, expected int32"),
            (LABELS - 1, "uses ids -1, 0, 1 for 3 parts, expected each of 0..2"),
            (LABELS * 2, "uses ids 0, 2, 4 for 3 parts"),
            (LABELS * 0, "uses ids 0 for 3 parts"),
            (np.arange(36), "uses ids 0, 1, 2, 3, 4, 5, 6, 7, 8, 9 for 3 parts"),
        ],
    )
    def test_labels_that_are_refused(self, labels: Any, said: str) -> None:
        with pytest.raises(ValueError, match=said):
            checked(sk.Segmentation(labels, guesses("a", "b", "c")), MESH)

    @pytest.mark.parametrize("value", [None, LABELS, (LABELS, guesses("a", "b", "c"))])
    def test_something_else(self, value: Any) -> None:
        with pytest.raises(ValueError, match=f"returned {type(value).__name__}, expected a simart_kit"):
            checked(value, MESH)

    def test_names_are_cleaned_and_made_unique(self) -> None:
        result = checked(sk.Segmentation(LABELS, guesses("Left Door", "left-door", "???")), MESH)
        assert [p.name for p in result.parts] == ["left_door", "left_door_2", "part"]

    def test_joint_hints_follow_the_new_names(self) -> None:
        hints = (
            sk.Joint("hinge", "fixed", "The Body", "Left Door"),
            sk.Joint("j2", "fixed", "The Body", "lid"),
        )
        segmentation = sk.Segmentation(LABELS, guesses("The Body", "Left Door", "lid"), hints)
        result = checked(segmentation, MESH)
        assert result.joints is not None
        assert [(j.parent, j.child) for j in result.joints] == [
            ("the_body", "left_door"),
            ("the_body", "lid"),
        ]

    def test_a_hint_for_an_unknown_part_is_left_for_the_asset_to_refuse(self) -> None:
        hints = (sk.Joint("hinge", "fixed", "a", "ghost"),)
        segmentation = checked(sk.Segmentation(LABELS, guesses("a", "b", "c"), hints), MESH)
        assert segmentation.joints == hints
        with pytest.raises(BadInputError, match="joint 'hinge' names part 'ghost'"):
            put_together(segmentation, *hints)

    def test_labels_of_any_integer_type_become_int32(self) -> None:
        for dtype in (np.uint8, np.int64):
            result = checked(sk.Segmentation(LABELS.astype(dtype), guesses("a", "b", "c")), MESH)
            assert result.face_part.dtype == np.int32

    def test_the_rest_is_kept(self) -> None:
        notes = (Note("segment", "info", "three cubes"),)
        guess = sk.PartGuess("a", "door", "glass", 0.25, "see-through")
        before = sk.Segmentation(LABELS, (guess, *guesses("b", "c")), None, LABELS, notes)
        result = checked(before, MESH)
        assert result.parts[0] == guess
        assert result.joints is None
        assert result.face_segment is LABELS
        assert result.notes == notes


class TestAssemble:
    def test_parts_without_a_joint_are_fixed_to_the_largest_of_them(self) -> None:
        asset = put_together(sk.Segmentation(LABELS, guesses("a", "b", "c")))
        assert asset.root.name == "b"
        assert [(j.name, j.kind, j.parent, j.child) for j in asset.joints] == [
            ("a_mount", "fixed", "b", "a"),
            ("c_mount", "fixed", "b", "c"),
        ]

    def test_a_part_that_moves_is_not_the_body_however_large(self) -> None:
        spin = sk.Joint("spin", "continuous", "c", "b")
        asset = put_together(sk.Segmentation(LABELS, guesses("a", "b", "c")), spin)
        assert asset.root.name == "c"
        assert [j.name for j in asset.joints] == ["spin", "a_mount"]
        assert asset.joints[0] is spin

    def test_joints_in_a_loop_are_refused(self) -> None:
        joints = [sk.Joint(f"{a}{b}", "fixed", a, b) for a, b in ("ab", "bc", "ca")]
        with pytest.raises(BadInputError, match="loop"):
            put_together(sk.Segmentation(LABELS, guesses("a", "b", "c")), *joints)

    def test_materials_come_from_the_table_and_unknown_ones_are_told(self) -> None:
        parts = (
            sk.PartGuess("a", material="glass"),
            sk.PartGuess("b", material="adamant"),
            sk.PartGuess("c"),
        )
        asset = put_together(sk.Segmentation(LABELS, parts))
        assert [p.material.name for p in asset.parts] == ["glass", DEFAULT_MATERIAL, "wood"]
        assert [(n.level, n.text) for n in asset.notes] == [
            ("warning", f"material 'adamant' is not in the table: {DEFAULT_MATERIAL} is used")
        ]

    def test_labels_descriptions_and_notes_are_kept(self) -> None:
        said = (Note("load", "info", "read"), Note("segment", "info", "found"))
        mesh = Mesh(MESH.vertices, MESH.faces, notes=said[:1])
        parts = (sk.PartGuess("a", "door", description="it opens"), *guesses("b", "c"))
        asset = put_together(sk.Segmentation(LABELS, parts, notes=said[1:]), mesh=mesh)
        assert asset.notes == said
        assert asset.mesh.notes == ()
        assert (asset.parts[0].label, asset.parts[0].description) == ("door", "it opens")

    def test_frame_and_base(self) -> None:
        matrix = np.diag([2.0, 2.0, 2.0, 1.0])
        one = sk.Segmentation(LABELS * 0, guesses("body"))
        asset = assemble("thing", MESH, one, (), matrix, floating=True)
        np.testing.assert_array_equal(asset.asset_from_source, matrix)
        assert asset.floating
        assert asset.joints == ()
