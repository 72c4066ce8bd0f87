"""A small piece as a finger meets it: which way it faces, its width, and how it stands in what is around."""

from __future__ import annotations

from collections.abc import Sequence, Set
from dataclasses import dataclass

import numpy as np

from simart_kit.arrays import BoolArray, FloatArray, IntArray, unit

from .scene import Scene

_OFF = 1e-4  # a ray starts so far off its face
_BLUNT = 0.4  # a shorter mean normal may be that of what something around hides
_NEAR = 0.1  # so far a face must see then: a finger gets there
_AROUND = 16  # places on the rim
_BESIDE = 0.12  # of its width, how far beside a cap the ground is felt for
_REACH = 1.0  # of its width, how far down
_UPRIGHT = 0.7  # cosine to the outward direction, of faces that a finger lies on
_FLATTER = 1.3  # how much less a shape spreads along its flattest way than along the next
_SAME_WAY = np.cos(np.deg2rad(35.0))


@dataclass(frozen=True, eq=False)
class Cap:
    """Lengths are shares of the object's diagonal.

    Attributes:
        outward: (3,) unit, where it faces in the aligned frame.
        top: (3,) middle of its rectangle, at its highest.
        wide: larger extent across `outward`.
        narrow: smaller one.
        thick: extent along `outward`.
        facing: length of the mean normal of what is seen: 1 for a plane, 0.5 for a half ball.
        seen: share of its surface that is open to the outside.
        rimmed: share of its rim beside which something else lies, no deeper than it is wide.
        proud: how far its top stands above that, as the median around; infinite without.
        closed: whether its middle is its own, which a ring's is not.
    """

    outward: FloatArray
    top: FloatArray
    wide: float
    narrow: float
    thick: float
    facing: float
    seen: float
    rimmed: float
    proud: float
    closed: bool


def measure_cap(scene: Scene, pieces: Sequence[int]) -> Cap | None:
    """What a finger would meet of some pieces, or None where nothing of them is open to the outside."""
    faces = scene.faces_of(tuple(pieces))
    areas = scene.face_areas[faces]
    normals, seen = _open_normals(scene, faces, None)
    mean = _mean(areas, normals, seen)
    if np.linalg.norm(mean) < _BLUNT:
        # What stands within a ring is hidden from afar, but not from a finger.
        nearer = _open_normals(scene, faces, _NEAR)
        if np.linalg.norm(_mean(areas, *nearer)) > np.linalg.norm(mean):
            (normals, seen), mean = nearer, _mean(areas, *nearer)
    facing = float(np.linalg.norm(mean))
    if facing < 1e-9:
        return None
    outward = mean / facing
    upright = seen & (normals @ outward > _UPRIGHT)
    if upright.any():
        outward = unit(areas[upright] @ normals[upright])
    outward = _flattest(scene, faces, outward)
    points = scene.triangles[faces].reshape(-1, 3)
    across = _across(points, outward)
    flat, heights = points @ across.T, points @ outward
    size, middle = np.ptp(flat, axis=0), (flat.max(axis=0) + flat.min(axis=0)) / 2
    wide, top = float(size.max()), float(heights.max())
    rimmed, proud = _surroundings(scene, pieces, flat, middle, across, outward, top)
    above = middle @ across + (top + wide) * outward
    first, _ = scene.rays.first(above[None], -outward)
    return Cap(
        outward,
        middle @ across + top * outward,
        wide,
        float(size.min()),
        float(np.ptp(heights)),
        facing,
        float(areas[seen].sum() / max(areas.sum(), 1e-30)),
        rimmed,
        proud,
        bool(first[0] >= 0 and np.isin(scene.labels[first[0]], pieces)),
    )


def stacked_on(scene: Scene, piece: int, cap: Cap, used: Set[int]) -> tuple[int, ...]:
    """Pieces on the same axis as a cap and about as wide: its sign above, its stem and its skirt below."""
    found = []
    for other, box in enumerate(scene.boxes):
        if other in used or scene.areas[other] > 3 * scene.areas[piece] or box.size.max() > 1.4 * cap.wide:
            continue
        way = box.center - cap.top
        height = float(way @ cap.outward)
        beside = float(np.linalg.norm(way - height * cap.outward))
        if beside < 0.25 * cap.wide and -cap.wide < height < 0.2 * cap.wide:
            found.append(other)
    return tuple(found)


def _open_normals(scene: Scene, faces: IntArray, reach: float | None) -> tuple[FloatArray, BoolArray]:
    """(N, 3) normals towards the outside, and which faces see it at all; a sheet counts on its front."""
    normals, centers = scene.normals[faces], scene.triangles[faces].mean(axis=1)
    front = ~scene.rays.blocked(centers + _OFF * normals, normals, reach)
    back = ~front & ~scene.rays.blocked(centers - _OFF * normals, -normals, reach)
    return np.where(back[:, None], -normals, normals), np.asarray(front | back)


def _mean(areas: FloatArray, normals: FloatArray, seen: BoolArray) -> FloatArray:
    """(3,) mean normal of what is seen."""
    return np.asarray(areas[seen] @ normals[seen] / max(areas[seen].sum(), 1e-30))


def _flattest(scene: Scene, faces: IntArray, near: FloatArray) -> FloatArray:
    """(3,) the way along which a shape spreads least, if that is about `near`; else `near`.

    Walls beside a cap are seen on one side more than on the other, which turns the mean of what is seen.
    """
    areas, corners = scene.face_areas[faces], scene.triangles[faces]
    corners = corners - areas @ corners.mean(axis=1) / max(areas.sum(), 1e-30)
    # The second moment of a triangle is that of its corners and of three times its middle, by area / 12.
    points = np.concatenate([corners, 3 * corners.mean(axis=1, keepdims=True)], axis=1)
    spreads, ways = np.linalg.eigh(np.einsum("f,fki,fkj->ij", areas, points, points))
    along = float(ways[:, 0] @ near)
    if abs(along) < _SAME_WAY or spreads[1] < _FLATTER * spreads[0]:
        return near
    return np.asarray(ways[:, 0] * np.sign(along))


def _across(points: FloatArray, outward: FloatArray) -> FloatArray:
    """(2, 3) rows that span the plane across, along the longest and the shortest way of the points."""
    plane = np.linalg.svd(outward[None])[2][1:]
    _, turn = np.linalg.eigh(np.cov((points @ plane.T).T))
    return np.asarray(turn.T @ plane)


def _surroundings(
    scene: Scene,
    pieces: Sequence[int],
    flat: FloatArray,
    middle: FloatArray,
    across: FloatArray,
    outward: FloatArray,
    top: float,
) -> tuple[float, float]:
    """Share of places beside the rim with something near below, and how far below the top it is."""
    angles = np.arange(_AROUND) * 2 * np.pi / _AROUND
    ways = np.column_stack([np.cos(angles), np.sin(angles)])
    wide = float(np.ptp(flat, axis=0).max())
    radii = ((flat - middle) @ ways.T).max(axis=0) + _BESIDE * wide
    lift = 0.3 * wide
    origins = (middle + ways * radii[:, None]) @ across + (top + lift) * outward
    face, distance = scene.rays.first(origins, -outward)
    near = (face >= 0) & (distance < lift + _REACH * wide) & ~np.isin(scene.labels[face], pieces)
    drops = np.where(near, distance - lift, np.inf)
    return float(near.mean()), float(np.median(drops))
