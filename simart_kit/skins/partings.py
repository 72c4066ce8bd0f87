"""Fronts between which a skin has closed the gap: cut half-way between their handles.

Two handles close together, each the other's mirror image, are those of a double door, or of a door above
another, and a lever that ends at the middle of a board is that of the leaf that opens first; rows of handles
at one pitch are those of drawers.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from ..arrays import FloatArray, IntArray
from .graph import SkinGraph

_LEAST = 0.05  # share of the surface that such a front has
_ALONG, _FLAT = 0.9, 0.6  # how nearly most of it looks one way, and what share of it does
_FACE = 0.2  # share of it that looks to the side of the handles
_LEVEL = 0.2  # how far it may lean
_ENDS = 0.01  # share of its vertices at either end that its extents leave out: the rims of skins are ragged
_OUT, _REACH = 0.007, 0.15  # how far out of the front handles stand at least and at most [longest sides]
_SMALL, _THIN = 0.9, 0.15  # shares of the front's extents, the longer and the shorter, that a handle takes
_SAME = 0.012  # by which handles may differ in size and be out of line [longest sides]
_CLOSE = 0.35  # share of the front's extent that handles beside their parting are apart at most
_EVEN = 0.12  # share of their pitch by which rows of handles may be off
_RIM = 0.025  # so near to the edge of a front, mouldings and frames stand out [longest sides]
_NEAR = 0.035  # share of its width between a lever and the edge of its leaf
_MOST = 20  # so many handles tell nothing
_MIDDLE = 0.05  # share of its width by which a double door may be parted off the middle


@dataclass(frozen=True, eq=False)
class _Face:
    """One side of a front, in (u, v, w): across, up and out.

    Attributes:
        axes: (3, 3) rows u, v, w.
        lower: (2,) corner [u, v].
        size: (2,) extents.
        level: where it lies [w].
        inside: (N, 2) places of its vertices [u, v].
        board: whether its other side is of the same piece.
    """

    axes: FloatArray
    lower: FloatArray
    size: FloatArray
    level: float
    inside: FloatArray
    board: bool


def with_fronts_parted(graph: SkinGraph, label: IntArray, facing: FloatArray) -> IntArray:
    """(V,) labels 0..; upright pieces are cut where the places of their handles tell that fronts meet.

    Args:
        graph: of the skin.
        label: (V,) its pieces 0...
        facing: (V, 3) unit, smooth normals.
    """
    area, result = np.bincount(label, graph.areas), label.copy()
    for piece in np.flatnonzero(area > _LEAST * area.sum()):
        members = np.flatnonzero(label == piece)
        for face in _faces(graph, facing, members):
            handles = _handles(graph, face)
            axis, lines = _partings(face, handles, graph.size)
            if len(lines):
                small = np.flatnonzero(area < _SMALL * area[piece])
                for one in (piece, *small[np.isin(small, label[_within(graph, face, handles)])]):
                    members = np.flatnonzero(label == one)
                    side = np.searchsorted(lines, graph.places[members] @ face.axes[axis])
                    result[members[side > 0]] = result.max() + side[side > 0]
                break
    return np.asarray(np.unique(result, return_inverse=True)[1].reshape(-1))


def _within(graph: SkinGraph, face: _Face, handles: FloatArray) -> IntArray:
    """Vertices of the handles."""
    places = graph.places @ face.axes.T
    out = np.flatnonzero(places[:, 2] > face.level + _OUT * graph.size)
    low, high = handles[:, 0], handles[:, 1]
    at = places[out, None, :2]
    within = np.all((at >= low) & (at <= high), axis=2)
    return np.asarray(out[np.any(within, axis=1)])


def _faces(graph: SkinGraph, facing: FloatArray, members: IntArray) -> Iterator[_Face]:
    """The upright sides of a flat piece: one, or both of a board."""
    areas, normals = graph.areas[members], facing[members]
    normal = np.linalg.eigh(normals.T @ (areas[:, None] * normals))[1][:, 2]
    if abs(normal[2]) > _LEVEL:
        return
    normal = np.array([*normal[:2], 0.0]) / np.linalg.norm(normal[:2])
    along = normals @ normal
    if areas[np.abs(along) > _ALONG].sum() < _FLAT * areas.sum():
        return
    sides = [sign for sign in (1.0, -1.0) if areas[sign * along > _ALONG].sum() > _FACE * areas.sum()]
    for sign in sides:
        out, up = sign * normal, np.array([0.0, 0.0, 1.0])
        axes = np.stack([np.cross(up, out), up, out])
        places = graph.places[members[sign * along > _ALONG]] @ axes.T
        lower, upper = np.quantile(places[:, :2], [_ENDS, 1 - _ENDS], axis=0)
        level = float(np.median(places[:, 2]))
        yield _Face(axes, lower, upper - lower, level, places[:, :2], len(sides) > 1)


def _handles(graph: SkinGraph, face: _Face) -> FloatArray:
    """(H, 2, 2) lower and upper corners [u, v] of the small things that stand out of a face."""
    places = graph.places @ face.axes.T
    height = (places[:, 2] - face.level) / graph.size
    rim = _RIM * graph.size
    lower, upper = face.lower + rim, face.lower + face.size - rim
    out = ((places[:, :2] > face.lower) & (places[:, :2] < upper + rim)).all(axis=1) & (height > _OUT)
    if not out.any():
        return np.zeros((0, 2, 2))
    label = np.where(out, graph.pieces(~out), -1)
    found = []
    for one in np.unique(label[out]):
        own = places[label == one]
        low, high = own[:, :2].min(axis=0), own[:, :2].max(axis=0)
        shares = np.sort((high - low) / face.size)
        reach = (own[:, 2].max() - face.level) / graph.size
        small = shares[1] < _SMALL and shares[0] < _THIN and reach < _REACH
        wide = (high - low).max() > 2 * graph.spacing and (low > lower).all() and (high < upper).all()
        slack = 2 * graph.spacing
        beside = (face.inside > low - slack) & (face.inside < high + slack)
        if small and wide and beside.all(axis=1).any():
            found.append((low, high))
    return np.array(found).reshape(-1, 2, 2)


def _partings(face: _Face, handles: FloatArray, size: float) -> tuple[int, FloatArray]:
    """The axis, 0 or 1, along which fronts lie side by side, and (N,) where they meet."""
    middle = np.array([face.lower[0] + face.size[0] / 2])
    if len(handles) == 1 and face.board and _ends_at(handles[0], float(middle[0]), face):
        return 0, middle
    if not 1 < len(handles) < _MOST or np.ptp(handles[:, 1] - handles[:, 0], axis=0).max() > 2 * _SAME * size:
        return 0, np.zeros(0)
    middles = handles.mean(axis=1)
    rows, columns = (_levels(middles[:, axis], _SAME * size) for axis in (1, 0))
    if len(handles) != len(rows) * len(columns):
        return 0, np.zeros(0)
    if len(rows) > 1:
        return 1, _between(rows, float(face.lower[1]), float(face.size[1]))
    central = abs(columns.mean() - middle[0]) < _MIDDLE * face.size[0]
    if len(columns) == 2 and central and np.ptp(columns) < _CLOSE * face.size[0]:
        return 0, columns.mean(keepdims=True)
    return 0, np.zeros(0)


def _ends_at(lever: FloatArray, middle: float, face: _Face) -> bool:
    """Whether a lever reaches from the middle of a face to one side."""
    wide, high = lever[1] - lever[0]
    off = float(np.abs(lever[:, 0] - middle).min())
    beside = abs(float(lever[:, 0].mean()) - middle) > 0.25 * wide
    return bool(wide > 2 * high and beside and off < _NEAR * face.size[0])


def _between(rows: FloatArray, low: float, height: float) -> FloatArray:
    """(N,) where fronts meet that have these rows of handles."""
    pitch, lines = np.diff(rows), (rows[1:] + rows[:-1]) / 2
    mean = float(pitch.mean())
    if len(rows) == 2 and mean < _CLOSE * height:
        return lines
    if np.abs(pitch - mean).max() > _EVEN * mean:
        return np.zeros(0)
    ends = np.array([rows[0] - mean / 2, rows[-1] + mean / 2])
    beyond = np.array([ends[0] - low, low + height - ends[1]])
    if (beyond < -_EVEN * mean).any() or (beyond > mean / 2).any():
        return np.zeros(0)
    plinths = ends[beyond > _EVEN * mean]
    return np.sort(np.concatenate([lines, plinths]))


def _levels(values: FloatArray, apart: float) -> FloatArray:
    """(N,) the different ones among some values."""
    ordered = np.sort(values)
    return np.array(
        [group.mean() for group in np.split(ordered, np.flatnonzero(np.diff(ordered) > apart) + 1)]
    )
