"""How sure the network has to be of a part: less so in an object like those that it was trained on."""

from __future__ import annotations

from dataclasses import replace

from .grouping import piece_parts
from .predicting import Prediction

# Shares of the sureness asked for that are enough in an object that is recognised, and in a familiar one.
_KNOWN, _HALF = 1 / 4, 1 / 2
# Familiar is what is read much alike from all sides, which differ no more than so much; and what is no newer
# than so much, unless they are quite at odds.
_MUCH_ALIKE, _NO_NEWER, _AT_ODDS = 0.003, 1.1, 0.02


def enough(said: Prediction, least: float, skin: bool) -> float:
    """How sure a part of an object has to be: less so in one that is like what was trained on.

    Args:
        said: with all parts that are worth a thought.
        least: how sure a part has to be, of moving as one and of how, in any object.
        skin: whether it is one closed skin; of these the network knows too little to be trusted with less.
    """
    if said.recognised:
        return _KNOWN * least
    familiar = said.discord <= (_AT_ODDS if said.novelty <= _NO_NEWER else _MUCH_ALIKE)
    return _HALF * least if familiar and not skin else least


def settled(said: Prediction, least: float) -> Prediction:
    """A prediction, its parts less sure than that in doubt; what these carry hangs on the body."""
    kept = [number for number, part in enumerate(said.parts, start=1) if part.certainty >= least]
    place = {number: k for k, number in enumerate(kept, start=1)}
    parts = tuple(replace(said.parts[n - 1], parent=place.get(said.parts[n - 1].parent, 0)) for n in kept)
    doubtful = tuple(part for part in said.parts if part.certainty < least)
    piece_part = piece_parts([part.pieces for part in parts], len(said.moves))
    return replace(said, parts=parts, doubtful=doubtful, piece_part=piece_part)
