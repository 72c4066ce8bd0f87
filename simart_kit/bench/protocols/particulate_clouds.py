"""Point clouds of the parts of two objects, and how they move, as Particulate's evaluation compares them."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ...arrays import FloatArray, IntArray
from ...sweeping import move, sample_surface
from ..articulation import Articulation, LinkJoint
from ..frame import same_faces, unit_from_object
from ..states import posed

POINTS = 100_000
STATES = 5


@dataclass(frozen=True, eq=False)
class PartClouds:
    """Points of an object in its own unit box, and its poses.

    Attributes:
        points: (N, 3) at rest, within [-0.5, 0.5].
        labels: (N,) link of each, -1 for none. Those of no link stay where they are.
        poses: (1 + S, L, 4, 4) `posed_T_rest` of each link: at rest and in every state.
    """

    points: FloatArray
    labels: IntArray
    poses: FloatArray

    @cached_property
    def parts(self) -> tuple[int, ...]:
        """Links that have points: one without surface is no part, here as in Particulate's evaluation."""
        return tuple(int(label) for label in np.unique(self.labels) if label >= 0)

    @cached_property
    def part_points(self) -> tuple[FloatArray, ...]:
        """(K, 3) points of each part."""
        return tuple(self.points[self.labels == part] for part in self.parts)

    @property
    def means(self) -> FloatArray:
        """(P, 3) mean of the points of each part."""
        return np.array([points.mean(axis=0) for points in self.part_points]).reshape(-1, 3)

    @property
    def diagonal(self) -> float:
        """Length of the diagonal of the box of all points."""
        return float(np.linalg.norm(np.ptp(self.points, axis=0)))

    def posed(self, state: int) -> FloatArray:
        """(N, 3) all points in a state, 0 for rest."""
        result = self.points.copy()
        for part, points in zip(self.parts, self.part_points, strict=True):
            result[self.labels == part] = move(self.poses[state, part], points)
        return result


def part_clouds(
    truth: Articulation, prediction: Articulation, *, points: int = POINTS, seed: int = 0
) -> tuple[PartClouds, PartClouds]:
    """Both objects as points spread evenly by area, each scaled and moved into [-0.5, 0.5] by its own box.

    Links fixed to each other are one part. Where both are the same faces, both get the same points, so that
    equal parts are exactly equal; the points of a cloud are taken as they are.

    Args:
        truth: in the frame of the prediction or another.
        prediction: likewise.
        points: of each object.
        seed: of the sampling.

    Raises:
        BadInputError: one of them has no surface: none of its faces has an area.
    """
    truth, prediction = (side.rigid().transformed(_unit(side)) for side in (truth, prediction))
    partner = same_faces(truth, prediction)
    if partner is None:
        return _separate(truth, points, seed), _separate(prediction, points, seed)
    other = prediction.labels[partner]
    columns = len(prediction.links) + 1
    places, cells = _sampled(truth, (truth.labels.astype(np.int64) + 1) * columns + other + 1, points, seed)
    one, two = np.divmod(cells, columns)
    return PartClouds(places, one - 1, _poses(truth)), PartClouds(places, two - 1, _poses(prediction))


def travel(joint: LinkJoint) -> tuple[float, float]:
    """Position in the first and in the last state [rad | units]: the limits as they are given.

    A continuous joint without limits turns by (0, 2 pi); other joints without limits stay.
    """
    if joint.lower is not None and joint.upper is not None:
        return (joint.lower, joint.upper)
    return (0.0, 2 * np.pi) if joint.kind == "continuous" else (0.0, 0.0)


def _unit(side: Articulation) -> FloatArray:
    return unit_from_object(side.bounds)


def _poses(side: Articulation) -> FloatArray:
    ways = [travel(link.joint) for link in side.links]
    fractions = np.linspace(0.0, 1.0, STATES)
    moved = [posed(side, [a + f * (b - a) for a, b in ways]) for f in fractions]
    return np.stack([np.tile(np.eye(4), (len(side.links), 1, 1)), *moved])


def _separate(side: Articulation, points: int, seed: int) -> PartClouds:
    places, cells = _sampled(side, side.labels.astype(np.int64) + 1, points, seed)
    return PartClouds(places, cells - 1, _poses(side))


def _sampled(side: Articulation, cells: IntArray, points: int, seed: int) -> tuple[FloatArray, IntArray]:
    """(N, 3) points and the cell (N,) of each: every cell gets its share of `points` by area.

    Args:
        side: a cloud gives its own points, thinned evenly to no more than `points`.
        cells: (F,) or (V,) id of each face, or point of a cloud.
        points: of the whole object.
        seed: of the sampling.
    """
    if side.is_cloud:
        kept = np.unique(np.linspace(0, len(cells) - 1, min(points, len(cells))).astype(np.int64))
        return side.vertices[kept], cells[kept]
    rng = np.random.default_rng(seed)
    ids, group = np.unique(cells, return_inverse=True)
    area = np.bincount(group, side.weights)
    counts = np.rint(points * area / area.sum()).astype(np.int64)
    places = [
        sample_surface(side.triangles[group == index], int(count), rng)
        for index, count in enumerate(counts)
        if count
    ]
    return np.concatenate(places), np.repeat(ids, counts)
