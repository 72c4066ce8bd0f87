"""What a data set holds, counted as it is written; sums, so that millions of records need no memory."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable
from typing import Any

from pydantic import BaseModel, ConfigDict, Field

from ..token_counts import TokenCounts, token_counts
from ..tokens import VoxelTokens
from .record import Record

PAPER_TOKENS = {"zero-sparse": 516, "force-sparse": 862, "dense": 4138}
"""Output tokens an object of the paper's ablation, symbolic text counted too."""


class Statistics(BaseModel):
    """Counts of a data set, or of one object of it.

    Histograms have the number of records by value, such as {"2": 14} for 14 records of two parts.
    """

    model_config = ConfigDict(extra="forbid", strict=True)

    objects: int = 0
    static: int = Field(default=0, description="Objects whose parts are all fixed.")
    records: int = Field(default=0, description="States of all objects.")
    pairs: dict[str, int] = Field(default={}, description="Questions by task.")
    skipped: dict[str, int] = Field(default={}, description="Objects left out, by reason.")
    sources: dict[str, int] = Field(default={}, description="Objects by source.")
    categories: dict[str, int] = Field(default={}, description="Objects by category.")
    types: dict[str, int] = Field(default={}, description="Parts by type, of all records.")
    parts: dict[str, int] = Field(default={}, description="Histogram of parts.")
    part_cells: dict[str, int] = Field(default={}, description="Histogram of the parts' cells, summed.")
    whole_cells: dict[str, int] = Field(default={}, description="Histogram of the whole's cells.")
    dense_tokens: int = Field(default=0, description="Tokens of all parts' dense form.")
    force_sparse_tokens: int = Field(default=0, description="Of their force-sparse form, see `of_records`.")
    zero_sparse_tokens: int = Field(default=0, description="Of their zero-sparse form.")

    def plus(self, other: Statistics) -> Statistics:
        """Both together."""
        values: dict[str, Any] = {}
        for name in type(self).model_fields:
            one, two = getattr(self, name), getattr(other, name)
            values[name] = one + two if isinstance(one, int) else _ordered(Counter(one) + Counter(two))
        return Statistics(**values)


def of_records(records: Iterable[Record]) -> Statistics:
    """Counts of one object's records; there is at least one.

    Tokens are voxel tokens of the parts, summed over the parts as in the paper's table; the symbolic text
    comes on top. The force-sparse form is counted with the occupied cells, the fewest that it can have: how
    many empty ones it keeps only a model without a zero token tells, see `bench vqvae`.
    """
    every = list(records)
    tokens = [_tokens([part.voxels for part in record.answer.parts]) for record in every]
    parts = [part for record in every for part in record.answer.parts]
    return Statistics(
        objects=1,
        static=int(all(part.type == "fixed" for part in parts)),
        records=len(every),
        pairs=_counted(pair.task for record in every for pair in record.pairs),
        sources={every[0].source: 1},
        categories={every[0].category: 1},
        types=_counted(part.type for part in parts),
        parts=_counted(str(len(record.answer.parts)) for record in every),
        part_cells=_counted(str(count.zero_sparse.cells) for count in tokens),
        whole_cells=_counted(str(len(record.voxels.index)) for record in every),
        dense_tokens=sum(count.dense.tokens for count in tokens),
        force_sparse_tokens=sum(count.force_sparse.tokens for count in tokens),
        zero_sparse_tokens=sum(count.zero_sparse.tokens for count in tokens),
    )


def skip(reason: str) -> Statistics:
    """Counts of an object that was left out."""
    return Statistics(skipped={reason: 1})


def quantile(histogram: dict[str, int], share: float) -> int:
    """The smallest value that at least this share of a histogram's records does not exceed; 0 for none."""
    total, seen = sum(histogram.values()), 0
    for value in sorted(map(int, histogram)):
        seen += histogram[str(value)]
        if seen >= share * total:
            return value
    return 0


def _tokens(parts: list[VoxelTokens]) -> TokenCounts:
    first, *others = (token_counts(part.dense() > 0) for part in parts)
    for more in others:
        first = first + more
    return first


def _counted(values: Iterable[str]) -> dict[str, int]:
    return _ordered(Counter(values))


def _ordered(counts: Counter[str]) -> dict[str, int]:
    """By number or by name, so that the order of the work leaves no trace."""
    return dict(sorted(counts.items(), key=lambda item: (len(item[0]) if item[0].isdigit() else 0, item[0])))
