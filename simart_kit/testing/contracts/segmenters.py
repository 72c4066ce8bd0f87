"""What a segmenter must keep."""

from __future__ import annotations

from typing import ClassVar

import numpy as np
import pytest

from ...arrays import IntArray
from ...assemble import assemble, checked
from ...beside import Beside
from ...mesh import Mesh
from ...spec.protocols import HelpedSegmenter, segment_by
from ...stages import PartGuess, Segmentation, Segmenter
from .. import meshes
from ..fingerprint import fingerprint
from .stages import StageContract


class SegmenterContract(StageContract):
    """For Segmenters.

    Attributes:
        invariant: whether moving and scaling a mesh leaves the partition as it is; set to False for a method
            that cannot promise it, such as a network on a fixed grid.
    """

    kind = Segmenter
    invariant: ClassVar[bool] = True

    def mesh(self) -> Mesh:
        """What is segmented: by default a cabinet with a door and a drawer."""
        return meshes.cabinet_mesh()

    def test_labels_every_face(self) -> None:
        mesh = self.mesh()
        result = self.make().segment(mesh)
        assert isinstance(result, Segmentation), f"segment() returned {type(result).__name__}"
        labels = result.face_part
        assert isinstance(labels, np.ndarray), f"face_part is a {type(labels).__name__}, expected an array"
        assert np.issubdtype(labels.dtype, np.integer), f"face_part has dtype {labels.dtype}, expected int32"
        faces = result.mesh_of(mesh).faces
        assert labels.shape == (len(faces),), f"face_part has shape {labels.shape}: one label a face"

    def test_one_guess_for_every_label(self) -> None:
        result = self.make().segment(self.mesh())
        used = np.unique(result.face_part).tolist()
        expected = list(range(len(result.parts)))
        assert used == expected, (
            f"face_part uses ids {used} for {len(result.parts)} guesses: number them from 0"
        )
        assert all(isinstance(guess, PartGuess) for guess in result.parts), "parts must hold PartGuess values"

    def test_core_accepts_it(self) -> None:
        mesh = self.mesh()
        segmentation = checked(self.make().segment(mesh), mesh)
        assemble("asset", mesh, segmentation, segmentation.joints or (), np.eye(4))

    def test_works_on_a_single_box(self) -> None:
        mesh = meshes.static_asset().mesh
        checked(self.make().segment(mesh), mesh)

    def test_same_answer_every_time(self) -> None:
        mesh, stage = self.mesh(), self.make()
        with Beside(isinstance(stage, HelpedSegmenter)) as another:
            one, two = stage.segment(mesh), segment_by(self.make(), mesh, None, another)
        assert fingerprint(one) == fingerprint(two), (
            "make generators with numpy.random.default_rng(self.seed), and give the same with help"
        )

    def test_leaves_the_mesh_alone(self) -> None:
        mesh = self.mesh()
        before = fingerprint(mesh)
        self.make().segment(mesh)
        assert fingerprint(mesh) == before, "segment() changed its mesh"

    def test_does_not_depend_on_place_and_size(self) -> None:
        if not self.invariant:
            pytest.skip("the class says invariant = False")
        mesh = self.mesh()
        moved_from_mesh = np.diag([1.7, 1.7, 1.7, 1.0])
        moved_from_mesh[:3, 3] = (0.4, -0.7, 0.3)
        at_rest = self.make().segment(mesh).face_part
        moved = self.make().segment(mesh.transformed(moved_from_mesh)).face_part
        assert np.array_equal(_first_seen(at_rest), _first_seen(moved)), "the partition changed"


def _first_seen(labels: IntArray) -> IntArray:
    """(F,) labels numbered in the order in which they first appear."""
    _, first, inverse = np.unique(labels, return_index=True, return_inverse=True)
    rank: IntArray = np.argsort(np.argsort(first))
    return rank[inverse]
