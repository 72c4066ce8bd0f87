"""Grids of made-up objects to train on."""

from __future__ import annotations

import numpy as np

from simart_kit.arrays import BoolArray
from simart_kit.errors import BadInputError
from simart_kit.voxels import cube_frame

from ..data import Progress
from ..grids import Grids, pack
from .shapes import procedural_object
from .together import occupancies

# numpy mixes seeds as 32-bit words: larger ones could spell another seed and number.
_SEEDS = 2**32


def procedural_grids(
    count: int,
    seed: int,
    resolution: int = 64,
    progress: Progress | None = None,
    *,
    first: int = 0,
    augmented: bool = False,
) -> Grids:
    """Objects first..first+count-1 of a seed: of each the whole in its cube, then its parts in the same cube.

    Object i is the same whatever `count` and `first` are, and no object of another seed.

    Args:
        count: objects, at least 1.
        seed: 0..2^32-1.
        resolution: voxels along an edge.
        progress: told the objects done and their number, after each.
        first: number of the first object, to make a long list in slices.
        augmented: as for `procedural_object`.

    Raises:
        BadInputError: a number is out of its range.
    """
    if count < 1 or first < 0 or first + count > _SEEDS:
        raise BadInputError(
            f"{count} objects from {first} on: give at least 1 object, and a first one from 0 on"
        )
    packed, names = [], []
    for number in range(first, first + count):
        grids = object_grids(seed, number, resolution, augmented)
        packed.append(pack(grids))
        names += [f"object {number}", *(f"object {number} part {k}" for k in range(len(grids) - 1))]
        if progress is not None:
            progress(number - first + 1, count)
    return Grids(resolution, np.concatenate(packed), tuple(names))


def object_grids(seed: int, number: int, resolution: int = 64, augmented: bool = False) -> BoolArray:
    """(1 + P, R, R, R) an object in its smallest cube, then its parts; of a single part only the whole.

    Raises:
        BadInputError: the seed is out of its range.
    """
    if not 0 <= seed < _SEEDS:
        raise BadInputError(f"seed {seed}: give one of 0..{_SEEDS - 1}")
    parts = procedural_object((seed, number), augmented)
    corners = np.concatenate([part.reshape(-1, 3) for part in parts])
    frame = cube_frame(np.stack([corners.min(axis=0), corners.max(axis=0)]), resolution)
    occupancy = occupancies(parts, frame)
    # A cell is on where any triangle touches it, so the whole is the union of its parts.
    whole = np.logical_or.reduce(occupancy, axis=0)[None]
    return whole if len(parts) == 1 else np.concatenate([whole, occupancy])
