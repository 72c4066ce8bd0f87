"""The pen: writes texts, numbers, names and voxels token by token, asking wherever there is a choice.

Every way of writing is a generator of `Point`s. Whoever runs it sends back the id that was chosen: the id of
the answer that is being encoded, or the one that a model prefers.
"""

from __future__ import annotations

from collections.abc import Generator, Sequence
from dataclasses import dataclass
from typing import NamedTuple, TypeVar

import numpy as np

from simart_kit.arrays import IntArray, frozen_ints

from ..answer.values import NAME_LENGTH
from ..tokens import VoxelTokens
from ..vocabulary import Vocabulary
from .lexicon import Lexicon
from .spelling import Spelling

T = TypeVar("T")


class Point(NamedTuple):
    """One token to be chosen.

    Attributes:
        allowed: (A,) ids, at least one; where it is the only one, the token is forced.
        wanted: the id of the answer that is being encoded; None when a model chooses.
    """

    allowed: IntArray
    wanted: int | None


Writing = Generator[Point, int, T]


@dataclass(frozen=True, slots=True)
class Want:
    """What a value is to be, when an answer is encoded.

    Attributes:
        text: the value, without what ends it.
        end: which of the ends follows.
    """

    text: str
    end: int = 0


class Written(NamedTuple):
    """A value, and which of the possible ends followed it."""

    text: str
    end: int


@dataclass(eq=False)
class Node:
    """A place in the tree of alternatives: tokens that may follow, or the alternative that is complete."""

    follow: dict[int, Node]
    ids: IntArray
    complete: int = -1


