"""A voxel model without zero token as one whose code 0 is the code that most empty cells have.

Where that code is left out, a force-sparse sequence remains: cells whose emptiness got another code stay.
Whoever reads the sequence puts the code back, so that the decoder gets what it was trained with.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
import torch
from torch import Tensor

from simart_kit.errors import BadInputError
from simart_kit.provenance import file_hash

from ..ablation.coding import Emptiness, emptiness
from ..ablation.variants import DENSE
from ..codec import EncodedGrids, TokenConfig, TokenModel, decode_tokens, encode_grids
from ..dataset.record import Record
from ..default_model import WEIGHTS_FILE, LoadedModel
from ..models import VoxelModel
from ..tokens import EMPTY_CODE, VoxelTokens
from ..training.grids import Grids
from ..vqvae.checkpoint import load_checkpoint

Recode = Callable[[Record], Record | None]
_FINGERPRINT = 16


@dataclass(frozen=True, eq=False)
class Codes:
    """`EncodedGrids`: codes alone."""

    codes: Tensor


@dataclass(frozen=True, eq=False)
class Entries:
    """The vectors of the codes, as the embeddings of a language model are started from them.

    Attributes:
        zero_token: (D,) of code 0.
        entries: (codebooks * (N - 1), D) of the others.
    """

    zero_token: Tensor
    entries: Tensor


class DroppedEmptiness:
    """The model with its code of emptiness and code 0 exchanged.

    Attributes:
        config: of the model, as mode zero: code 0 is left out of sequences.
        quantiser: its vectors in the new order.
    """

    def __init__(self, model: VoxelModel, null: int) -> None:
        """Take a model of mode dense and its code of emptiness."""
        self.config: TokenConfig = model.config.model_copy(update={"mode": "zero"})
        self._model, self._null = model, null
        books = model.quantiser.entries.detach().reshape(
            model.config.codebooks, model.config.codebook_size, -1
        )
        order = self._exchanged(torch.arange(model.config.codebook_size))
        books = books[:, order]
        self.quantiser = Entries(books[:, 0].mean(0), books[:, 1:].flatten(0, 1))

    @torch.no_grad()
    def encode(self, occupancy: Tensor) -> EncodedGrids:
        """Codes of (B, 1, R, R, R) voxels, 0 where a cell is left out."""
        return Codes(self._exchanged(self._model.encode(occupancy).codes))

    @torch.no_grad()
    def decode(self, codes: Tensor, occupied: Tensor) -> Tensor:
        """(B, 1, R, R, R) logits of (B, X, Y, Z) codes; nothing is on outside the `occupied` cells."""
        return self._model.decode(self._exchanged(codes), occupied)

    def _exchanged(self, codes: Tensor) -> Tensor:
        moved = torch.where(codes == self._null, EMPTY_CODE, codes)
        return torch.where(codes == EMPTY_CODE, self._null, moved)


def dropping_codec(folder: Path, data: LoadedModel, grids: Grids) -> tuple[LoadedModel, Emptiness]:
    """A trained model without zero token, and what it makes of emptiness.

    Args:
        folder: of the model.
        data: the voxel model of the data, whose cells and codes it must have.
        grids: that tell which code stands for emptiness.

    Raises:
        BadInputError: it is no such model, or of other cells or codes.
    """
    model = load_checkpoint(folder).eval()
    config, grid = model.config, data.grid
    if config.mode != DENSE:
        raise BadInputError(
            f"{folder} is a model of mode '{config.mode}': force-sparse sequences need one of mode '{DENSE}'"
        )
    if (config.cells, config.codebook_size) != (grid.shape, grid.codebook):
        raise BadInputError(
            f"{folder} has {config.grid} cells and {config.codebook_size} codes, but the data "
            f"{'x'.join(map(str, grid.shape))} and {grid.codebook}: the rows need the same"
        )
    with torch.no_grad():
        null = emptiness(model, grids)
    if null is None:
        raise BadInputError("the data have no empty cell: there is nothing to leave out of a sequence")
    fingerprint = file_hash(folder / WEIGHTS_FILE)[:_FINGERPRINT]
    return LoadedModel(DroppedEmptiness(model, null.code), grid, fingerprint, folder), null


class Recoder:
    """Gives records the codes of another voxel model, each once.

    Their voxels are those that their own codes decode to.
    """

    def __init__(self, data: TokenModel, codec: TokenModel) -> None:
        """Take the model of the records' codes, and the one whose codes they get."""
        self._data, self._codec = data, codec
        self._known: dict[str, tuple[VoxelTokens, ...] | None] = {}

    def __call__(self, record: Record) -> Record | None:
        """The record in other codes; None if a part has no voxel, or no cell of the object, left."""
        if record.key not in self._known:
            self._known[record.key] = self._tokens(record)
        found = self._known[record.key]
        if found is None:
            return None
        whole, *own = found
        given = zip(record.answer.parts, own, strict=True)
        parts = tuple(replace(part, voxels=voxels) for part, voxels in given)
        return replace(record, voxels=whole, answer=replace(record.answer, parts=parts))

    def _tokens(self, record: Record) -> tuple[VoxelTokens, ...] | None:
        """Of the whole, then of each part, within the whole's cells as the paper asks."""
        voxels = decode_tokens(self._data, [record.voxels, *[part.voxels for part in record.answer.parts]])
        if not voxels.any(axis=(1, 2, 3)).all():
            return None
        whole, *parts = encode_grids(self._codec, voxels)
        within = [_within(part, whole) for part in parts]
        return (whole, *within) if all(len(tokens.index) for tokens in (whole, *within)) else None


def _within(part: VoxelTokens, whole: VoxelTokens) -> VoxelTokens:
    kept = np.isin(part.index, whole.index)
    return VoxelTokens(part.grid, part.index[kept], part.code[kept])
