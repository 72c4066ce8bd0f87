"""Start of a codebook from data: from random entries most of them would never be chosen."""

from __future__ import annotations

from collections.abc import Iterable

import torch
from torch import Tensor

from simart_kit.errors import BadInputError

from ..models import VoxelModel
from .contexts import contexts

# Vectors given to k-means; 64 an entry of the full codebook.
MOST_VECTORS = 1 << 18


@torch.no_grad()
def initialise_codebook(
    model: VoxelModel, batches: Iterable[Tensor], generator: torch.Generator, most: int = MOST_VECTORS
) -> int:
    """Set the entries to k-means centres of encoder features, and the zero token to the mean of empty cells.

    Args:
        model: its quantiser is changed in place.
        batches: (B, 1, R, R, R) voxels; read until there are `most` vectors.
        generator: on the CPU, so that all devices draw alike.
        most: bound on the vectors gathered.

    Returns:
        Number of vectors that k-means was given.

    Raises:
        BadInputError: no voxel of any batch is on.
    """
    gathered: list[Tensor] = []
    books: list[Tensor] = []
    empty = _EmptyMean(model)
    for batch in batches:
        features, occupied = model.features(batch)
        picked = torch.ones_like(occupied) if model.config.mode == "dense" else occupied
        gathered.append(features[picked])
        books.append(contexts(picked, model.config.codebooks))
        empty.add(features, occupied)
        if sum(map(len, gathered)) >= most:
            break
    vectors = torch.cat(gathered)[:most] if gathered else torch.zeros(0)
    if not len(vectors):
        raise BadInputError("the codebook cannot be started: no voxel of the given shapes is on")
    model.quantiser.initialise(vectors, torch.cat(books)[:most], generator)
    empty.store()
    return len(vectors)


@torch.no_grad()
def initialise_zero_token(model: VoxelModel, occupancy: Tensor) -> None:
    """Set the zero token to the mean feature of the cells of (B, 1, R, R, R) voxels that have none on."""
    empty = _EmptyMean(model)
    empty.add(*model.features(occupancy))
    empty.store()


class _EmptyMean:
    """Mean of the features of empty cells, batch by batch, in float64."""

    def __init__(self, model: VoxelModel) -> None:
        self._token = model.quantiser.zero_token
        self._sum = torch.zeros(model.config.vector_length, dtype=torch.float64)
        self._count = 0

    def add(self, features: Tensor, occupied: Tensor) -> None:
        empty = features[~occupied]
        self._sum += empty.double().sum(0).cpu()
        self._count += len(empty)

    def store(self) -> None:
        """Leaves the token as it is where the mode has none, or no cell was empty."""
        if self._token is not None and self._count:
            self._token.copy_(self._sum / self._count)
