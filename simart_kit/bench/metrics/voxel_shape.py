"""Overlap of parts as voxels, where meshes have no faces in common."""

from __future__ import annotations

import numpy as np

from ...arrays import BoolArray, FloatArray, IntArray
from ...voxels import GridFrame, voxelise
from ..articulation import Articulation

_BORDER = 1e-9  # cells by which a point may lie outside the cube: rounding


def part_grids(articulation_in_unit_frame: Articulation, resolution: int = 64) -> BoolArray:
    """Which cells of the cube [-0.5, 0.5]^3 the surface of each link touches; what lies outside is cut off.

    Cells that a triangle only touches at their border count, too; of a point cloud, those that hold a point.

    Returns:
        (L, R, R, R) with R = `resolution`; nothing for a link without faces.
    """
    value = articulation_in_unit_frame
    frame = GridFrame((-0.5, -0.5, -0.5), 1.0 / resolution, resolution)
    grids = np.zeros((len(value.links),) + (resolution,) * 3, dtype=np.bool_)
    for link in range(len(value.links)):
        mine = value.labels == link
        if value.is_cloud:
            grids[(link, *_cells(value.vertices[mine], frame).T)] = True
        else:
            grids[link] = voxelise(value.triangles[mine], frame).occupancy
    return grids


def voxel_iou(a: BoolArray, b: BoolArray) -> float:
    """Intersection over union of two grids of one shape, by number of cells; 0..1.

    1 when both are empty: nothing was missed and nothing invented.
    """
    union = int((a | b).sum())
    return int((a & b).sum()) / union if union else 1.0


def _cells(points: FloatArray, frame: GridFrame) -> IntArray:
    """(K, 3) whole cells of the points inside the cube; its upper border belongs to the last cells."""
    place = frame.to_grid(points)
    inside = ((place >= -_BORDER) & (place <= frame.resolution + _BORDER)).all(axis=1)
    return np.floor(place[inside]).astype(np.int64).clip(0, frame.resolution - 1)
