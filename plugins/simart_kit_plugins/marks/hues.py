"""A colour for every piece: pieces that meet in a picture never look alike."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from simart_kit.arrays import FloatArray, IntArray
from simart_kit.colors import Color

# Far apart in hue or in lightness, none so dark that a black numeral's box drowns in it.
PALETTE: tuple[Color, ...] = (
    (66, 135, 245),
    (245, 150, 30),
    (40, 175, 95),
    (225, 50, 75),
    (150, 85, 225),
    (240, 220, 60),
    (20, 185, 205),
    (235, 120, 200),
    (140, 100, 60),
    (160, 215, 70),
    (20, 75, 150),
    (250, 185, 165),
    (120, 125, 40),
    (130, 25, 85),
    (175, 205, 245),
    (15, 95, 75),
)
_REACH = 6  # pixels over which two pieces count as meeting


def piece_colors(pictures: Sequence[IntArray], count: int) -> tuple[Color, ...]:
    """A colour a piece, larger ones first: as unlike as can be to those that it meets, and seldom used.

    Args:
        pictures: (H, W) piece seen in each pixel, -1 for none.
        count: number of pieces.
    """
    meets = _meetings(pictures, count)
    palette = np.array(PALETTE, dtype=np.float64)
    apart = _apart(palette)
    chosen = np.full(count, -1)
    used = np.zeros(len(palette), dtype=np.int64)
    for piece in range(count):
        beside = chosen[np.flatnonzero(meets[piece] & (chosen >= 0))]
        nearest = apart[:, beside].min(axis=1) if len(beside) else np.full(len(palette), 1.0)
        chosen[piece] = int(np.argmax(np.minimum(nearest, 0.5) - 0.3 * used))
        used[chosen[piece]] += 1
    return tuple(PALETTE[index] for index in chosen)


def _apart(palette: FloatArray) -> FloatArray:
    """(K, K) how unlike colours look, 0..1: distance of their squares, which weighs light differences."""
    weighted = palette / 255.0 * np.sqrt([0.3, 0.5, 0.2])
    return np.asarray(np.linalg.norm(weighted[:, None] - weighted[None], axis=2))


def _meetings(pictures: Sequence[IntArray], count: int) -> np.ndarray[tuple[int, int], np.dtype[np.bool_]]:
    """(N, N) whether two pieces come within a few pixels of each other in some picture."""
    meets = np.zeros((count, count), dtype=np.bool_)
    for picture in pictures:
        for one, two in (
            (picture[:, :-_REACH], picture[:, _REACH:]),
            (picture[:-_REACH], picture[_REACH:]),
            (picture[:, :-1], picture[:, 1:]),
            (picture[:-1], picture[1:]),
        ):
            both = (one >= 0) & (two >= 0) & (one != two)
            meets[one[both], two[both]] = True
    return meets | meets.T
