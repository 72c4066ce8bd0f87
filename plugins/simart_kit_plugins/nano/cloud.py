"""A surface as points that know their piece: what the network reads, of meshes and of made-up objects."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from simart_kit.arrays import FloatArray, IntArray

# A piece gets at least so many points however small it is, and at most so many.
_LEAST, _MOST = 6, 160


@dataclass(frozen=True, eq=False)
class Cloud:
    """Points of a surface cut into pieces.

    Attributes:
        points: (N, 3) in the object's frame: its bounding box is centred, its longest side is 1, z is up.
        normals: (N, 3) unit; which way they point says nothing.
        colors: (N, 3) sRGB, 0..1.
        piece: (N,) 0..count-1; every piece has a point.
        area: (N,) surface that each point stands for, as a share of the whole.
        count: number of pieces.
    """

    points: FloatArray
    normals: FloatArray
    colors: FloatArray
    piece: IntArray
    area: FloatArray
    count: int


@dataclass(frozen=True, eq=False)
class Samples:
    """Places on faces.

    Attributes:
        face: (N,) which face.
        weights: (N, 3) of its corners; rows sum to 1.
        area: (N,) surface that each stands for, in square units.
    """

    face: IntArray
    weights: FloatArray
    area: FloatArray


def sample_pieces(areas: FloatArray, piece: IntArray, count: int, generator: np.random.Generator) -> Samples:
    """Places on all pieces, in proportion to the square root of their area: small pieces count for more.

    Args:
        areas: (F,) of the faces.
        piece: (F,) of the faces, each of 0..max in use.
        count: how many places, about.
        generator: of the places.
    """
    order = np.argsort(piece, kind="stable")
    sizes = np.maximum(areas[order], 1e-12 * max(areas.sum(), 1e-300))
    total = np.bincount(piece[order], sizes)
    share = np.sqrt(total)
    wanted = np.clip(np.round(count * share / share.sum()), _LEAST, _MOST).astype(np.int64)
    ends = np.cumsum(sizes)
    starts = np.r_[0.0, np.cumsum(total)[:-1]]
    owner = np.repeat(np.arange(len(total)), wanted)
    rank = np.arange(len(owner)) - np.repeat(np.cumsum(wanted) - wanted, wanted)
    along = starts[owner] + total[owner] * (rank + generator.random(len(owner))) / wanted[owner]
    face = order[np.minimum(np.searchsorted(ends, along), len(order) - 1)]
    return Samples(face, _corner_weights(len(face), generator), total[owner] / wanted[owner])


def sample_evenly(areas: FloatArray, count: int, generator: np.random.Generator) -> Samples:
    """`count` places, each as likely to be anywhere on the surface."""
    ends = np.cumsum(areas)
    along = ends[-1] * (np.arange(count) + generator.random(count)) / count
    face = np.minimum(np.searchsorted(ends, along), len(areas) - 1)
    return Samples(face, _corner_weights(count, generator), np.full(count, ends[-1] / count))


def _corner_weights(count: int, generator: np.random.Generator) -> FloatArray:
    """(N, 3) uniform in a triangle."""
    root, along = np.sqrt(generator.random(count)), generator.random(count)
    return np.column_stack([1 - root, root * (1 - along), root * along])
