"""Divided faces put together again wherever all their pieces are of one part."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from simart_kit.arrays import BoolArray, IntArray
from simart_kit.mesh import Mesh

from .halving import Pieces
from .polygons import triangulated


def whole_again(steps: Sequence[Pieces], label: IntArray) -> tuple[Mesh, IntArray, IntArray]:
    """Undo divisions that no end of a part needs.

    A face that meets a divided one keeps the corners on the side that they share.

    Args:
        steps: from the undivided mesh on, each a division of the one before.
        label: (F,) part of each face of the last one.

    Returns:
        The mesh, and (G,) source and part of each of its faces.
    """
    faces, source, part = _largest(steps, label)
    last = steps[-1]
    used = np.zeros(int(last.vertex.max()) + 1, dtype=np.bool_)
    used[last.vertex[faces]] = True
    middles = _middles(last, len(steps[0].mesh.vertices))
    face, corners = _conforming(last, faces, used, middles)
    source, part = source[face], part[face]
    return _compact(last.mesh, len(steps[0].mesh.vertices), corners), source, part


def _largest(steps: Sequence[Pieces], label: IntArray) -> tuple[IntArray, IntArray, IntArray]:
    """(G, 3) corners, source and part of the largest pieces that are of one part each."""
    corners, sources, parts = [], [], []
    pure = np.ones(len(label), dtype=np.bool_)
    for fine, coarse in zip(reversed(steps), [*reversed(steps[:-1]), None], strict=True):
        if coarse is None:
            above = np.zeros(len(label), dtype=np.bool_)
        else:
            above, label_above = _unanimous(fine.parent, label, pure, len(coarse.mesh.faces))
        kept = pure & ~(above[fine.parent] if coarse is not None else above)
        corners.append(fine.mesh.faces[kept])
        sources.append(fine.source[kept])
        parts.append(label[kept])
        if coarse is not None:
            pure, label = above, label_above
    return np.concatenate(corners), np.concatenate(sources), np.concatenate(parts)


def _unanimous(parent: IntArray, label: IntArray, pure: BoolArray, count: int) -> tuple[BoolArray, IntArray]:
    """(count,) whether all pieces of a face are of one part, and the part of its first piece."""
    first = np.unique(parent, return_index=True)[1]
    lead = label[first]
    bad = ~pure | (label != lead[parent])
    return np.bincount(parent, bad, count) == 0, lead


def _middles(last: Pieces, old: int) -> dict[tuple[int, int], int]:
    """The vertex half-way between two, lower first."""
    rows = np.sort(last.ends, axis=1).tolist()
    return {(low, high): old + number for number, (low, high) in enumerate(rows)}


def _conforming(
    last: Pieces, faces: IntArray, used: BoolArray, middles: dict[tuple[int, int], int]
) -> tuple[IntArray, IntArray]:
    """(H,) face and (H, 3) corners of triangles that have all used vertices on their sides as corners."""
    count = len(last.mesh.vertices)
    ends = np.sort(last.ends, axis=1)
    known = np.unique(ends[:, 0] * count + ends[:, 1])
    after = np.roll(faces, -1, axis=1)
    sides = np.minimum(faces, after).astype(np.int64) * count + np.maximum(faces, after)
    touched = np.isin(sides, known).any(axis=1)
    plain = np.flatnonzero(~touched)
    face, corners = [plain], [faces[plain]]
    for index in np.flatnonzero(touched).tolist():
        polygon, side = [], []
        for number in range(3):
            start, end = int(faces[index, number]), int(after[index, number])
            between = _between(start, end, last.vertex, used, middles)
            polygon += [start, *between]
            side += [1 << number | 1 << (number + 2) % 3] + [1 << number] * len(between)
        triangles = triangulated(last.mesh.vertices[polygon], side)
        corners.append(np.array(polygon)[triangles])
        face.append(np.full(len(triangles), index))
    return np.concatenate(face), np.concatenate(corners)


def _between(
    start: int, end: int, vertex: IntArray, used: BoolArray, middles: dict[tuple[int, int], int]
) -> list[int]:
    """The used vertices between two, in order."""
    middle = middles.get((min(start, end), max(start, end)))
    if middle is None:
        return []
    before = _between(start, middle, vertex, used, middles)
    after = _between(middle, end, vertex, used, middles)
    return before + [middle] * bool(used[vertex[middle]]) + after


def _compact(fine: Mesh, old: int, faces: IntArray) -> Mesh:
    """The first vertices, those of the others that are used, and the faces on them, without materials."""
    kept = np.ones(len(fine.vertices), dtype=np.bool_)
    kept[old:] = False
    kept[faces] = True
    chosen, place = np.flatnonzero(kept), np.cumsum(kept) - 1
    return replace(
        fine,
        vertices=fine.vertices[chosen],
        faces=place[faces],
        normals=None if fine.normals is None else fine.normals[chosen],
        uv=None if fine.uv is None else fine.uv[chosen],
        colors=None if fine.colors is None else fine.colors[chosen],
        face_material=np.zeros(len(faces), dtype=np.int64),
        face_node=None,
    )
