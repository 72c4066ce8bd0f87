"""One UsdGeomMesh as a Piece: triangles, and one value a vertex."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from simart_kit import BadInputError
from simart_kit.arrays import ByteArray, FloatArray, IntArray
from simart_kit.srgb import encoded

from .pieces import Piece
from .usd_materials import Looks


@dataclass(frozen=True, eq=False)
class Corners:
    """The triangles of a mesh as rows of 3F corners.

    Attributes:
        point: (3F,) index into the mesh's points.
        polygon: (3F,) polygon that a corner's triangle was cut from.
        corner: (3F,) index into `faceVertexIndices`.
        sizes: how many values each interpolation has.
    """

    point: IntArray
    polygon: IntArray
    corner: IntArray
    sizes: dict[str, int]


@dataclass(frozen=True, eq=False)
class Values:
    """Values of a primvar, and which one each corner takes.

    Attributes:
        rows: (N, K).
        ids: (3F,) row of each corner.
        splits: whether corners at one point may differ.
    """

    rows: FloatArray
    ids: IntArray
    splits: bool


def mesh_piece(prim: Any, looks: Looks, node: int) -> Piece:
    """Triangulate a mesh prim; polygons become fans.

    Args:
        prim: a UsdGeomMesh.
        looks: of the file.
        node: number of this mesh.
    """
    from pxr import Usd, UsdGeom

    mesh, time = UsdGeom.Mesh(prim), Usd.TimeCode.EarliestTime()
    points = _array(mesh.GetPointsAttr().Get(time), np.float64).reshape(-1, 3)
    counts = _array(mesh.GetFaceVertexCountsAttr().Get(time), np.int64)
    indices = _array(mesh.GetFaceVertexIndicesAttr().Get(time), np.int64)
    left_handed = mesh.GetOrientationAttr().Get(time) == UsdGeom.Tokens.leftHanded
    corners = _corners(prim, points, counts, indices, left_handed)
    materials, texture_set, bound = looks.of_faces(prim, len(counts))

    primvars = UsdGeom.PrimvarsAPI(prim)
    normals = _values(primvars.FindPrimvarWithInheritance("normals"), corners, looks)
    if normals is None:
        attribute = mesh.GetNormalsAttr()
        normals = _fitted(attribute, None, mesh.GetNormalsInterpolation(), corners, looks)
    uv = _values(_texture_coordinates(primvars, texture_set), corners, looks)
    color = None if bound else _values(primvars.FindPrimvarWithInheritance("displayColor"), corners, looks)
    face_material = materials[corners.polygon[::3]]
    if color is not None and len(color.rows) == 1:
        face_material, color = np.full(len(face_material), looks.plain(color.rows[0])), None
    elif color is not None:
        face_material = np.full(len(face_material), looks.colored())
    return _piece(points, corners, face_material, [normals, uv, color], node)


def _corners(prim: Any, points: FloatArray, counts: IntArray, indices: IntArray, flipped: bool) -> Corners:
    if counts.sum() != len(indices) or (counts < 0).any():
        raise BadInputError(
            f"mesh {prim.GetPath()} counts {counts.sum()} face corners but has {len(indices)}"
        )
    if len(indices) and (indices.min() < 0 or indices.max() >= len(points)):
        bad = indices.max() if indices.max() >= len(points) else indices.min()
        raise BadInputError(
            f"face index {bad} of mesh {prim.GetPath()} is out of range: it has {len(points)} points"
        )
    triangles = np.maximum(counts - 2, 0)
    polygon = np.repeat(np.arange(len(counts)), triangles)
    step = np.arange(len(polygon)) - np.repeat(np.cumsum(triangles) - triangles, triangles)
    start = (np.cumsum(counts) - counts)[polygon]
    columns = [start, start + step + 1, start + step + 2]
    corner = np.column_stack(columns[::-1] if flipped else columns).ravel()
    sizes = {
        "constant": 1,
        "uniform": len(counts),
        "vertex": len(points),
        "varying": len(points),
        "faceVarying": len(indices),
    }
    return Corners(indices[corner], np.repeat(polygon, 3), corner, sizes)


def _texture_coordinates(primvars: Any, wanted: str) -> Any:
    """The primvar that the material reads, or else the usual names, or else any of that type."""
    found = {p.GetPrimvarName(): p for p in primvars.FindPrimvarsWithInheritance() if p.HasValue()}
    pairs = [
        n for n, p in found.items() if str(p.GetTypeName()) in ("texCoord2f[]", "texCoord2d[]", "float2[]")
    ]
    for name in (wanted, "st", "UVMap", *sorted(pairs)):
        if name in found:
            return found[name]
    return None


def _values(primvar: Any, corners: Corners, looks: Looks) -> Values | None:
    from pxr import Usd

    if primvar is None or not primvar.HasValue():
        return None
    indices = primvar.GetIndices(Usd.TimeCode.EarliestTime()) if primvar.IsIndexed() else None
    return _fitted(primvar.GetAttr(), indices, primvar.GetInterpolation(), corners, looks)


def _fitted(
    attribute: Any, indices: Any, interpolation: str, corners: Corners, looks: Looks
) -> Values | None:
    """Values of an attribute by corner; None, and a warning, when their number is wrong."""
    from pxr import Usd

    rows = _array(attribute.Get(Usd.TimeCode.EarliestTime()), np.float64)
    if not len(rows):
        return None
    order = np.arange(len(rows)) if indices is None else _array(indices, np.int64)
    if len(order) != corners.sizes.get(interpolation) or order.min() < 0 or order.max() >= len(rows):
        looks.warnings.append(f"{attribute.GetPath()} is left out: it does not fit its mesh")
        return None
    if interpolation == "constant":
        return Values(rows[order], np.zeros_like(corners.point), splits=False)
    if interpolation in ("vertex", "varying"):
        return Values(rows, order[corners.point], splits=False)
    if interpolation == "uniform":
        return Values(rows, order[corners.polygon], splits=True)
    return _shared(Values(rows, order[corners.corner], splits=True))


def _shared(values: Values) -> Values:
    """The same with equal rows as one, so that corners which agree stay one vertex."""
    rows = np.ascontiguousarray(values.rows + 0.0)  # no negative zeros
    keys = rows.view(np.dtype((np.void, rows.dtype.itemsize * rows.shape[1]))).ravel()
    _, first, inverse = np.unique(keys, return_index=True, return_inverse=True)
    return Values(rows[first], inverse.reshape(-1)[values.ids], values.splits)


def _piece(
    points: FloatArray, corners: Corners, face_material: IntArray, values: list[Values | None], node: int
) -> Piece:
    vertex = corners.point
    for value in values:
        if value is not None and value.splits:
            _, vertex = np.unique(vertex * len(value.rows) + value.ids, return_inverse=True)
    _, first, faces = np.unique(vertex, return_index=True, return_inverse=True)
    normals, uv, color = (None if v is None else v.rows[v.ids[first]] for v in values)
    piece = Piece(points[corners.point[first]], faces.reshape(-1, 3), face_material, node=node)
    return replace(
        piece,
        normals=normals,
        uv=None if uv is None else uv[:, :2],
        colors=None if color is None else _rgba(color),
    )


def _rgba(linear: FloatArray) -> ByteArray:
    """(V, 4) sRGB bytes of (V, 3) linear colours."""
    return encoded(np.column_stack([np.nan_to_num(linear[:, :3]), np.ones(len(linear))]))


def _array(values: Any, kind: type) -> Any:
    return np.array([] if values is None else values, dtype=kind)
