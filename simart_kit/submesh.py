"""Some faces of a mesh as a mesh of their own."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from .arrays import BoolArray
from .mesh import Mesh


def submesh(mesh: Mesh, faces: BoolArray) -> Mesh:
    """The (F,) chosen faces, in their order, with their look, on only the vertices that they use.

    Raises:
        BadInputError: no face is chosen.
    """
    used, corners = np.unique(mesh.faces[faces], return_inverse=True)
    kept = replace(
        mesh,
        faces=mesh.faces[faces],
        face_material=mesh.face_material[faces],
        face_node=None if mesh.face_node is None else mesh.face_node[faces],
    )
    return kept.on_vertices(used, corners.reshape(-1, 3))
