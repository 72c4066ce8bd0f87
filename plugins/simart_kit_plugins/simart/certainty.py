"""How sure a model was of what it said, by the probabilities of the tokens that it chose."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Sequence

from .asking import Word

_LEAST = 1e-9
_CAPTIONS, _VOXELS = '"parts_captions":{', '"parts_voxels":{'
_PART = re.compile(r'"\d+":\{"name":')


def certainty(words: Iterable[Word]) -> float:
    """Geometric mean of the probabilities of the tokens that were chosen, 0..1; 1 where none was."""
    chosen = [max(word.probability, _LEAST) for word in words if not word.forced]
    return min(1.0, math.exp(sum(map(math.log, chosen)) / len(chosen))) if chosen else 1.0


def caption_certainty(words: Sequence[Word], parts: int) -> list[float] | None:
    """How sure a model was of the name, joint and material of each part.

    Args:
        words: of a whole answer, as the grammar writes it.
        parts: how many parts it has.

    Returns:
        (P,) 0..1; None where nothing is known of the words.
    """
    text = "".join(word.text for word in words)
    first, last = text.find(_CAPTIONS), text.find(_VOXELS)
    starts = [match.start() for match in _PART.finditer(text, max(first, 0), max(last, 0))]
    if len(starts) != parts:
        return None
    groups: list[list[Word]] = [[] for _ in starts]
    place, part = 0, -1
    for word in words:
        while part + 1 < parts and place >= starts[part + 1]:
            part += 1
        if part >= 0 and place < last:
            groups[part].append(word)
        place += len(word.text)
    return [certainty(group) for group in groups]
