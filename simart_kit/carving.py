"""Cutting convex shapes out of convex shapes, so that neighbours which overlap at rest do so no more."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from .arrays import FloatArray
from .asset import Asset, ConvexMesh
from .beside import ALONE, Beside
from .convex_overlap import convex, gap, meets
from .fitting import box_around, fitted
from .hulls import hull_corners, hull_of, volume
from .separation import CLEARANCE, TOLERANCE, overlaps, replaced
from .triangles import areas, unit_normals

WORK = 200
"""Shapes that may be cut out of others in all, as often as they are: what bounds the time."""

_MOST_PLANES = 10  # of what is cut out; rounder shapes are cut out as their box
_THIN = 0.001  # [m] along a cut below which a piece is dropped
_MOSTLY = 0.95  # share of what cuts all around leave with which a single cut will do
_EXACT = 0.999  # share of its box that a piece fills which is one
_SLIVER = 0.01  # share of the shape below which a piece is dropped
_MORE = 48  # shapes that a part may have more for this
_SHORTER = 0.05  # of the object's diagonal that a part's box may lose on a side


def carved_apart(asset: Asset, work: int = WORK, beside: Beside = ALONE) -> Asset:
    """The asset without overlaps at rest: of two parts the one gives way that loses the smaller share.

    It is cut along the planes of the other's shapes; one that has very many by then is only cut smaller, and
    none gives way that would lose much of its extent by it, as one with a pivot within another's blade. What
    turns without end does only if the other cannot: a wheel with a notch does not roll.

    Args:
        asset: with collision shapes.
        work: see `WORK`; pairs that come after it is done stay as they are.
        beside: who tries how it is if the other of two gives way.
    """
    shapes = {part.name: list(part.collision) for part in asset.parts}
    most = {name: len(row) + _MORE for name, row in shapes.items()}
    ends = {name: _ends(row) for name, row in shapes.items() if row}
    rolling = {joint.child for joint in asset.joints if joint.kind == "continuous"}
    for overlap in overlaps(asset):
        if work <= 0:
            break
        one, other = overlap.one, overlap.other
        later = beside.ask(_without, shapes[other], shapes[one], most[other])
        tried = {one: _without(shapes[one], shapes[other], most[one]), other: later.result()}
        work -= sum(spent for _, spent in tried.values())
        made = {giver: row for giver, (row, _) in tried.items()}
        kept = {
            name: _volume(row) / max(_volume(shapes[name]), 1e-12)
            for name, row in made.items()
            if row and np.abs(_ends(row) - ends[name]).max() <= _SHORTER * asset.mesh.diagonal
        }
        if kept:
            giver = max(kept, key=lambda name: (name not in rolling, kept[name]))
            shapes[giver] = made[giver]
    return replaced(asset, {name: tuple(row) for name, row in shapes.items()})


def carved(shape: ConvexMesh, other: ConvexMesh, clearance: float = CLEARANCE) -> tuple[ConvexMesh, ...]:
    """What of a shape lies outside another one, in convex pieces, without slivers.

    Of a single cut and of cuts all around, the one that leaves more is taken, few pieces before many.

    Args:
        shape: that gives way.
        other: what is cut out; of one with many faces, the box around it.
        clearance: how far the pieces stay away from it [m].
    """
    normals, ends = _planes(other)
    single = _single(shape, normals, ends + clearance)
    left = 0.0 if single is None else volume(single)
    if single is not None and left > _MOSTLY * volume(shape):
        return (_fitted(single),)
    around = _around(shape, normals, ends + clearance)
    if single is not None and left > _MOSTLY * _volume(around):
        return (_fitted(single),)
    least = _SLIVER * volume(shape)
    return tuple(_fitted(piece) for piece in around if volume(piece) > least)


def trimmed(shape: ConvexMesh, other: ConvexMesh) -> tuple[ConvexMesh, ...]:
    """What is left of a shape by the one cut that parts it from another and leaves most; may be nothing."""
    normals, ends = _planes(other)
    left = _single(shape, normals, ends + CLEARANCE)
    return () if left is None else (_fitted(left),)


def _single(shape: ConvexMesh, normals: FloatArray, ends: FloatArray) -> ConvexMesh | None:
    """What one cut leaves of a shape: the one that leaves most."""
    best, most = None, 0.0
    for normal, end in zip(normals, ends, strict=True):
        points = _below(shape, -normal, -end)
        held = None if points is None else hull_corners(points)
        if held is not None and held[1] > most:
            best, most = points, held[1]
    return shape if best is shape.vertices else None if best is None else hull_of(best)


def _around(shape: ConvexMesh, normals: FloatArray, ends: FloatArray) -> list[ConvexMesh]:
    """What lies beyond any of some planes, cut off where most stands out first."""
    pieces, rest, open_planes = list[ConvexMesh](), shape, list(range(len(ends)))
    while open_planes:
        reach = [float(convex(rest).extent(normals[[k]])[1][0]) - ends[k] for k in open_planes]
        plane = open_planes.pop(int(np.argmax(reach)))
        if max(reach) <= 0:
            break  # what is left lies inside
        if max(reach) > _THIN:
            piece = _half(rest, -normals[plane], -ends[plane])
            pieces += [] if piece is None else [piece]
        inside = _half(rest, normals[plane], ends[plane])
        if inside is None:
            break
        rest = inside
    return pieces


def _ends(shapes: Sequence[ConvexMesh]) -> FloatArray:
    """(2, 3) lowest and highest corner of the box around shapes [m]."""
    points = np.concatenate([shape.vertices for shape in shapes])
    return np.array([points.min(axis=0), points.max(axis=0)])


def _volume(shapes: Sequence[ConvexMesh]) -> float:
    return sum(map(volume, shapes))


def _without(
    shapes: Sequence[ConvexMesh], taker: Sequence[ConvexMesh], most: int
) -> tuple[list[ConvexMesh], int]:
    """The shapes with another part's cut out, and how often one was; no more than `most` are made smaller."""
    made, spent = list(shapes), 0
    for other in map(convex, taker):
        near = meets(other, np.array([convex(one).bounds for one in made]).reshape(-1, 2, 3)).tolist()
        met = [k for k in near if -gap(convex(made[k]), other, TOLERANCE)[0] > TOLERANCE]
        for k in reversed(met):
            made[k : k + 1] = (carved if len(made) < most else trimmed)(made[k], other.shape)
        spent += len(met)
    return made, spent


