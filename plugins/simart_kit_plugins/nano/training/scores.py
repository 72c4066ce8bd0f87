"""How much of what the network should say it does say, on objects that it was not trained on."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import torch
from torch import Tensor

from ..learning import Targets, batch_of, targets_of
from ..losses import losses
from ..network import Batch, NanoNetwork, Reading
from ..reading import MOST_PAIRED
from ..store import Stored

_AT_ONCE = 16


@dataclass(frozen=True)
class NanoScore:
    """Shares of right answers; a number without anything to answer is NaN.

    Attributes:
        objects: how many were asked about.
        loss: the total, mean over batches.
        together: pairs of pieces told right to be of one part or not, mean over objects.
        moves: pieces told right to move or not, mean over objects.
        kind: parts, given their pieces, whose kind of joint is right.
        candidate: of those with a right candidate, parts whose first one is right.
        category: objects whose category is right.
    """

    objects: int
    loss: float
    together: float
    moves: float
    kind: float
    candidate: float
    category: float


@torch.no_grad()
def score(network: NanoNetwork, examples: Sequence[Stored]) -> NanoScore:
    """Ask about all examples."""
    rows: list[list[float]] = []
    device = next(network.parameters()).device
    ordered = sorted(examples, key=lambda one: len(one.own))
    for first in range(0, len(ordered), _AT_ONCE):
        some = ordered[first : first + _AT_ONCE]
        batch, targets = batch_of(some).to(device), targets_of(some, network.config).to(device)
        reading = network(batch)
        total = losses(network, batch, reading, targets).total.item()
        rows += [[total, *row] for row in _rows(network, batch, reading, targets)]
    if not rows:
        nothing = float("nan")
        return NanoScore(0, nothing, nothing, nothing, nothing, nothing, nothing)
    table = np.array(rows)
    asked, right = table[:, [4, 6]].sum(axis=0), table[:, [5, 7]].sum(axis=0)
    shares = np.where(asked > 0, right / np.maximum(asked, 1), np.nan).tolist()
    means = table[:, 1:4].mean(axis=0).tolist()
    kind, candidate = shares
    loss = float(table[:, 0].mean())
    return NanoScore(len(rows), loss, means[0], means[1], kind, candidate, means[2])


def _rows(network: NanoNetwork, batch: Batch, reading: Reading, targets: Targets) -> list[list[float]]:
    """Of each object: pairs, pieces, category right; parts asked for kind, right; for candidates, right."""
    read = network.parts(
        reading.tokens, batch.there, targets.owner, targets.share, targets.numbers, targets.real
    )
    kind = read.kind.argmax(1) == targets.part_kind
    asked = (targets.right != 0).any(1)
    first = targets.right.gather(1, read.right.argmax(1, keepdim=True))[:, 0] != 0
    rows = []
    for k in range(len(targets.part)):
        real = targets.part[k] >= 0
        part = targets.part[k][real]
        same = part[:, None] == part[None]
        together = _together(network, batch, reading, k, len(part))
        pairs = ((together > 0) == same).float().mean().item()
        pieces = ((reading.moves[k][real] > 0) == (part > 0)).float().mean().item()
        category = float(reading.category[k].argmax() == targets.category[k])
        mine = targets.owner == k
        told = [mine.sum().item(), kind[mine].sum().item()]
        told += [(mine & asked).sum().item(), (first & mine & asked).sum().item()]
        rows.append([pairs, pieces, category, *told])
    return rows


def _together(network: NanoNetwork, batch: Batch, reading: Reading, row: int, count: int) -> Tensor:
    """(S, S) logits of the pieces of an object, after a look at their pairs if these are looked at."""
    if count > MOST_PAIRED:
        return reading.together[row, :count, :count]
    return network.paired(batch, reading, torch.tensor([row]), count)[0]
