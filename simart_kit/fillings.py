"""Which closed shells are material, which are voids, and which are hollow though no inside is drawn."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .arrays import BoolArray, FloatArray, IntArray
from .bounds import bounds_of, triangle_bounds
from .materials import Build
from .shells import Shells
from .triangles import crosses

FILM = 0.25  # walls drawn thinner than this share of the usual ones are no walls of a real thing
_MOST_CONTAINERS = 512
# Rays from points inside run along z after this rotation, so that they miss the edges of axis-aligned boxes.
_ODD_ROTATION = np.linalg.qr(np.array([[0.61, 0.23, -0.41], [-0.17, 0.83, 0.29], [0.37, -0.11, 0.71]]))[0]

Containment = tuple[int, BoolArray]


@dataclass(frozen=True, eq=False)
class Fillings:
    """How closed shells count.

    Attributes:
        factor: (N,) on each shell's signed moments: +-1 for material and voids, 0 for what is buried.
        walled: (N,) shells that count as walls along them.
    """

    factor: FloatArray
    walled: BoolArray


def fillings(shells: Shells, ids: IntArray, volumes: FloatArray, build: Build) -> Fillings:
    """Say how each of some closed shells counts.

    There is material where the winding number, in the sense of the outermost shell around, is positive. A
    shell has walls of the usual thickness instead where what it bounds, less the voids in it, is thicker on
    average than things of the material are solid, or where a void leaves a film only; what is inside
    then stands for itself. The mean thickness is twice the volume a surface: that of a board, half the
    diameter of a rod, a third of the side of a cube.

    Args:
        shells: all of a part.
        ids: (N,) the closed ones.
        volumes: (N,) signed, of each [m^3].
        build: how things of the material are built.
    """
    own, areas = np.sign(volumes), shells.areas[ids]
    holders = _containments(shells, ids, np.abs(volumes))
    walled, dropped = np.zeros(len(ids), dtype=np.bool_), np.zeros(len(ids), dtype=np.bool_)
    while True:  # what stands for itself in a hollow shell may be hollow too
        free = ~(walled | dropped)
        holders = [(container, inside) for container, inside in holders if free[container]]
        factor = np.where(free, _factors(own, holders), 0.0)
        more, voids = _hollow(factor, volumes, areas, holders, build)
        if not more.any():
            return Fillings(factor, walled)
        walled |= more
        dropped |= voids


def _factors(own: FloatArray, holders: list[Containment]) -> FloatArray:
    """(N,) factor of each shell of (N,) orientation."""
    around, outermost = np.zeros(len(own)), np.zeros(len(own))
    for container, inside in holders:
        outermost[inside & (outermost == 0)] = own[container]
        around[inside] += own[container]
    outermost[outermost == 0] = own[outermost == 0]
    outside = around * outermost
    return np.asarray(((outside + own * outermost > 0).astype(float) - (outside > 0)) * own)


def _hollow(
    factor: FloatArray, volumes: FloatArray, areas: FloatArray, holders: list[Containment], build: Build
) -> tuple[BoolArray, BoolArray]:
    """(N,) shells that have walls, and (N,) voids in them, which say no more than that they are hollow."""
    filled, void = factor * volumes > 0, factor * volumes < 0
    owner = np.full(len(factor), -1)
    for container, inside in holders:  # largest first: the smallest one around stays
        if filled[container]:
            owner[inside] = container
    held = void & (owner >= 0)
    voids = np.bincount(owner[held], np.abs(volumes[held]), len(factor))
    lining = np.bincount(owner[held], areas[held], len(factor))
    surface = areas + lining
    thickness = np.zeros(len(factor))  # of a shell without area, too
    np.divide(2 * (np.abs(volumes) - voids), surface, out=thickness, where=surface > 0)
    walled = filled & ((thickness > build.solid_up_to) | ((voids > 0) & (thickness < FILM * build.wall)))
    return walled, held & walled[owner]


def _containments(shells: Shells, ids: IntArray, volumes: FloatArray) -> list[Containment]:
    """Closed shells that hold others: (index, (N,) mask of those inside), largest first."""
    if len(ids) < 2:
        return []
    triangles = shells.triangles @ _ODD_ROTATION.T
    split = shells.split()
    turned = [triangles[split[i]] for i in ids]
    boxes = [triangle_bounds(t) for t in turned]
    lower, upper = (
        np.array(sides) for sides in zip(*(bounds_of(t.reshape(-1, 3)) for t in turned), strict=True)
    )
    probes = np.array([_point_inside(p) for p in turned])
    result = []
    for index in np.argsort(-volumes, kind="stable")[:_MOST_CONTAINERS]:
        near = (lower >= lower[index]).all(axis=1) & (upper <= upper[index]).all(axis=1)
        near &= volumes < volumes[index]
        inside = np.zeros(len(ids), dtype=bool)
        inside[near] = [_winding(turned[index], boxes[index], probe) != 0 for probe in probes[near]]
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


def _winding(triangles: FloatArray, boxes: tuple[FloatArray, FloatArray], point: FloatArray) -> int:
    """How often (F, 3, 3) closed triangles, in boxes, go around a point: signed hits of a ray along +z."""
    low, high = boxes
    near = (low[:, 0] <= point[0]) & (high[:, 0] >= point[0]) & (low[:, 1] <= point[1])
    near &= (high[:, 1] >= point[1]) & (high[:, 2] > point[2])
    corners = triangles[near] - point
    following = corners[:, [1, 2, 0]]
    sides = corners[..., 0] * following[..., 1] - corners[..., 1] * following[..., 0]
    hit = (sides > 0).all(axis=1) | (sides < 0).all(axis=1)
    height = np.einsum("nk,nk->n", sides[:, [1, 2, 0]], corners[..., 2]) * np.sign(sides[:, 0])
    return int(np.sign(sides[hit & (height > 0), 0]).sum())
