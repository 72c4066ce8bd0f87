"""What each thing that the network says wrongly costs."""

from __future__ import annotations

from dataclasses import dataclass

import torch
from torch import Tensor
from torch.nn.functional import binary_cross_entropy_with_logits, cross_entropy, smooth_l1_loss

from .learning import Targets
from .lessening import MOST_ASKED
from .network import Batch, NanoNetwork, PartReading, Reading
from .reading import MOST_PAIRED
from .truth import KINDS

_PRISMATIC = KINDS.index("prismatic")
# Less travel than this is none [rad | sides of the object].
_SHORTEST = 1e-3
# Pair layers: of what strangers cost a moving piece, the share of those that move too; what the body counts.
_NEIGHBOURS, _BODY = 0.5, 0.3
_WEIGHTS = {
    "together": 1.0,
    "moves": 0.5,
    "kind": 0.3,
    "label": 0.2,
    "category": 0.1,
    "size": 0.1,
    "part_kind": 0.5,
    "right": 0.5,
    "sense": 0.2,
    "near": 0.5,
    "reach": 0.2,
    "carrier": 0.2,
    "paired": 1.0,
}


@dataclass(frozen=True, eq=False)
class NanoLosses:
    """Each term, not weighted, and the weighted sum.

    Attributes:
        terms: by name.
        total: their weighted sum.
    """

    terms: dict[str, Tensor]
    total: Tensor


def losses(model: NanoNetwork, batch: Batch, reading: Reading, targets: Targets) -> NanoLosses:
    """All terms for a batch that was read."""
    read = model.parts(
        reading.tokens, batch.there, targets.owner, targets.share, targets.numbers, targets.real
    )
    real, whole = targets.part >= 0, targets.category >= 0
    terms = {
        "together": _together(reading.together, targets.part),
        "moves": binary_cross_entropy_with_logits(reading.moves[real], (targets.part[real] > 0).float()),
        "kind": _known(reading.kind, targets.kind),
        "label": _known(reading.label, targets.label),
        "category": _known(reading.category, targets.category),
        "size": smooth_l1_loss(reading.size[whole], targets.size[whole])
        if whole.any()
        else reading.size.sum() * 0,
        **_of_parts(model, read, targets),
        "paired": _paired(model, batch, reading, targets),
    }
    total = torch.stack([_WEIGHTS[name] * term for name, term in terms.items()]).sum()
    return NanoLosses(terms, total)


def _together(logits: Tensor, part: Tensor) -> Tensor:
    """Cross-entropy over pairs of pieces: each object counts alike."""
    cost, weight = _of_pieces(logits, part)
    return ((cost * weight).sum(1) / weight.sum(1).clamp(min=1e-6)).mean()


def _paired(model: NanoNetwork, batch: Batch, reading: Reading, targets: Targets) -> Tensor:
    """The same after a look at pairs, of objects of which these are looked at.

    Each part counts alike, but those of one object no more than as many as are asked for.
    """
    count = batch.there.sum(1)
    few = count <= MOST_PAIRED
    if not few.any():
        return model.pairs.norm.weight.sum() * 0
    most = int(count[few].max())
    logits = model.paired(batch, reading, few, most)
    cost, weight = _of_pieces(logits, targets.part[few, :most], _NEIGHBOURS, _BODY)
    weight = weight / (weight.sum(1, keepdim=True) / MOST_ASKED).clamp(min=1)
    return (cost * weight).sum() / weight.sum()


