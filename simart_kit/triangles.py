"""Triangles as (F, 3, 3) corners: which way they face, and how large they are."""

from __future__ import annotations

import numpy as np

from .arrays import FloatArray, units


def crosses(triangles: FloatArray) -> FloatArray:
    """(F, 3) normals towards where the corners run counter-clockwise, as long as twice the area."""
    return np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])


def areas(triangles: FloatArray) -> FloatArray:
    """(F,) areas, in square units."""
    return np.asarray(0.5 * np.linalg.norm(crosses(triangles), axis=1))


def unit_normals(triangles: FloatArray) -> FloatArray:
    """(F, 3) unit normals; zero for a triangle without area."""
    return units(crosses(triangles))
