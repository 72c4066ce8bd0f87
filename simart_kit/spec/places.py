"""Where parts lie, as seen from the side that they open to: what words such as "left edge" mean there."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ..alignment import yaw
from ..arrays import FloatArray, IntArray
from ..asset import Joint
from ..kinematics import rotation
from ..mesh import Mesh
from ..rays import Rays
from .values import AxisWord

# Sides as rows (u, v, w): u across, v up, w outward; the last opens upward. The first wins a tie.
_FACINGS: dict[str, FloatArray] = {
    "front": np.array([[1.0, 0, 0], [0, 0, 1], [0, -1, 0]]),
    "top": np.array([[1.0, 0, 0], [0, 1, 0], [0, 0, 1]]),
    "left": np.array([[0, -1.0, 0], [0, 0, 1], [-1, 0, 0]]),
    "right": np.array([[0, 1.0, 0], [0, 0, 1], [1, 0, 0]]),
    "back": np.array([[-1.0, 0, 0], [0, 0, 1], [0, 1, 0]]),
}
_WAYS: dict[str, FloatArray] = {
    "front": np.array([0.0, -1, 0]),
    "back": np.array([0.0, 1, 0]),
    "left": np.array([-1.0, 0, 0]),
    "right": np.array([1.0, 0, 0]),
    "up": np.array([0.0, 0, 1]),
    "down": np.array([0.0, 0, -1]),
}
# Which edges of a part that faces some side are its front and back edges.
_ALONG_DEPTH = {
    "front edge": {"top": "bottom", "left": "right", "right": "left"},
    "back edge": {"top": "top", "left": "left", "right": "right"},
}
EDGES = ("left", "right", "bottom", "top")
_SPANNING = 0.7  # what fills this share of every extent is the body
_GRID = 8  # rays along a side of the rectangle that is looked at
_SEEN = 0.5  # of a rectangle, from which on it counts as seen
_THIN = 0.5  # thickness by the next longer side, below which a part is a panel
_LEVEL = 0.05  # of the object's size: what differs less is alike
_NEAR_EDGE = 0.15  # of the part's size: how far from its edge a hinge may lie
_ALONG = np.cos(np.deg2rad(15.0))


@dataclass(frozen=True, eq=False)
class Place:
    """A part among the others.

    Attributes:
        facing: the side that it opens to: "front", "top", "left", "right" or "back".
        axes: (3, 3) rows u across, v up and w outward, as seen from that side, in the asset frame.
        turn: (3, 3) from the asset frame to that of the object's own faces, about the vertical.
        box: (2, 3) lower and upper corner in (u, v, w) [m].
        whole: (2, 3) the same of the object.
        outer: the outer ones of its "left" and "right" edge; both where none is farther out.
    """

    facing: str
    axes: FloatArray
    turn: FloatArray
    box: FloatArray
    whole: FloatArray
    outer: tuple[str, ...] = ("left", "right")

    @property
    def size(self) -> FloatArray:
        """(3,) extents in (u, v, w) [m]."""
        return np.asarray(self.box[1] - self.box[0])

    @property
    def center(self) -> FloatArray:
        """(3,) middle in the asset frame [m]."""
        return np.asarray(self.box.mean(axis=0) @ self.axes)

    def edges(self, word: AxisWord) -> tuple[str, ...]:
        """The edges of `EDGES` that a word means; none where it means no edge, or the part has no such."""
        if word == "outer edge":
            return self.outer
        if word == "inner edge":
            return tuple(edge for edge in ("left", "right") if edge not in self.outer) or self.outer
        if word in _ALONG_DEPTH:
            edge = _ALONG_DEPTH[word].get(self.facing)
            return (edge,) if edge else ()
        edge = word.removesuffix(" edge")
        return (edge,) if word != edge else ()

    def line(self, edge: str) -> tuple[FloatArray, FloatArray]:
        """Of a hinge along an edge, (3,) unit axis, about which positive opens, and (3,) point [m]."""
        u, v, w = self.box.mean(axis=0)
        axis, point = {
            "left": ((0.0, -1.0, 0.0), (self.box[0, 0], v, w)),
            "right": ((0.0, 1.0, 0.0), (self.box[1, 0], v, w)),
            "bottom": ((1.0, 0.0, 0.0), (u, self.box[0, 1], w)),
            "top": ((-1.0, 0.0, 0.0), (u, self.box[1, 1], w)),
        }[edge]
        return np.array(axis) @ self.axes, np.array(point) @ self.axes

    def way(self, word: AxisWord) -> FloatArray | None:
        """(3,) unit direction that a word means; None where it means several."""
        return np.asarray(_WAYS[word] @ self.turn) if word in _WAYS else None


def fits(joint: Joint, word: AxisWord, place: Place) -> bool:
    """Whether the axis of a joint lies as a word says; where a slide goes, its sense counts too."""
    if joint.kind in ("fixed", "ball", "free"):
        return False
    axis = np.array(joint.axis)
    if word.endswith("edge"):
        return joint.turns and any(_on_edge(joint, edge, place) for edge in place.edges(word))
    if word in ("vertical", "horizontal"):
        upright = abs(axis[2])
        return bool(upright > _ALONG if word == "vertical" else upright < np.sqrt(1 - _ALONG**2))
    along = float(axis @ (_WAYS[word] @ place.turn))
    return bool((abs(along) if joint.turns else along) > _ALONG)


def part_places(mesh: Mesh, face_part: IntArray, labels: Sequence[str]) -> tuple[Place, ...]:
    """The place of each part of (F,) `face_part`; of parts with one label, neighbours tell the outer edge."""
    turn = rotation(np.array([0.0, 0.0, -yaw(mesh)]))
    corners = mesh.triangles @ turn.T
    whole = _box(corners)
    boxes = [_box(corners[face_part == index]) for index in range(len(labels))]
    looks = _Looks(corners, face_part)
    places = [_place(box, whole, turn, index, looks) for index, box in enumerate(boxes)]
    return tuple(
        _with_outer(place, [p for p, other in zip(places, labels, strict=True) if other == label])
        for place, label in zip(places, labels, strict=True)
    )


def _box(corners: FloatArray) -> FloatArray:
    points = corners.reshape(-1, 3)
    return np.array([points.min(axis=0), points.max(axis=0)])


class _Looks:
    """How much of parts is seen from each side; the surface is made ready for rays when first needed."""

    def __init__(self, corners: FloatArray, face_part: IntArray) -> None:
        self._corners, self._part = corners, face_part

    @cached_property
    def _rays(self) -> Rays:
        return Rays(self._corners.reshape(-1, 3), np.arange(3 * len(self._corners)).reshape(-1, 3))

    def rank(self, part: int, box: FloatArray, whole: FloatArray, facing: str) -> tuple[bool, int, float]:
        """How well a part shows from a side: whether most of it does, how far out it lies, and its area."""
        axes = _FACINGS[facing]
        near, far = _turned(box, axes), _turned(whole, axes)
        outside = far[1, 2]
        steps = (np.arange(_GRID) + 0.5) / _GRID
        u, v = (near[0, k] + steps * (near[1, k] - near[0, k]) for k in (0, 1))
        grid = np.stack([*map(np.ravel, np.meshgrid(u, v)), np.full(_GRID**2, outside + 1.0)], axis=1)
        faces, _ = self._rays.first(grid @ axes, -axes[2])
        share = float(((faces >= 0) & (self._part[faces] == part)).mean())
        behind = round((outside - near[1, 2]) / max(outside - far[0, 2], 1e-9) / _LEVEL)
        return share >= _SEEN, -behind, share * float(np.prod(near[1, :2] - near[0, :2]))


def _place(box: FloatArray, whole: FloatArray, turn: FloatArray, part: int, looks: _Looks) -> Place:
    facing = _facing(box, whole, part, looks)
    axes = _FACINGS[facing]
    return Place(facing, axes @ turn, turn, _turned(box, axes), _turned(whole, axes))


def _facing(box: FloatArray, whole: FloatArray, part: int, looks: _Looks) -> str:
    """Of an upright panel, the outer one of its two sides; of all else, the one that it shows on."""
    size = box[1] - box[0]
    if (size >= _SPANNING * (whole[1] - whole[0])).all():
        return "front"
    order = np.argsort(size)
    # What is low and wide may be a lid, or a drawer with its box.
    if order[0] == 2 or size[order[0]] >= _THIN * size[order[1]]:
        return max(_FACINGS, key=lambda facing: looks.rank(part, box, whole, facing))
    low, high = ("left", "right") if order[0] == 0 else ("front", "back")
    middle = whole[:, order[0]].mean()
    beyond = (box[:, order[0]].mean() - middle) / max(float(np.ptp(whole[:, order[0]])), 1e-9)
    return high if beyond > (0.0 if order[0] == 0 else _LEVEL) else low


def _turned(box: FloatArray, axes: FloatArray) -> FloatArray:
    """A box along the axes of a facing (a signed permutation)."""
    corners = box @ axes.T
    return np.array([corners.min(axis=0), corners.max(axis=0)])


def _with_outer(place: Place, kin: Sequence[Place]) -> Place:
    """The outer edge is away from the one neighbour of its kind; else the one nearer the object's edge."""
    beside = [other for other in kin if other is not place and _in_row(place, other)]
    sides = {"left" if o.box[:, 0].mean() < place.box[:, 0].mean() else "right" for o in beside}
    if len(sides) == 1:
        outer: tuple[str, ...] = ("right",) if "left" in sides else ("left",)
    else:
        gaps = np.abs(place.box[:, 0] - place.whole[:, 0])
        level = abs(gaps[0] - gaps[1]) < _LEVEL * (place.whole[1, 0] - place.whole[0, 0])
        outer = ("left", "right") if level else (("left",) if gaps[0] < gaps[1] else ("right",))
    return Place(place.facing, place.axes, place.turn, place.box, place.whole, outer)


def _in_row(one: Place, other: Place) -> bool:
    if one.facing != other.facing:
        return False
    both = min(one.box[1, 1], other.box[1, 1]) - max(one.box[0, 1], other.box[0, 1])
    return bool(both > 0.5 * min(one.size[1], other.size[1]))


def _on_edge(joint: Joint, edge: str, place: Place) -> bool:
    axis, point = place.line(edge)
    if abs(float(np.array(joint.axis) @ axis)) < _ALONG:
        return False
    across = 0 if edge in ("left", "right") else 1
    off = place.axes[across] @ (np.array(joint.origin) - point)
    return bool(abs(off) <= _NEAR_EDGE * place.size[across])
