"""Shells that tell nothing of a skin: the inner sides of its walls, which nobody sees, and strays.

Generators of shapes deliver both. Skins of theirs would be taken for solids that lie apart.
"""

from __future__ import annotations

import numpy as np

from ..arrays import BoolArray, IntArray
from ..mesh import Mesh
from ..rays import Rays
from .fineness import RADIUS, coarseness, is_fine, is_rough
from .refining import longest_side, refined

_MAIN = 0.4  # share of the surface that a skin has at least
_STRAY = 0.001  # share of the surface that a stray has at most
_MOST = 64  # shells that are looked at, the largest
_LOOKS = 48  # faces of a shell from which one looks around
_HIDDEN = 0.9  # share of the ways that something is in, of a hidden one
_UNEVEN = 2.0  # so many times as coarse as the skin a shell is at most, or the skin as it
_WALL = 0.06  # longest sides that are at most between the two sides of a wall
# Along the axes, and between each three of them.
_WAYS = np.array([w for w in np.ndindex(3, 3, 3) if np.count_nonzero(np.array(w) - 1) in (1, 3)]) - 1.0


def aside_of_skin(mesh: Mesh, kept: IntArray, label: IntArray, patch: IntArray) -> BoolArray:
    """(K,) which faces are aside of the largest shell, if that is a skin: finely meshed, or decimated.

    Args:
        mesh: of the faces.
        kept: (K,) ids of the faces.
        label: (K,) shells 0...
        patch: (K,) labels of what creases bound.
    """
    areas = np.bincount(label, mesh.face_areas[kept], 1)
    shells = np.argsort(-areas, kind="stable")
    skin = label == shells[0]
    aside = np.zeros(len(areas), dtype=np.bool_)
    many = len(areas) > 1 and areas[shells[0]] > _MAIN * areas.sum()
    if not many or not (is_fine(mesh, kept[skin]) or is_rough(mesh, kept[skin], patch[skin])):
        return aside[label]
    aside[(areas > 0) & (areas < _STRAY * areas.sum())] = True
    rays, coarse = Rays(mesh.vertices, mesh.faces[kept[skin]]), coarseness(mesh, kept[skin])
    for shell in shells[1:_MOST]:
        own = kept[label == shell]
        if len(own) and 1 / _UNEVEN < coarseness(mesh, own) / coarse < _UNEVEN:
            aside[shell] |= _is_hidden(mesh, own, rays)
    return np.asarray(aside[label])


def _is_hidden(mesh: Mesh, shell: IntArray, rays: Rays) -> bool:
    """Whether hardly a way leads from the (N,) faces of a shell past what the rays meet."""
    some = shell[np.linspace(0, len(shell) - 1, min(_LOOKS, len(shell))).astype(int)]
    starts = np.repeat(mesh.triangles[some].mean(axis=1), len(_WAYS), axis=0)
    return float(rays.blocked(starts, np.tile(_WAYS, (len(some), 1))).mean()) > _HIDDEN


def pieces_before(mesh: Mesh, skin: IntArray, piece: IntArray, aside: IntArray) -> IntArray:
    """(H,) piece of the nearest place of a skin for each face aside; one number more where none is near.

    Args:
        mesh: of the faces.
        skin: (K,) ids of the skin's faces.
        piece: (K,) their pieces 0...
        aside: (H,) ids of faces.
    """
    from scipy.spatial import cKDTree

    size = float(np.ptp(mesh.bounds, axis=0).max())
    longest = longest_side(mesh.vertices, mesh.faces[skin], RADIUS * size)
    fine = refined(mesh.vertices, mesh.faces[skin], longest)
    away, nearest = cKDTree(fine.places[fine.faces].mean(axis=1)).query(mesh.triangles[aside].mean(axis=1))
    return np.where(away < _WALL * size, piece[fine.source[nearest]], int(piece.max()) + 1)