def _planes(shape: ConvexMesh) -> tuple[FloatArray, FloatArray]:
    """(N, 3) outward normals and (N,) offsets of the faces of a shape, or of the box around it."""
    triangles = shape.vertices[shape.faces]
    area = areas(triangles)
    triangles = triangles[area > 1e-9 * area.max()]
    normals = unit_normals(triangles)
    ends = np.einsum("ni,ni->n", normals, triangles[:, 0])
    first = np.unique(np.round(normals, 5), axis=0, return_index=True)[1]
    if len(first) > _MOST_PLANES:
        return _planes(box_around(shape.vertices))
    kept = np.sort(first)
    return normals[kept], ends[kept]


def _half(shape: ConvexMesh, axis: FloatArray, end: float) -> ConvexMesh | None:
    """What of a shape lies no farther along a (3,) unit axis than `end` [m]; None where that is nothing."""
    points = _below(shape, axis, end)
    return shape if points is shape.vertices else None if points is None else hull_of(points)


def _below(shape: ConvexMesh, axis: FloatArray, end: float) -> FloatArray | None:
    """(N, 3) points around that, those of the shape where all of it is; None where it is nothing, or thin."""
    height = shape.vertices @ axis - end
    if height.max() <= 0:
        return shape.vertices
    if height.min() > -_THIN:
        return None
    ends = shape.faces[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)
    low, high = ends[(height[ends[:, 0]] <= 0) & (height[ends[:, 1]] > 0)].T
    share = (height[low] / (height[low] - height[high]))[:, None]
    cut = shape.vertices[low] + share * (shape.vertices[high] - shape.vertices[low])
    return np.concatenate([shape.vertices[height <= 0], cut])


def _fitted(piece: ConvexMesh) -> ConvexMesh:
    """A piece as the primitive that it is, or as it is."""
    return piece if piece.primitive else fitted(piece.vertices, volume(piece), _EXACT) or piece
