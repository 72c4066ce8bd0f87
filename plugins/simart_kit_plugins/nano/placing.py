"""Hinges that geometry finds, where the network tells that they are: rules know edges, it has seen hinges."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from .proposals import SAME, Proposal, along, joint_of, overlap

if TYPE_CHECKING:
    from simart_kit import Joint, Mesh

    from .meshes import MeshCloud
    from .predicting import Prediction

# The network is right about the place of a hinge of which it is so sure, if it is so far from where geometry
# has it: nearer lines are one, which geometry has exactly, and farther ones are at other edges, which it
# confuses in what it does not recognise [shares of the diagonal].
_SURE, _ELSEWHERE, _AT_OTHER_EDGES = 0.8, 0.012, 0.1


def placed(mesh: Mesh, geometry: Sequence[Proposal], said: Prediction, seen: MeshCloud) -> list[Proposal]:
    """What geometry proposes, each hinge at the line that the network is sure of along the same axis.

    What the network is not sure moves counts, too: that it does, geometry says.

    Args:
        mesh: of the faces.
        geometry: proposals.
        said: of the object.
        seen: what was read.
    """
    told = [
        (np.isin(seen.face_piece, part.pieces), joint_of(part, seen))
        for part in (*said.parts, *said.doubtful)
        if part.kind == "revolute" and part.confidence >= _SURE
    ]
    farthest = np.inf if said.recognised else _AT_OTHER_EDGES

    def line(one: Proposal) -> Joint:
        for faces, joint in told:
            if along(one.joint, joint) and overlap(mesh, one.faces, faces) >= SAME:
                return _at(one.joint, joint, _ELSEWHERE * mesh.diagonal, farthest * mesh.diagonal)
        return one.joint

    return [replace(one, joint=line(one)) for one in geometry]


def _at(exact: Joint, told: Joint, nearest: float, farthest: float) -> Joint:
    """A hinge, moved to another line along its axis if that is so far from it [m]."""
    off = np.subtract(told.origin, exact.origin)
    apart = float(np.linalg.norm(np.cross(off, exact.axis)))
    if not nearest <= apart <= farthest:
        return exact
    return replace(exact, origin=told.origin, evidence=(*exact.evidence, *told.evidence))
