"""From the cloud of an object to its moving parts and their joints, by the network."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import torch

from simart_kit.arrays import FloatArray, IntArray
from simart_kit.asset import JointKind

from .candidates import Candidates, candidates
from .cloud import Cloud
from .evidence import TOUCHING, evidence
from .examples import Example
from .grouping import Group, groups, piece_parts
from .learning import batch_of
from .network import NanoNetwork, PartReading, Reading
from .scene import Pieces, pieces_of
from .store import stored
from .truth import KINDS


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
        confidence: chance of kind and axis together; 0..1.
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


@dataclass(frozen=True, eq=False)
class Prediction:
    """What the network says of an object.

    Attributes:
        parts: the surest first.
        piece_part: (S,) part of each piece, from 1; 0 is the body.
        category: what it is; empty where no known one fits.
        category_score: 0..1.
        size: longest side [m].
    """

    parts: tuple[PredictedPart, ...]
    piece_part: IntArray
    category: str
    category_score: float
    size: float


@torch.no_grad()
def predict(network: NanoNetwork, cloud: Cloud, least: float = 0.4) -> Prediction:
    """Read a cloud.

    Args:
        network: on the CPU.
        cloud: of the object.
        least: parts less sure than this stay with the body.
    """
    pieces = pieces_of(cloud)
    nothing = Example(cloud, pieces, np.zeros(cloud.count, dtype=np.int64), np.array([True]), (), "", 1.0)
    reading = network(batch_of([stored(nothing)]))
    area = np.asarray(np.bincount(cloud.piece, cloud.area, cloud.count), dtype=np.float64)
    together = reading.together[0].sigmoid().numpy().astype(np.float64)
    moves = reading.moves[0].sigmoid().numpy().astype(np.float64)
    found = [g for g in groups(moves, together, area, least) if len(g.pieces) < cloud.count]
    parts = _parts(network, reading, cloud, pieces, found, area) if found else ()
    category = reading.category[0].softmax(0)
    best = int(category.argmax())
    name = network.config.categories[best - 1] if best else ""
    size = float(reading.size[0].exp())
    return Prediction(parts, piece_parts(found, cloud.count), name, float(category[best]), size)


def _parts(
    network: NanoNetwork,
    reading: Reading,
    cloud: Cloud,
    pieces: Pieces,
    found: list[Group],
    area: FloatArray,
) -> tuple[PredictedPart, ...]:
    lines = [_candidates(cloud, group) for group in found]
    widest = max(len(own) for own, _ in lines)
    share = np.zeros((len(found), cloud.count), dtype=np.float32)
    numbers = np.zeros((len(found), widest, lines[0][1].shape[1]), dtype=np.float32)
    real = np.zeros((len(found), widest), dtype=np.bool_)
    for row, (group, (own, told)) in enumerate(zip(found, lines, strict=True)):
        share[row, group.pieces] = area[group.pieces] / area[group.pieces].sum()
        numbers[row, : len(own)], real[row, : len(own)] = told, True
    owner = torch.zeros(len(found), dtype=torch.int64)
    given = (torch.from_numpy(array) for array in (share, numbers, real))
    read = network.parts(reading.tokens, owner, *given)
    carrier = _carriers(network, read)
    return tuple(
        _part(network, reading, read, row, group, own, carrier[row])
        for row, (group, (own, _)) in enumerate(zip(found, lines, strict=True))
    )


def _candidates(cloud: Cloud, group: Group) -> tuple[Candidates, FloatArray]:
    """The candidates of a group and their evidence."""
    from scipy.spatial import cKDTree

    inside = np.isin(cloud.piece, group.pieces)
    own, rest = cloud.points[inside], cloud.points[~inside]
    gap = np.minimum(np.asarray(cKDTree(rest).query(own)[0]), 1.0)
    found = candidates(own, cloud.normals[inside], own[gap < TOUCHING])
    return found, evidence(found, own, rest, gap)


def _carriers(network: NanoNetwork, read: PartReading) -> list[int]:
    """Of each part, the number of the part that carries it, or 0; without loops."""
    logits = network.carriers(read.embedding, read.embedding)
    logits.fill_diagonal_(-torch.inf)
    chosen = torch.cat([logits.new_zeros(len(logits), 1), logits], dim=1).argmax(1).tolist()
    for part in range(1, len(chosen) + 1):
        seen, above = {part}, chosen[part - 1]
        while above and above not in seen:
            seen.add(above)
            above = chosen[above - 1]
        if above:
            chosen[part - 1] = 0
    return [int(above) for above in chosen]


def _part(
    network: NanoNetwork,
    reading: Reading,
    read: PartReading,
    row: int,
    group: Group,
    own: Candidates,
    parent: int,
) -> PredictedPart:
    kinds = read.kind[row].softmax(0)
    kind = KINDS[int(kinds.argmax())]
    slide = kind == "prismatic"
    chance = read.right[row, : len(own)].clone()
    chance[torch.from_numpy((own.source == 0) != slide)] = -torch.inf
    shares = chance.softmax(0)
    best = int(shares.argmax())
    lower, upper = (float(value) for value in read.travel[row, best] * (1 if slide else torch.pi))
    axis = own.axis[best]
    if -lower > upper:  # positive opens
        axis, lower, upper = -axis, -upper, -lower
    limited = kind in ("revolute", "prismatic")
    label = int(reading.label[0, torch.from_numpy(group.pieces)].softmax(1).mean(0).argmax())
    return PredictedPart(
        group.pieces,
        network.config.labels[label - 1] if label else "",
        group.score,
        kind,
        axis,
        own.origin[best],
        min(lower, 0.0) if limited else 0.0,
        max(upper, 0.0) if limited else 0.0,
        parent,
        float(kinds.max() * shares[best]),
    )
