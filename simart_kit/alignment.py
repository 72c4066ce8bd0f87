"""How an object is turned about the vertical: the direction that its upright faces follow."""

from __future__ import annotations

import numpy as np

from .mesh import Mesh


def yaw(mesh: Mesh) -> float:
    """Turn of the object's upright faces against the axes [rad], in (-pi/4, pi/4].

    The fullest one-degree bin of directions, modulo a quarter turn; 0 where no direction stands out.
    """
    normals, areas = mesh.face_normals, mesh.face_areas
    upright = np.abs(normals[:, 2]) < 0.2
    if areas[upright].sum() < 0.05 * areas.sum():
        return 0.0
    angles = np.arctan2(normals[upright, 1], normals[upright, 0])
    quarter = np.mod(angles + np.pi / 4, np.pi / 2) - np.pi / 4
    weights = areas[upright]
    histogram, edges = np.histogram(quarter, bins=90, range=(-np.pi / 4, np.pi / 4), weights=weights)
    if histogram.max() < 0.25 * weights.sum():
        return 0.0
    middle = (edges[:-1] + edges[1:])[histogram.argmax()] / 2
    near = np.abs(quarter - middle) < np.deg2rad(1.5)
    found = float(np.average(quarter[near], weights=weights[near]))
    return 0.0 if abs(found) < np.deg2rad(0.5) else found
