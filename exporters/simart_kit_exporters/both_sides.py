"""Which parts show the backs of their faces, which renderers leave out unless told otherwise."""

from __future__ import annotations

import numpy as np

from simart_kit.arrays import FloatArray
from simart_kit.asset import Asset
from simart_kit.topology import edges, touching, weld
from simart_kit.triangles import crosses

_WELD = 1e-6  # of the part's size


def two_sided_parts(asset: Asset) -> set[str]:
    """Names of the parts whose surface is open somewhere, or inside out."""
    triangles = asset.mesh.triangles
    return {p.name for i, p in enumerate(asset.parts) if _shows_backs(triangles[asset.face_part == i])}


def _shows_backs(triangles: FloatArray) -> bool:
    """Whether (F, 3, 3) triangles leave an edge that is not walked as often one way as the other."""
    points = triangles.reshape(-1, 3)
    corners = weld(points, _WELD * float(np.linalg.norm(np.ptp(points, axis=0)))).reshape(-1, 3)
    solid = (corners != np.roll(corners, 1, axis=1)).all(axis=1)
    if not solid.any():
        return True
    corners, triangles = corners[solid], triangles[solid]
    edge, way = edges(corners), np.where(corners < np.roll(corners, -1, axis=1), 1, -1)
    if np.bincount(edge.ravel(), way.ravel()).any():
        return True
    middle = points.mean(axis=0)
    heights = np.einsum("ij,ij->i", triangles[:, 0] - middle, crosses(triangles))
    return bool((np.bincount(touching(corners), heights) <= 0).any())
