"""Voxel tokens as ids: the tokens that a model's tokenizer is given, and the way there and back."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from simart_kit.arrays import IntArray, frozen_ints
from simart_kit.errors import BadInputError

from .token_parser import ATOMIC, Kind, Word, WordSequence, read_triplets
from .tokens import VOXEL_NAME, TokenGrid, VoxelTokens, code_name, coordinate_name


@dataclass(frozen=True, slots=True)
class Vocabulary:
    """Consecutive ids for `<voxel>`, then every cell `<xyz_i>`, then every code `<mesh_k>`.

    Code 0 has an id too, so that an id less `first_code` is the row of the codebook; it never occurs in a
    valid sequence.

    Attributes:
        grid: the grid and codebook that the tokens belong to.
        first_id: id of `<voxel>`, the length of the tokenizer before the tokens are added.
    """

    grid: TokenGrid
    first_id: int

    def __post_init__(self) -> None:
        """Refuse ids that do not fit the int32 arrays which hold them."""
        if not 0 <= self.first_id <= 2**31 - len(self):
            raise BadInputError(f"first token id {self.first_id} must lie in 0..{2**31 - len(self)}")

    def __len__(self) -> int:
        return 1 + self.grid.cells + self.grid.codebook

    @property
    def first_coordinate(self) -> int:
        """Id of `<xyz_0>`."""
        return self.first_id + 1

    @property
    def first_code(self) -> int:
        """Id of `<mesh_0>`."""
        return self.first_coordinate + self.grid.cells

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the tokens in the order of their ids, to be added to a tokenizer in one go."""
        cells = map(coordinate_name, range(self.grid.cells))
        codes = map(code_name, range(self.grid.codebook))
        return (VOXEL_NAME, *cells, *codes)

    def encode(self, tokens: VoxelTokens) -> IntArray:
        """(3K,) int32 ids, read-only; raises BadInputError for tokens of another grid or codebook."""
        if tokens.grid != self.grid:
            raise BadInputError(f"tokens of {tokens.grid} do not fit the vocabulary of {self.grid}")
        voxel = np.full(len(tokens.index), self.first_id)
        triplets = [voxel, tokens.index + self.first_coordinate, tokens.code + self.first_code]
        return frozen_ints(np.stack(triplets, axis=1).ravel())

    def decode(
        self,
        ids: Sequence[int] | IntArray,
        *,
        ordered: bool = True,
        allowed: IntArray | None = None,
        source: str = "voxel token ids",
    ) -> VoxelTokens:
        """Read ids back, as strictly as `token_parser.parse` reads text; the options are the same.

        Raises:
            TokenError: the first mistake, with its position.
        """
        end = Word(Kind.END, 0, "the end", None)
        sequence = WordSequence([self._word(value) for value in ids], end, ATOMIC, source)
        return read_triplets(sequence, self.grid, ordered=ordered, allowed=allowed)

    def _word(self, value: object) -> Word:
        """One id as a token; whatever is not an id of this vocabulary is shown as it is."""
        if isinstance(value, bool) or not isinstance(value, (int, np.integer)):
            return Word(Kind.OTHER, 0, str(value), None)
        place = int(value) - self.first_id
        if place == 0:
            return Word(Kind.VOXEL, 0, VOXEL_NAME, None)
        if 1 <= place <= self.grid.cells:
            return Word(Kind.COORDINATE, place - 1, coordinate_name(place - 1), None)
        code = place - 1 - self.grid.cells
        if 0 <= code < self.grid.codebook:
            return Word(Kind.CODE, code, code_name(code), None)
        return Word(Kind.OTHER, 0, f"id {value}", None)
