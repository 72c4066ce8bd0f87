"""An answer without parts that came to nothing: their children move up to who carried them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from .answer.values import ObjectAnswer


def surviving(answer: ObjectAnswer, kept: Sequence[int]) -> ObjectAnswer:
    """The answer with the parts `kept` alone, ascending, at least one; the first of them is the root.

    A part whose parent is gone hangs on the nearest that is left above it, or else on the root. It keeps its
    axis, for answers say all places in the object's cube and not in that of a parent.
    """
    place = {part: number for number, part in enumerate(kept)}
    parts = [replace(answer.parts[kept[0]], type="fixed", parent=None, motion=None)]
    for number in kept[1:]:
        parent = answer.parts[number].parent
        while parent is not None and parent not in place:
            parent = answer.parts[parent].parent
        parts.append(replace(answer.parts[number], parent=0 if parent is None else place[parent]))
    return replace(answer, parts=tuple(parts))
