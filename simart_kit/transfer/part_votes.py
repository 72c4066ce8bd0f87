"""Face labels from votes: of a face's corners, of points inside large faces, of the faces of a segment."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ..arrays import BoolArray, Float32Array, FloatArray, IntArray
from ..triangles import areas, chunks

# Points inside one face, and inside all faces together, at most; a large face still gets one.
_MOST_A_FACE, _MOST = 512, 300_000
# Fractional steps of the plastic-number sequence, which fills a square evenly.
_STEPS = np.array([0.7548776662466927, 0.5698402909980532])
# Corners this sure of the same part leave a face no choice.
_SURE = 0.75


@dataclass(frozen=True, eq=False)
class Ballot:
    """What the voters of each face said.

    Attributes:
        label: (F,) part with most votes, the lowest where several have as many.
        margin: (F,) share of the votes by which it leads the second, 0..1.
        tied: (T,) faces where others are next to the part that leads.
        contenders: (T, P) which parts lead there, or are next to it.
    """

    label: IntArray
    margin: FloatArray
    tied: IntArray
    contenders: BoolArray


@dataclass(frozen=True, eq=False)
class InsidePoints:
    """Points spread over the faces that are too large for their corners to speak for.

    Attributes:
        faces: (B,) ids of those faces, ascending.
        start: (B,) where the points of each begin; it has at least one.
        points: (N, 3) [m].
    """

    faces: IntArray
    start: IntArray
    points: FloatArray

    @property
    def counts(self) -> IntArray:
        """(B,) number of points in each face."""
        return np.asarray(np.diff(np.r_[self.start, len(self.points)]))

    def sums(self, values: Float32Array) -> Float32Array:
        """(B, K) sum over each face of (N, K) values."""
        if not len(self.faces):
            return np.zeros((0, values.shape[1]), dtype=np.float32)
        return np.asarray(np.add.reduceat(values, self.start, axis=0))


def inside_points(points: FloatArray, faces: IntArray, spacing: float) -> InsidePoints:
    """Points about `spacing` [m] apart inside the faces that extend further than that along an axis."""
    large = np.flatnonzero(_extent(points, faces) > spacing)
    corners = points[faces[large]]
    across = np.linalg.norm(corners - corners[:, [1, 2, 0]], axis=2).max(axis=1, initial=0.0)
    wanted = np.ceil(np.clip(np.maximum(areas(corners) / spacing**2, across / spacing), 1, _MOST_A_FACE))
    wanted = np.maximum(wanted * min(1.0, _MOST / max(wanted.sum(), 1.0)), 1).astype(np.int64)
    start = np.cumsum(wanted) - wanted
    triangle = np.repeat(np.arange(len(large)), wanted)
    rank = np.arange(len(triangle)) - start[triangle]
    along = (0.5 + (rank[:, None] + 1) * _STEPS) % 1.0
    along = np.where(along.sum(axis=1, keepdims=True) > 1, 1 - along, along)
    weights = np.column_stack([1 - along.sum(axis=1), along])
    return InsidePoints(large, start, np.einsum("nk,nkx->nx", weights, corners[triangle]))


def _extent(points: FloatArray, faces: IntArray) -> Float32Array:
    """(F,) longest side of each face's bounding box [m], in single precision."""
    columns = [(column - column.mean()).astype(np.float32) for column in points.T]
    longest = np.zeros(len(faces), dtype=np.float32)
    for some in chunks(len(faces)):
        corners = np.ascontiguousarray(faces[some].T)
        for column in columns:
            a, b, c = (column.take(corner) for corner in corners)
            side = np.maximum(np.maximum(a, b), c) - np.minimum(np.minimum(a, b), c)
            np.maximum(longest[some], side, out=longest[some])
    return longest


def unanimous(likely: Float32Array, faces: IntArray) -> tuple[IntArray, BoolArray]:
    """(F,) part that a face's first corner is sure of, -1 if none, and whether the others agree."""
    sure = np.flatnonzero(likely >= _SURE)
    vertex = sure // likely.shape[1]
    told = np.full(len(likely), -1, dtype=np.int64)
    told[vertex] = sure - vertex * likely.shape[1]
    a, b, c = told.take(faces).T
    return a, (a == b) & (b == c) & (a >= 0)


def vote(likely: Float32Array, faces: IntArray, tie: float, large: IntArray, sums: Float32Array) -> Ballot:
    """Let the corners of each face vote, and in large faces the points inside, each with its probabilities.

    Args:
        likely: (V, P) at the vertices.
        faces: (F, 3) vertex ids.
        tie: share of the votes that a contender may be behind.
        large: (B,) faces with points inside.
        sums: (B, P) of the probabilities at their points.
    """
    votes = np.zeros((len(faces), likely.shape[1]), dtype=np.float32)
    for some in chunks(len(faces)):
        for corner in faces[some].T:
            votes[some] += likely.take(corner, axis=0)
    votes[large] += sums
    votes /= np.einsum("ij->i", votes)[:, None]
    label = votes.argmax(axis=1)
    rows = np.arange(len(faces))
    top = votes[rows, label]
    votes[rows, label] = 0
    second = votes[rows, votes.argmax(axis=1)]
    tied = np.flatnonzero(second > top - tie)
    contenders = votes[tied] > (top[tied] - tie)[:, None]
    contenders[np.arange(len(tied)), label[tied]] = True
    return Ballot(label, (top - second).astype(np.float64), tied, contenders)


def agree_in_segments(
    label: IntArray, weight: FloatArray, segment: IntArray, count: int, agreement: float
) -> IntArray:
    """(F,) labels where every segment that agrees overwhelmingly has one; no part loses its last face by it.

    Args:
        label: (F,) parts 0..count-1.
        weight: (F,) what each face's label counts.
        segment: (F,) segments 0...
        count: number of parts.
        agreement: share of a segment's weight that the first part needs.
    """
    pair = segment * np.int64(count) + label
    shape = (int(segment.max()) + 1, count)
    table = np.bincount(pair, weight, math.prod(shape)).reshape(shape)
    faces = np.bincount(pair, minlength=math.prod(shape)).reshape(shape)
    winner = table.argmax(axis=1)
    unified = table.max(axis=1) >= agreement * table.sum(axis=1)
    minority = table.copy()
    minority[np.arange(len(table)), winner] = 0
    unified &= (minority <= (1 - agreement) * table.sum(axis=0)).all(axis=1)
    # What becomes of each part's faces in each segment.
    agreed = np.where(unified[:, None], winner[:, None], np.arange(count))
    lost = (faces.sum(axis=0) > 0) & (np.bincount(agreed.ravel(), faces.ravel(), count) == 0)
    agreed[:, lost] = np.flatnonzero(lost)
    return np.asarray(agreed.ravel().take(pair))
