"""Strict reading of voxel tokens; every mistake is met by a TokenError that points at the token."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from enum import Enum, auto

import numpy as np

from simart_kit.arrays import IntArray

from .token_errors import Mistake, TokenError
from .tokens import EMPTY_CODE, VOXEL_NAME, TokenGrid, VoxelTokens, code_name, coordinate_name

# A name in angle brackets, also one that is cut off, or whatever else stands between blanks.
_WORD = re.compile(r"<[^<>\s]*>?|[^\s<]+")
_NUMBER = re.compile(r"0|[1-9][0-9]*")
_ATOM = re.compile(r"<(xyz|mesh)_(0|[1-9][0-9]*)>")
# No grid or codebook comes near ten digits; longer numbers are not worth converting.
_MOST_DIGITS = 10
_SHOWN = 24
_NEIGHBOURS = 3


class Kind(Enum):
    """What a token can be read as."""

    VOXEL = auto()
    NUMBER = auto()
    COORDINATE = auto()
    CODE = auto()
    OTHER = auto()
    CUT = auto()
    END = auto()


@dataclass(frozen=True, slots=True)
class Word:
    """A token as it was met.

    Attributes:
        kind: what it can be read as.
        value: the cell index, the code, or the number of either; 0 for other kinds.
        shown: how to show it in a message.
        offset: character at which it starts, from 0; none among ids.
    """

    kind: Kind
    value: int
    shown: str
    offset: int | None


@dataclass(frozen=True, slots=True)
class Notation:
    """How cells and codes are written: as decimals, or as atomic tokens."""

    coordinate: Kind
    code: Kind

    def index(self, value: int) -> str:
        """A cell index in this notation."""
        return str(value) if self.coordinate is Kind.NUMBER else coordinate_name(value)

    def entry(self, value: int) -> str:
        """A code in this notation."""
        return str(value) if self.code is Kind.NUMBER else code_name(value)


DECIMAL = Notation(Kind.NUMBER, Kind.NUMBER)
ATOMIC = Notation(Kind.COORDINATE, Kind.CODE)


@dataclass(frozen=True, slots=True)
class WordSequence:
    """What is read: the words, the word that stands for the end, the notation, and the name of it all."""

    words: Sequence[Word]
    end: Word
    notation: Notation
    source: str

    def word(self, token: int) -> Word:
        """The word at a position, or the end behind the last."""
        return self.words[token] if token < len(self.words) else self.end

    def error(self, mistake: Mistake, token: int, expected: str) -> TokenError:
        """The error that points at a token, shown among its neighbours."""
        found = self.word(token)
        first, last = max(0, token - _NEIGHBOURS), token + _NEIGHBOURS + 1
        before = [_clip(word.shown) for word in self.words[first:token]]
        after = [_clip(word.shown) for word in self.words[token + 1 : last]]
        middle = f">>{_clip(found.shown)}<<"
        ends = ["..."] if first > 0 else [], ["..."] if last < len(self.words) else []
        excerpt = " ".join([*ends[0], *before, middle, *after, *ends[1]])
        shown = found.shown if found.kind is Kind.END else repr(_clip(found.shown))
        return TokenError(self.source, mistake, token, found.offset, shown, expected, repr(excerpt))


def parse(
    text: str,
    grid: TokenGrid,
    *,
    ordered: bool = True,
    allowed: IntArray | None = None,
    source: str = "voxel tokens",
) -> VoxelTokens:
    """Read `<voxel> 43 1930 <voxel> 44 7`, or the atomic names `<voxel><xyz_43><mesh_1930>`.

    A text is in one notation throughout: atomic when it holds an `<xyz_` or `<mesh_` name, else decimal.
    Numbers are plain ASCII decimals without sign or leading zeros. An empty text is no cells.

    Args:
        text: what a model or a person wrote.
        grid: the grid and codebook that the tokens belong to.
        ordered: whether a cell index below the one before it is a mistake; the result is in order either way.
        allowed: indices of the input's cells, such as `whole.index`: the paper's rule that "output voxels
            must be a subset of the input". It binds cells only, for parts that share a cell have each a code
            of their own. None allows all cells.
        source: what the text is, for messages.

    Raises:
        TokenError: the first mistake, with its position.
    """
    words = [_word(match) for match in _WORD.finditer(text)]
    notation = ATOMIC if "<xyz_" in text or "<mesh_" in text else DECIMAL
    end = Word(Kind.END, 0, "the end", len(text))
    return read_triplets(WordSequence(words, end, notation, source), grid, ordered=ordered, allowed=allowed)


def read_triplets(
    sequence: WordSequence, grid: TokenGrid, *, ordered: bool, allowed: IntArray | None
) -> VoxelTokens:
    """Read words three by three, as `parse` describes; raises TokenError at the first mistake."""
    permitted = None if allowed is None else {int(cell) for cell in allowed}
    codes: dict[int, int] = {}
    last = -1
    for token in range(0, len(sequence.words), 3):
        _require_voxel(sequence, token)
        index = _index(sequence, token + 1, grid)
        if index in codes:
            raise sequence.error(Mistake.DUPLICATE_INDEX, token + 1, "a cell not named before")
        if ordered and index < last:
            expected = f"a cell after {sequence.notation.index(last)}"
            raise sequence.error(Mistake.DECREASING_INDEX, token + 1, expected)
        if permitted is not None and index not in permitted:
            expected = f"one of the {len(permitted)} cells of the input"
            raise sequence.error(Mistake.FOREIGN_INDEX, token + 1, expected)
        codes[index] = _code(sequence, token + 2, grid)
        last = index
    pairs = np.array(sorted(codes.items()), dtype=np.int32).reshape(-1, 2)
    return VoxelTokens(grid, pairs[:, 0], pairs[:, 1])


def _require_voxel(sequence: WordSequence, token: int) -> None:
    found = sequence.word(token)
    if found.kind is Kind.VOXEL:
        return
    if found.kind is Kind.CUT:
        raise sequence.error(Mistake.TRUNCATED, token, VOXEL_NAME)
    # A stray word behind the last triplet is chatter; a number, or triplets that go on, betray a lost token.
    goes_on = any(word.kind is Kind.VOXEL for word in sequence.words[token:])
    if token > 0 and found.kind is Kind.OTHER and not goes_on:
        raise sequence.error(Mistake.TRAILING, token, f"{VOXEL_NAME} or the end")
    raise sequence.error(Mistake.MISSING_VOXEL, token, VOXEL_NAME)


def _index(sequence: WordSequence, token: int, grid: TokenGrid) -> int:
    notation = sequence.notation
    expected = f"a cell index {notation.index(0)}..{notation.index(grid.cells - 1)}"
    _require_kind(sequence, token, notation.coordinate, Mistake.BAD_INDEX, expected)
    value = sequence.word(token).value
    if value >= grid.cells:
        raise sequence.error(Mistake.INDEX_OUT_OF_RANGE, token, expected)
    return value


def _code(sequence: WordSequence, token: int, grid: TokenGrid) -> int:
    notation = sequence.notation
    expected = f"a code {notation.entry(1)}..{notation.entry(grid.codebook - 1)}"
    _require_kind(sequence, token, notation.code, Mistake.BAD_CODE, expected)
    value = sequence.word(token).value
    if value == EMPTY_CODE:
        raise sequence.error(Mistake.EMPTY_CODE, token, expected)
    if value >= grid.codebook:
        raise sequence.error(Mistake.CODE_OUT_OF_RANGE, token, expected)
    return value


def _require_kind(
    sequence: WordSequence, token: int, wanted: Kind, otherwise: Mistake, expected: str
) -> None:
    """Raise unless the word is of the wanted kind; `otherwise` is the mistake where no better name fits."""
    found = sequence.word(token).kind
    if found in (Kind.END, Kind.CUT):
        raise sequence.error(Mistake.TRUNCATED, token, expected)
    if found is Kind.VOXEL:
        raise sequence.error(Mistake.EXTRA_VOXEL, token, expected)
    if found is not wanted:
        raise sequence.error(otherwise, token, expected)


def _word(match: re.Match[str]) -> Word:
    """Read one word of a text."""
    text, offset = match[0], match.start()
    if text == VOXEL_NAME:
        return Word(Kind.VOXEL, 0, text, offset)
    if _NUMBER.fullmatch(text):
        return Word(Kind.NUMBER, _value(text), text, offset)
    if atom := _ATOM.fullmatch(text):
        kind = Kind.COORDINATE if atom[1] == "xyz" else Kind.CODE
        return Word(kind, _value(atom[2]), text, offset)
    # A name that the text's own end cuts in two is the work of a length limit, not a wrong name.
    cut = text.startswith("<") and not text.endswith(">") and match.end() == len(match.string)
    return Word(Kind.CUT if cut else Kind.OTHER, 0, text, offset)


def _value(digits: str) -> int:
    return int(digits) if len(digits) <= _MOST_DIGITS else 10**_MOST_DIGITS


def _clip(text: str) -> str:
    return text if len(text) <= _SHOWN else text[: _SHOWN - 3] + "..."
