"""The grammar of the model's answers, for one tokenizer."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from simart_kit.arrays import IntArray, frozen_ints
from simart_kit.errors import BadInputError

from ..answer.values import ObjectAnswer
from ..mllm.tokenizing import require_names
from ..tokens import VoxelTokens
from ..vocabulary import Vocabulary
from .fitting import object_text
from .lexicon import Lexicon, Tokenizer
from .machine import Encoded, Machine, encode
from .pen import Pen
from .script import write_answer, write_grounding

__all__ = ["MAX_PARTS", "Encoded", "Grammar", "Machine"]

MAX_PARTS = 16


class Grammar:
    """Encodes answers for training, and makes the state machines that decode nothing but valid ones.

    Attributes:
        vocabulary: ids of the voxel tokens.
        max_parts: how many parts an answer may have.
    """

    def __init__(self, tokenizer: Tokenizer, vocabulary: Vocabulary, *, max_parts: int = MAX_PARTS) -> None:
        """Read the tokenizer's vocabulary, once.

        Args:
            tokenizer: a byte-level tokenizer of Qwen's form, with the voxel tokens added.
            vocabulary: ids of the voxel tokens in it.
            max_parts: how many parts an answer may have.

        Raises:
            BadInputError: the tokenizer is of another kind, or has not these voxel tokens.
        """
        if max_parts < 1:
            raise BadInputError(f"max_parts is {max_parts}: an answer has at least one part")
        require_names(tokenizer, vocabulary)
        self.vocabulary, self.max_parts = vocabulary, max_parts
        self._lexicon = Lexicon(tokenizer)
        self._pen = Pen(self._lexicon, vocabulary)
        self._coordinates = range(vocabulary.first_coordinate, vocabulary.first_code)

    def encode_answer(self, answer: ObjectAnswer, *, allowed: IntArray | None = None) -> Encoded:
        """The ids of an answer. What the grammar cannot write is rounded, as `fitting.object_text` tells.

        Args:
            answer: what is to be written.
            allowed: (C,) cells of the input, which tell where voxels are forced; None for those of the parts.

        Raises:
            BadInputError: too many parts, or a part without voxels or outside the allowed cells.
        """
        text = object_text(answer, self.max_parts)
        used = np.unique(np.concatenate([part.voxels.index for part in answer.parts]))
        cells = self._cells(used if allowed is None else allowed)
        for number, part in enumerate(answer.parts):
            self._require_within(part.voxels, cells, f"part {number} of the answer")
        return encode(write_answer(self._pen, cells, self.max_parts, self._lexicon.end, text))

    def encode_grounding(self, tokens: VoxelTokens, *, allowed: IntArray | None = None) -> Encoded:
        """The ids of the voxels of one part; `allowed` as for an answer, None for all cells of the grid."""
        cells = self._cells(np.arange(self.vocabulary.grid.cells) if allowed is None else allowed)
        self._require_within(tokens, cells, "the grounded part")
        return encode(write_grounding(self._pen, cells, self._lexicon.end, tokens))

    def answer_machine(self, allowed: IntArray) -> Machine:
        """A machine that decodes an answer about an input with these (C,) cells."""
        script = write_answer(self._pen, self._cells(allowed), self.max_parts, self._lexicon.end, None)
        return Machine(script, self._coordinates)

    def grounding_machine(self, allowed: IntArray) -> Machine:
        """A machine that decodes the voxels of one part of an input with these (C,) cells."""
        script = write_grounding(self._pen, self._cells(allowed), self._lexicon.end, None)
        return Machine(script, self._coordinates)

    def text(self, ids: Sequence[int] | IntArray) -> str:
        """The text of ids, in the atomic form that the parsers of answers read, without its end."""
        return self._lexicon.text([int(token) for token in ids]).removesuffix(self._lexicon.end)

    def _cells(self, allowed: IntArray) -> IntArray:
        cells = frozen_ints(np.unique(allowed))
        if not len(cells):
            raise BadInputError("the input has no voxel tokens: there is nothing to find parts in")
        if cells[0] < 0 or cells[-1] >= self.vocabulary.grid.cells:
            raise BadInputError(f"the input's cells must lie within 0..{self.vocabulary.grid.cells - 1}")
        return cells

    def _require_within(self, tokens: VoxelTokens, cells: IntArray, what: str) -> None:
        if tokens.grid != self.vocabulary.grid:
            raise BadInputError(f"{what} is in {tokens.grid}, but the model's is {self.vocabulary.grid}")
        if not len(tokens.index):
            raise BadInputError(f"{what} has no voxels: leave it out")
        if foreign := np.setdiff1d(tokens.index, cells).tolist():
            raise BadInputError(f"{what} has cell {foreign[0]}, which is not a cell of the input")
