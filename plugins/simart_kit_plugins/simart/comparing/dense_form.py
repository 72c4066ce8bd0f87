"""Voxels without coordinates: a code for every cell of the grid, in order, code 0 where a cell is empty.

The vocabulary decides how voxels are written; prompts, grammar and loss take it from there.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from simart_kit.arrays import IntArray, frozen_ints

from ..finetune.choices import Rows
from ..grammar.grammar import MAX_PARTS, Grammar
from ..grammar.lexicon import Lexicon, Tokenizer
from ..grammar.pen import Pen, Point, Want, Writing
from ..mllm.simart_model import SimartModel
from ..tokens import EMPTY_CODE, VoxelTokens
from ..vocabulary import Vocabulary


@dataclass(frozen=True, slots=True)
class DenseVocabulary(Vocabulary):
    """The same ids as `Vocabulary`, of which a sequence has codes alone, as many as there are cells."""

    def encode(self, tokens: VoxelTokens) -> IntArray:
        """(cells,) ids; raises BadInputError for tokens of another grid or codebook."""
        Vocabulary.encode(self, tokens)
        return frozen_ints(tokens.dense().ravel() + self.first_code)


class DensePen(Pen):
    """Writes voxels as dense grids; cells that the input has not can only be empty, which is forced."""

    def __init__(self, lexicon: Lexicon, vocabulary: Vocabulary) -> None:
        """Take the ids as `Pen` does."""
        super().__init__(lexicon, vocabulary)
        self._empty = vocabulary.first_code + EMPTY_CODE
        self._codes_or_empty = frozen_ints(np.append(self._empty, self._codes))

    def voxels(self, cells: IntArray, ends: tuple[str, ...], want: VoxelTokens | None) -> Writing[None]:
        """Write a code for each cell of the grid, at least one not empty; the arguments are `Pen.voxels`'."""
        named, last = set(cells.tolist()), int(cells[-1])
        wanted = iter(() if want is None else self._vocabulary.encode(want).tolist())
        found = False
        for cell in range(self._vocabulary.grid.cells):
            allowed = self._only(self._empty) if cell not in named else self._codes_or_empty
            if cell == last and not found:
                allowed = self._codes
            chosen = yield Point(allowed, next(wanted, None))
            found = found or chosen != self._empty
        ending = None if want is None else Want("")
        chosen = yield Point(self._with_ends((), ends), self._target(ending, ends, None))
        yield from self._rest(ends, chosen, ending)


class DenseGrammar(Grammar):
    """`Grammar` with voxels as dense grids; its texts are those of the sparse form, which are parsed."""

    def __init__(self, tokenizer: Tokenizer, vocabulary: Vocabulary, *, max_parts: int = MAX_PARTS) -> None:
        """Read the vocabulary as `Grammar` does."""
        super().__init__(tokenizer, vocabulary, max_parts=max_parts)
        self._pen = DensePen(self._lexicon, vocabulary)

    def text(self, ids: Sequence[int] | IntArray) -> str:
        """The text of ids in the sparse form."""
        return super().text(sparse_ids(ids, self.vocabulary))


def sparse_ids(ids: Sequence[int] | IntArray, vocabulary: Vocabulary) -> list[int]:
    """Ids with every whole dense grid as triplets; a grid that is cut off is left out."""
    grid, first = vocabulary.grid, vocabulary.first_code
    result: list[int] = []
    codes: list[int] = []
    for token in map(int, ids):
        if not first <= token < first + grid.codebook:
            result.append(token)
            continue
        codes.append(token - first)
        if len(codes) == grid.cells:
            tokens = VoxelTokens.from_dense(grid, np.array(codes).reshape(grid.shape))
            result += Vocabulary.encode(vocabulary, tokens).tolist()
            codes = []
    return result


def written_densely(bundle: SimartModel) -> SimartModel:
    """The same model, asked and answering in dense grids."""
    known = bundle.vocabulary
    return replace(bundle, vocabulary=DenseVocabulary(known.grid, known.first_id))


def grammar_of(bundle: SimartModel) -> Grammar:
    """The grammar of a model's form of voxels."""
    dense = isinstance(bundle.vocabulary, DenseVocabulary)
    return (DenseGrammar if dense else Grammar)(bundle.tokenizer, bundle.vocabulary)


def choices_of(vocabulary: Vocabulary) -> Rows:
    """Where each kind of token is; in the dense form emptiness is a code to be chosen, too."""
    rows = Rows.of(vocabulary)
    if not isinstance(vocabulary, DenseVocabulary):
        return rows
    return replace(rows, codes=slice(rows.codes.start - 1, rows.codes.stop))
