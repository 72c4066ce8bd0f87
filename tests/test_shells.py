"""Volumes below triangles, and which pieces of a surface are closed, by hand."""

import numpy as np
import pytest

from simart_kit.shells import find_shells, signed_volumes
from simart_kit.testing.meshes import boxes_mesh


def test_signed_volumes_are_of_tetrahedra_at_the_origin_and_sum_to_a_box() -> None:
    corner = np.eye(3)[None]
    np.testing.assert_allclose(signed_volumes(np.concatenate([corner, corner[:, ::-1]])), [1 / 6, -1 / 6])
    block = boxes_mesh([((1, 1, 1), (2, 3, 4))])  # 1 x 2 x 3
    assert signed_volumes(block.triangles).sum() == pytest.approx(6.0)


def test_boxes_are_closed_one_by_one_and_an_open_one_is_not() -> None:
    mesh = boxes_mesh([((0, 0, 0), (1, 1, 1)), ((2, 0, 0), (3, 1, 1))])
    shells = find_shells(mesh.vertices, mesh.faces[:-1])
    assert np.bincount(shells.face_shell).tolist() == [12, 11]
    assert shells.closed.tolist() == [True, False]


def test_no_faces_no_shells() -> None:
    shells = find_shells(np.zeros((3, 3)), np.zeros((0, 3), dtype=np.int64))
    assert shells.count == len(shells.faces) == 0
