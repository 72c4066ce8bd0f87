"""The shapes of a folder: mesh files and converted assets, with the labels beside them."""

from __future__ import annotations

import hashlib
import json
import os
from collections.abc import Iterator
from dataclasses import dataclass
from importlib.metadata import version
from pathlib import Path
from urllib.parse import unquote

import numpy as np

from simart_kit.arrays import BoolArray, IntArray
from simart_kit.asset_io import ARRAYS_FILE, ASSET_FILE, load_asset
from simart_kit.bench.formats.label_files import read_npz_labels
from simart_kit.errors import BadInputError
from simart_kit.loading import read_source
from simart_kit.mesh import Mesh
from simart_kit.plugins import Plugins
from simart_kit.provenance import file_hash
from simart_kit.voxels import GridFrame, cube_frame, voxelise

SUFFIXES = (".glb", ".gltf", ".obj", ".ply", ".stl", ".off", ".dae", ".3mf")
SUFFIXES_USD = (".usd", ".usda", ".usdc", ".usdz")
FACE_PART = "face_part"
# Their geometry may lie in other layers, found only by composing them.
_LAYERED = (".usd", ".usda", ".usdc")


@dataclass(frozen=True)
class Shape:
    """An object that can be voxelised.

    Attributes:
        path: a mesh file, or the folder of a converted asset.
        files: all files that its voxels depend on; none where only reading it would tell.
        labels: an .npz with `face_part` (F,), the part of each face, -1 for none; None for no labels.
    """

    path: Path
    files: tuple[Path, ...]
    labels: Path | None = None


def find_shapes(folder: Path) -> tuple[Shape, ...]:
    """All shapes of a folder and below, in the order of their paths; none in hidden folders.

    Labels are those of SIMART-Bench: NAME.npz, NAME.gt.npz or gt.npz beside NAME.glb. A folder with an
    asset.json is one shape, and not looked into further: its exports are the same object.

    Raises:
        BadInputError: there is no such folder.
    """
    if not folder.is_dir():
        raise BadInputError(f"{folder} is no folder: give one with mesh files")
    return tuple(_shapes(folder))


def content_key(shape: Shape, resolution: int) -> str | None:
    """A name for the voxels of a shape: another one once its files, the resolution or the package change.

    None for a shape that may depend on files not known here.

    Raises:
        OSError: a file cannot be read.
    """
    if not shape.files:
        return None
    told = [version("simart-kit"), str(resolution), shape.path.suffix.lower(), *map(file_hash, shape.files)]
    return hashlib.sha256(" ".join(told).encode()).hexdigest()


def shape_grids(shape: Shape, resolution: int, plugins: Plugins) -> BoolArray:
    """(1 + P, R, R, R) the whole object in its cube, then each labelled part in the same cube.

    The cube is the smallest about the object in the canonical frame, [-0.5, 0.5]^3 of TRELLIS. An object of
    one part is that part already, so it has no second grid.

    Raises:
        BadInputError: the mesh cannot be read, or the labels are not of its faces.
    """
    mesh, labels = _read(shape, plugins)
    frame = cube_frame(mesh.bounds, resolution)
    parts = np.unique(labels[labels >= 0])
    chosen = [labels == part for part in parts] if len(parts) > 1 or (labels < 0).any() else []
    whole = np.ones(len(labels), dtype=np.bool_)
    return np.stack([_occupancy(mesh, faces, frame) for faces in (whole, *chosen)])


def _shapes(folder: Path) -> Iterator[Shape]:
    for place, folders, names in os.walk(folder):
        here = Path(place)
        if ASSET_FILE in names:
            folders.clear()
            yield Shape(here, (here / ARRAYS_FILE, here / ASSET_FILE))
            continue
        folders[:] = sorted(name for name in folders if not name.startswith("."))
        files = [here / name for name in sorted(names) if not name.startswith(".")]
        yield from (_mesh_shape(path, files) for path in files if _is_mesh(path))


def _is_mesh(path: Path) -> bool:
    return path.suffix.lower() in (*SUFFIXES, *SUFFIXES_USD)


def _mesh_shape(path: Path, siblings: list[Path]) -> Shape:
    names = (f"{path.stem}.npz", f"{path.stem}.gt.npz", "gt.npz")
    there = {other.name: other for other in siblings}
    labels = next((there[name] for name in names if name in there), None)
    if path.suffix.lower() in _LAYERED:
        return Shape(path, (), labels)
    buffers = _buffers(path) if path.suffix.lower() == ".gltf" else []
    return Shape(path, (path, *buffers, *([] if labels is None else [labels])), labels)


def _buffers(path: Path) -> list[Path]:
    """The files with the numbers of a glTF; none for a damaged one, of which its loader will tell."""
    try:
        names = [unquote(str(buffer.get("uri", ""))) for buffer in json.loads(path.read_bytes())["buffers"]]
    except (OSError, ValueError, TypeError, KeyError, AttributeError, RecursionError):
        return []
    files = [path.parent / name for name in names if name and not name.startswith("data:")]
    return [file for file in files if file.is_file()]


def _read(shape: Shape, plugins: Plugins) -> tuple[Mesh, IntArray]:
    """The mesh in the canonical frame, and the (F,) part of each face, -1 for none."""
    if shape.path.is_dir():
        asset = load_asset(shape.path)
        return asset.mesh, asset.face_part
    mesh = read_source(shape.path, plugins).mesh
    if shape.labels is None:
        return mesh, np.zeros(len(mesh.faces), dtype=np.int32)
    labels = read_npz_labels(shape.labels, FACE_PART)
    if len(labels) != len(mesh.faces):
        raise BadInputError(
            f"{shape.labels} labels {len(labels)} faces, but {shape.path.name} has {len(mesh.faces)}"
        )
    return mesh, labels


def _occupancy(mesh: Mesh, faces: BoolArray, frame: GridFrame) -> BoolArray:
    return voxelise(mesh.triangles[faces], frame).occupancy
