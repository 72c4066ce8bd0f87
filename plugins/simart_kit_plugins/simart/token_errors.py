"""What can be wrong in a sequence of voxel tokens, and the error that points at the token."""

from __future__ import annotations

from enum import StrEnum

from simart_kit.errors import BadInputError


class Mistake(StrEnum):
    """The kinds of mistake; the value is how a message names it."""

    MISSING_VOXEL = "missing <voxel>"
    EXTRA_VOXEL = "<voxel> in the middle of a triplet"
    BAD_INDEX = "not a cell index"
    INDEX_OUT_OF_RANGE = "cell index out of range"
    DUPLICATE_INDEX = "cell named twice"
    DECREASING_INDEX = "cells out of order"
    FOREIGN_INDEX = "cell that the input does not occupy"
    BAD_CODE = "not a code"
    CODE_OUT_OF_RANGE = "code out of range"
    EMPTY_CODE = "code 0, which means emptiness"
    TRUNCATED = "triplet cut short"
    TRAILING = "text after the last triplet"


class TokenError(BadInputError):
    """A sequence of tokens is not valid.

    Attributes:
        source: what was read, such as a file or a part's name.
        mistake: the kind of mistake.
        token: number of the token, from 0; one past the last for a sequence that ends too early.
        offset: character at which the token starts, from 0; none for a sequence of ids.
        found: the token as it was met.
        expected: what may stand there.
        excerpt: the token among its neighbours, marked by `>>` and `<<`, in one line.
    """

    def __init__(
        self,
        source: str,
        mistake: Mistake,
        token: int,
        offset: int | None,
        found: str,
        expected: str,
        excerpt: str,
    ) -> None:
        # All of them go to the base, so that the error survives the way back from a worker process.
        super().__init__(source, mistake, token, offset, found, expected, excerpt)
        self.source, self.mistake, self.token, self.offset = source, mistake, token, offset
        self.found, self.expected, self.excerpt = found, expected, excerpt

    def __str__(self) -> str:
        place = f"token {self.token}" + ("" if self.offset is None else f", character {self.offset}")
        return (
            f"{self.source}: {self.mistake} at {place} (from 0): "
            f"found {self.found}, expected {self.expected}; near {self.excerpt}"
        )
