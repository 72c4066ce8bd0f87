"""The part at any place of a skin: that of the nearest patch."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from simart_kit.arrays import FloatArray, IntArray
from simart_kit.drawing.appearance import Appearance
from simart_kit.mesh import Mesh
from simart_kit.srgb import linear_to_srgb

from ..superfaces import nearest_superface
from .cutting import PartAt


def patch_parts(mesh: Mesh, middles: FloatArray, patch_part: IntArray) -> PartAt:
    """A function that tells parts at places.

    Args:
        mesh: the skin.
        middles: (K, 9) of its patches, as `superfaces` gives them for points whose longest side is 1 about 0.
        patch_part: (K,) the part of each patch.
    """
    looks = Appearance(replace(mesh, normals=np.zeros_like(mesh.vertices)))  # no normal is asked for
    center = mesh.bounds.mean(axis=0)
    size = float(np.ptp(mesh.bounds, axis=0).max())
    # Texture is averaged over about as much as a thousandth of the side.
    footprint = 1e-3 * size

    def part_at(face: IntArray, weights: FloatArray) -> IntArray:
        places = np.einsum("nk,nkx->nx", weights, mesh.triangles[face])
        wide = np.full(len(face), footprint, dtype=np.float32)
        linear = looks.colors(face, weights.astype(np.float32), wide)[:, :3]
        colors = linear_to_srgb(linear.astype(np.float64))
        nearest = nearest_superface(middles, (places - center) / size, mesh.face_normals[face], colors)
        return np.asarray(patch_part[nearest])

    return part_at


def patch_size(mesh: Mesh, patches: int) -> float:
    """Side of a square as large as the mean patch [m]."""
    return float(np.sqrt(mesh.face_areas.sum() / max(patches, 1)))
