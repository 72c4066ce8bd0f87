"""What a surface bounds: moments of the material inside, also where the surface is open."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from .arrays import BoolArray, FloatArray, IntArray
from .hulls import hull_of
from .moments import moved, sheet_moments, solid_moments, summed
from .shells import Shells, find_shells
from .triangles import crosses

THICKNESS = 0.01  # [m] of the board that an open surface stands for
_SLENDERNESS = 0.1  # a sheet is thinner than this share of the square root of its area
_FLAT = 0.3  # below this share of a sheet's volume its hull says nothing about its depth
_NOTHING = 1e-9  # slivers below this share of the area fill T-junctions and weigh nothing
_MOST_HULLS = 64
_MOST_CONTAINERS = 512
# Rays from points inside run along z after this rotation, so that they miss the edges of axis-aligned boxes.
_ODD_ROTATION = np.linalg.qr(np.array([[0.61, 0.23, -0.41], [-0.17, 0.83, 0.29], [0.37, -0.11, 0.71]]))[0]


@dataclass(frozen=True, eq=False)
class Solid:
    """The material of a part.

    Attributes:
        moments: (4, 4), see `moments`; the measure is the volume [m^3].
        method: how the volume was found.
        guessed: share of the volume (0..1) that open surfaces stand for.
    """

    moments: FloatArray
    method: str
    guessed: float


def solid(vertices: FloatArray, faces: IntArray, thickness: float = THICKNESS) -> Solid:
    """The material bounded by (F, 3) faces.

    Closed shells count exactly. A shell inside another is a void when it is wound the other way, and part of
    the material otherwise. An open shell stands for a board of `thickness` along it, or for its convex hull
    if that is smaller but not flat; all open shells together never take more than their common hull.
    Shells that only overlap count twice.

    Args:
        vertices: (V, 3) [m].
        faces: (F, 3).
        thickness: of boards drawn as a single surface [m]; less for small ones, a tenth of their width.
    """
    shells = find_shells(vertices, faces)
    middle = (vertices[faces.ravel()].min(axis=0) + vertices[faces.ravel()].max(axis=0)) / 2
    local = replace(shells, vertices=shells.vertices - middle)
    inside, closed_text = _closed(local)
    around, open_text = _open(local, thickness)
    total = inside + around
    if not total[3, 3] > 0:
        return Solid(_speck(vertices[faces.ravel()]), "no area", 1.0)
    method = " + ".join(text for text in (closed_text, open_text) if text)
    return Solid(moved(total, middle), method, float(around[3, 3] / total[3, 3]))


def _speck(points: FloatArray) -> FloatArray:
    """(4, 4) moments of a cubic millimetre spread over (N, 3) points."""
    rows = np.column_stack([points, np.ones(len(points))])
    return np.asarray(1e-9 * rows.T @ rows / len(points))


def _closed(shells: Shells) -> tuple[FloatArray, str]:
    moments = summed(solid_moments(shells.triangles), shells.face_shell, shells.count)
    weights = np.zeros(shells.count)
    ids = np.flatnonzero(shells.closed)
    weights[ids] = _fillings(shells, ids, moments[ids, 3, 3])
    filled = int((weights * moments[:, 3, 3] > 0).sum())
    voids = int((weights * moments[:, 3, 3] < 0).sum())
    text = "" if filled == 0 else "closed mesh" if filled == 1 else f"{filled} closed shells"
    if voids:
        text += f" with {voids} void{'s' if voids > 1 else ''}"
    return np.einsum("s,sij->ij", weights, moments), text


def _fillings(shells: Shells, ids: IntArray, volumes: FloatArray) -> FloatArray:
    """(N,) factor on each closed shell's signed moments: +-1 for material and voids, 0 for what is buried.

    There is material where the winding number, in the sense of the outermost shell around, is positive.
    """
    own = np.sign(volumes)
    around, outermost = np.zeros(len(ids)), np.zeros(len(ids))
    for container, inside in _containments(shells, ids, np.abs(volumes)):
        outermost[inside & (outermost == 0)] = own[container]
        around[inside] += own[container]
    outermost[outermost == 0] = own[outermost == 0]
    outside = around * outermost
    return ((outside + own * outermost > 0).astype(float) - (outside > 0)) * own


def _containments(shells: Shells, ids: IntArray, volumes: FloatArray) -> list[tuple[int, BoolArray]]:
    """Closed shells that hold others: (index, (N,) mask of those inside), largest first."""
    if len(ids) < 2:
        return []
    triangles = shells.triangles @ _ODD_ROTATION.T
    split = shells.split()
    turned = [triangles[split[i]] for i in ids]
    lower = np.array([t.min(axis=(0, 1)) for t in turned])
    upper = np.array([t.max(axis=(0, 1)) for t in turned])
    probes = np.array([_point_inside(p) for p in turned])
    result = []
    for index in np.argsort(-volumes, kind="stable")[:_MOST_CONTAINERS]:
        near = (lower >= lower[index]).all(axis=1) & (upper <= upper[index]).all(axis=1)
        near &= volumes < volumes[index]
        inside = np.zeros(len(ids), dtype=bool)
        inside[near] = [_winding(turned[index], probe) != 0 for probe in probes[near]]
        if inside.any():
            result.append((int(index), inside))
    return result


def _point_inside(triangles: FloatArray) -> FloatArray:
    """(3,) a point just below the largest of a closed shell's (F, 3, 3) triangles."""
    cross = crosses(triangles)
    volume = np.einsum("ni,ni->", triangles[:, 0] - triangles[0, 0], cross)
    length = np.linalg.norm(cross, axis=1)
    largest = int(length.argmax())
    normal = cross[largest] / length[largest] * np.sign(volume)
    return np.asarray(triangles[largest].mean(axis=0) - normal * 1e-4 * np.sqrt(length[largest]))


