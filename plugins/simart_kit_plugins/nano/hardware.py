"""What stays with the body although only a moving part holds it: straps, stiles, pointers, handles behind.

A person tells by three things: it lies along the part, not along the rest; nothing else holds it, or the part
could not move past it; and the rest does not stop it on the part's way.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from simart_kit.sweeping import Sweep, sample_faces

from .pooling import stuck
from .proposals import Proposal

if TYPE_CHECKING:
    from simart_kit import Joint, Mesh
    from simart_kit.arrays import BoolArray, FloatArray, IntArray

_SAMPLES, _POINTS = 30_000, 100  # of the surface, and of a piece
_SMALL = 0.2  # of the part's area that a piece may have
_ALONG = 0.9  # share of a piece's points that lie nearer to the part than to the rest
_TOUCH = 0.01  # of the object's diagonal: what is nearer holds


def with_hardware(mesh: Mesh, face_piece: IntArray, proposals: Sequence[Proposal]) -> list[Proposal]:
    """The proposals with the small pieces that only they hold; small movers hang on what they stand before.

    Args:
        mesh: of the faces.
        face_piece: (F,) piece of each face.
        proposals: parts that share no face.
    """
    surface = _Surface(mesh, proposals)
    grown = list(proposals)
    free = np.bincount(face_piece[surface.owner >= 0], minlength=int(face_piece.max()) + 1) == 0
    for piece in np.flatnonzero(free):
        faces = face_piece == piece
        holder = surface.holder(faces, -1)
        if holder is not None:
            grown[holder] = replace(grown[holder], faces=grown[holder].faces | faces)
    for k, proposal in enumerate(proposals):
        if proposal.parent is None and (holder := surface.holder(proposal.faces, k)) is not None:
            grown[k] = replace(grown[k], parent=holder)
    return grown


class _Surface:
    """Points all over an object, and whose they are."""

    def __init__(self, mesh: Mesh, proposals: Sequence[Proposal]) -> None:
        self._mesh, self._proposals = mesh, proposals
        self.owner = np.full(len(mesh.faces), -1)
        for k, proposal in enumerate(proposals):
            self.owner[proposal.faces] = k
        self._areas = [float(mesh.face_areas[p.faces].sum()) for p in proposals]
        self._faces, self._points = sample_faces(mesh.triangles, _SAMPLES, np.random.default_rng(0))

    def holder(self, faces: BoolArray, own: int) -> int | None:
        """The proposal, other than its own (-1 for none), that alone holds (F,) faces; None for the rest."""
        mesh = self._mesh
        area, near = float(mesh.face_areas[faces].sum()), _TOUCH * mesh.diagonal
        corners = mesh.triangles[faces].reshape(-1, 3)
        lower, upper = corners.min(axis=0) - near, corners.max(axis=0) + near
        inside = ((self._points >= lower) & (self._points <= upper)).all(axis=1) & ~faces[self._faces]
        around = self.owner[self._faces[inside]]
        able = [
            k
            for k in np.unique(around)
            if k >= 0 and k != own and area < _SMALL * self._areas[k] and self._proposals[k].parent is None
        ]
        if not able:
            return None
        points = sample_faces(mesh.triangles[faces], _POINTS, np.random.default_rng(0))[1]
        apart = {k: distances(points, self._points[inside][around == k]) for k in able}
        rest = distances(points, self._points[inside][around == -1])
        best = min(able, key=lambda k: float(np.minimum(apart[k], near).sum()))
        if apart[best].min() > near or np.mean(apart[best] < rest) < _ALONG:
            return None
        alone = own < 0 and rest.min() > near
        held = alone or _stops(mesh, self._proposals[best], faces)
        return best if held and _goes_along(mesh, self._proposals[best], faces) else None


def distances(points: FloatArray, others: FloatArray) -> FloatArray:
    """(N,) distance of points to the nearest of others; infinite where there are none."""
    from scipy.spatial import cKDTree

    return np.asarray(cKDTree(others).query(points)[0]) if len(others) else np.full(len(points), np.inf)


def _stops(mesh: Mesh, proposal: Proposal, faces: BoolArray) -> bool:
    """Whether (F,) faces are in a part's way; of what slides, either way, for it may be clasped."""
    joint = proposal.joint
    if joint.limits is None:
        return False
    sweep = Sweep(mesh.vertices, mesh.faces[proposal.faces], mesh.faces[faces])
    ways = (joint, _turned_back(joint)) if joint.kind == "prismatic" else (joint,)
    return any(stuck(way, sweep) for way in ways)


def _goes_along(mesh: Mesh, proposal: Proposal, faces: BoolArray) -> bool:
    """Whether (F,) faces can move as a part does: a rail behind a drawer's front would hit the next one."""
    joint, others = proposal.joint, ~proposal.faces & ~faces
    if joint.limits is None or not others.any():
        return True
    sweep = Sweep(mesh.vertices, mesh.faces[faces], mesh.faces[others], holes=True)
    return not stuck(joint, sweep)


def _turned_back(joint: Joint) -> Joint:
    x, y, z = joint.axis
    return replace(joint, axis=(-x, -y, -z))
