"""What a token of an answer is chosen among: the loss compares it with nothing that the grammar bars.

Decoding samples from what the grammar allows. Trained on the same, a model spends nothing on learning that
a cell must be one of the input's and come after the last one, which the grammar knows.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from simart_kit.arrays import BoolArray, IntArray

from ..vocabulary import Vocabulary
from .kinds import CODE, COORDINATE

if TYPE_CHECKING:
    from torch import Tensor, device

NO_CELL = -1
_ROWS = 256


@dataclass(frozen=True, eq=False)
class CellChoices:
    """The cells that could come at each place of E examples in B rows of L tokens.

    Attributes:
        present: (E, C) bool, cells of the example's object.
        owner: (B, L) example of each place.
        last: (B, L) the last cell that the same part has at each place; NO_CELL where there is none.
    """

    present: Tensor
    owner: Tensor
    last: Tensor

    def to(self, device: device) -> CellChoices:
        """The same on a device."""
        return CellChoices(self.present.to(device), self.owner.to(device), self.last.to(device))

    def allowed(self, places: Tensor) -> Tensor:
        """(N, C) bool: cells that may come next at (B, L) bool `places`, N of them."""
        import torch

        cells = torch.arange(self.present.shape[1], device=self.present.device)
        later = cells[None] > self.last[places][:, None]
        return self.present[self.owner[places]] & later


@dataclass(frozen=True, eq=False)
class Rows:
    """Where in the vocabulary each kind of token is.

    Attributes:
        words: ids below are words and digits, and the token that opens a voxel.
        coordinates: ids of cells.
        codes: ids of codes, without that of emptiness.
    """

    words: slice
    coordinates: slice
    codes: slice

    @classmethod
    def of(cls, vocabulary: Vocabulary) -> Rows:
        """The rows of a vocabulary."""
        first, last = vocabulary.first_code, vocabulary.first_code + vocabulary.grid.codebook
        return cls(
            slice(0, vocabulary.first_id + 1),
            slice(vocabulary.first_coordinate, first),
            slice(first + 1, last),
        )


def last_cells(ids: IntArray, vocabulary: Vocabulary) -> IntArray:
    """(L,) for each place the cell that its part has had last, when the token after it is chosen.

    A part's cells end at whatever is neither a voxel's opening, a cell nor a code.
    """
    last = np.full(len(ids), NO_CELL)
    low, high = vocabulary.first_coordinate, vocabulary.first_code
    current = NO_CELL
    for place, token in enumerate(ids.tolist()):
        if low <= token < high:
            current = token - low
        elif token < vocabulary.first_id or token >= high + vocabulary.grid.codebook:
            current = NO_CELL
        last[place] = current
    return last


def present_cells(cells: IntArray, vocabulary: Vocabulary) -> BoolArray:
    """(C,) whether a cell is one of an object's."""
    present = np.zeros(vocabulary.grid.cells, dtype=np.bool_)
    present[cells] = True
    return present


def losses(
    hidden: Tensor, head: Tensor, targets: Tensor, kinds: Tensor, allowed: Tensor, rows: Rows
) -> tuple[Tensor, Tensor]:
    """Cross-entropy of each token among those of its kind, and whether it is the likeliest of them.

    Each kind is scored with its own rows of the head, which is most of a small model's work.

    Args:
        hidden: (N, D) what the head is applied to.
        head: (V, D) its weights.
        targets: (N,) ids.
        kinds: (N,) places in `KINDS`; numbers and words are compared with each other.
        allowed: (K, C) bool, for the K targets that are cells, in their order.
        rows: of the vocabulary.

    Returns:
        (N,) float32 losses [nats] and (N,) bool.
    """
    import torch
    from torch.nn.functional import cross_entropy

    each = torch.zeros(len(targets), device=hidden.device)
    right = torch.zeros_like(targets, dtype=torch.bool)
    cell, code = kinds == COORDINATE, kinds == CODE
    for chosen, within in ((cell, rows.coordinates), (code, rows.codes), (~(cell | code), rows.words)):
        scores = _scores(hidden[chosen], head[within])
        if within is rows.coordinates:
            scores = scores.masked_fill(~allowed, float("-inf"))
        wanted = targets[chosen] - within.start
        each = each.masked_scatter(chosen, cross_entropy(scores, wanted, reduction="none"))
        right[chosen] = scores.detach().argmax(dim=-1) == wanted
    return each, right


def _scores(hidden: Tensor, head: Tensor) -> Tensor:
    """(N, V) float32; the rows are filled up, for kernels are made anew for each number of them."""
    from torch.nn.functional import linear, pad

    count = len(hidden)
    filled = pad(hidden, (0, 0, 0, -count % _ROWS))
    return linear(filled, head)[:count].float()