def _winding(triangles: FloatArray, point: FloatArray) -> int:
    """How often (F, 3, 3) closed triangles go around a point: signed hits of a ray along +z."""
    low, high = triangles.min(axis=1), triangles.max(axis=1)
    near = ((low <= point)[:, :2] & (high >= point)[:, :2]).all(axis=1) & (high[:, 2] > point[2])
    corners = triangles[near] - point
    following = corners[:, [1, 2, 0]]
    sides = corners[..., 0] * following[..., 1] - corners[..., 1] * following[..., 0]
    hit = (sides > 0).all(axis=1) | (sides < 0).all(axis=1)
    height = np.einsum("nk,nk->n", sides[:, [1, 2, 0]], corners[..., 2]) * np.sign(sides[:, 0])
    return int(np.sign(sides[hit & (height > 0), 0]).sum())


def _open(shells: Shells, thickness: float) -> tuple[FloatArray, str]:
    areas = shells.areas
    ids = np.flatnonzero(~shells.closed & (areas > _NOTHING * areas.sum()))
    if not len(ids):
        return np.zeros((4, 4)), ""
    thick = np.minimum(thickness, _SLENDERNESS * np.sqrt(areas))
    faces = np.flatnonzero(~shells.closed[shells.face_shell])
    label = shells.face_shell[faces]
    moments = summed(sheet_moments(shells.triangles[faces], thick[label]), label, shells.count)
    points = shells.points()
    hulled = []
    for i in ids[np.argsort(-moments[ids, 3, 3], kind="stable")][:_MOST_HULLS].tolist():
        smaller = _smaller_hull(points[i], moments[i, 3, 3])
        if smaller is not None:
            moments[i] = smaller
            hulled.append(i)
    total = moments[ids].sum(axis=0)
    common = (
        _smaller_hull(shells.vertices[np.unique(shells.faces[faces])], total[3, 3]) if len(ids) > 1 else None
    )
    if common is not None:
        return common, f"convex hull of {len(ids)} open pieces"
    return total, _open_text(thick[np.setdiff1d(ids, hulled)], len(hulled))


def _smaller_hull(points: FloatArray, sheet_volume: float) -> FloatArray | None:
    """(4, 4) moments of the convex hull, if it is smaller than the sheet and yet not flat."""
    hull = hull_of(points)
    if hull is None:
        return None
    moments = np.asarray(solid_moments(hull.vertices[hull.faces]).sum(axis=0))
    return moments if _FLAT * sheet_volume < moments[3, 3] < sheet_volume else None


def _open_text(sheets: FloatArray, hulls: int) -> str:
    texts = []
    if len(sheets):
        low, high = (f"{v * 1000:.2g}" for v in (sheets.min(), sheets.max()))
        size = f"{high} mm" if low == high else f"{low} to {high} mm"
        texts.append(f"sheet of {size}" if len(sheets) == 1 else f"{len(sheets)} sheets of {size}")
    if hulls:
        texts.append("convex hull" if hulls == 1 else f"convex hulls of {hulls} components")
    return " + ".join(texts)
