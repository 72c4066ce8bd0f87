"""Overlay: two articulations of an object laid over each other, as samples to compare parts by."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from ..arrays import FloatArray, IntArray, frozen_floats, frozen_ints
from .articulation import Articulation
from .frame import same_faces
from .sampling import Cloud, Samples, sampled

_DENSER = 4  # times as many points to look labels up among
_TRIED = 16  # points looked at for the label of one
_NO_SURFACE = 0.05  # of the truth's longest side: a point farther than this from a surface is not on it
_TOUCHING = 0.0003  # of the truth's longest side: what facing away counts for, as if it were a gap


@dataclass(frozen=True, eq=False)
class Overlay:
    """What overlaps and distances of the parts of a truth and a prediction are counted on.

    Where both are the same faces, overlap counts those, by area. Where not, it counts the points of either
    surface, each with its own label and that of the nearest point of the other surface; the points of the
    truth weigh 1 together, and so do those of the prediction.

    Attributes:
        shared: whether both are the same faces.
        true_labels: (K,) link of the truth, -1 for none or no surface there.
        predicted_labels: (K,) link of the prediction, likewise.
        weights: (K,) what each counts for.
        truth: points to measure distances between; every part has some, by area but no fewer than asked for.
        prediction: likewise; when shared, the same points in the same order, so that the distance of equal
            parts is exactly 0. When not, it is that of two samplings: up to some 0.01 of its size.
    """

    shared: bool
    true_labels: IntArray
    predicted_labels: IntArray
    weights: FloatArray
    truth: Cloud
    prediction: Cloud


def overlay(
    truth: Articulation, prediction: Articulation, *, points: int = 20_000, least: int = 256, seed: int = 0
) -> Overlay:
    """Lay a prediction over the truth; both in the same frame.

    Args:
        truth: what is right.
        prediction: what is scored.
        points: sampled on either surface.
        least: points of every part (when shared: of every true part in every predicted part), however small.
            A point cloud has no more than its own.
        seed: of the sampling; equal seeds give equal samples.
    """
    partner = same_faces(truth, prediction)
    if partner is not None:
        return _shared(truth, prediction.labels[partner], points, least, seed)
    return _separate(truth, prediction, points, least, seed)


def _shared(truth: Articulation, predicted: IntArray, points: int, least: int, seed: int) -> Overlay:
    """The overlay of one surface with two labels a face."""
    columns = int(predicted.max()) + 2
    cells = (truth.labels.astype(np.int64) + 1) * columns + predicted + 1
    both = sampled(truth, cells, points, least, seed)
    true_labels, predicted_labels = np.divmod(both.cloud.labels, columns)
    return Overlay(
        shared=True,
        true_labels=truth.labels,
        predicted_labels=frozen_ints(predicted),
        weights=truth.weights,
        truth=replace(both.cloud, labels=frozen_ints(true_labels - 1)),
        prediction=replace(both.cloud, labels=frozen_ints(predicted_labels - 1)),
    )


def _separate(truth: Articulation, prediction: Articulation, points: int, least: int, seed: int) -> Overlay:
    """The overlay of two surfaces."""
    size = float((truth.bounds[1] - truth.bounds[0]).max())
    clouds, labels = [], []
    for value, other in ((truth, prediction), (prediction, truth)):
        own = sampled(value, value.labels, points, least, seed)
        among = sampled(other, other.labels, _DENSER * points, _DENSER * least, seed + 1)
        clouds.append(own.cloud)
        labels.append(labels_there(own, among, size))
    one, two = clouds
    weights = [one.weights / one.weights.sum(), two.weights / two.weights.sum()]
    return Overlay(
        shared=False,
        true_labels=frozen_ints(np.concatenate([one.labels, labels[1]])),
        predicted_labels=frozen_ints(np.concatenate([labels[0], two.labels])),
        weights=frozen_floats(np.concatenate(weights)),
        truth=one,
        prediction=two,
    )


def labels_there(own: Samples, among: Samples, size: float) -> IntArray:
    """(N,) label of the other surface at each point of one's own; -1 where there is none.

    The nearest sample may be on the far side of a thin gap, so where samples of several parts are near, their
    triangles are measured. Where parts touch, the one is meant that faces the way of the point's own surface.

    Args:
        own: points to be labelled.
        among: points of the other surface with their labels.
        size: longest side of the object.
    """
    from scipy.spatial import cKDTree

    ranks = np.arange(1, min(_TRIED, len(among.cloud.points)) + 1)
    distance, near = map(np.asarray, cKDTree(among.cloud.points).query(own.cloud.points, ranks))
    labels = among.cloud.labels[near]
    found: IntArray = labels[:, 0].copy()
    if among.triangles is not None:
        # A part that is wound inside out here or there mostly faces the other way.
        alike = np.einsum("nx,nx->n", own.normals, among.normals[near[:, 0]])
        sign = np.where(np.bincount(found + 1, alike, among.cloud.labels.max() + 2) < 0, -1.0, 1.0)
        unsure = np.flatnonzero((labels != labels[:, :1]).any(axis=1))
        choice, ways = near[unsure], sign[labels[unsure] + 1, None] * among.normals[near[unsure]]
        turned = ((own.normals[unsure, None] - ways) ** 2).sum(axis=2)
        cost = gaps(own.cloud.points[unsure], among.triangles[choice]) ** 2 + (_TOUCHING * size) ** 2 * turned
        found[unsure] = labels[unsure, cost.argmin(axis=1)]
    found[distance[:, 0] > _NO_SURFACE * size] = -1
    return found


def gaps(points: FloatArray, triangles: FloatArray) -> FloatArray:
    """(N, K) distances of (N, 3) points to (N, K, 3, 3) triangles."""
    from trimesh.triangles import closest_point

    many = np.repeat(points, triangles.shape[1], axis=0)
    with np.errstate(all="ignore"):  # triangles next to no area
        nearest = closest_point(triangles.reshape(-1, 3, 3), many)
    gaps = np.linalg.norm(nearest - many, axis=1)
    return np.where(np.isfinite(gaps), gaps, np.inf).reshape(triangles.shape[:2])
