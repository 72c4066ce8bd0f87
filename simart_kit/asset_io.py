"""Asset <-> folder: asset.json for people to edit, parts.npz for the arrays. See docs/asset-format.md."""

from __future__ import annotations

import json
import zipfile
import zlib
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
from pydantic import ValidationError

from .arrays import frozen_bytes
from .asset import Asset, ConvexMesh
from .asset_schema import AssetTable, PartTable
from .errors import BadInputError, SimartKitError
from .mesh import Image, Mesh, VisualMaterial
from .stages import Segmentation

ASSET_FILE = "asset.json"
ARRAYS_FILE = "parts.npz"
_IMAGES = ("base_color_image", "metallic_roughness_image", "normal_image")
# What reading a damaged .npz may raise; RuntimeError is for flags and methods that zipfile does not know.
_DAMAGED = (OSError, ValueError, EOFError, RuntimeError, zipfile.BadZipFile, zlib.error)
_MESH_ARRAYS = ("vertices", "faces", "normals", "uv", "colors", "face_material", "face_node")


def save_asset(asset: Asset, folder: Path) -> Path:
    """Write asset.json and parts.npz; returns the former. The same asset gives the same bytes.

    Raises:
        BadInputError: a value that the format does not allow, such as a mass of 0; the field is named.
    """
    try:
        table = AssetTable.of(asset)
    except ValidationError as error:
        raise BadInputError(f"asset '{asset.name}' cannot be stored: {_told(error)}") from error
    folder.mkdir(parents=True, exist_ok=True)
    arrays = _mesh_arrays(asset.mesh) | {"face_part": asset.face_part}
    for index, part in enumerate(asset.parts):
        for number, shape in enumerate(part.collision):
            arrays[f"collision_{index}_{number}_vertices"] = shape.vertices
            arrays[f"collision_{index}_{number}_faces"] = shape.faces
    _write_arrays(folder / ARRAYS_FILE, arrays)
    text = json.dumps(table.model_dump(mode="json", by_alias=True), indent=1, allow_nan=False)
    (folder / ASSET_FILE).write_text(text + "\n", encoding="utf-8")
    return folder / ASSET_FILE


def load_asset(folder: str | Path) -> Asset:
    """Read a folder that `save_asset` or a run wrote; asset.json may have been edited.

    Raises:
        BadInputError: a file is missing or damaged, or an edited field is wrong; the message names the field.
    """
    folder = Path(folder)
    path = folder / ASSET_FILE
    try:
        table = AssetTable.model_validate_json(path.read_text(encoding="utf-8"))
    except (FileNotFoundError, NotADirectoryError) as error:
        raise BadInputError(
            f"{folder} has no {ASSET_FILE}: give the output folder of a conversion"
        ) from error
    except (OSError, UnicodeDecodeError) as error:
        raise BadInputError(f"cannot read {path}: {error}") from error
    except ValidationError as error:
        raise BadInputError(f"{path}: {_told(error)}") from error
    arrays = _read_arrays(folder / ARRAYS_FILE)
    try:
        return _asset(table, arrays)
    except KeyError as error:
        raise BadInputError(
            f"{folder / ARRAYS_FILE} has no array {error}: it is not of this {ASSET_FILE}"
        ) from error
    except SimartKitError as error:
        raise BadInputError(f"{path}: {error}") from error


def save_value(value: object, folder: Path) -> None:
    """Keep a stage's input for whoever looks into its failure: an asset folder, or arrays in an .npz."""
    if isinstance(value, Asset):
        save_asset(value, folder)
        return
    folder.mkdir(parents=True, exist_ok=True)
    if isinstance(value, Mesh):
        _write_arrays(folder / "mesh.npz", _mesh_arrays(value))
    elif isinstance(value, Segmentation):
        names = np.array([p.name for p in value.parts])
        _write_arrays(folder / "segmentation.npz", {"face_part": value.face_part, "parts": names})
        if value.mesh is not None:
            save_value(value.mesh, folder)


def _told(error: ValidationError) -> str:
    """Every wrong field and what is wrong with it, on one line."""
    return "; ".join(f"{'.'.join(map(str, e['loc'])) or 'file'}: {e['msg']}" for e in error.errors())


def _mesh_arrays(mesh: Mesh) -> dict[str, Any]:
    arrays = {name: getattr(mesh, name) for name in _MESH_ARRAYS if getattr(mesh, name) is not None}
    for index, material in enumerate(mesh.materials):
        for name in _IMAGES:
            image = getattr(material, name)
            if image is not None:
                arrays[f"material_{index}_{name}"] = np.frombuffer(image.png, np.uint8)
    return arrays


def _write_arrays(path: Path, arrays: Mapping[str, Any]) -> None:
    """As `numpy.savez_compressed`, in a third of its time: files are some percent larger."""
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED, compresslevel=1) as archive:
        for name, array in arrays.items():
            with archive.open(f"{name}.npy", "w", force_zip64=True) as member:
                np.lib.format.write_array(member, np.asarray(array), allow_pickle=False)


def _read_arrays(path: Path) -> dict[str, Any]:
    try:
        # Opened here: numpy leaves a file that it cannot read open.
        with path.open("rb") as file, np.load(file, allow_pickle=False) as archive:
            arrays = {name: archive[name] for name in archive.files}
    except FileNotFoundError as error:
        raise BadInputError(f"cannot read {path}: no such file, and {ASSET_FILE} needs it") from error
    except _DAMAGED as error:
        raise BadInputError(f"cannot read {path}: {error}") from error
    words = [name for name, array in arrays.items() if array.dtype.kind not in "biuf"]
    if words:
        raise BadInputError(f"cannot read {path}: no numbers in {', '.join(words)}")
    return arrays


def _asset(table: AssetTable, arrays: dict[str, Any]) -> Asset:
    materials = tuple(
        _with_images(m.value(), index, arrays) for index, m in enumerate(table.visual_materials)
    )
    optional: dict[str, Any] = {name: arrays.get(name) for name in ("normals", "uv", "colors", "face_node")}
    mesh = Mesh(
        arrays["vertices"],
        arrays["faces"],
        materials=materials,
        face_material=arrays["face_material"],
        **optional,
    )
    parts = tuple(
        replace(row.value(), collision=_collision(row, index, arrays))
        for index, row in enumerate(table.parts)
    )
    return table.asset(mesh, arrays["face_part"], parts)


def _with_images(material: VisualMaterial, index: int, arrays: dict[str, Any]) -> VisualMaterial:
    images: dict[str, Any] = {
        name: Image(frozen_bytes(arrays[f"material_{index}_{name}"]).tobytes())
        for name in _IMAGES
        if f"material_{index}_{name}" in arrays
    }
    return replace(material, **images)


def _collision(row: PartTable, index: int, arrays: dict[str, Any]) -> tuple[ConvexMesh, ...]:
    numbers = range(row.collision_shapes)
    prefixes = [f"collision_{index}_{number}" for number in numbers]
    return tuple(
        ConvexMesh(arrays[f"{p}_vertices"], arrays[f"{p}_faces"], row.primitive(number))
        for number, p in zip(numbers, prefixes, strict=True)
    )
