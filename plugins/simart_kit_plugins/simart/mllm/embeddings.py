"""First values of the voxel tokens' rows: codes from their codebook vectors, cells from where they are."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from simart_kit.arrays import Float32Array, FloatArray

from ..default_model import LoadedModel
from ..tokens import TokenGrid
from ..vocabulary import Vocabulary

if TYPE_CHECKING:
    from torch import Tensor, nn

_WAVES = 8
"""Sines and cosines of a coordinate; the longest wave has twice the grid's length."""
# Share of a row's variance that all tokens of a kind have in common: that it is a cell, or a code.
_KIND = 0.25


def codebook_vectors(codec: LoadedModel) -> Float32Array:
    """(K, D) vectors of a model's codes, row 0 that of emptiness.

    A model with a codebook for each context has several vectors for a code: the mean, since they were
    started from the same centres and a code means something alike in all of them.
    """
    quantiser = codec.model.quantiser  # type: ignore[attr-defined]  # both kinds of model have one
    entries = quantiser.entries.detach().float().cpu().numpy()
    books = entries.reshape(-1, codec.grid.codebook - 1, entries.shape[1])
    empty = quantiser.zero_token.detach().float().cpu().numpy()
    return np.asarray(np.concatenate([empty[None], books.mean(axis=0)]), dtype=np.float32)


def cell_waves(grid: TokenGrid) -> FloatArray:
    """(cells, 48) sines and cosines of every cell's x, y and z, with waves of halving length."""
    size = np.array(grid.shape)
    middles = (grid.coordinates(np.arange(grid.cells)) + 0.5) / size.max()
    phase = np.pi * middles[:, :, None] * 2.0 ** (np.arange(_WAVES) / 2)
    return np.concatenate([np.sin(phase), np.cos(phase)], axis=2).reshape(grid.cells, -1)


def token_features(vocabulary: Vocabulary, codebook: Float32Array, width: int, seed: int) -> Float32Array:
    """(tokens, width) rows about 0 with a mean square of 1 each kind, in the order of the ids.

    Vectors of codes and cells are projected by fixed random matrices, which about keeps distances in the
    codebook and in space; to each kind a direction of its own is added.

    Args:
        vocabulary: which tokens.
        codebook: (K, D) vectors of the codes, see `codebook_vectors`.
        width: of the embeddings.
        seed: of the projections.
    """
    generator = np.random.default_rng(seed)
    voxel = _unit(generator.standard_normal((1, width)))
    cells = _projected(cell_waves(vocabulary.grid), width, generator)
    codes = _projected(codebook.astype(np.float64), width, generator)
    return np.concatenate([voxel, cells, codes]).astype(np.float32)


def fill_rows(weight: Tensor, features: Float32Array, first_id: int) -> None:
    """Write rows `first_id` and on of an embedding: its trained rows' mean plus features in their spread.

    Args:
        weight: (rows, width), changed in place; the rows before `first_id` are the trained ones.
        features: (tokens, width) about 0, of mean square 1.
        first_id: row of the first feature.
    """
    import torch

    with torch.no_grad():
        trained = weight[:first_id].float()
        mean = trained.mean(0)
        spread = (trained - mean).square().mean().sqrt()
        rows = mean + spread * torch.from_numpy(features).to(weight.device)
        weight[first_id : first_id + len(features)] = rows.to(weight.dtype)


def start_embeddings(model: nn.Module, vocabulary: Vocabulary, codec: LoadedModel, seed: int) -> None:
    """Fill the voxel tokens' rows of a Qwen3-VL: those it reads with, and those it writes with if untied."""
    read = model.get_input_embeddings().weight  # type: ignore[operator]
    write = model.get_output_embeddings().weight  # type: ignore[operator]
    features = token_features(vocabulary, codebook_vectors(codec), read.shape[1], seed)
    fill_rows(read, features, vocabulary.first_id)
    if write is not read:
        fill_rows(write, features, vocabulary.first_id)


def _projected(vectors: FloatArray, width: int, generator: np.random.Generator) -> FloatArray:
    """(N, width) random projection of (N, D) vectors about their mean, plus the kind's own direction."""
    centred = vectors - vectors.mean(axis=0)
    rows = centred @ generator.standard_normal((vectors.shape[1], width))
    kind = _unit(generator.standard_normal((1, width)))
    return np.asarray(np.sqrt(1 - _KIND) * _unit(rows) + np.sqrt(_KIND) * kind)


def _unit(rows: FloatArray) -> FloatArray:
    """Rows scaled together to a mean square of 1."""
    return np.asarray(rows / np.sqrt(np.square(rows).mean()))
