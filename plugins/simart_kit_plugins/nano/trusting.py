"""How sure the network has to be of a part: less so in an object like those that it was trained on."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from simart_kit.arrays import FloatArray, IntArray

from .grouping import piece_parts
from .predicting import Prediction
from .proposals import Proposal, only

# Shares of the sureness asked for that are enough in an object that is recognised, and in a familiar one.
_KNOWN, _HALF = 1 / 4, 1 / 2
# The same where nothing else is found: of what is less sure in catalogues, five of six parts are wrong, most
# of them on what stands still, and of what is surer two of five are right.
_ALONE = 5 / 8
# Familiar is what is read much alike from all sides, or is no newer than so if these are not quite at odds.
_MUCH_ALIKE, _NO_NEWER, _AT_ODDS = 0.002, 1.15, 0.02
# What is newer is too strange for half of the sureness, though nothing else is found: most plants, plugs and
# seats of catalogues that would move so do not.
_STRANGE = 1.35
# What is newer than this is like nothing that was made, and is read alike from all sides for want of hints:
# wall sockets, as clocks.
_ALIEN = 1.75
# Where geometry finds as many parts, its borders are better unless the sides differ by no more.
_HARDLY = 0.003
# What is less likely than this to move is sure to stand still, in what is read much alike from all sides.
_STILL = 0.02
# How sure it has to be that an object is of a kind of which nothing moves: less so where it recognises the
# object and sees nothing move.
_STATIC, _STATIC_IF_NOTHING_MOVES = 0.95, 0.7

# Of a skin cut by relief: how much alike a network reads it that leads, and one that is heard where geometry
# finds nothing; then a third of the sureness is enough.
_LEADS_ON_SKIN, _HEARD_ON_SKIN, _THIRD = 0.004, 0.01, 1 / 3


def stands_still(said: Prediction, still: float) -> bool:
    """Whether nothing of an object moves, whatever geometry finds on it.

    Args:
        said: of it, with all parts that are worth a thought.
        still: chance of the kinds of which nothing moves.
    """
    nothing = said.recognised and not said.parts
    return still >= (_STATIC_IF_NOTHING_MOVES if nothing else _STATIC)


def enough(said: Prediction, least: float, skin: bool, alone: bool) -> float:
    """How sure a part of an object has to be: less so in one that is like what was trained on.

    Args:
        said: with all parts that are worth a thought.
        least: how sure a part has to be, of moving as one and of how, in any object.
        skin: whether it is one closed skin; of these the network knows too little to be trusted with less.
        alone: whether geometry was asked and finds nothing; else what is not sure would stand still.
    """
    if _ALIEN < said.novelty < float("inf"):  # without statistics it is infinite
        return least
    if said.recognised:
        return _KNOWN * least
    if skin:
        return least
    if said.discord <= (_AT_ODDS if said.novelty <= _NO_NEWER else _MUCH_ALIKE):
        return _HALF * least
    # What is seen from one side alone, as of many pieces, is sure of nothing: no other side could object.
    if alone and said.discord < float("inf") and said.novelty <= _STRANGE:
        return _ALONE * least
    return least


def enough_on_skin(said: Prediction, least: float) -> float:
    """How sure a part of a skin has to be that is cut by relief; all of 1 where the network is not heard.

    Args:
        said: with all parts that are worth a thought.
        least: how sure a part has to be in any object.
    """
    return _THIRD * least if said.discord <= _HEARD_ON_SKIN else 1.0


def leads_on_skin(said: Prediction, found: Sequence[Proposal], geometry: Sequence[Proposal]) -> bool:
    """Whether what the network finds on a skin that is cut by relief comes before what geometry finds.

    Args:
        said: of the skin.
        found: proposals by the network.
        geometry: by geometry.
    """
    return said.discord <= _LEADS_ON_SKIN and len(geometry) < len(found)


def settled(said: Prediction, least: float) -> Prediction:
    """A prediction, its parts less sure than that in doubt; what these carry hangs on the body."""
    kept = [number for number, part in enumerate(said.parts, start=1) if part.certainty >= least]
    place = {number: k for k, number in enumerate(kept, start=1)}
    parts = tuple(replace(said.parts[n - 1], parent=place.get(said.parts[n - 1].parent, 0)) for n in kept)
    doubtful = tuple(part for part in said.parts if part.certainty < least)
    piece_part = piece_parts([part.pieces for part in parts], len(said.moves))
    return replace(said, parts=parts, doubtful=doubtful, piece_part=piece_part)


def heeded(
    said: Prediction, geometry: Sequence[Proposal], piece: IntArray, areas: FloatArray
) -> list[Proposal]:
    """What geometry proposes, without what the network is sure stands still.

    Args:
        said: of the object; how likely each piece moves counts by area.
        geometry: proposals.
        piece: (F,) of each face of the mesh.
        areas: (F,) of each face.
    """
    if said.discord > _MUCH_ALIKE:
        return list(geometry)
    moving = said.moves[piece] * areas
    return only(
        geometry,
        [k for k, p in enumerate(geometry) if moving[p.faces].sum() >= _STILL * areas[p.faces].sum()],
    )


def leads(said: Prediction, found: Sequence[Proposal], geometry: Sequence[Proposal]) -> bool:
    """Whether what the network finds comes first, and geometry only adds to it; else it is the other way.

    Args:
        said: of the object.
        found: proposals by the network.
        geometry: by geometry.
    """
    if not geometry:
        return True
    return said.recognised and (said.discord <= _HARDLY or len(geometry) < len(found))
