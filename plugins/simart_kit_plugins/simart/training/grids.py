"""Occupancy grids in memory, one bit a voxel."""

from __future__ import annotations

import hashlib
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from simart_kit.arrays import BoolArray, ByteArray, IntArray, frozen_bytes
from simart_kit.errors import BadInputError


@dataclass(frozen=True, eq=False)
class Grids:
    """What a model is trained and judged on.

    Attributes:
        resolution: R, voxels along an edge.
        packed: (N, ceil(R^3 / 8)) uint8, each row a grid in C order as `numpy.packbits` packs it; N > 0.
        names: what each grid shows, for messages.
    """

    resolution: int
    packed: ByteArray
    names: tuple[str, ...]

    def __post_init__(self) -> None:
        object.__setattr__(self, "packed", frozen_bytes(self.packed))
        if not len(self.packed):
            raise BadInputError("there is no grid to train on")
        if self.packed.shape != (len(self.names), packed_size(self.resolution)):
            raise ValueError(f"{len(self.names)} grids of edge {self.resolution} in {self.packed.shape}")

    def __len__(self) -> int:
        return len(self.names)

    def occupancy(self, indices: Sequence[int] | IntArray) -> BoolArray:
        """(B, R, R, R) the grids of these numbers."""
        return unpack(self.packed[np.asarray(indices, dtype=np.int64)], self.resolution)

    @cached_property
    def fingerprint(self) -> str:
        """SHA-256 of all voxels in their order: equal for grids that train alike."""
        digest = hashlib.sha256(f"{self.resolution} {len(self)} ".encode())
        digest.update(self.packed.data)
        return digest.hexdigest()


def packed_size(resolution: int) -> int:
    """Bytes of a packed grid."""
    return -(-(resolution**3) // 8)


def pack(occupancy: BoolArray) -> ByteArray:
    """(..., R, R, R) bool to (..., ceil(R^3 / 8)) bytes."""
    return np.packbits(occupancy.reshape(*occupancy.shape[:-3], -1), axis=-1)


def unpack(packed: ByteArray, resolution: int) -> BoolArray:
    """The inverse of `pack`."""
    bits = np.unpackbits(packed, axis=-1, count=resolution**3)
    return bits.reshape(*packed.shape[:-1], *(resolution,) * 3).astype(np.bool_)


def objects_of(names: Sequence[str]) -> list[list[int]]:
    """Rows of each object, its whole first, by their names: "NAME part 1" or "NAME, part 1" is of NAME."""
    objects: list[list[int]] = []
    for row, name in enumerate(names):
        whole = names[objects[-1][0]] if objects else ""
        of_it = name.removeprefix(whole).removeprefix(",") if whole and name.startswith(whole) else ""
        if of_it.startswith(" part ") and of_it[6:].isdigit():
            objects[-1].append(row)
        else:
            objects.append([row])
    return objects


def joined(several: Sequence[Grids]) -> Grids:
    """All grids in one, such as generated ones and a folder's.

    Raises:
        BadInputError: they differ in resolution.
    """
    resolutions = {grids.resolution for grids in several}
    if len(resolutions) != 1:
        raise BadInputError(f"grids of {sorted(resolutions)} voxels an edge: one resolution is needed")
    packed = np.concatenate([grids.packed for grids in several])
    return Grids(resolutions.pop(), packed, tuple(name for grids in several for name in grids.names))
