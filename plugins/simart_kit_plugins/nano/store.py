"""Examples as one file of arrays, so that training reads thousands without making them again."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from simart_kit.arrays import Float32Array, FloatArray, IntArray

from .evidence import COUNT
from .examples import Example, MovingPart

# Fields of a row each: (name, type); what belongs to one example lies together.
_PER_POINT = ("points", "normals", "colors", "piece")
_PER_PIECE = ("own", "part")
_PER_PART = ("number", "kind", "travel", "parent", "label", "candidates")
_PER_CANDIDATE = ("numbers", "right")


@dataclass(frozen=True, eq=False)
class Stored:
    """An example as training reads it; shapes as in `Example` and `PartTruth`.

    Attributes:
        points, normals, colors: (N, 3).
        piece: (N,).
        own: (S, PIECE_NUMBERS).
        gap: (S, S).
        part: (S,) part of each piece.
        number: (Q,) the moving parts that can be told, as numbers in `part`.
        kind, parent: (Q,).
        label: (Q,) text.
        travel: (Q, 2).
        candidates: (Q,) how many each has.
        numbers: (sum of these, COUNT).
        right: (sum of these,).
        category: of the object.
        size: longest side [m].
    """

    points: FloatArray
    normals: FloatArray
    colors: FloatArray
    piece: IntArray
    own: Float32Array
    gap: Float32Array
    part: IntArray
    number: IntArray
    kind: IntArray
    travel: Float32Array
    parent: IntArray
    label: np.ndarray[tuple[int], np.dtype[np.str_]]
    candidates: IntArray
    numbers: FloatArray
    right: IntArray
    category: str
    size: float


def stored(example: Example) -> Stored:
    """An example in its small form."""
    known = [(n, part) for n, part in enumerate(example.parts, start=1) if part is not None]
    parts: list[MovingPart] = [part for _, part in known]
    truths = [part.truth for part in parts]
    cloud = example.cloud
    return Stored(
        cloud.points.astype(np.float16),
        cloud.normals.astype(np.float16),
        cloud.colors.astype(np.float16),
        cloud.piece.astype(np.int16),
        example.pieces.own,
        example.pieces.gap.astype(np.float16),
        example.part.astype(np.int16),
        np.array([n for n, _ in known], dtype=np.int16),
        np.array([truth.kind for truth in truths], dtype=np.int8),
        np.array([truth.travel for truth in truths], dtype=np.float32).reshape(-1, 2),
        np.array([truth.parent for truth in truths], dtype=np.int16),
        np.array([truth.label for truth in truths], dtype=np.str_),
        np.array([len(truth.right) for truth in truths], dtype=np.int16),
        np.concatenate([*(part.numbers for part in parts), np.zeros((0, COUNT))]).astype(np.float16),
        np.concatenate([*(truth.right for truth in truths), np.zeros(0, dtype=np.int8)]),
        example.category,
        example.size,
    )


def save(examples: Sequence[Stored], path: Path) -> None:
    """Write examples; no pickle."""
    names = [*_PER_POINT, *_PER_PIECE, *_PER_PART, *_PER_CANDIDATE]
    arrays = {name: np.concatenate([getattr(e, name) for e in examples]) for name in names}
    arrays["gap"] = np.concatenate([e.gap.ravel() for e in examples])
    arrays["category"] = np.array([e.category for e in examples])
    arrays["size"] = np.array([e.size for e in examples])
    counts = [(len(e.points), len(e.own), len(e.number), len(e.right)) for e in examples]
    arrays["counts"] = np.array(counts)
    partial = path.with_suffix(".partial.npz")
    np.savez(partial, allow_pickle=False, **arrays)
    partial.replace(path)


def load(path: Path) -> list[Stored]:
    """Read what `save` wrote."""
    with np.load(path) as file:
        arrays = {name: file[name] for name in file.files}
    counts = arrays["counts"]
    ends = np.concatenate([np.zeros((1, 4), dtype=np.int64), np.cumsum(counts, axis=0)])
    square = np.concatenate([[0], np.cumsum(counts[:, 1] ** 2)])
    rows = zip((_PER_POINT, _PER_PIECE, _PER_PART, _PER_CANDIDATE), range(4), strict=True)
    place = {name: level for fields, level in rows for name in fields}
    found = []
    for k in range(len(counts)):
        own = {name: arrays[name][ends[k, lv] : ends[k + 1, lv]] for name, lv in place.items()}
        gap = arrays["gap"][square[k] : square[k + 1]].reshape(counts[k, 1], counts[k, 1])
        found.append(
            Stored(**own, gap=gap, category=str(arrays["category"][k]), size=float(arrays["size"][k]))
        )
    return found
