"""Latent cells <-> tokens: which neighbouring cells stand side by side in a token's vector."""

from __future__ import annotations

from torch import Tensor

from .config import Cells, Layout


def space_to_depth(latent: Tensor, cells: Cells, layout: Layout) -> Tensor:
    """(B, C, L, L, L) latent cells to (B, X, Y, Z, D) tokens, D = C L^3 / XYZ; moves values, changes none.

    `spatial`: token (x, y, z) holds the box of latent cells at (x, y, z), one after the other with z fastest,
    each with its C channels. `flat-view`: it holds a run of latent cells in memory order, so its coordinate
    is no place; this is what a plain view of the channels-last array gives, as in ShapeLLM-Omni.
    """
    batch, _, *edges = latent.shape
    channels_last = latent.movedim(1, -1)
    if layout == "flat-view":
        return channels_last.reshape(batch, *cells, -1)
    x, y, z = (edge // count for edge, count in zip(edges, cells, strict=True))
    boxes = channels_last.reshape(batch, cells[0], x, cells[1], y, cells[2], z, -1)
    return boxes.permute(0, 1, 3, 5, 2, 4, 6, 7).reshape(batch, *cells, -1)


def depth_to_space(tokens: Tensor, latent_edge: int, layout: Layout) -> Tensor:
    """(B, X, Y, Z, D) tokens to (B, C, L, L, L) latent cells: the exact inverse of `space_to_depth`."""
    batch, *cells, _ = tokens.shape
    whole = (batch, latent_edge, latent_edge, latent_edge, -1)
    if layout == "flat-view":
        return tokens.reshape(whole).movedim(-1, 1)
    x, y, z = (latent_edge // count for count in cells)
    boxes = tokens.reshape(batch, *cells, x, y, z, -1)
    return boxes.permute(0, 1, 4, 2, 5, 3, 6, 7).reshape(whole).movedim(-1, 1)
