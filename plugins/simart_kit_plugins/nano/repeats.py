"""Groups that are several parts in a row, as keys are: of some pieces each, and nearly touching."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from simart_kit.arrays import FloatArray, IntArray

from .grouping import Group, group_of
from .piece_boxes import PieceBoxes, alike
from .voting import Said

# Of more pieces it is not asked how they may be parted: there are too many ways.
_MOST = 8
# So many other parts each set of pieces has to be shaped as: if fewer are, that may be chance.
_SEVERAL = 2
# From so sure on that two sets are of one part they are, as beads on one wire.
_SURE = 0.95


def repeated(found: Sequence[Group], said: Said, boxes: PieceBoxes, area: FloatArray) -> list[Group]:
    """The groups, those of sets of pieces that are each shaped as several other parts in these sets.

    Each set has to be more surely of one part than any two are. What is parted may be what others are shaped
    as.

    Args:
        found: groups of pieces.
        said: of the object.
        boxes: of its pieces.
        area: (S,) of the pieces, any unit.
    """
    result, before = list(found), 0
    while before < len(result) > _SEVERAL:
        before = len(result)
        shape = boxes.shapes_of([group.pieces for group in result])
        result = [
            group_of(pieces, said.moves, said.together, area) if len(pieces) < len(group.pieces) else group
            for number, group in enumerate(result)
            for pieces in _parted(group.pieces, np.delete(shape, number, axis=0), boxes, said, area)
        ]
    return result


def _parted(
    pieces: IntArray, others: FloatArray, boxes: PieceBoxes, said: Said, area: FloatArray
) -> list[IntArray]:
    """The pieces in sets shaped as several of (M, 4) other parts, or all together."""
    if not 1 < len(pieces) <= _MOST:
        return [pieces]
    number = np.arange(1, 2 ** len(pieces) - 1)
    sets = (number[:, None] >> np.arange(len(pieces))) & 1 == 1
    fits = alike(boxes.shapes(pieces, sets), others).sum(axis=1) >= _SEVERAL
    larger = np.argsort(-sets[fits].sum(axis=1), kind="stable")
    cover = _cover(number[fits][larger].tolist(), 2 ** len(pieces) - 1)
    chosen = [pieces[sets[n - 1]] for n in cover]
    return chosen if chosen and _surer_alone(chosen, said, area) else [pieces]


def _cover(sets: Sequence[int], left: int) -> list[int]:
    """Sets, as bits, that share out all that is left, the first that do; none where there are none."""
    for one in sets:
        if one & left & -left and one & left == one:
            rest = _cover(sets, left ^ one) if left != one else []
            if rest or left == one:
                return [one, *rest]
    return []


def _surer_alone(sets: Sequence[IntArray], said: Said, area: FloatArray) -> bool:
    """Whether each set of pieces is more surely of one part than any two are, which is not nearly sure."""
    share = np.array([np.isin(np.arange(len(area)), pieces) * area for pieces in sets])
    share /= share.sum(axis=1, keepdims=True)
    chance = share @ said.together @ share.T
    two = chance[~np.eye(len(sets), dtype=bool)].max()
    return bool(two < min(_SURE, np.diag(chance).min()))
