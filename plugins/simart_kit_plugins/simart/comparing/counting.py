"""Output tokens an object, as the paper's table counts them: voxels of all parts, and the text."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..dataset.record import Record
from ..mllm.simart_model import SimartModel
from .dense_form import grammar_of
from .dropping import Recode


@dataclass(frozen=True)
class OutputTokens:
    """Means over records.

    Attributes:
        objects: that were counted.
        parts: of each.
        voxels: tokens that stand for voxels.
        text: the others, the end of the answer included.
    """

    objects: int
    parts: float
    voxels: float
    text: float

    @property
    def all(self) -> float:
        """Tokens of an answer."""
        return self.voxels + self.text


def output_tokens(bundle: SimartModel, records: Sequence[Record], recode: Recode) -> OutputTokens:
    """Count the true answers in a row's form, however long, but for those that its codes cannot tell."""
    grammar, first = grammar_of(bundle), bundle.vocabulary.first_id
    rows = []
    for record in records:
        own = recode(record)
        if own is None or len(own.answer.parts) > grammar.max_parts:
            continue
        ids = grammar.encode_answer(own.answer, allowed=own.voxels.index).ids
        named = int(((ids >= first) & (ids < first + len(bundle.vocabulary))).sum())
        rows.append((len(own.answer.parts), named, len(ids) - named))
    parts, voxels, text = np.mean(rows, axis=0).tolist() if rows else (0.0, 0.0, 0.0)
    return OutputTokens(len(rows), parts, voxels, text)
