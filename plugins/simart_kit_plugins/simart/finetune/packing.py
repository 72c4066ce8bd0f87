"""Examples as batches: rows of nearly one length, or examples in one row that are blind to each other.

Rows are padded at their end, where causal attention lets nothing see it, so that no mask is needed and the
fast kernels are used. Where a row holds several examples, their places in the row start at 0 for each one;
transformers reads block-diagonal attention from that, as a mask or as lengths for Flash Attention.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from .choices import NO_CELL, CellChoices
from .examples import UNCOUNTED, Example
from .plan import FinetunePlan

if TYPE_CHECKING:
    from torch import Tensor


@dataclass(frozen=True, eq=False)
class Batch:
    """B rows of L tokens.

    Attributes:
        ids: (B, L) tokens.
        positions: (3, B, L) for the rotary embedding, or (4, B, L) with places in the example first, where
            rows hold several examples.
        targets: (B, L) the token that comes next.
        weights: (B, L) float32, of the target in the loss.
        kinds: (B, L) place in `KINDS` of the target, or `UNCOUNTED`.
        pixels: patches of all pictures, or None.
        patches: (N, 3) their numbers, or None.
        cells: what the cells of the answers are chosen among.
        tokens: tokens without padding.
    """

    ids: Tensor
    positions: Tensor
    targets: Tensor
    weights: Tensor
    kinds: Tensor
    pixels: Tensor | None
    patches: Tensor | None
    cells: CellChoices
    tokens: int

    def to(self, device: object) -> Batch:
        """The batch on a device."""
        moved = {
            name: getattr(self, name).to(device)
            for name in ("ids", "positions", "targets", "weights", "kinds", "pixels", "patches", "cells")
            if getattr(self, name) is not None
        }
        return replace(self, **moved)


def batches(
    examples: Sequence[Example], plan: FinetunePlan, padding: int, rng: np.random.Generator
) -> list[Batch]:
    """All examples that are not too long, in batches of up to `batch_tokens`, shuffled."""
    fitting = sorted((e for e in examples if len(e) <= plan.longest), key=lambda e: (len(e), e.key))
    grouped = _packed(fitting, plan) if plan.packing else _bucketed(fitting, plan)
    order = rng.permutation(len(grouped))
    return [collate(grouped[place], padding, plan.multiple) for place in order]


def collate(rows: Sequence[Sequence[Example]], padding: int, multiple: int) -> Batch:
    """Rows of examples as tensors, padded to a multiple of so many tokens."""
    import torch

    longest = max(sum(map(len, row)) for row in rows)
    shape = (len(rows), -(-longest // multiple) * multiple)
    ids = np.full(shape, padding, dtype=np.int64)
    targets = np.full(shape, padding, dtype=np.int64)
    positions = np.zeros((4, *shape), dtype=np.int64)
    weights = np.zeros(shape, dtype=np.float32)
    kinds = np.full(shape, UNCOUNTED, dtype=np.int64)
    owner = np.zeros(shape, dtype=np.int64)
    last = np.full(shape, NO_CELL, dtype=np.int64)
    flat = [example for row in rows for example in row]
    count = 0
    for number, row in enumerate(rows):
        start = 0
        for example in row:
            end = start + len(example)
            owner[number, start:end], count = count, count + 1
            last[number, start:end] = example.last
            ids[number, start:end] = example.ids
            targets[number, start : end - 1] = example.ids[1:]
            weights[number, start : end - 1] = example.weights[1:]
            kinds[number, start : end - 1] = example.kinds[1:]
            positions[0, number, start:end] = np.arange(len(example))
            positions[1:, number, start:end] = example.positions
            start = end
        rest = np.arange(shape[1] - start)
        positions[:, number, start:] = positions[0, number, start - 1] + 1 + rest
    several = any(len(row) > 1 for row in rows)
    seen = [example.patches for example in flat if example.patches is not None]
    return Batch(
        ids=torch.from_numpy(ids),
        positions=torch.from_numpy(positions if several else positions[1:]),
        targets=torch.from_numpy(targets),
        weights=torch.from_numpy(weights),
        kinds=torch.from_numpy(kinds),
        pixels=torch.from_numpy(np.concatenate([p.values for p in seen])) if seen else None,
        patches=torch.tensor([p.grid for p in seen]) if seen else None,
        cells=CellChoices(
            torch.from_numpy(np.stack([example.present for example in flat])),
            torch.from_numpy(owner),
            torch.from_numpy(last),
        ),
        tokens=sum(map(len, flat)),
    )


def _bucketed(examples: Sequence[Example], plan: FinetunePlan) -> list[list[list[Example]]]:
    """Examples by length, each in a row of its own."""
    groups: list[list[list[Example]]] = [[]]
    for example in examples:
        length = -(-len(example) // plan.multiple) * plan.multiple
        if groups[-1] and (len(groups[-1]) + 1) * length > plan.batch_tokens:
            groups.append([])
        groups[-1].append([example])
    return [group for group in groups if group]


def _packed(examples: Sequence[Example], plan: FinetunePlan) -> list[list[list[Example]]]:
    """One row a batch, filled with the longest example that still fits."""
    rows: list[list[Example]] = []
    room: list[int] = []
    for example in reversed(examples):
        place = next((i for i, left in enumerate(room) if left >= len(example)), len(rows))
        if place == len(rows):
            rows.append([])
            room.append(plan.batch_tokens)
        rows[place].append(example)
        room[place] -= len(example)
    return [[row] for row in rows]
