"""Points of an Articulation, part by part, so that small parts have enough to be measured by."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ..arrays import FloatArray, IntArray, frozen_floats, frozen_ints
from ..sweeping import sample_faces
from ..triangles import unit_normals
from .articulation import Articulation


@dataclass(frozen=True, eq=False)
class Cloud:
    """Points of a surface.

    Attributes:
        points: (N, 3), in the frame of what they are of.
        labels: (N,) link of each, -1 for none.
        weights: (N,) area that each stands for; a share of the points, where there is no surface.
    """

    points: FloatArray
    labels: IntArray
    weights: FloatArray

    def of(self, link: int) -> Cloud:
        """The points of one link; none for a link without surface."""
        mine = self.labels == link
        return Cloud(self.points[mine], self.labels[mine], self.weights[mine])


@dataclass(frozen=True, eq=False)
class Samples:
    """Points, and the surface that each lies on.

    Attributes:
        cloud: the points.
        triangles: (N, 3, 3) the one that each lies on; None where there is no surface.
        normals: (N, 3) unit normals of those; 0 where there is no surface.
    """

    cloud: Cloud
    triangles: FloatArray | None
    normals: FloatArray


def sampled(value: Articulation, labels: IntArray, points: int, least: int, seed: int) -> Samples:
    """Points of every label by its area, but no fewer than `least`.

    Args:
        value: surface or points.
        labels: (F,) or (V,), one a face or point.
        points: how many in all, about.
        least: of every label; a point cloud has no more than its own.
        seed: of the random numbers.
    """
    rng = np.random.default_rng(seed)
    order = np.argsort(labels, kind="stable")
    groups = np.split(order, np.flatnonzero(np.diff(labels[order])) + 1)
    clouds, sources = [], []
    for group in groups:
        own = value.weights[group].sum()
        count = max(least, math.ceil(points * own / value.weights.sum()))
        source, places = (_drawn if value.is_cloud else _spread)(value, group, count, rng)
        share = np.full(len(places), own / max(len(places), 1))
        clouds.append((places, labels[source], share))
        sources.append(source)
    places, names, shares = (np.concatenate(column) for column in zip(*clouds, strict=True))
    cloud = Cloud(frozen_floats(places), frozen_ints(names), frozen_floats(shares))
    if value.is_cloud:
        return Samples(cloud, None, np.zeros_like(places))
    triangles = value.triangles[np.concatenate(sources)]
    return Samples(cloud, triangles, unit_normals(triangles))


def _spread(
    value: Articulation, faces: IntArray, count: int, rng: np.random.Generator
) -> tuple[IntArray, FloatArray]:
    """(N,) faces and (N, 3) points on them, evenly in cumulated area; N = count, or 0 without area."""
    chosen, points = sample_faces(value.triangles[faces], count, rng)
    return faces[chosen], points


def _drawn(
    value: Articulation, points: IntArray, count: int, rng: np.random.Generator
) -> tuple[IntArray, FloatArray]:
    """(N,) of the points given, and where they are: all of them, or as many as `count`."""
    chosen = points if len(points) <= count else np.sort(rng.choice(points, count, replace=False))
    return chosen, value.vertices[chosen]
