"""What it costs to end a part along an edge: little at concave creases and at seams of colour."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from simart_kit.arrays import FloatArray, IntArray
from simart_kit.drawing.appearance import Appearance
from simart_kit.mesh import Mesh
from simart_kit.srgb import linear_to_srgb

from .links import Links

# The turn [rad] and the difference of colour (white and black are 1.7 apart) that make an end
# e times cheaper.
# A door ends in the groove behind its front edge: the edge itself, though sharper, must not look as good.
_CONVEX, _CONCAVE, _COLOR = np.pi, np.deg2rad(6.0), 0.02
# What even the likeliest edge costs, as a share of plain surface.
_LEAST = 0.005


def end_costs(mesh: Mesh, near: Links) -> FloatArray:
    """(L,) cost of each link [m]: the length of its edge times a weight 0..1."""
    sharp = np.where(near.turn > 0, near.turn / _CONCAVE, -near.turn / _CONVEX)
    sharp += _color_jumps(mesh, near) / _COLOR
    return near.length * np.maximum(np.exp(-sharp), _LEAST)


def _color_jumps(mesh: Mesh, near: Links) -> FloatArray:
    """(L,) difference of the sRGB colours of the two faces, each averaged over the face."""
    used, ends = np.unique(np.concatenate([near.left, near.right]), return_inverse=True)
    colors = face_colors(mesh, used)
    left, right = ends.reshape(2, -1)
    return np.asarray(np.linalg.norm(colors[left] - colors[right], axis=1))


def face_colors(mesh: Mesh, face: IntArray) -> FloatArray:
    """(N, 3) sRGB colours 0..1 of some faces."""
    looks = Appearance(replace(mesh, normals=np.zeros_like(mesh.vertices)))  # no normal is asked for
    middle = np.full((len(face), 3), 1 / 3, dtype=np.float32)
    footprint = np.sqrt(mesh.face_areas[face]).astype(np.float32)
    return linear_to_srgb(looks.colors(face, middle, footprint)[:, :3].astype(np.float64))
