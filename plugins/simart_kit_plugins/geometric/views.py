"""A part as it is seen from the side that it opens to: where its front lies, and what sticks out of it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from simart_kit.arrays import FloatArray, IntArray
from simart_kit.topology import connected, neighbours, weld
from simart_kit.triangles import areas

from .scene import FACINGS, Box, Scene

_STICKS_OUT = 0.006  # of the diagonal: flatter ornament is not a handle
_SAME = 1e-6  # diagonals within which corners are at one place
_CRUMB = 0.1  # of the largest thing that sticks out: what is smaller is no handle


@dataclass(frozen=True, eq=False)
class View:
    """One part and the body, in (u, v, w) of a facing; lengths are shares of the object's diagonal.

    Attributes:
        part: its id.
        facing: key of `FACINGS`.
        box: of the part without what sticks out of its front.
        handle: of what sticks out of the front, or None.
        foot: (2,) where that stands on the front [u, v]; without any, the middle of the front.
        body: bounding box of everything.
        ajar: angle of the front against the facing, about v, right-handed [rad].
    """

    part: int
    facing: str
    box: Box
    handle: Box | None
    foot: FloatArray
    body: Box
    ajar: float

    @property
    def axes(self) -> FloatArray:
        """(3, 3) rows u, v, w in the aligned frame."""
        return FACINGS[self.facing]

    @property
    def handle_place(self) -> tuple[float, float]:
        """Foot of the handle on the front, -1..1 across and up; (0, 0) without a handle."""
        u, v = 2 * (self.foot - self.box.center[:2]) / np.maximum(self.box.size[:2], 1e-9)
        return float(u), float(v)

    @property
    def is_box(self) -> bool:
        """Whether it reaches as far back as a drawer does."""
        depth = self.box.size[2] - abs(np.sin(self.ajar)) * self.box.size[0]
        return bool(depth > 0.3 * self.body.size[2] and depth > 0.3 * self.box.size[:2].min())


def view_part(scene: Scene, part: int, sides: Sequence[str] = tuple(FACINGS)) -> View:
    """See a part from that of some sides where most of it shows."""
    faces = scene.faces_of((part,))
    facing = sides[0]
    if len(sides) > 1:
        facing = max(sides, key=lambda name: shown(scene, FACINGS[name], part))
    axes = FACINGS[facing]
    corners = scene.triangles[faces] @ axes.T
    front, ajar = _front_plane(scene, axes, faces, corners)
    whole = Box(corners.min(axis=(0, 1)), corners.max(axis=(0, 1)))
    box, handle = whole, None
    if whole.upper[2] - front > _STICKS_OUT:
        out = corners[(corners[:, :, 2] > front + 0.3 * (whole.upper[2] - front)).all(axis=1)]
        out = _without_crumbs(out).reshape(-1, 3) if len(out) else out
        if len(out) and np.prod(np.ptp(out[:, :2], axis=0)) < 0.4 * np.prod(whole.size[:2]):
            handle = Box(out.min(axis=0), out.max(axis=0))
            box = Box(whole.lower, np.array([whole.upper[0], whole.upper[1], front]))
    box = _without_back_handle(corners, box)
    foot = box.center[:2] if handle is None else _foot(corners, front, handle)
    return View(part, facing, box, handle, foot, scene.box.turned(axes), ajar)


def _without_crumbs(corners: FloatArray) -> FloatArray:
    """The (F, 3, 3) triangles without crumbs: at the ragged border of a skin's part some stick out."""
    _, one, two = neighbours(weld(corners.reshape(-1, 3), _SAME).reshape(-1, 3))
    group = connected(len(corners), one, two)
    area = np.bincount(group, areas(corners))[group]
    return np.asarray(corners[area >= _CRUMB * area.max()])


def _without_back_handle(corners: FloatArray, box: Box) -> Box:
    """The box of a thin panel, without a small thing that sticks out of its back: a door's other handle."""
    heights = corners[..., 2]
    flat = np.ptp(heights, axis=1) < 1e-4
    spread = np.prod(np.ptp(corners[..., :2], axis=1), axis=1)
    low = heights[flat & (spread > 0.1 * np.prod(box.size[:2]))]
    if not len(low) or low.min() - box.lower[2] < _STICKS_OUT:
        return box
    back = float(low.min())
    out = corners[(heights < back - 0.3 * (back - box.lower[2])).all(axis=1)].reshape(-1, 3)
    thin = box.upper[2] - back < 0.3 * box.size[:2].min()
    if not thin or not len(out) or np.prod(np.ptp(out[:, :2], axis=0)) > 0.15 * np.prod(box.size[:2]):
        return box
    return Box(np.array([*box.lower[:2], back]), box.upper)


def _foot(corners: FloatArray, front: float, handle: Box) -> FloatArray:
    """(2,) middle of the cut through a handle close to its front: a lever reaches far from its stem."""
    level = front + 0.2 * (handle.upper[2] - front)
    within = ((corners[..., :2] >= handle.lower[:2]) & (corners[..., :2] <= handle.upper[:2])).all(
        axis=(1, 2)
    )
    middle = cut(corners[within], level)
    return handle.center[:2] if middle is None else middle


def cut(corners: FloatArray, level: float) -> FloatArray | None:
    """(2,) middle of where (F, 3, 3) triangles cross a height in the third coordinate; None where none do."""
    starts, ends = corners.reshape(-1, 3), np.roll(corners, -1, axis=1).reshape(-1, 3)
    crossing = (starts[:, 2] - level) * (ends[:, 2] - level) < 0
    if not crossing.any():
        return None
    starts, ends = starts[crossing], ends[crossing]
    share = ((level - starts[:, 2]) / (ends - starts)[:, 2])[:, None]
    points = (starts + share * (ends - starts))[:, :2]
    return np.asarray((points.min(axis=0) + points.max(axis=0)) / 2)


def shown(scene: Scene, axes: FloatArray, part: int) -> float:
    """Area of a part's rectangle that is seen from outside."""
    box = scene.boxes[part].turned(axes)
    steps = (np.arange(8) + 0.5) / 8
    u, v = np.meshgrid(box.lower[0] + steps * box.size[0], box.lower[1] + steps * box.size[1])
    outside = scene.box.turned(axes).upper[2] + 1.0
    origins = np.column_stack([u.ravel(), v.ravel(), np.full(u.size, outside)])
    faces, _ = scene.rays.first(origins @ axes, np.array([0.0, 0.0, -1.0]) @ axes)
    seen = (faces >= 0) & (scene.labels[faces] == part)
    return float(seen.mean() * np.prod(box.size[:2]))


def _front_plane(scene: Scene, axes: FloatArray, faces: IntArray, corners: FloatArray) -> tuple[float, float]:
    """Where most of the outward surface lies [w], and how far it is turned about v [rad]."""
    normals = scene.normals[faces] @ axes.T
    outward = np.flatnonzero(normals[:, 2] > 0.8)
    if not len(outward):
        return float(corners[:, :, 2].max()), 0.0
    areas = scene.face_areas[faces][outward]
    normal = areas @ normals[outward]
    ajar = float(np.arctan2(normal[0], normal[2]))
    heights = corners[outward].max(axis=1)[:, 2]
    edges = np.linspace(heights.min(), heights.max() + 1e-9, 33)
    histogram, _ = np.histogram(heights, bins=edges, weights=areas)
    # The outermost level with a fair share: ornament on a panel must not hide the panel.
    fair = np.flatnonzero(histogram >= 0.3 * histogram.max())
    return float(edges[fair[-1] + 1]), ajar
