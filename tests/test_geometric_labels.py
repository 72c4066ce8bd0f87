"""What labels of parts change about `geometric`'s joints, and what is round."""

import numpy as np
import pytest
from simart_kit_plugins.geometric.predictor import GeometricJoints
from simart_kit_plugins.geometric.rounds import is_rod, round_axis

import simart_kit as sk
from simart_kit.assemble import checked
from simart_kit.testing.meshes import boxes_mesh

from .furniture import (
    OPENING,
    box,
    carcass,
    cart,
    panel,
)

PANEL = [*carcass((-0.25, 0.25), (-0.2, 0.2), (0.0, 0.5)), panel((-0.249, 0.249), -0.22, (0.001, 0.499))]


def labelled(label: str, name: str = "thing") -> tuple[sk.Joint, ...]:
    """Joints of the panel when another segmenter gave it a label."""
    mesh = boxes_mesh(PANEL)
    labels = np.repeat([0, 1], [60, 12])
    parts = (sk.PartGuess("case", label="body"), sk.PartGuess(name, label=label))
    return GeometricJoints().predict(mesh, checked(sk.Segmentation(labels, parts), mesh))


class TestLabels:
    """The predictor takes what another segmenter calls a part as evidence."""

    @pytest.mark.parametrize(
        ("label", "kind"),
        [
            ("", "revolute"),
            ("door", "revolute"),
            ("Left Door", "revolute"),
            ("drawer", "prismatic"),
            ("sliding panel", "prismatic"),
            ("drawers", "prismatic"),
        ],
    )
    def test_a_label_decides_where_the_shape_leaves_room(self, label: str, kind: str) -> None:
        (joint,) = labelled(label)
        assert joint.kind == kind
        assert (joint.parent, joint.child) == ("case", "thing")

    def test_the_reason_is_given(self) -> None:
        (joint,) = labelled("drawer")
        assert "labelled 'drawer'" in joint.evidence
        assert joint.name == "thing_slide"
        assert joint.axis == (0.0, -1.0, 0.0)

    def test_a_name_does_for_a_label(self) -> None:
        (joint,) = labelled("", name="top_drawer")
        assert joint.kind == "prismatic"

    @pytest.mark.parametrize("label", ["", "drawer"])
    def test_a_box_behind_the_front_makes_a_drawer_of_anything(self, label: str) -> None:
        mesh = boxes_mesh(OPENING["sideboard"])
        parts = (sk.PartGuess("body"), sk.PartGuess("thing", label=label))
        (joint,) = GeometricJoints().predict(mesh, sk.Segmentation(np.repeat([0, 1], [96, 84]), parts))
        assert joint.kind == "prismatic"
        assert "a box hangs behind the front" in joint.evidence

    def test_depth_alone_makes_a_drawer(self) -> None:
        """Higher than wide, without a handle or a name: only the box behind the front speaks for a slide."""
        bin_ = box((-0.15, 0.15), (-0.22, 0.15), (0.03, 0.46))
        mesh = boxes_mesh([*carcass((-0.25, 0.25), (-0.2, 0.2), (0.0, 0.5)), bin_])
        parts = (sk.PartGuess("body"), sk.PartGuess("thing"))
        (joint,) = GeometricJoints().predict(mesh, sk.Segmentation(np.repeat([0, 1], [60, 12]), parts))
        assert (joint.kind, joint.axis) == ("prismatic", (0.0, -1.0, 0.0))

    def test_something_round_that_is_called_a_wheel_spins(self) -> None:
        mesh = cart(0)
        labels = np.concatenate([np.zeros(12), np.repeat([1, 2, 3, 4], 128)]).astype(np.int32)
        parts = tuple(sk.PartGuess(n) for n in ("deck", "wheel_a", "wheel_b", "wheel_c", "wheel_d"))
        joints = GeometricJoints().predict(mesh, sk.Segmentation(labels, parts))
        assert [j.kind for j in joints] == ["continuous"] * 4
        assert {j.parent for j in joints} == {"deck"}

    def test_the_body_is_what_is_called_so(self) -> None:
        """The base is the smaller of two boxes; without its label the larger would be the body."""
        mesh = boxes_mesh(
            [box((-0.1, 0.1), (-0.1, 0.1), (0, 0.2)), box((-0.3, 0.3), (-0.3, 0.3), (0.2, 0.25))]
        )
        labels = np.repeat([0, 1], 12)
        for label, parent in (("base", "a"), ("", "b")):
            parts = (sk.PartGuess("a", label=label), sk.PartGuess("b"))
            (joint,) = GeometricJoints().predict(mesh, sk.Segmentation(labels, parts))
            assert joint.parent == parent

    def test_one_part_has_no_joint(self) -> None:
        mesh = boxes_mesh(PANEL)
        one = sk.Segmentation(np.zeros(72, dtype=np.int32), (sk.PartGuess("body"),))
        assert GeometricJoints().predict(mesh, one) == ()


class TestRoundness:
    """A rim all around makes a disc, however few corners it has."""

    @pytest.mark.parametrize(
        ("corners", "is_round"), [(4, False), (6, False), (8, True), (12, True), (32, True)]
    )
    def test_coarse_discs_are_round_and_nuts_are_not(self, corners: int, is_round: bool) -> None:
        angles = 2 * np.pi * np.arange(corners) / corners
        rim = np.column_stack([np.cos(angles), np.zeros(corners), np.sin(angles)])
        disc = np.concatenate([rim - [0, 0.2, 0], rim + [0, 0.2, 0]])
        assert (round_axis(disc) == 1) == is_round

    def test_a_rod_is_no_disc(self) -> None:
        angles = 2 * np.pi * np.arange(24) / 24
        rim = np.column_stack([np.cos(angles), np.sin(angles), np.zeros(24)])
        assert round_axis(np.concatenate([rim - [0, 0, 3], rim + [0, 0, 3]])) is None

    def test_a_needle_without_width_is_no_disc(self) -> None:
        """Scans and downloads have faces whose corners lie on one line."""
        needle = np.column_stack([np.zeros((5, 2)), np.linspace(0, 1, 5)])
        assert round_axis(needle) is None
        assert not is_rod(needle, 2)
