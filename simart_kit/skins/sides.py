"""Sides of a box that rounded edges join in one piece: cut by the way they look."""

from __future__ import annotations

import numpy as np

from ..arrays import FloatArray, IntArray
from ..topology import connected
from .graph import SkinGraph

_ALONG = np.cos(np.deg2rad(20.0))  # to an axis, of what looks along it
_BIG = 0.05  # share of the surface that such a piece has at least
_FLAT = 0.8  # share of it that looks along the axes
_AXIS = 0.25  # share of it that looks along each of two axes, one way or the other


def ways(facing: FloatArray) -> IntArray:
    """(V,) which way (V, 3) unit vectors look: 0..5 for x, -x, y, -y, z and -z, or -1 for between them."""
    axis = np.abs(facing).argmax(axis=1)
    nearest = np.take_along_axis(facing, axis[:, None], axis=1)[:, 0]
    return np.asarray(np.where(np.abs(nearest) > _ALONG, 2 * axis + (nearest < 0), -1))


def with_sides_parted(graph: SkinGraph, label: IntArray, way: IntArray, least: float) -> IntArray:
    """(V,) labels 0..; of what is flat and looks several ways along the axes, each way is a piece.

    Args:
        graph: of the skin.
        label: (V,) its pieces 0...
        way: (V,) which way they look, as `ways` tells it; edges go with the side that reaches them first.
        least: share of the whole surface below which a piece is none.
    """
    area, count = np.bincount(label, graph.areas), int(label.max()) + 1
    shares = np.bincount(label * 7 + way + 1, graph.areas, 7 * count).reshape(count, 7) / area[:, None]
    several = (shares[:, 1::2] + shares[:, 2::2] > _AXIS).sum(axis=1) > 1
    boxy = several & (shares[:, 0] < 1 - _FLAT) & (area > _BIG * area.sum())
    parted = np.where(boxy[label], 7 * label + way + 1, 7 * label)
    a, b = graph.edges.T
    same = parted[a] == parted[b]
    return graph.filled(connected(len(label), a[same], b[same]), boxy[label] & (way < 0), least)
