"""Groups that are several parts: what lies apart and is as large is one part only where that is sure."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from simart_kit.arrays import FloatArray, IntArray

from .cloud import Cloud
from .grouping import Group, group_of
from .piece_boxes import PieceBoxes, alike
from .repeats import repeated
from .voting import Said

# Pieces nearer than the first touch [sides of the object]; of one part surely those nearer than the last.
_TOUCHING = (0.02, 0.005)
# Clusters with this share of the largest one's area may be parts, if together they are so much of the group.
_AS_LARGE, _NEARLY_ALL = 0.6, 0.85
# So sure it has to be that two such clusters are of one part.
_SURE = 0.85


def parted(found: Sequence[Group], said: Said, cloud: Cloud, area: FloatArray) -> list[Group]:
    """The groups, those that are several parts in these: casters, or doors side by side, are hardly ever one.

    Clusters of pieces that lie apart are, unless it is nearly sure that they belong together; and whatever is
    said, if each is shaped as another part is: of seven keys, no two are one. `repeats` parts what touches.

    Args:
        found: groups of pieces.
        said: of the object.
        cloud: of it.
        area: (S,) of the pieces, any unit.
    """
    boxes, result = PieceBoxes.of(cloud), list[Group]()
    for group in found:
        others = [other.pieces for other in found if other is not group]
        parts = _apart(group.pieces, said, area) or _as_others(group.pieces, others, said, boxes, area)
        result += [group_of(p, said.moves, said.together, area) for p in parts] if parts else [group]
    return repeated(result, said, boxes, area)


def _apart(pieces: IntArray, said: Said, area: FloatArray) -> list[IntArray]:
    """The parts of which it is not sure enough that they are one; none where it is."""
    from scipy.sparse.csgraph import connected_components

    cluster, large = _clusters(pieces, said, area, _TOUCHING[0])
    share = (cluster == np.arange(cluster.max() + 1)[:, None]) * area[pieces]
    share /= share.sum(axis=1, keepdims=True)
    chance = share @ said.together[np.ix_(pieces, pieces)] @ share.T
    count, part = connected_components(chance[np.ix_(large, large)] >= _SURE)
    # Small clusters go with the large one that they most likely belong with.
    nearest = chance[:, large].argmax(axis=1)
    nearest[large] = np.arange(len(large))
    return [pieces[part[nearest][cluster] == k] for k in range(count)] if count > 1 else []


def _as_others(
    pieces: IntArray, others: Sequence[IntArray], said: Said, boxes: PieceBoxes, area: FloatArray
) -> list[IntArray]:
    """The clusters, if all may be parts and each is shaped as another part; else none."""
    for touching in _TOUCHING if others else ():
        cluster, large = _clusters(pieces, said, area, touching)
        own = [pieces[cluster == k] for k in large]
        if len(own) < 2 or len(own) <= cluster.max():
            continue
        if alike(boxes.shapes_of(own), boxes.shapes_of(others)).any(axis=1).all():
            return own
    return []


def _clusters(pieces: IntArray, said: Said, area: FloatArray, touching: float) -> tuple[IntArray, IntArray]:
    """(K,) cluster of each piece, by what touches; and which of the clusters may be parts."""
    from scipy.sparse.csgraph import connected_components

    _, cluster = connected_components(said.gap[np.ix_(pieces, pieces)] < touching)
    size = np.bincount(cluster, area[pieces])
    large = np.flatnonzero(size >= _AS_LARGE * size.max())
    all_of_it = size[large].sum() >= _NEARLY_ALL * size.sum()
    return cluster, large if all_of_it else large[:1]
