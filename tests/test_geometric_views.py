"""What sticks out of a part's front: its handle, and not the ragged border of a skin's part."""

from __future__ import annotations

import numpy as np
import trimesh
from simart_kit_plugins.geometric.scene import make_scene
from simart_kit_plugins.geometric.views import view_part

from simart_kit.mesh import Mesh


def leaf(fringe: int) -> Mesh:
    """A leaf, 0.5 by 0.7, with an upright bar near its right edge, and lone triangles before its top."""
    board = trimesh.creation.box((0.5, 0.02, 0.7))
    bar = trimesh.creation.box((0.01, 0.03, 0.1)).apply_translation((0.22, -0.02, 0.25))
    vertices, faces = [board.vertices, bar.vertices], [board.faces, bar.faces + 8]
    for k in range(fringe):
        x = -0.25 + 0.5 * (k + 0.5) / fringe
        vertices.append(np.array([[x, -0.03, 0.345], [x + 0.006, -0.03, 0.345], [x, -0.03, 0.35]]))
        faces.append(np.array([[0, 1, 2]]) + 16 + 3 * k)
    return Mesh(np.concatenate(vertices), np.concatenate(faces))


def test_lone_triangles_at_a_border_are_of_no_handle() -> None:
    plain, ragged = (
        view_part(make_scene(mesh, np.zeros(len(mesh.faces), dtype=np.int64)), 0, ("front",))
        for mesh in (leaf(0), leaf(30))
    )
    assert plain.handle is not None
    assert ragged.handle is not None
    np.testing.assert_allclose(ragged.handle.lower[:2], plain.handle.lower[:2], atol=0.01)
    np.testing.assert_allclose(ragged.handle.upper[:2], plain.handle.upper[:2], atol=0.01)
    np.testing.assert_allclose(ragged.handle_place, plain.handle_place, atol=0.05)


def test_two_knobs_of_a_size_are_both_handles() -> None:
    board = trimesh.creation.box((0.8, 0.02, 0.3))
    knobs = [trimesh.creation.icosphere(radius=0.015).apply_translation((x, -0.025, 0)) for x in (-0.2, 0.2)]
    whole = trimesh.util.concatenate([board, *knobs])
    mesh = Mesh(np.array(whole.vertices), np.array(whole.faces))
    view = view_part(make_scene(mesh, np.zeros(len(mesh.faces), dtype=np.int64)), 0, ("front",))
    assert view.handle is not None
    assert view.handle.size[0] > 0.4 / np.linalg.norm((0.8, 0.05, 0.3))