def _of_pieces(
    logits: Tensor, part: Tensor, neighbours: float = 0.0, body: float = 1.0
) -> tuple[Tensor, Tensor]:
    """(B, S) cost of what is said of each piece's pairs, and what the piece counts.

    Of each piece, partners and strangers cost alike. A body of a hundred pieces must not outweigh a door of
    one: all pieces of a part count 1 together.

    Args:
        logits: (B, S, S).
        part: (B, S) part of each piece; 0 is the body, -1 is padding.
        neighbours: share of a moving piece's strangers that those have which move as well.
        body: what it counts for a part that moves.
    """
    real = part >= 0
    pair = real[:, :, None] & real[:, None, :]
    same = (part[:, :, None] == part[:, None, :]) & pair
    other = pair & ~same
    cost = binary_cross_entropy_with_logits(logits, same.float(), reduction="none")
    partners, strangers = _mean(cost, same), _mean(cost, other)
    if neighbours:
        moving = other & (part > 0)[:, :, None] & (part > 0)[:, None]
        share = neighbours * moving.any(2)
        strangers = (1 - share) * strangers + share * _mean(cost, moving)
    return partners + strangers, real * torch.where(part > 0, 1.0, body) / same.sum(2).clamp(min=1)


def _mean(cost: Tensor, counted: Tensor) -> Tensor:
    """(B, S) means of (B, S, S) along the last axis, of what counts."""
    return (cost * counted).sum(2) / counted.sum(2).clamp(min=1)


def _of_parts(model: NanoNetwork, read: PartReading, targets: Targets) -> dict[str, Tensor]:
    nothing = read.embedding.sum() * 0
    if not len(targets.owner):
        return dict.fromkeys(("part_kind", "right", "sense", "near", "reach", "carrier"), nothing)
    right = targets.right != 0
    asked = right.any(1)
    chance = read.right.float().log_softmax(1)
    good = torch.logsumexp(chance.masked_fill(~right, -torch.inf), dim=1)
    return {
        "part_kind": cross_entropy(read.kind, targets.part_kind),
        "right": -good[asked].mean() if asked.any() else nothing,
        **_of_travel(read, targets, nothing),
        "carrier": _carrier(model, read.embedding, targets),
    }


def _of_travel(read: PartReading, targets: Targets, nothing: Tensor) -> dict[str, Tensor]:
    """In which sense each right candidate opens, how much of the way is on the shorter side, and how far."""
    lower, upper = targets.travel.unbind(1)
    whole = upper - lower
    limited = whole > _SHORTEST
    if not limited.any():
        return dict.fromkeys(("sense", "near", "reach"), nothing)
    share = (torch.minimum(-lower, upper).clamp(min=0) / whole.clamp(min=_SHORTEST))[limited]
    opens = targets.right[limited] * torch.sign(lower + upper)[limited, None]
    # What goes as far both ways has no side to open to.
    counts = (opens != 0) * (1 - 2 * share)[:, None]
    cost = binary_cross_entropy_with_logits(read.sense[limited], (opens > 0).float(), reduction="none")
    slides = (targets.part_kind[limited] == _PRISMATIC)[:, None]
    reach = read.reach[limited].gather(1, slides.long())[:, 0]
    return {
        "sense": (cost * counts).sum() / counts.sum().clamp(min=1),
        "near": (read.near[limited].sigmoid() / 2 - share).abs().mean(),
        "reach": (reach - whole[limited].log()).abs().mean(),
    }


def _carrier(model: NanoNetwork, embedding: Tensor, targets: Targets) -> Tensor:
    """Cross-entropy of each part's carrier among the parts of its object and the body, whose logit is 0."""
    beside = targets.owner[:, None] == targets.owner[None]
    beside = beside & ~torch.eye(len(beside), dtype=torch.bool, device=beside.device)
    # Of a batch's pairs of parts few are of one object: all of them would be half of what a step computes.
    child, parent = torch.nonzero(beside, as_tuple=True)
    told = model.carrier(torch.cat([embedding[child], embedding[parent]], dim=1))[:, 0]
    logits = told.new_full(beside.shape, -torch.inf).index_put((child, parent), told)
    body = logits.new_zeros(len(logits), 1)
    return cross_entropy(torch.cat([body, logits], dim=1), targets.parent + 1)


def _known(logits: Tensor, wanted: Tensor) -> Tensor:
    """Cross-entropy where something is wanted, 0 where nothing is."""
    asked = wanted >= 0
    if not asked.any():
        return logits.sum() * 0
    return cross_entropy(logits[asked], wanted[asked])
