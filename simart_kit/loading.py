"""Reading a source file: who can, in which frame, and whether it can be used at all."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from pathlib import Path

from .arrays import FloatArray
from .assemble import checked
from .errors import BadInputError, PluginError, SimartKitError
from .mesh import Mesh, Note, UpAxis, canonical
from .normals import with_normals
from .plugins import Plugins
from .provenance import file_hash
from .stages import Segmentation

UNITS = {"mm": 0.001, "cm": 0.01, "m": 1.0, "in": 0.0254, "ft": 0.3048}
# Sizes beyond these are damage or a joke; single precision loses the shape.
_SMALLEST, _LARGEST = 1e-6, 1e6


@dataclass(frozen=True, eq=False)
class Source:
    """A file that was read.

    Attributes:
        mesh: in the canonical frame, in the metres that the file claims.
        asset_from_source: (4, 4) maps the file's coordinates to the mesh's.
        sha256: of the file.
        stated: parts and joints of `mesh`, where the file states them.
    """

    mesh: Mesh
    asset_from_source: FloatArray
    sha256: str
    stated: Segmentation | None = None


def source_path(source: str | Path) -> Path:
    """The file as a path; raises BadInputError when there is none."""
    path = Path(source)
    try:
        folder, there = path.is_dir(), path.exists()
    except OSError as error:  # a name that no file can have
        raise BadInputError(f"no such file: {path}: {error.strerror}") from error
    if folder:
        raise BadInputError(f"{path} is a folder: name one mesh file in it")
    if not there:
        raise BadInputError(f"no such file: {path}")
    return path


def read_source(
    path: Path, plugins: Plugins, up: UpAxis | None = None, unit: str | float | None = None
) -> Source:
    """Read a mesh file and bring it to the canonical frame; normals are computed where the file has none.

    Raises:
        BadInputError: nobody reads this format, the file is broken, or its size makes no sense.
    """
    metres_per_unit = metres(unit)
    if path.stat().st_size == 0:
        raise BadInputError(f"{path} is empty (0 bytes)")
    loaded = _loaded(path, plugins)
    mesh = loaded.mesh if isinstance(loaded, Segmentation) else loaded
    if mesh is None or (isinstance(loaded, Segmentation) and loaded.joints is None):
        raise PluginError(f"{path}: a loader plugin returned a Segmentation without its mesh and joints")
    placed, asset_from_source = canonical(mesh, up, metres_per_unit)
    if not _SMALLEST < placed.diagonal < _LARGEST or not float(placed.face_areas.sum()) > 0:
        raise BadInputError(
            f"{path}: the object is {placed.diagonal:.3g} m across with a surface of "
            f"{float(placed.face_areas.sum()):.3g} m2: check the file, or give its --unit"
        )
    decided = Note("load", "info", _frame_text(mesh, up, unit))
    placed = with_normals(placed)  # once, for every stage that draws or exports
    placed = replace(placed, notes=(*mesh.notes, decided))
    stated = _stated(path, loaded, placed, asset_from_source) if isinstance(loaded, Segmentation) else None
    return Source(placed, asset_from_source, file_hash(path), stated)


def _stated(path: Path, loaded: Segmentation, placed: Mesh, asset_from_source: FloatArray) -> Segmentation:
    """What a file states of its own mesh, as of the mesh in the canonical frame."""
    joints = tuple(joint.transformed(asset_from_source) for joint in loaded.joints or ())
    told = "parts and joints as the file states them: the recipe's segmenter and joint predictor are not used"
    notes = (Note("load", "info", told), *loaded.notes)
    try:
        return checked(replace(loaded, mesh=None, joints=joints, notes=notes), placed)
    except ValueError as error:
        raise PluginError(f"{path}: a loader plugin's Segmentation: {error}") from error


def _loaded(path: Path, plugins: Plugins) -> Mesh | Segmentation:
    try:
        mesh = plugins.manager.hook.load_mesh(path=path)
    except SimartKitError:
        raise
    except Exception as error:
        raise PluginError(f"{path}: a loader plugin failed: {type(error).__name__}: {error}") from error
    if mesh is None:
        raise BadInputError(
            f"{path}: no plugin reads '{path.suffix or path.name}' files; "
            "known are glb, gltf, obj, ply, stl, off, dae, 3mf, usd, usda, usdc, usdz, urdf"
        )
    if not isinstance(mesh, Mesh | Segmentation):
        raise PluginError(f"{path}: a loader plugin returned {type(mesh).__name__}, not a Mesh")
    return mesh


def metres(unit: str | float | None) -> float | None:
    """Metres a unit from a name or a number; None stays None."""
    if unit is None:
        return None
    try:
        value = UNITS[unit] if unit in UNITS else float(unit)
    except ValueError:
        value = math.nan
    if not (math.isfinite(value) and value > 0):
        raise BadInputError(f"unit '{unit}': use {', '.join(UNITS)} or metres a unit as a number > 0")
    return value


def _frame_text(mesh: Mesh, up: UpAxis | None, unit: str | float | None) -> str:
    said = (
        "the file gives no unit, metres assumed"
        if mesh.metres_per_unit is None
        else (f"the file says {mesh.metres_per_unit:g} m a unit")
    )
    length = f"--unit {unit}" if unit is not None else said
    return f"up is {up or mesh.up} ({'--up' if up else 'from the format'}); {length}"
