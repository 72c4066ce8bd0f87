"""Hinges that geometry finds, where the network tells that they are: rules know edges, it has seen hinges."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from .proposals import SAME, Proposal, along, joint_of, overlap

if TYPE_CHECKING:
    from simart_kit import Joint, Mesh
    from simart_kit.arrays import BoolArray

    from .meshes import MeshCloud
    from .predicting import Prediction

# The network is right about the place of a hinge of which it is so sure, if it is so far from where geometry
# has it: nearer lines are one, which geometry has exactly, and farther ones are at other edges, which it
# confuses in what it does not recognise [shares of the diagonal].
_SURE, _ELSEWHERE, _AT_OTHER_EDGES = 0.8, 0.012, 0.1
# What is likely to turn along an edge, and goes no farther from it than this, is a latch there, and no hinge
# [share of the diagonal].
_LIKELY, _LATCH = 0.5, 0.12


def placed(mesh: Mesh, geometry: Sequence[Proposal], said: Prediction, seen: MeshCloud) -> list[Proposal]:
    """What geometry proposes, each hinge at the line that the network is sure of along the same axis.

    What the network is not sure moves counts, too: that it does, geometry says. Nor need it be sure of a line
    in what it recognises, if it has latches where geometry has the hinge.

    Args:
        mesh: of the faces.
        geometry: proposals.
        said: of the object.
        seen: what was read.
    """
    told = [
        (np.isin(seen.face_piece, part.pieces), joint_of(part, seen))
        for part in (*said.parts, *said.doubtful)
        if part.kind == "revolute"
    ]

    def line(one: Proposal) -> Joint:
        at_latch = said.recognised and any(_is_latch(mesh, one, *other) for other in told)
        farthest = np.inf if said.recognised else _AT_OTHER_EDGES
        for faces, joint in told:
            sure = at_latch or joint.confidence >= _SURE
            if sure and along(one.joint, joint) and overlap(mesh, one.faces, faces) >= SAME:
                return _at(one.joint, joint, _ELSEWHERE * mesh.diagonal, farthest * mesh.diagonal)
        return one.joint

    return [replace(one, joint=line(one)) for one in geometry]


def _is_latch(mesh: Mesh, one: Proposal, faces: BoolArray, joint: Joint) -> bool:
    """Whether something else that turns by itself lies along a hinge all over, as latches on an edge do."""
    hinge = one.joint
    if joint.confidence < _LIKELY or not along(hinge, joint) or overlap(mesh, one.faces, faces) >= SAME:
        return False
    off = mesh.points_of(faces) - np.array(hinge.origin)
    return bool(np.linalg.norm(np.cross(off, hinge.axis), axis=1).max() < _LATCH * mesh.diagonal)


def _at(exact: Joint, told: Joint, nearest: float, farthest: float) -> Joint:
    """A hinge, moved to another line along its axis if that is so far from it [m]."""
    off = np.subtract(told.origin, exact.origin)
    apart = float(np.linalg.norm(np.cross(off, exact.axis)))
    if not nearest <= apart <= farthest:
        return exact
    return replace(exact, origin=told.origin, evidence=(*exact.evidence, *told.evidence))
