"""What a token of an answer is: the losses are told apart by it, and weighed."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from simart_kit.arrays import IntArray, frozen_ints

from ..vocabulary import Vocabulary
from .plan import KindWeights

if TYPE_CHECKING:
    from transformers import PreTrainedTokenizerBase

KINDS = ("coordinate", "code", "number", "word")
COORDINATE, CODE, NUMBER, WORD = range(len(KINDS))
_NUMERIC = frozenset("0123456789.-")


def token_kinds(tokenizer: PreTrainedTokenizerBase, vocabulary: Vocabulary) -> IntArray:
    """(V,) place in `KINDS` of every id of a tokenizer; numbers are written digit by digit."""
    kinds = np.full(len(tokenizer), WORD)
    pieces = tokenizer.convert_ids_to_tokens(list(range(vocabulary.first_id)))
    numeric = [place for place, piece in enumerate(pieces) if piece and set(piece) <= _NUMERIC]
    kinds[numeric] = NUMBER
    kinds[vocabulary.first_coordinate : vocabulary.first_code] = COORDINATE
    kinds[vocabulary.first_code : vocabulary.first_code + vocabulary.grid.codebook] = CODE
    return frozen_ints(kinds)


def kind_weights(weights: KindWeights) -> tuple[float, ...]:
    """The weights in the order of `KINDS`."""
    return (weights.coordinate, weights.code, weights.number, weights.word)
