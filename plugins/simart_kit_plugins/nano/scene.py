"""What the network is given of an object: its cloud, its pieces, and how near these are to each other."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from simart_kit.arrays import Float32Array, FloatArray

from .cloud import Cloud

# Pairs of points farther apart tell nothing of contact.
REACH = 0.06
_NEIGHBOURS = 8
_LEAST = 1e-5
# Columns of `Pieces.own`.
MIDDLE, HALF, SPREAD, FACING, COLOR = slice(0, 3), slice(3, 6), slice(6, 12), slice(12, 18), slice(18, 21)
AREA, FLATNESS = 21, 22
PIECE_NUMBERS, PAIR_NUMBERS, RIVALRY_NUMBERS = 23, 13, 4
# Row of pair numbers that tells how much of one's box is in the other's; the next is the other way round.
WITHIN = 6
# Of pairs: how near is near [sides of the object], and by how much boxes that touch overlap.
NEAR, MARGIN = (0.004, 0.01, 0.03), 0.004
# Middles so far apart are as far as what looks altogether different [sides of the object].
FAR = 0.5


@dataclass(frozen=True, eq=False)
class Pieces:
    """Numbers of pieces and of pairs of them.

    Attributes:
        own: (S, PIECE_NUMBERS) float32: middle, half size, spread, directions, colour, area and flatness.
        gap: (S, S) float32 least distance of sampled points; `REACH` where it is more.
    """

    own: Float32Array
    gap: Float32Array


def pieces_of(cloud: Cloud) -> Pieces:
    """The numbers of a cloud's pieces."""
    low, high = _extremes(cloud)
    share = np.bincount(cloud.piece, cloud.area, cloud.count)
    middle = _means(cloud.points, cloud)
    spread = _means(_products(cloud.points - middle[cloud.piece]), cloud)
    facing = _means(_products(cloud.normals), cloud)
    sizes = np.sqrt(np.abs(spread)) * np.sign(spread)
    flat = facing[:, :3].max(axis=1)
    own = np.column_stack(
        [
            (low + high) / 2,
            (high - low) / 2,
            sizes * 2,
            facing,
            _means(cloud.colors, cloud) - 0.5,
            area_number(share.astype(np.float64)),
            flat,
        ]
    )
    assert own.shape[1] == PIECE_NUMBERS
    return Pieces(own.astype(np.float32), _gaps(cloud))


def area_number(share: FloatArray) -> FloatArray:
    """Shares of the surface as numbers about 0..1 that tell small ones apart."""
    return np.asarray(np.log(share + _LEAST) / 6 + 1)


def area_share(number: FloatArray) -> FloatArray:
    """The inverse of `area_number`."""
    return np.asarray(np.maximum(np.exp((number - 1) * 6) - _LEAST, 0))


def _gaps(cloud: Cloud) -> Float32Array:
    """(S, S) by the nearest few points of each point."""
    from scipy.spatial import cKDTree

    count = min(_NEIGHBOURS + 1, len(cloud.points))
    found_near = cKDTree(cloud.points).query(cloud.points, k=range(1, count + 1), distance_upper_bound=REACH)
    near, other = (np.asarray(value) for value in found_near)
    here = np.repeat(cloud.piece, near.shape[1])
    flat, found = near.ravel(), np.isfinite(near.ravel())
    there = cloud.piece[np.where(found, other.ravel(), 0)]
    gap = np.full((cloud.count, cloud.count), REACH)
    np.minimum.at(gap, (here[found], there[found]), flat[found])
    gap = np.minimum(gap, gap.T)
    np.fill_diagonal(gap, 0)
    return np.asarray(gap, dtype=np.float32)


def _extremes(cloud: Cloud) -> tuple[FloatArray, FloatArray]:
    """(S, 3) lowest and highest corner of each piece."""
    order = np.argsort(cloud.piece, kind="stable")
    starts = np.searchsorted(cloud.piece[order], np.arange(cloud.count))
    points = cloud.points[order]
    return np.minimum.reduceat(points, starts, axis=0), np.maximum.reduceat(points, starts, axis=0)


def _means(values: FloatArray, cloud: Cloud) -> FloatArray:
    """(S, K) mean of (N, K) over the points of each piece."""
    sums = [np.bincount(cloud.piece, column, cloud.count) for column in values.T]
    return np.asarray(np.stack(sums, axis=1) / np.bincount(cloud.piece, minlength=cloud.count)[:, None])


def _products(vectors: FloatArray) -> FloatArray:
    """(N, 6) xx, yy, zz, xy, xz, yz."""
    x, y, z = vectors.T
    return np.column_stack([x * x, y * y, z * z, x * y, x * z, y * z])
