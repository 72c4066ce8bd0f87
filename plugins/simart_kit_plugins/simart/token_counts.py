"""How long the token sequence of a shape is, and what sparsity saves.

How the paper's numbers are read. "Approximately 70 %" fewer informative tokens is the share of a grid's
cells that are empty and so need no token: `reduction.cells`. A dense sequence needs one code a cell, for the
place in the sequence tells the coordinate; a sparse one needs `<voxel>`, coordinate and code, three atomic
tokens a cell. In tokens, `reduction.tokens`, a single grid therefore gains only while less than a third of
its cells are occupied. The paper's table of token numbers sums over the parts of an object: the dense form
repeats the whole grid for each part, while the sparse form grows with what the parts occupy. Add the counts
of the parts, with `+`, to compare with it; the table also counts symbolic text, of an unknown length.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from simart_kit.arrays import BoolArray
from simart_kit.errors import BadInputError

from .tokens import GRID_SHAPES

DENSE_TOKENS_PER_CELL = 1
SPARSE_TOKENS_PER_CELL = 3


@dataclass(frozen=True, slots=True)
class SequenceLength:
    """Length of a sequence.

    Attributes:
        cells: cells that it names.
        tokens: atomic tokens that a model reads or writes for them.
    """

    cells: int
    tokens: int

    def __add__(self, other: SequenceLength) -> SequenceLength:
        return SequenceLength(self.cells + other.cells, self.tokens + other.tokens)


@dataclass(frozen=True, slots=True)
class Reduction:
    """What the zero-sparse form saves against the dense one, as shares; below 0 where it is longer.

    Attributes:
        cells: share of the cells that need no token, the paper's 70 %.
        tokens: share of the atomic tokens saved.
    """

    cells: float
    tokens: float


@dataclass(frozen=True, slots=True)
class TokenCounts:
    """Lengths of the three forms of one grid, or of several added up.

    Attributes:
        dense: a code for every cell.
        force_sparse: a triplet for every cell that a model without a zero token keeps.
        zero_sparse: a triplet for every occupied cell.
    """

    dense: SequenceLength
    force_sparse: SequenceLength
    zero_sparse: SequenceLength

    def __add__(self, other: TokenCounts) -> TokenCounts:
        return TokenCounts(
            self.dense + other.dense,
            self.force_sparse + other.force_sparse,
            self.zero_sparse + other.zero_sparse,
        )

    @property
    def reduction(self) -> Reduction:
        """What the zero-sparse form saves against the dense one."""
        return Reduction(
            1 - self.zero_sparse.cells / self.dense.cells, 1 - self.zero_sparse.tokens / self.dense.tokens
        )


def token_counts(occupied: BoolArray, *, force_kept: BoolArray | None = None) -> TokenCounts:
    """Lengths of the dense, force-sparse and zero-sparse sequence of one grid.

    The paper's force-sparse sequences are longer than its zero-sparse ones (862 against 516 tokens), though
    it says of both that only occupied cells stay. It observes that a model without a zero token spreads
    emptiness over two to four of its codes; our reading is that it drops a cell only when its code is the one
    taken for emptiness. Such a model alone can tell; without `force_kept` the occupied cells are counted.

    Args:
        occupied: (X, Y, Z) from `TokenGrid.occupied_cells`.
        force_kept: (X, Y, Z) cells that a model without a zero token keeps, such as `codes != 1849`.

    Raises:
        BadInputError: an array has not the shape of a token grid.
    """
    kept = occupied if force_kept is None else force_kept
    if occupied.shape not in GRID_SHAPES or kept.shape != occupied.shape:
        raise BadInputError(
            f"cells of shapes {occupied.shape} and {kept.shape}: both must be one of {GRID_SHAPES}"
        )
    return TokenCounts(
        SequenceLength(occupied.size, occupied.size * DENSE_TOKENS_PER_CELL),
        _sparse(kept),
        _sparse(occupied),
    )


def _sparse(cells: BoolArray) -> SequenceLength:
    count = int(np.count_nonzero(cells))
    return SequenceLength(count, count * SPARSE_TOKENS_PER_CELL)
