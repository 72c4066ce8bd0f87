"""From the cloud of an object to its moving parts and their joints, by the network."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from simart_kit.arrays import FloatArray, IntArray
from simart_kit.asset import JointKind

from .array_network import ArrayNetwork
from .candidates import Candidates
from .choices import Choices
from .cloud import Cloud
from .evidence import COUNT
from .grouping import Group, groups, piece_parts
from .novelty import TokenStatistics, tokens_of
from .part_lines import part_lines
from .parting import parted
from .siblings import nearest_carriers, shared_certainty
from .voting import VOTES, Said, SaidParts, say, say_parts

# Less sure groups of pieces are not looked at.
_WORTH = 0.3
# Share of the surface that a part which lies loose may have.
_CARRIED = 0.5
# An object of which the sides differ no more than by the first is recognised, and by the second if it is no
# newer than that: what it has seen alike it reads alike from all sides, else each side says something else.
_ALIKE, _ALIKE_IF_NOT_NEW, _NO_NEWER = 0.0005, 0.01, 1.1
# It may be as new as it likes if it is that sure what it is, the sides hardly differ, and it is like others
# of that kind: generated things of other kinds are taken for known ones less surely, and real ones are less
# like them.
_SURE_OF_KIND, _ALIKE_IF_OF_KIND, _LIKE_ITS_KIND = 0.8, 0.005, 1.8


@dataclass(frozen=True, eq=False)
class PredictedPart:
    """A moving part, in the frame of the cloud.

    Attributes:
        pieces: of the cloud.
        label: what it is called; empty where no known label fits.
        score: how sure it is that this moves as one; 0..1.
        kind: of its joint.
        axis: (3,) unit.
        origin: (3,) a point on it.
        lower, upper: limits [rad | sides of the object]; 0 where the kind has none.
        parent: number of the part that carries it, from 1; 0 is the body.
        confidence: chance of kind and line together; 0..1.
        certainty: how sure it is that this moves, and moves so, as parts of its shape do; 0..1.
        choices: what is said of all its joints, where that is kept.
        reasons: for its joint, where it is not the network's.
    """

    pieces: IntArray
    label: str
    score: float
    kind: JointKind
    axis: FloatArray
    origin: FloatArray
    lower: float
    upper: float
    parent: int
    confidence: float
    certainty: float
    choices: Choices | None = None
    reasons: tuple[str, ...] = ()


@dataclass(frozen=True, eq=False)
class Prediction:
    """What the network says of an object.

    Attributes:
        parts: those sure enough; all, until that is decided (`trusting.settled`).
        doubtful: those that are not; their pieces stay with the body.
        piece_part: (S,) part of each piece, from 1; 0 is the body.
        moves: (S,) chance of each piece to be of a moving part.
        category: what it is; empty where no known one fits.
        discord: how far what is said of it from each side is apart (`voting.discord`).
        novelty: how unlike it is to what was trained on (`TokenStatistics.novelty`); infinite where the model
            has no statistics.
        categories: chance of each known category.
        size: longest side [m], and the factor by which opinions differ about it, at least 1.
        unlikeness: to others of its category (`KindStatistics.unlikeness`); infinite where that is not known.
    """

    parts: tuple[PredictedPart, ...]
    doubtful: tuple[PredictedPart, ...]
    piece_part: IntArray
    moves: FloatArray
    category: str
    discord: float
    novelty: float
    categories: Mapping[str, float]
    size: tuple[float, float]
    unlikeness: float = float("inf")

    @property
    def recognised(self) -> bool:
        """Whether it is read alike from all sides, as what was trained on is, of whatever kind."""
        if self.novelty <= _NO_NEWER:
            return self.discord <= _ALIKE_IF_NOT_NEW
        sure = max(self.categories.values(), default=0.0) >= _SURE_OF_KIND
        of_kind = sure and self.unlikeness <= _LIKE_ITS_KIND
        return self.discord <= (_ALIKE_IF_OF_KIND if of_kind else _ALIKE)


def predict(
    network: ArrayNetwork, cloud: Cloud, votes: int = VOTES, statistics: TokenStatistics | None = None
) -> Prediction:
    """Read a cloud.

    Args:
        network: that reads it.
        cloud: of the object.
        votes: from how many sides it is seen, 1..8; one of very many pieces is seen from one alone.
            What is seen from one alone is not recognised.
        statistics: of what the network was trained on, where they are known.
    """
    said = say(network, cloud, votes)
    area = _areas(cloud)
    grown = parted(groups(said.moves, said.together, area, _WORTH), said, cloud, area)
    found = [group for group in grown if len(group.pieces) < cloud.count]
    parts = tuple(plausible(part, area) for part in _parts(network, said, cloud, found))
    names = network.config.categories
    best = int(said.category.argmax())
    name = names[best - 1] if best else ""
    chances = dict(zip(names, said.category[1:].tolist(), strict=True))
    piece_part = piece_parts([part.pieces for part in parts], cloud.count)
    novelty, unlike = _news(said, best - 1, statistics)
    return Prediction(
        parts, (), piece_part, said.moves, name, said.discord, novelty, chances, said.size, unlike
    )


def _news(said: Said, kind: int, statistics: TokenStatistics | None) -> tuple[float, float]:
    """Novelty of an object, and unlikeness to its kind; -1 is of none."""
    if statistics is None:
        return float("inf"), float("inf")
    tokens = tokens_of(said)
    known = statistics.kinds if kind >= 0 else None
    unlike = float("inf") if known is None else known.unlikeness(tokens, kind)
    return statistics.novelty(tokens), unlike


def plausible(part: PredictedPart, area: FloatArray) -> PredictedPart:
    """The part; not sure at all where it lies loose and is most of the object: no body would carry it."""
    loose = part.kind == "free" and area[part.pieces].sum() > _CARRIED * area.sum()
    return replace(part, certainty=0.0) if loose else part


def predict_groups(
    network: ArrayNetwork, cloud: Cloud, found: Sequence[Group], votes: int = VOTES
) -> tuple[PredictedPart, ...]:
    """The joints of given groups of pieces, in their order; none holds all pieces."""
    return _parts(network, say(network, cloud, votes), cloud, found)


def _parts(
    network: ArrayNetwork, said: Said, cloud: Cloud, found: Sequence[Group]
) -> tuple[PredictedPart, ...]:
    if not found:
        return ()
    area = _areas(cloud)
    lines = [part_lines(cloud, np.isin(cloud.piece, group.pieces)) for group in found]
    widest = max(len(line.found) for line in lines)
    share = np.zeros((len(found), cloud.count), dtype=np.float32)
    numbers = np.zeros((len(found), widest, COUNT))
    real = np.zeros((len(found), widest), dtype=np.bool_)
    for row, (group, line) in enumerate(zip(found, lines, strict=True)):
        share[row, group.pieces] = area[group.pieces] / area[group.pieces].sum()
        count = len(line.found)
        numbers[row, :count], real[row, :count] = line.evidence(), True
    parts = say_parts(network, said.tokens, share, numbers, real)
    each = [
        _part(network, said, parts, row, group, line.found)
        for row, (group, line) in enumerate(zip(found, lines, strict=True))
    ]
    pieces, takes = [part.pieces for part in each], [(part.label, part.kind) for part in each]
    carriers = _without_loops(nearest_carriers(cloud, pieces, takes, parts.carrier))
    shared = shared_certainty(cloud, pieces, np.array([part.certainty for part in each]))
    return tuple(
        replace(part, parent=above, certainty=float(sure))
        for part, above, sure in zip(each, carriers, shared, strict=True)
    )


def _areas(cloud: Cloud) -> FloatArray:
    return np.asarray(np.bincount(cloud.piece, cloud.area, cloud.count), dtype=np.float64)


def _without_loops(carriers: Sequence[int]) -> list[int]:
    """Of each part, the number of the part that carries it; 0, the body, where it would carry itself."""
    chosen = list(carriers)
    for part in range(1, len(chosen) + 1):
        seen, above = {part}, chosen[part - 1]
        while above and above not in seen:
            seen.add(above)
            above = chosen[above - 1]
        if above:
            chosen[part - 1] = 0
    return chosen


def _part(
    network: ArrayNetwork,
    said: Said,
    parts: SaidParts,
    row: int,
    group: Group,
    own: Candidates,
) -> PredictedPart:
    count = len(own)
    choices = Choices(parts.kind[row], parts.right[row, :count], parts.travel[row, :count], own)
    best = choices.best()
    label = int(said.label[group.pieces].mean(axis=0).argmax())
    return PredictedPart(
        group.pieces,
        network.config.labels[label - 1] if label else "",
        group.score,
        best.kind,
        best.axis,
        best.origin,
        best.lower,
        best.upper,
        0,
        best.confidence,
        group.score * best.confidence,
        choices,
    )
