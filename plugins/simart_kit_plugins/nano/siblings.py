"""Parts alike are one kind of thing: as sure as they are on average, and each with its own surroundings."""

from __future__ import annotations

from collections.abc import Hashable, Sequence

import numpy as np

from simart_kit.arrays import FloatArray, IntArray

from .cloud import Cloud
from .piece_boxes import PieceBoxes, alike

# A part that one of several alike carries is as near to it, of the object's longest side; points lie apart.
_BESIDE = 0.05


def shared_certainty(cloud: Cloud, parts: Sequence[IntArray], certainty: FloatArray) -> FloatArray:
    """(P,) mean certainty of the parts that are shaped alike, which for most is their own.

    Four legs of a stool do not make a door of one of them; four wheels turn if three surely do.

    Args:
        cloud: of the object.
        parts: the pieces of each part.
        certainty: (P,) of each by itself, 0..1.
    """
    if not parts:
        return certainty
    shapes = PieceBoxes.of(cloud).shapes_of(parts)
    same = alike(shapes, shapes)
    return np.asarray(same @ certainty / same.sum(axis=1))


def nearest_carriers(
    cloud: Cloud, parts: Sequence[IntArray], takes: Sequence[Hashable], chance: FloatArray
) -> list[int]:
    """Number from 1 of the part that carries each, 0 for the body: the most likely kind, and its nearest one.

    Which of five casters a wheel turns in is a matter of place, not of what a caster looks like: each of them
    is as likely, and all together may be likelier than the body. One that is far from all of them is carried
    by none.

    Args:
        cloud: of the object.
        parts: the pieces of each part.
        takes: what each is taken for; parts with equal ones are alike.
        chance: (P, P + 1) of being carried by the body, and by each part.
    """
    points = [cloud.points[np.isin(cloud.piece, pieces)] for pieces in parts]
    found = []
    for row, own in enumerate(chance):
        likely = {kind: sum(own[k + 1] for k in _alike(takes, kind, row)) for kind in dict.fromkeys(takes)}
        best = max(likely, key=lambda kind: likely[kind])
        alike = _alike(takes, best, row) if likely[best] > own[0] else []
        gaps = [_gap(points[row], points[k]) for k in alike] if len(alike) > 1 else [0.0] * len(alike)
        near = bool(gaps) and min(gaps) <= _BESIDE
        found.append(alike[int(np.argmin(gaps))] + 1 if near else 0)
    return found


def _alike(takes: Sequence[Hashable], kind: Hashable, but: int) -> list[int]:
    return [k for k, taken in enumerate(takes) if taken == kind and k != but]


def _gap(one: FloatArray, other: FloatArray) -> float:
    """Least distance between (N, 3) and (M, 3) points."""
    from scipy.spatial import cKDTree

    return float(np.min(cKDTree(one).query(other)[0]))
