"""What a surface bounds: moments of the material inside, also where the surface is open."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from .arrays import FloatArray, IntArray
from .capping import capped
from .fillings import FILM, fillings
from .hulls import hull_of
from .materials import Build
from .moments import moved, sheet_moments, solid_moments, summed
from .shells import Shells, find_shells
from .topology import occurring
from .triangles import unit_normals

THICKNESS = 0.01  # [m] of a board of no material in particular
AS_DRAWN = Build(THICKNESS, np.inf)
_SLENDERNESS = 0.1  # a sheet is thinner than this share of the square root of its area
_FLAT = 0.3  # below this share of a sheet's volume its hull says nothing about its depth
_NOTHING = 1e-9  # slivers below this share of the area fill T-junctions and weigh nothing
_MOST_HULLS = 64


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


def solid(vertices: FloatArray, faces: IntArray, build: Build = AS_DRAWN) -> Solid:
    """The material bounded by (F, 3) faces.

    Closed shells count exactly, those with small holes as if these had caps. A shell inside another is a
    void when it is wound the other way, and part of the material otherwise; one too thick to be solid is
    hollow, see `fillings.fillings`. An open shell stands for a board along it, or for its convex hull if that
    is smaller but not flat; all open shells together never take more than their common hull. Shells that only
    overlap count twice, but all closed ones together never take more than their hull.

    Args:
        vertices: (V, 3) [m].
        faces: (F, 3).
        build: how things of the material are built; boards drawn as a single surface are as thick as its
            walls, small ones a tenth of their width.
    """
    shells = capped(find_shells(vertices, faces), FILM * build.wall)
    middle = (vertices[faces.ravel()].min(axis=0) + vertices[faces.ravel()].max(axis=0)) / 2
    local = replace(shells, vertices=shells.vertices - middle)
    inside, closed_text = _bounded(local, *_closed(local, build))
    around, open_text = _open(local, build.wall)
    total = inside + around
    if not total[3, 3] > 0:
        return Solid(_speck(vertices[faces.ravel()]), "no area", 1.0)
    method = " + ".join(text for text in (closed_text, open_text) if text)
    return Solid(moved(total, middle), method, float(around[3, 3] / total[3, 3]))


def _bounded(shells: Shells, moments: FloatArray, text: str) -> tuple[FloatArray, str]:
    """Moments of closed shells, or of their hull where they overlap so much that they exceed it."""
    count = int(shells.closed.sum())
    if count < 2:
        return moments, text
    closed = shells.closed[shells.face_shell]
    hull = hull_of(shells.vertices[occurring(shells.faces[closed])])
    if hull is None:
        return moments, text
    most = np.asarray(solid_moments(hull.vertices[hull.faces]).sum(axis=0))
    if moments[3, 3] <= most[3, 3] * (1 + _NOTHING):
        return moments, text
    return most, f"convex hull of {count} overlapping shells"


def _speck(points: FloatArray) -> FloatArray:
    """(4, 4) moments of a cubic millimetre spread over (N, 3) points."""
    rows = np.column_stack([points, np.ones(len(points))])
    return np.asarray(1e-9 * rows.T @ rows / len(points))


def _closed(shells: Shells, build: Build) -> tuple[FloatArray, str]:
    moments = summed(solid_moments(shells.triangles), shells.face_shell, shells.count)
    ids = np.flatnonzero(shells.closed)
    volumes = moments[ids, 3, 3]
    found = fillings(shells, ids, volumes, build)
    total = np.einsum("s,sij->ij", found.factor, moments[ids])
    walled = ids[found.walled]
    if len(walled):
        total = total + _walls(shells, walled, moments, build.wall).sum(axis=0)
    filled, voids = (int((sign * found.factor * volumes > 0).sum()) for sign in (1, -1))
    text = "" if filled == 0 else "closed mesh" if filled == 1 else f"{filled} closed shells"
    if voids:
        text += f" with {voids} void{'s' if voids > 1 else ''}"
    if len(walled):
        hollow = "hollow shell" if len(walled) == 1 else f"{len(walled)} hollow shells"
        text += f"{' + ' if text else ''}{hollow} with walls of {_millimetres(build.wall)} mm"
    return total, text


def _walls(shells: Shells, ids: IntArray, moments: FloatArray, wall: float) -> FloatArray:
    """(N, 4, 4) moments of walls inside closed shells, which are solid where the walls would be more.

    Walls overlap along edges and count twice there.
    """
    ways = np.sign(moments[:, 3, 3])
    chosen = np.isin(shells.face_shell, ids)
    triangles, label = shells.triangles[chosen], shells.face_shell[chosen]
    inward = -unit_normals(triangles) * ways[label][:, None]
    thick = np.full(len(triangles), wall)
    layers = summed(sheet_moments(triangles + inward[:, None] * wall / 2, thick), label, shells.count)
    solids = moments[ids] * ways[ids][:, None, None]
    return np.asarray(np.where((layers[ids] < solids)[:, 3:, 3:], layers[ids], solids))


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
        _smaller_hull(shells.vertices[occurring(shells.faces[faces])], total[3, 3]) if len(ids) > 1 else None
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
        low, high = _millimetres(sheets.min()), _millimetres(sheets.max())
        size = f"{high} mm" if low == high else f"{low} to {high} mm"
        texts.append(f"sheet of {size}" if len(sheets) == 1 else f"{len(sheets)} sheets of {size}")
    if hulls:
        texts.append("convex hull" if hulls == 1 else f"convex hulls of {hulls} components")
    return " + ".join(texts)


def _millimetres(length: float) -> str:
    return f"{length * 1000:.2g}"
