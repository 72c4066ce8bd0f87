"""The two faces of a board, such as a door's leaf or a laptop's screen: one piece, if no way leads over."""

from __future__ import annotations

import numpy as np

from ..arrays import FloatArray, IntArray
from ..rays import Rays
from ..topology import connected
from .graph import SkinGraph, unit

# A board is no thicker than this share of the longest side, and than this one of its own width.
_THICK, _SLENDER = 0.1, 0.35
_LEAST = 0.004  # share of the surface that either face has at least
_ALONG, _FLAT = 0.9, 0.6  # how nearly most of a face looks one way, and what share of it does
_COVERED = 0.6  # share of either face behind which the other one lies
_LOOKS = 200  # places at which a face is looked through


def with_faces_joined(
    graph: SkinGraph, label: IntArray, facing: FloatArray, rays: Rays, face_label: IntArray
) -> IntArray:
    """(V,) labels 0..; flat pieces that lie back to back, with little between them, are one.

    Args:
        graph: of the skin.
        label: (V,) its pieces 0...
        facing: (V, 3) unit, smooth normals.
        rays: that meet the skin's faces.
        face_label: (F,) the piece of each of these.
    """
    covered = _covered(graph, label, facing, rays, face_label) > _COVERED
    one, two = np.nonzero(covered & covered.T)
    joined = connected(len(covered), one, two)
    return np.asarray(np.unique(joined[label], return_inverse=True)[1].reshape(-1))


def _covered(
    graph: SkinGraph, label: IntArray, facing: FloatArray, rays: Rays, face_label: IntArray
) -> FloatArray:
    """(P, P) share of a flat piece close behind which another one lies."""
    area = np.bincount(label, graph.areas)
    sums = [np.bincount(label, graph.areas * column, len(area)) for column in facing.T]
    normal = unit(np.stack(sums, axis=1))
    shares = np.zeros((len(area), len(area)))
    for piece in np.flatnonzero(area > _LEAST * area.sum()):
        members = np.flatnonzero(label == piece)
        flat = members[facing[members] @ normal[piece] > _ALONG]
        if graph.areas[flat].sum() < _FLAT * area[piece]:
            continue
        some = flat[np.linspace(0, len(flat) - 1, min(_LOOKS, len(flat))).astype(int)]
        starts = graph.places[some] - 0.1 * graph.spacing * normal[piece]
        met, distance = rays.first(starts, -normal[piece])
        thick = min(_THICK * graph.size, _SLENDER * float(np.sqrt(area[piece])))
        close = (met >= 0) & (distance < thick)
        shares[piece] = np.bincount(face_label[met[close]], minlength=len(area)) / len(some)
    return shares
