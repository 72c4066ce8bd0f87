"""Small patches of one direction and colour: pieces of a skin that nothing else cuts."""

from __future__ import annotations

import numpy as np

from simart_kit.arrays import FloatArray, IntArray

# How far apart a right angle and black and white are, in sides of the object.
_NORMAL, _COLOR = 0.12, 0.15
_ROUNDS = 2


def superfaces(
    points: FloatArray, normals: FloatArray, colors: FloatArray, count: int, generator: np.random.Generator
) -> tuple[IntArray, FloatArray]:
    """Cluster (N, 3) points by place, direction and colour, from random ones of them.

    Args:
        points: (N, 3), the object's longest side is 1.
        normals: (N, 3) unit; opposite ones are far apart, as the sides of a thin board are.
        colors: (N, 3) 0..1.
        count: at most so many patches.
        generator: of the start.

    Returns:
        (N,) patch of each point, 0.. without gaps, and (K, 9) their middles, for `nearest_superface`.
    """
    from scipy.spatial import cKDTree

    features = _features(points, normals, colors)
    start = generator.choice(len(features), min(count, len(features)), replace=False)
    middles = features[np.sort(start)]
    for _ in range(_ROUNDS):
        owner = np.asarray(cKDTree(middles).query(features)[1])
        sizes = np.bincount(owner, minlength=len(middles))
        sums = np.stack([np.bincount(owner, column, len(middles)) for column in features.T], axis=1)
        middles = sums[sizes > 0] / sizes[sizes > 0, None]
    owner = np.asarray(cKDTree(middles).query(features)[1])
    used, owner = np.unique(owner, return_inverse=True)
    return owner.reshape(-1), middles[used]


def nearest_superface(
    middles: FloatArray, points: FloatArray, normals: FloatArray, colors: FloatArray
) -> IntArray:
    """(N,) the patch that each further point belongs to."""
    from scipy.spatial import cKDTree

    return np.asarray(cKDTree(middles).query(_features(points, normals, colors))[1])


def _features(points: FloatArray, normals: FloatArray, colors: FloatArray) -> FloatArray:
    return np.hstack([points, _NORMAL * normals, _COLOR * colors])
