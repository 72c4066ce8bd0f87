"""What answers score that know nothing of the object in question."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from simart_kit.arrays import IntArray

from ..answer.values import ObjectAnswer, PartAnswer
from ..dataset.record import Pair, Record
from ..tokens import VoxelTokens


def still(record: Record) -> ObjectAnswer:
    """Nothing moves: one fixed part with all cells."""
    return ObjectAnswer("object", record.answer.scale, (PartAnswer("fixed", record.voxels),))


def borrowed(record: Record, others: Sequence[Record], rng: np.random.Generator) -> ObjectAnswer:
    """The answer to another object, taken at random; its parts get this object's cells at random.

    Every part is given the share of the cells that it had there, at least one.
    """
    other = others[int(rng.integers(len(others)))]
    sizes = np.array([len(part.voxels.index) for part in other.answer.parts], dtype=np.float64)
    cells = len(record.voxels.index)
    kept = other.answer.parts[:cells]
    counts = np.maximum(1, np.floor(cells * sizes / sizes.sum()).astype(int))[: len(kept)]
    order = rng.permutation(cells)
    ends = np.minimum(np.cumsum(counts), cells)
    starts = np.concatenate([[0], ends[:-1]])
    parts = tuple(
        replace(part, voxels=_subset(record.voxels, order[start:end]))
        for part, start, end in zip(kept, starts, ends, strict=True)
    )
    return ObjectAnswer(other.answer.name, other.answer.scale, parts)


def guessed_cells(record: Record, pair: Pair, rng: np.random.Generator) -> IntArray:
    """Cells at random, as many as the part that is asked for really has."""
    if pair.part is None:
        raise ValueError("a question for the whole object asks for no part")
    size = len(record.answer.parts[pair.part].voxels.index)
    return np.asarray(rng.permutation(record.voxels.index)[:size])


def _subset(voxels: VoxelTokens, places: IntArray) -> VoxelTokens:
    chosen = np.sort(places)
    return VoxelTokens(voxels.grid, voxels.index[chosen], voxels.code[chosen])
