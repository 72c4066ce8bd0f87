"""Reads GLB, glTF, OBJ, PLY, STL, OFF, DAE and 3MF through trimesh's parsers.

Only the parsers: trimesh's own meshes would merge vertices, drop what is not finite and invent normals.
Faces come in the order of `trimesh.load(path, process=False, force="mesh")`.

| format    | up                 | unit                     |
| --------- | ------------------ | ------------------------ |
| GLB, glTF | +y                 | metre                    |
| DAE       | `up_axis`, else +y | `unit`, else metre       |
| 3MF       | +z                 | `unit`, else millimetre  |
| OBJ       | +y (by custom)     | not said                 |
| PLY, STL, OFF | +z (by custom) | not said                 |
"""

from __future__ import annotations

import io
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import numpy as np

from simart_kit import BadInputError, Mesh, hookimpl
from simart_kit.arrays import FloatArray, IntArray
from simart_kit.findings import Finding, library
from simart_kit.mesh import UpAxis

from .dae import dae_frame
from .folder import AssetFolder
from .gltf import check_gltf
from .guards import check_zip, reading, survived
from .materials import Palette
from .obj import clean_obj, obj_warnings
from .pieces import Piece, bounded, joined
from .trimesh_materials import material_index, rgba

GLTF = ("glb", "gltf")
UP: dict[str, UpAxis] = {
    "glb": "+y",
    "gltf": "+y",
    "obj": "+y",
    "dae": "+y",
    "3mf": "+z",
    "ply": "+z",
    "stl": "+z",
    "off": "+z",
}
# Formats whose scene has nodes; trimesh's pieces of an OBJ are its materials.
WITH_NODES = (*GLTF, "dae", "3mf")
UNITS_3MF = {
    "micron": 1e-6,
    "millimeter": 1e-3,
    "millimeters": 1e-3,
    "centimeter": 1e-2,
    "inch": 0.0254,
    "foot": 0.3048,
    "meter": 1.0,
}


@hookimpl
def load_mesh(path: Path) -> Mesh | None:
    """Read a file of one of the formats above."""
    return read_mesh(path, path.parent)


def read_mesh(path: Path, within: Path) -> Mesh | None:
    """Read a file of one of the formats above; None of another.

    Args:
        path: the file.
        within: folder around it; what the file refers to must lie there.

    Raises:
        BadInputError: the file is broken; names it.
    """
    kind = path.suffix.lower().lstrip(".")
    if kind not in UP:
        return None
    with reading(path, kind.upper()):
        return _load(path, kind, within)


def _load(path: Path, kind: str, within: Path) -> Mesh:
    warnings = check_gltf(path) if kind in GLTF else []
    if kind == "3mf":
        check_zip(path)
    data = path.read_bytes()
    if kind == "obj":
        warnings, data = obj_warnings(data), clean_obj(data)
    up, metres = dae_frame(data) if kind == "dae" else (UP[kind], 1.0 if kind in GLTF else None)
    folder, palette = AssetFolder(path, within, strict=kind in GLTF), Palette()
    with survived("trimesh") as troubles:
        parsed = _parsed(data, kind, folder)
        pieces = bounded(
            _piece(part, palette, node).moved(matrix) for part, matrix, node in _instances(parsed)
        )
    if kind in GLTF and folder.missing:
        raise BadInputError(folder.missing[0])
    if kind == "3mf":
        metres = UNITS_3MF[parsed["metadata"]["units"]]
    warnings += [*folder.missing, *troubles, *palette.warnings]
    return joined(pieces, palette.materials, up, metres, kind in WITH_NODES, warnings)


def _parsed(data: bytes, kind: str, folder: AssetFolder) -> Mapping[str, Any]:
    """Arguments of trimesh's constructors: of a mesh, or of a scene with "geometry" and "graph"."""
    from trimesh.exchange.load import mesh_loaders

    parsed: Mapping[str, Any] = mesh_loaders[kind](
        file_obj=io.BytesIO(data), file_type=kind, resolver=folder, process=False
    )
    return parsed


def _instances(parsed: Mapping[str, Any]) -> Iterator[tuple[Mapping[str, Any], FloatArray, int]]:
    """Each use of a geometry, with world_from_geometry (4, 4) and the number of its node."""
    from trimesh.scene.transforms import SceneGraph

    if "geometry" not in parsed:
        yield parsed, np.eye(4), 0
        return
    geometry, edges = parsed["geometry"], parsed.get("graph")
    if edges is None:
        edges = [{"frame_to": name, "geometry": name} for name in geometry]
    graph = SceneGraph(base_frame=parsed.get("base_frame", "world"))
    parents = {}
    for edge in edges:
        graph.update(**edge)
        parents[edge["frame_to"]] = edge.get("frame_from")
    numbers: dict[object, int] = {}
    for frame in graph.nodes_geometry:
        matrix, name = graph.get(frame)
        # trimesh hangs the primitives of a glTF mesh below its node, each under a made-up name.
        primitive = geometry[name].get("metadata", {}).get("from_gltf_primitive", False)
        node = numbers.setdefault(parents[frame] if primitive else frame, len(numbers))
        yield geometry[name], np.asarray(matrix, dtype=np.float64), node


def _piece(part: Mapping[str, Any], palette: Palette, node: int) -> Piece:
    vertices = np.asarray(part["vertices"], dtype=np.float64).reshape(-1, 3)
    faces, count = _triangles(part.get("faces")), len(vertices)
    visual = part.get("visual")
    attributes = getattr(visual, "vertex_attributes", {})
    colors = rgba(part.get("vertex_colors"), count)
    if colors is None:
        colors = rgba(attributes.get("color"), count)
    face_colors = rgba(part.get("face_colors"), len(faces)) if colors is None else None
    material = material_index(palette, visual, colors is not None or face_colors is not None)
    piece = Piece(
        vertices,
        faces,
        np.full(len(faces), material, dtype=np.int32),
        _rows(part.get("vertex_normals"), count, 3),
        _rows(getattr(visual, "uv", None), count, 2),
        colors,
        node,
    )
    return piece if face_colors is None else piece.with_face_colors(face_colors)


def _triangles(faces: Any) -> IntArray:
    """(F, 3) of trimesh's triangles, quads or polygons; none for points and lines."""
    from trimesh.geometry import triangulate_quads

    if faces is None or len(faces) == 0:
        return np.zeros((0, 3), dtype=np.int32)
    shape = np.shape(faces)
    whole = faces if len(shape) == 2 and shape[1] == 3 else triangulate_quads(faces)
    return np.asarray(whole, dtype=np.int64)


def _rows(values: Any, count: int, columns: int) -> FloatArray | None:
    """(count, columns) floats; None where the file gives none or too few."""
    if values is None or np.ndim(values) != 2 or len(values) != count or np.shape(values)[1] < columns:
        return None
    return np.asarray(values, dtype=np.float64)[:, :columns]


@hookimpl
def diagnose() -> list[Finding]:
    """The parsers; those of DAE and 3MF are used for these formats alone."""
    of_formats = (library(name, stages=()) for name in ("pycollada", "lxml", "networkx"))
    return [library("trimesh"), *of_formats]
