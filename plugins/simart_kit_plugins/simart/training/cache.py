"""Voxels of shapes on the disk, so that a second run does not make them again."""

from __future__ import annotations

import os
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from simart_kit.arrays import ByteArray
from simart_kit.errors import OutputError

from .grids import packed_size


@dataclass(frozen=True)
class VoxelCache:
    """A folder with an .npy for each shape: (1 + P, ceil(R^3 / 8)) packed grids, under the shape's key.

    Attributes:
        folder: made when the first shape is stored.
        resolution: voxels along an edge.
    """

    folder: Path
    resolution: int

    def get(self, key: str) -> ByteArray | None:
        """The packed grids of a key; None when there are none, or their file is damaged."""
        try:
            # Opened here: numpy leaves a file that it cannot read open.
            with (self.folder / f"{key}.npy").open("rb") as file:
                packed = np.load(file, allow_pickle=False)
        except (OSError, ValueError, EOFError):
            return None
        fits = isinstance(packed, np.ndarray) and packed.dtype == np.uint8 and packed.ndim == 2
        return packed if fits and packed.shape[1] == packed_size(self.resolution) and len(packed) else None

    def put(self, key: str, packed: ByteArray) -> None:
        """Store in one move, so that runs that share the folder never see half a file.

        Raises:
            OutputError: the folder cannot be written.
        """
        partial = self.folder / f"{key}.{os.getpid()}.partial"
        try:
            self.folder.mkdir(parents=True, exist_ok=True)
            with partial.open("wb") as file:
                np.save(file, packed, allow_pickle=False)
            partial.replace(self.folder / f"{key}.npy")
        except OSError as error:
            raise OutputError(f"cannot write the voxel cache {self.folder}: {error.strerror}") from error
