"""A folder of mesh files as grids to train on."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from simart_kit.arrays import ByteArray
from simart_kit.bench.numbers import counted
from simart_kit.errors import BadInputError, OutputError, SimartKitError
from simart_kit.plugins import Plugins

from .cache import VoxelCache
from .grids import Grids, pack
from .shapes import Shape, content_key, find_shapes, shape_grids

Progress = Callable[[int, int], None]


@dataclass(frozen=True, eq=False)
class VoxelData:
    """What a folder gave.

    Attributes:
        grids: of each shape in the order of the paths, the whole and then its parts.
        shapes: number of shapes that they are of.
        skipped: a sentence for each shape that could not be used.
    """

    grids: Grids
    shapes: int
    skipped: tuple[str, ...]


def voxel_data(
    folder: Path, resolution: int, cache: Path, plugins: Plugins, progress: Progress | None = None
) -> VoxelData:
    """Voxelise all shapes of a folder and below; see `find_shapes` for what these are.

    Args:
        folder: with files that the loaders of `plugins` read.
        resolution: voxels along an edge, such as `VqvaeConfig.resolution`.
        cache: a folder that keeps the voxels of shapes by the content of their files.
        plugins: read the files.
        progress: told the shapes done and their number, after each.

    Raises:
        BadInputError: there is no such folder, or no shape in it can be used.
        OutputError: the cache cannot be written.
    """
    shapes = find_shapes(folder)
    store = VoxelCache(cache, resolution)
    packed: list[ByteArray] = []
    names: list[str] = []
    skipped: list[str] = []
    for done, shape in enumerate(shapes, start=1):
        try:
            packed.append(_packed(shape, store, plugins))
            names += _names(shape.path.relative_to(folder).as_posix(), len(packed[-1]))
        except OutputError:
            raise
        except SimartKitError as error:
            skipped.append(str(error))
        if progress is not None:
            progress(done, len(shapes))
    if not packed:
        raise BadInputError(_nothing(folder, skipped))
    return VoxelData(Grids(resolution, np.concatenate(packed), tuple(names)), len(packed), tuple(skipped))


def _packed(shape: Shape, store: VoxelCache, plugins: Plugins) -> ByteArray:
    try:
        key = content_key(shape, store.resolution)
    except OSError as error:
        raise BadInputError(f"cannot read {error.filename}: {error.strerror}") from error
    known = None if key is None else store.get(key)
    if known is not None:
        return known
    packed = pack(shape_grids(shape, store.resolution, plugins))
    if key is not None:
        store.put(key, packed)
    return packed


def _names(name: str, count: int) -> list[str]:
    return [name, *(f"{name}, part {number}" for number in range(1, count))]


def _nothing(folder: Path, skipped: list[str]) -> str:
    if not skipped:
        return f"{folder} has no mesh file: give a folder with GLB, OBJ, STL, PLY or USD files"
    return f"none of {counted(len(skipped), 'shape')} in {folder} can be used; the first: {skipped[0]}"