class Pen:
    """Writes with a tokenizer's tokens; a value is followed by one of several texts, its ends."""

    def __init__(self, lexicon: Lexicon, vocabulary: Vocabulary) -> None:
        """Take the ids of texts from `lexicon` and those of voxels from `vocabulary`."""
        self._lexicon, self._vocabulary = lexicon, vocabulary
        self._trees: dict[tuple[str, ...], Node] = {}
        first = vocabulary.first_code
        self._codes = frozen_ints(np.arange(first + 1, first + vocabulary.grid.codebook))
        self._single: dict[int, IntArray] = {}

    def text(self, text: str) -> Writing[None]:
        """Write a text that leaves no choice."""
        for number in self._lexicon.ids(text):
            yield Point(self._only(number), number)

    def choice(self, alternatives: tuple[str, ...], want: int | None) -> Writing[int]:
        """Write one of several texts, and give its place among them; `want` is the place that is wanted."""
        wanted = None if want is None else self._lexicon.ids(alternatives[want])
        node, written = self._tree(alternatives), 0
        while node.complete < 0:
            node = node.follow[(yield Point(node.ids, None if wanted is None else wanted[written]))]
            written += 1
        return node.complete

    def number(self, spelling: Spelling, ends: tuple[str, ...], want: Want | None) -> Writing[Written]:
        """Write a number, a character a token, and one of the ends, none of which begins like a number."""
        characters, text = self._lexicon.characters, ""
        while True:
            following, may_end = spelling(text)
            allowed = self._with_ends([characters[one] for one in following], ends if may_end else ())
            wanted = None if want is None else want.text[len(text) : len(text) + 1]
            target = self._target(want, ends, characters[wanted] if wanted else None)
            chosen = yield Point(allowed, target)
            if chosen not in characters.values():
                return Written(text, (yield from self._rest(ends, chosen, want)))
            text += self._lexicon.text_of[chosen]

    def words(self, ends: tuple[str, ...], want: Want | None) -> Writing[Written]:
        """Write a name of letters, digits, single blanks, "-" and "_", or none, and one of the ends."""
        ids = () if want is None else self._lexicon.encode(want.text)
        text, written = "", 0
        while True:
            may_end = not text or text[-1].isalnum()
            allowed = self._with_ends(self._word_ids(text), ends if may_end else ())
            target = self._target(want, ends, ids[written] if written < len(ids) else None)
            chosen = yield Point(allowed, target)
            word = self._lexicon.text_of.get(chosen)
            if word is None:
                return Written(text, (yield from self._rest(ends, chosen, want)))
            text, written = text + word, written + 1

    def voxels(self, cells: IntArray, ends: tuple[str, ...], want: VoxelTokens | None) -> Writing[None]:
        """Write at least one voxel and one of the ends, the first where the voxels are given.

        Args:
            cells: (C,) ascending indices of the cells that may be named.
            ends: what may follow.
            want: the voxels, where an answer is encoded.
        """
        vocabulary = self._vocabulary
        coordinates = frozen_ints(cells + vocabulary.first_coordinate)
        wanted = iter(() if want is None else vocabulary.encode(want).tolist())
        voxel, used = vocabulary.first_id, 0
        closing = None if want is None else self._tree(ends[:1]).ids[0].item()
        chosen = yield Point(self._only(voxel), next(wanted, None))
        while chosen == voxel:
            chosen = yield Point(coordinates[used:], next(wanted, None))
            used = int(np.searchsorted(coordinates, chosen)) + 1
            yield Point(self._codes, next(wanted, None))
            more = [voxel] if used < len(coordinates) else []
            chosen = yield Point(self._with_ends(more, ends), next(wanted, closing))
        yield from self._rest(ends, chosen, None if want is None else Want(""))

    def _rest(self, ends: tuple[str, ...], first: int, want: Want | None) -> Writing[int]:
        """What follows the first token of an end; gives which end it was."""
        node, written = self._tree(ends).follow[first], 1
        wanted = None if want is None else self._lexicon.ids(ends[want.end])
        while node.complete < 0:
            node = node.follow[(yield Point(node.ids, None if wanted is None else wanted[written]))]
            written += 1
        return node.complete

    def _target(self, want: Want | None, ends: tuple[str, ...], within: int | None) -> int | None:
        """The id that is wanted next: one of the value, or the first of its end."""
        if want is None or within is not None:
            return within
        return self._lexicon.ids(ends[want.end])[0]

    def _with_ends(self, ids: Sequence[int] | IntArray, ends: tuple[str, ...]) -> IntArray:
        starts = self._tree(ends).ids if ends else frozen_ints([])
        return frozen_ints(np.concatenate([np.asarray(ids, dtype=np.int32), starts]))

    def _word_ids(self, text: str) -> IntArray:
        """(W,) ids of the words that may follow, after each of which the name can be brought to an end."""
        words, room = self._lexicon.words, NAME_LENGTH - len(text)
        fits = (words.length < room) | ((words.length == room) & words.ends)
        if not text:
            fits &= words.starts
        elif text.endswith(" "):
            fits &= words.joins
        return np.asarray(words.ids[fits])

    def _only(self, number: int) -> IntArray:
        if number not in self._single:
            self._single[number] = frozen_ints([number])
        return self._single[number]

    def _tree(self, texts: tuple[str, ...]) -> Node:
        """The tree of alternatives, which is remembered: the same few come up again and again."""
        if texts not in self._trees:
            sequences = [(place, self._lexicon.ids(text)) for place, text in enumerate(texts)]
            self._trees[texts] = _tree(sequences, 0)
        return self._trees[texts]


def _tree(sequences: list[tuple[int, tuple[int, ...]]], depth: int) -> Node:
    """The tree of numbered sequences from a depth on; raises ValueError where one begins another."""
    done = [place for place, ids in sequences if len(ids) == depth]
    if done and len(sequences) > 1:
        raise ValueError("an alternative of the grammar begins another: they could not be told apart")
    if done:
        return Node({}, frozen_ints([]), done[0])
    branches: dict[int, list[tuple[int, tuple[int, ...]]]] = {}
    for place, ids in sequences:
        branches.setdefault(ids[depth], []).append((place, ids))
    follow = {number: _tree(members, depth + 1) for number, members in branches.items()}
    return Node(follow, frozen_ints(list(follow)))
