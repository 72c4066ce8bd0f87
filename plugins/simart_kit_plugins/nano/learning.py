"""Stored examples as batches of tensors, and what the network should have said."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, fields
from typing import Any

import numpy as np
import torch
from torch import Tensor

from simart_kit.arrays import FloatArray

from .config import NanoConfig
from .network import Batch
from .reading import padded, rows_of
from .scene import AREA
from .store import Stored


@dataclass(frozen=True, eq=False)
class Targets:
    """What is right for a `Batch`.

    Attributes:
        part: (B, S) part of each piece; 0 is the body, -1 is padding.
        kind: (B, S) how the piece's part moves; -1 where it does not.
        label: (B, S) what the piece's part is called; -1 for the body and padding.
        category: (B,) what the object is; -1 where it is two.
        size: (B,) natural logarithm of the longest side [m].
        owner: (P,) object of each moving part.
        share: (P, S) how much of the part each piece is.
        numbers: (P, C, COUNT) evidence.
        real: (P, C) bool.
        part_kind: (P,).
        right: (P, C) 1, -1 or 0.
        travel: (P, 2) about the true axis [rad | sides of the object].
        parent: (P,) row of the part that carries it; -1 for the body.
    """

    part: Tensor
    kind: Tensor
    label: Tensor
    category: Tensor
    size: Tensor
    owner: Tensor
    share: Tensor
    numbers: Tensor
    real: Tensor
    part_kind: Tensor
    right: Tensor
    travel: Tensor
    parent: Tensor

    def to(self, device: torch.device | str) -> Targets:
        """On another device."""
        return Targets(*(getattr(self, field.name).to(device) for field in fields(self)))


def batch_of(examples: Sequence[Stored]) -> Batch:
    """Examples side by side."""
    rows = rows_of(examples)
    return Batch(*(torch.from_numpy(getattr(rows, field.name)) for field in fields(rows)))


def targets_of(examples: Sequence[Stored], config: NanoConfig) -> Targets:
    """What is right for `batch_of` the same examples."""
    most = padded(examples)
    widest = max([int(c) for e in examples for c in e.candidates], default=1)
    labels = {label: k for k, label in enumerate(config.labels, start=1)}
    categories = {name: k for k, name in enumerate(config.categories, start=1)}
    part = np.full((len(examples), most), -1)
    kind, label = part.copy(), part.copy()
    rows: list[tuple[Any, ...]] = []
    for row, e in enumerate(examples):
        size, first = len(e.own), len(rows)
        part[row, :size] = e.part
        starts = np.concatenate([[0], np.cumsum(e.candidates)])
        area = np.exp((e.own[:, AREA] - 1) * 6)
        carried = {int(n): first + k for k, n in enumerate(e.number)}
        for k, n in enumerate(e.number):
            mine = e.part == n
            kind[row, :size][mine] = e.kind[k]
            label[row, :size][mine] = labels.get(str(e.label[k]), 0)
            share = np.zeros(most, dtype=np.float32)
            share[:size] = mine * area
            held = slice(starts[k], starts[k + 1])
            numbers = np.zeros((widest, e.numbers.shape[1]), dtype=np.float32)
            right, real = np.zeros(widest, dtype=np.float32), np.zeros(widest, dtype=np.bool_)
            own = starts[k + 1] - starts[k]
            numbers[:own], right[:own], real[:own] = e.numbers[held], e.right[held], True
            parent = carried.get(int(e.parent[k]), -1)
            rows.append((row, share / share.sum(), numbers, real, right, int(e.kind[k]), e.travel[k], parent))
    columns = [np.array(column) for column in zip(*rows, strict=True)] if rows else _no_parts(most, examples)
    owner, shares, evidence, real_, right_, part_kind, travel, parent_ = map(torch.from_numpy, columns)
    known = [categories.get(e.category, 0) if e.category else -1 for e in examples]
    return Targets(
        torch.from_numpy(part),
        torch.from_numpy(kind),
        torch.from_numpy(label),
        torch.tensor(known),
        torch.tensor([float(np.log(e.size)) for e in examples]),
        owner,
        shares.float(),
        evidence,
        real_,
        part_kind,
        right_,
        travel.float(),
        parent_,
    )


def _no_parts(most: int, examples: Sequence[Stored]) -> list[FloatArray]:
    from .evidence import COUNT

    return [
        np.zeros(0, dtype=np.int64),
        np.zeros((0, most), dtype=np.float32),
        np.zeros((0, 1, COUNT), dtype=np.float32),
        np.zeros((0, 1), dtype=np.bool_),
        np.zeros((0, 1), dtype=np.float32),
        np.zeros(0, dtype=np.int64),
        np.zeros((0, 2), dtype=np.float32),
        np.zeros(0, dtype=np.int64),
    ]
