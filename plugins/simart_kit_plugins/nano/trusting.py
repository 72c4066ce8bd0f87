"""How sure the network has to be of a part: less so in an object like those that it was trained on."""

from __future__ import annotations

from dataclasses import replace

from .grouping import piece_parts
from .predicting import Prediction

# Shares of the sureness asked for that are enough in an object that is recognised, and in one that is read
# much alike from all sides, which differ no more than so much, or that is no newer than so much.
_KNOWN, _MUCH, _MUCH_ALIKE, _FAMILIAR = 1 / 4, 1 / 2, 0.003, 1.1


def settled(said: Prediction, least: float, skin: bool) -> Prediction:
    """A prediction, its parts that are not sure enough among the doubtful ones.

    What each side reads otherwise is like nothing that was trained on.

    Args:
        said: with all parts that are worth a thought.
        least: how sure a part has to be, of moving as one and of how, in any object.
        skin: whether it is one closed skin; of these the network knows too little to be trusted with less.
    """
    if said.recognised:
        return _sure(said, _KNOWN * least)
    alike = said.discord <= _MUCH_ALIKE or familiar(said)
    return _sure(said, _MUCH * least if alike and not skin else least)


def familiar(said: Prediction) -> bool:
    """Whether an object is made as those are that the network was trained on, whatever it is."""
    return said.novelty <= _FAMILIAR


def _sure(said: Prediction, least: float) -> Prediction:
    """With the parts that are sure enough; one whose carrier is not hangs on the body."""
    kept = [number for number, part in enumerate(said.parts, start=1) if part.certainty >= least]
    place = {number: k for k, number in enumerate(kept, start=1)}
    parts = tuple(replace(said.parts[n - 1], parent=place.get(said.parts[n - 1].parent, 0)) for n in kept)
    doubtful = tuple(part for part in said.parts if part.certainty < least)
    piece_part = piece_parts([part.pieces for part in parts], len(said.moves))
    return replace(said, parts=parts, doubtful=doubtful, piece_part=piece_part)
