"""An object read from several sides at once: what the network says on average."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import torch
from torch import Tensor

from simart_kit.arrays import BoolArray, Float32Array, FloatArray

from .candidates import SLIDE
from .cloud import Cloud
from .examples import Example
from .learning import batch_of
from .network import NanoNetwork
from .scene import pieces_of
from .store import stored
from .turning import VIEWS, turned, turned_evidence


@dataclass(frozen=True, eq=False)
class Said:
    """What is said of an object; chances are means over the sides that it was seen from.

    Attributes:
        moves: (S,) chance of each piece to be of a moving part.
        together: (S, S) chance of two pieces to be of one part.
        label: (S, L) chances of what the piece's part is called.
        category: (C,) chances of what the object is.
        size: longest side [m], and the factor by which the sides differ about it, at least 1.
        tokens: (V, S', D) of each side, for `say_parts`; padded as in training.
    """

    moves: FloatArray
    together: FloatArray
    label: FloatArray
    category: FloatArray
    size: tuple[float, float]
    tokens: Tensor


@dataclass(frozen=True, eq=False)
class SaidParts:
    """What is said of parts.

    Attributes:
        kind: (P, K) chances, by `KINDS`.
        right: (P, C) chance of each candidate; 0 where there is none.
        travel: (P, C, 2) limits about each: turns [rad], slides [sides of the object].
        carrier: (P, P + 1) chance of being carried by the body, and by each part.
    """

    kind: FloatArray
    right: FloatArray
    travel: FloatArray
    carrier: FloatArray


@torch.no_grad()
def say(network: NanoNetwork, cloud: Cloud, votes: int) -> Said:
    """Read a cloud from the first `votes` of the eight `VIEWS`."""
    nothing = Example(
        cloud, pieces_of(cloud), np.zeros(cloud.count, dtype=np.int64), np.array([True]), (), "", 1.0
    )
    here = stored(nothing)
    read = network(batch_of([turned(here, *view) for view in VIEWS[:votes]]))
    count = cloud.count
    sizes = read.size.numpy()
    return Said(
        _mean(read.moves[:, :count].sigmoid()),
        _mean(read.together[:, :count, :count].sigmoid()),
        _mean(read.label[:, :count].softmax(2)),
        _mean(read.category.softmax(1)),
        (float(np.exp(sizes.mean())), float(np.exp(sizes.std()))),
        read.tokens,
    )


@torch.no_grad()
def say_parts(
    network: NanoNetwork, tokens: Tensor, share: Float32Array, numbers: FloatArray, real: BoolArray
) -> SaidParts:
    """Read parts of an object.

    Args:
        network: that read it.
        tokens: (V, S', D) of `say`.
        share: (P, S) how much of the part each piece is; rows sum to 1.
        numbers: (P, C, COUNT) evidence of its candidates, as seen from the first side.
        real: (P, C) which candidates exist.
    """
    kinds, rights, travels, carriers = [], [], [], []
    padded = np.pad(share, ((0, 0), (0, tokens.shape[1] - share.shape[1])))
    given = torch.from_numpy(padded), torch.from_numpy(real)
    for own, (quarters, mirrored) in zip(tokens, VIEWS, strict=False):
        flat = turned_evidence(numbers.reshape(-1, numbers.shape[2]), quarters, mirrored)
        seen = torch.from_numpy(flat.reshape(numbers.shape).astype(np.float32))
        read = network.parts(own[None], torch.zeros(len(share), dtype=torch.int64), given[0], seen, given[1])
        slide = seen[..., SLIDE] > 0
        travel = torch.where(slide[..., None], read.travel, read.travel * torch.pi)
        if mirrored:
            travel = torch.where(slide[..., None], travel, -travel.flip(2))
        carried = network.carriers(read.embedding, read.embedding).fill_diagonal_(-torch.inf)
        kinds.append(read.kind.softmax(1))
        rights.append(read.right.softmax(1))
        travels.append(travel)
        carriers.append(torch.cat([carried.new_zeros(len(carried), 1), carried], dim=1).softmax(1))
    return SaidParts(*(_mean(torch.stack(found)) for found in (kinds, rights, travels, carriers)))


def _mean(votes: Tensor) -> FloatArray:
    return np.asarray(votes.mean(0).numpy(), dtype=np.float64)
