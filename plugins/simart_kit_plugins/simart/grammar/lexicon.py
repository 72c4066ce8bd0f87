"""What a grammar must know of a tokenizer, looked up once: texts as ids, characters, words of names."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np

from simart_kit.arrays import BoolArray, IntArray, frozen_ints
from simart_kit.errors import BadInputError

# How byte-level tokenizers write a blank.
_BLANK = "Ġ"
_WORD = re.compile(rf"{_BLANK}?[A-Za-z0-9_\-]+(?:{_BLANK}[A-Za-z0-9_\-]+)*{_BLANK}?|{_BLANK}")
_LETTERS = re.compile(r"[A-Za-z0-9]")
_SPELT = "0123456789.-"


class Tokenizer(Protocol):
    """The part of a Hugging Face tokenizer that the grammar uses."""

    @property
    def eos_token(self) -> str | None: ...
    @property
    def all_special_ids(self) -> list[int]: ...
    def get_vocab(self) -> dict[str, int]: ...
    def encode(self, text: str, *, add_special_tokens: bool) -> list[int]: ...
    def convert_ids_to_tokens(self, ids: list[int]) -> Any: ...


@dataclass(frozen=True, eq=False)
class Words:
    """Tokens that names are made of, ascending in id; every array is (W,).

    Attributes:
        ids: their ids.
        length: characters in each.
        starts: whether the first character is a letter or a digit.
        joins: whether it may follow a blank, that is, does not begin with one.
        ends: whether the last character is a letter or a digit.
    """

    ids: IntArray
    length: IntArray
    starts: BoolArray
    joins: BoolArray
    ends: BoolArray


class Lexicon:
    """A tokenizer's ids for what the grammar writes.

    Attributes:
        end: text of the token that ends an answer.
        characters: ids of the digits, "." and "-", which numbers are spelt with, one by one.
        words: tokens that names are made of.
        text_of: text of each token of a name or number by its id.
    """

    def __init__(self, tokenizer: Tokenizer) -> None:
        """Read the whole vocabulary; raises BadInputError for one that is not byte-level or has no end."""
        if tokenizer.eos_token is None:
            raise BadInputError(
                "the tokenizer has no eos token, with which answers end: use one of Qwen's form"
            )
        self.end = str(tokenizer.eos_token)
        self._tokenizer = tokenizer
        self._ids: dict[str, tuple[int, ...]] = {}
        vocabulary = tokenizer.get_vocab()
        special = set(tokenizer.all_special_ids)
        names = sorted(
            (number, name.replace(_BLANK, " "))
            for name, number in vocabulary.items()
            if _WORD.fullmatch(name) and number not in special
        )
        if missing := [one for one in (*_SPELT, _BLANK, "a", "Z", "_") if one not in vocabulary]:
            raise BadInputError(
                f"the tokenizer has no token for {missing[0]!r}: use a byte-level one of Qwen's form"
            )
        self.characters = {one: vocabulary[one] for one in _SPELT}
        self.text_of = dict(names) | {number: one for one, number in self.characters.items()}
        self.words = _words(names)

    def ids(self, text: str) -> tuple[int, ...]:
        """Ids of a text, which is remembered: the texts of the grammar are few."""
        if text not in self._ids:
            self._ids[text] = self.encode(text)
        return self._ids[text]

    def encode(self, text: str) -> tuple[int, ...]:
        """Ids of a text."""
        return tuple(self._tokenizer.encode(text, add_special_tokens=False))

    def text(self, ids: Sequence[int]) -> str:
        """Text of ids that the grammar wrote, all of which stand for ASCII characters."""
        tokens = self._tokenizer.convert_ids_to_tokens(list(ids))
        return "".join(tokens).replace(_BLANK, " ")


def _words(names: list[tuple[int, str]]) -> Words:
    texts = [text for _, text in names]
    return Words(
        ids=frozen_ints([number for number, _ in names]),
        length=frozen_ints([len(text) for text in texts]),
        starts=np.array([_LETTERS.match(text) is not None for text in texts]),
        joins=np.array([text[0] != " " for text in texts]),
        ends=np.array([_LETTERS.match(text[-1]) is not None for text in texts]),
    )
