"""What a recording shows of how nano came to its parts."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from simart_kit.evidence import Evidence, PointEvidence, VertexEvidence

if TYPE_CHECKING:
    from simart_kit import Mesh
    from simart_kit.arrays import IntArray

    from .meshes import MeshCloud
    from .predicting import Prediction


def evidence(mesh: Mesh, face_piece: IntArray, said: Prediction, seen: MeshCloud) -> tuple[Evidence, ...]:
    """The chance to move all over the surface, and the points that were read, by the network's own parts.

    Args:
        mesh: whose faces are in parts.
        face_piece: (F,) piece of each face.
        said: by the network, before anything else had a say.
        seen: what it read.
    """
    corners = mesh.faces.reshape(-1)
    chance = np.repeat(said.moves[face_piece], 3)
    count = np.maximum(np.bincount(corners, minlength=len(mesh.vertices)), 1)
    moves = np.bincount(corners, chance, len(mesh.vertices)) / count
    points = seen.cloud.points * seen.size + seen.center
    names = ["body", *(f"{part.label or 'part'} {part.certainty:.2f}" for part in said.parts)]
    return (
        VertexEvidence("Chance to move", np.clip(moves, 0, 1).astype(np.float32)),
        PointEvidence("Points read", points, said.piece_part[seen.cloud.piece], tuple(names)),
    )
