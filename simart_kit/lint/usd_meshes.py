"""USD meshes: indices, extents, areas, normals and winding."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from ..arrays import FloatArray, IntArray
from .findings import Finding
from .mesh_sense import Faces, is_wound_inwards
from .usd_scene import UsdScene, stated

if TYPE_CHECKING:
    from pxr import Usd

_NO_AREA = 1e-14  # share of the squared diagonal: what single precision leaves of nothing


def mesh_findings(scene: UsdScene) -> Iterator[Finding]:
    """Breaches by meshes, and by the extents of other shapes."""
    from pxr import UsdGeom

    for prim in scene.prims:
        if prim.IsA(UsdGeom.Gprim) and not prim.IsInstanceProxy():
            yield from _extent_findings(prim)
        if prim.IsA(UsdGeom.Mesh) and not prim.IsInstanceProxy():
            yield from _mesh_findings(prim)


def _extent_findings(prim: Usd.Prim) -> Iterator[Finding]:
    from pxr import Usd, UsdGeom

    found = stated(prim, "extent")
    true = UsdGeom.Boundable.ComputeExtentFromPlugins(UsdGeom.Boundable(prim), Usd.TimeCode.EarliestTime())
    where = str(prim.GetPath())
    points = stated(prim, "points")
    if not true or not np.isfinite(true).all() or not (points is None or np.isfinite(points).all()):
        return
    if found is None:
        if prim.IsA(UsdGeom.PointBased):
            yield Finding("mesh-extent", where, "it has no extent: author that of its points")
        return
    size = float(np.linalg.norm(np.array(true[1]) - np.array(true[0])))
    if len(found) != 2 or np.abs(np.array(found) - np.array(true)).max() > 1e-4 * size:
        yield Finding(
            "mesh-extent", where, f"its extent is not that of its points: author {true[0]} {true[1]}"
        )


def _mesh_findings(prim: Usd.Prim) -> Iterator[Finding]:
    where = str(prim.GetPath())
    points = np.array(stated(prim, "points") or (), dtype=np.float64).reshape(-1, 3)
    counts = np.array(stated(prim, "faceVertexCounts") or (), dtype=np.int64)
    indices = np.array(stated(prim, "faceVertexIndices") or (), dtype=np.int64)
    if (stated(prim, "subdivisionScheme") or "catmullClark") != "none":
        yield Finding("mesh-subdivided", where, "set subdivisionScheme to none")
    if counts.sum() != len(indices) or (counts < 3).any():
        text = f"its face counts ask for {counts.sum()} indices and it has {len(indices)}: author them again"
        yield Finding("mesh-counts", where, text)
    elif not len(counts):
        yield Finding("mesh-empty", where, "it has no faces: remove it")
    elif indices.min() < 0 or indices.max() >= len(points):
        text = f"faces name points {indices.min()} to {indices.max()} of {len(points)}: author them again"
        yield Finding("mesh-index", where, text)
    elif np.isfinite(points).all():
        faces = Faces(points, counts, indices, stated(prim, "orientation") == "leftHanded")
        yield from _shape_findings(prim, faces)


def _shape_findings(prim: Usd.Prim, faces: Faces) -> Iterator[Finding]:
    where = str(prim.GetPath())
    flat = int((faces.areas <= _NO_AREA * faces.squared_size).sum())
    if flat:
        yield Finding(
            "mesh-degenerate", where, f"{flat} of {len(faces.counts)} faces have no area: remove them"
        )
    inwards = is_wound_inwards(faces)
    if inwards:
        yield Finding(
            "winding-flipped", where, "its faces are wound inwards: reverse the order of their corners"
        )
    normals, interpolation = _normals(prim)
    if normals is None:
        return
    expected = _expected(faces, interpolation)
    if len(normals) != expected:
        text = f"it has {len(normals)} normals, and {expected} are wanted for interpolation '{interpolation}'"
        yield Finding("normals-count", where, text)
        return
    if np.abs(np.linalg.norm(normals, axis=1) - 1).max(initial=0.0) > 1e-2:
        yield Finding("normals-not-unit", where, "some normals are not of length 1: normalise them")
    if not inwards and faces.share_against(_corner_normals(faces, normals, interpolation)) > 0.5:
        yield Finding(
            "normals-flipped", where, "most normals point against the winding of their faces: flip them"
        )


def _normals(prim: Usd.Prim) -> tuple[FloatArray | None, str]:
    """(N, 3) normals that renderers take, indexed ones spelled out, and their interpolation."""
    from pxr import Usd, UsdGeom

    primvar = UsdGeom.PrimvarsAPI(prim).GetPrimvar("normals")
    if primvar and primvar.HasAuthoredValue():
        values = primvar.ComputeFlattened(Usd.TimeCode.EarliestTime())
        return np.array(values, dtype=np.float64).reshape(-1, 3), str(primvar.GetInterpolation())
    values = stated(prim, "normals")
    if values is None:
        return None, ""
    return np.array(values, dtype=np.float64).reshape(-1, 3), str(
        UsdGeom.Mesh(prim).GetNormalsInterpolation()
    )


def _expected(faces: Faces, interpolation: str) -> int:
    sizes = {"constant": 1, "uniform": len(faces.counts), "faceVarying": len(faces.indices)}
    return sizes.get(interpolation, len(faces.points))


def _corner_normals(faces: Faces, normals: FloatArray, interpolation: str) -> FloatArray:
    """(N, 3) normals of the corners of all faces."""
    owners: IntArray = np.repeat(np.arange(len(faces.counts)), faces.counts)
    pick = {
        "constant": np.zeros_like(faces.indices),
        "uniform": owners,
        "faceVarying": np.arange(len(faces.indices)),
    }
    return np.asarray(normals[pick.get(interpolation, faces.indices)])
