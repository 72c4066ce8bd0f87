"""Which grids a step sees, and how they are turned: functions of the seed and the step alone.

Nothing is carried from step to step, so that a run that goes on needs no saved sampler.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import torch
from torch import Tensor

from simart_kit.arrays import ByteArray
from simart_kit.voxels import LongArray

from .config import TrainingConfig
from .grids import Grids

# Streams of random numbers; each draw is from the generator of (seed, stream, number).
_ORDER, _AUGMENT, _TORCH = 0, 1, 2


@dataclass(frozen=True, eq=False)
class Sampler:
    """Batches of grids for training, on a device.

    Attributes:
        grids: to draw from.
        config: its batch size, seed and augmentation.
        device: of the batches.
    """

    grids: Grids
    config: TrainingConfig
    device: torch.device

    def batch(self, step: int) -> Tensor:
        """(B, 1, R, R, R) uint8 0 or 1, the batch of a step."""
        rows = batch_rows(len(self.grids), self.config.batch_size, self.config.seed, step)
        voxels = unpack_on(self.grids.packed[rows], self.grids.resolution, self.device)
        return augmented(voxels, self.config.seed, step) if self.config.augment else voxels


def batch_rows(count: int, batch_size: int, seed: int, step: int) -> LongArray:
    """(B,) rows of a step: pass after pass over all rows, each pass in an order of its own."""
    places = np.arange(step * batch_size, (step + 1) * batch_size, dtype=np.int64)
    rows = np.zeros(batch_size, dtype=np.int64)
    for epoch in np.unique(places // count).tolist():
        mine = places // count == epoch
        order = _numpy_generator(seed, _ORDER, epoch).permutation(count)
        rows[mine] = order[places[mine] % count]
    return rows


def augmented(voxels: Tensor, seed: int, step: int) -> Tensor:
    """Each of (B, 1, R, R, R) grids in one of its eight poses, at random.

    The poses are quarter turns about z, each as it is and mirrored in x: up stays up. Mirrors in y are among
    them.
    """
    pose = torch.from_numpy(_numpy_generator(seed, _AUGMENT, step).integers(8, size=len(voxels)))
    result = voxels.clone()
    for turns in range(4):
        for mirrored in range(2):
            rows = torch.nonzero(pose == 2 * turns + mirrored)[:, 0].to(voxels.device)
            turned = torch.rot90(voxels[rows], turns, dims=(2, 3))
            result[rows] = turned.flip(2) if mirrored else turned
    return result


def unpack_on(packed: ByteArray, resolution: int, device: torch.device) -> Tensor:
    """(B, ceil(R^3 / 8)) packed grids to (B, 1, R, R, R) uint8 on a device, unpacked there."""
    bytes_there = torch.from_numpy(np.array(packed)).to(device)
    shifts = torch.arange(7, -1, -1, dtype=torch.uint8, device=device)
    bits = (bytes_there[:, :, None] >> shifts) & 1
    return bits.flatten(1)[:, : resolution**3].reshape(-1, 1, *(resolution,) * 3)


def torch_generator(seed: int, number: int) -> torch.Generator:
    """The generator, on the CPU, of a step; k-means has that of number -1."""
    state = np.random.SeedSequence([seed, _TORCH, number + 1]).generate_state(1, np.uint64)
    return torch.Generator().manual_seed(int(state[0]))


def _numpy_generator(seed: int, stream: int, number: int) -> np.random.Generator:
    return np.random.default_rng([seed, stream, number])
