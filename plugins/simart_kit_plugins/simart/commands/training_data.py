"""What `train vqvae` trains and judges a model on: folders of meshes, and generated objects."""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from pathlib import Path

from simart_kit.cli.common import warn
from simart_kit.errors import BadInputError
from simart_kit.plugins import Plugins

from ..training.data import voxel_data
from ..training.grids import Grids, joined

# Objects to judge a model on come from this seed, those to train on from lower ones.
HELD_OUT_SEED = 2**32 - 1
_TOLD = 5
# Shows how far a task, named first, has come: done, of how many.
Progress = Callable[[str, int, int], None]


def training_grids(
    folders: Sequence[Path],
    generated: int,
    seed: int,
    resolution: int,
    plugins: Plugins,
    progress: Progress,
) -> Grids:
    """The grids of all folders, then those of generated objects.

    Args:
        folders: of mesh files; voxels are kept in the user's cache.
        generated: number of objects to make besides.
        seed: of these.
        resolution: voxels along an edge.
        plugins: read the files.
        progress: told what is done.

    Raises:
        BadInputError: there is nothing to train on, or the seed is the one of held-out objects.
        OutputError: the cache cannot be written.
    """
    if not folders and not generated:
        raise BadInputError("there is nothing to train on: give --data DIR, --procedural N, or both")
    if seed >= HELD_OUT_SEED:
        raise BadInputError(f"seed {seed} is not below {HELD_OUT_SEED}, the seed of the held-out objects")
    found = [folder_grids(folder, resolution, plugins, progress) for folder in folders]
    if generated:
        found.append(_generated(generated, seed, resolution, "objects made", progress, augmented=True))
    return joined(found)


def held_out_grids(count: int, resolution: int, progress: Progress) -> Grids:
    """Grids of generated objects that no training sees; none is augmented."""
    return _generated(count, HELD_OUT_SEED, resolution, "held-out objects made", progress)


def folder_grids(folder: Path, resolution: int, plugins: Plugins, progress: Progress) -> Grids:
    """The grids of a folder; what cannot be used is a warning.

    Raises:
        BadInputError: there is no such folder, or nothing in it can be used.
    """
    data = voxel_data(
        folder, resolution, voxel_cache(), plugins, lambda done, of: progress(f"shapes of {folder}", done, of)
    )
    more = len(data.skipped) - _TOLD
    warn(data.skipped[:_TOLD])
    warn([f"{more} more shapes of {folder} could not be used"] if more > 0 else [])
    return data.grids


def voxel_cache() -> Path:
    """The folder that keeps voxels: simart-kit/voxels in $XDG_CACHE_HOME, or in ~/.cache."""
    base = os.environ.get("XDG_CACHE_HOME")
    return (Path(base) if base else Path.home() / ".cache") / "simart-kit" / "voxels"


def _generated(
    count: int, seed: int, resolution: int, task: str, progress: Progress, augmented: bool = False
) -> Grids:
    from ..training.procedural import procedural_grids

    return procedural_grids(
        count, seed, resolution, lambda done, of: progress(task, done, of), augmented=augmented
    )
