"""Where parts of one kind lie against each other: the upper one, the second from the left, the big one."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from .arrays import BoolArray, FloatArray
from .mesh import Mesh
from .part_words import name_words
from .stages import PartGuess

# Axis and sign of each side in the canonical frame: left is -x, front is -y, up is +z.
_TOWARDS = {
    "left": (0, -1.0),
    "right": (0, 1.0),
    "front": (1, -1.0),
    "back": (1, 1.0),
    "lower": (2, -1.0),
    "upper": (2, 1.0),
}
_APART = 0.02  # of the object's size: centres nearer than this lie level
_UNTOLD, _OPPOSITE = 0.7, 0.31
_ROW = 0.05  # of the object's size: parts whose tops differ less stand in one row


@dataclass(frozen=True, eq=False)
class NamedPart:
    """What is known of a part that a description may mean.

    Attributes:
        name: unique.
        label: what kind of thing it is, or "".
        description: for people, or "".
        material: key of the material table.
        box: (2, 3) lower and upper corner in the canonical frame [m].
        whole: (2, 3) the same of the object.
        area: of its surface [m2].
    """

    name: str
    label: str
    description: str
    material: str
    box: FloatArray
    whole: FloatArray
    area: float

    @property
    def center(self) -> FloatArray:
        """(3,) middle of its box [m]."""
        return np.asarray(self.box.mean(axis=0))

    def gap(self, other: NamedPart) -> float:
        """Distance between both boxes [m]."""
        apart = np.maximum(self.box[0] - other.box[1], other.box[0] - self.box[1])
        return float(np.linalg.norm(np.maximum(apart, 0.0)))


def named_part(mesh: Mesh, faces: BoolArray, guess: PartGuess) -> NamedPart:
    """A part by the (F,) faces of a mesh that it has, and by what a segmenter said of it."""
    corners = mesh.triangles[faces].reshape(-1, 3)
    box = np.array([corners.min(axis=0), corners.max(axis=0)])
    area = float(mesh.face_areas[faces].sum())
    return NamedPart(guess.name, guess.label, guess.description, guess.material, box, mesh.bounds, area)


def side_fit(kind: Sequence[NamedPart], side: str) -> FloatArray:
    """(K,) 0..1: how far towards a side each part lies among those of its kind.

    Where names of this kind claim the side, they are believed: who gave them may know the object's own left.
    """
    claims = np.array([side in name_words(part.name)[1] for part in kind])
    if claims.any():
        return np.where(claims, 1.0, _OPPOSITE)
    centers, size = np.array([part.center for part in kind]), kind[0].whole[1] - kind[0].whole[0]
    if side == "middle":
        return _middle_fit(centers)
    axis, sign = _TOWARDS[side]
    along = sign * centers[:, axis]
    if len(kind) == 1:
        off = along[0] - sign * kind[0].whole[:, axis].mean()
        return np.array([1.0 if off > -_APART * size[axis] else _OPPOSITE])
    spread = along.max() - along.min()
    if spread < _APART * size[axis]:
        return np.full(len(kind), _UNTOLD)
    return np.asarray((along - along.min()) / spread)


def size_fit(kind: Sequence[NamedPart], size: int) -> FloatArray:
    """(K,) 0..1: how big (`size` 1) or small (-1) each part is among those of its kind, by area."""
    areas = size * np.array([part.area for part in kind])
    spread = areas.max() - areas.min()
    if spread < _APART * np.abs(areas).max():
        return np.full(len(kind), 1.0 if len(kind) == 1 else _UNTOLD)
    return np.asarray((areas - areas.min()) / spread)


def levels(kind: Sequence[NamedPart], side: str) -> list[list[int]]:
    """The parts counted from a side, those that lie level together.

    Without a side each by itself in reading order, row by row from top left.
    """
    centers, size = np.array([part.center for part in kind]), kind[0].whole[1] - kind[0].whole[0]
    if side not in _TOWARDS:
        row = _ROW * float(size.max())
        return [
            [i] for i in sorted(range(len(kind)), key=lambda i: (-round(centers[i, 2] / row), *centers[i]))
        ]
    axis, sign = _TOWARDS[side]
    along = -sign * centers[:, axis]
    found: list[list[int]] = []
    for index in np.argsort(along, kind="stable").tolist():
        if found and along[index] - along[found[-1][0]] < _APART * size[axis]:
            found[-1].append(index)
        else:
            found.append([index])
    return found


def _middle_fit(centers: FloatArray) -> FloatArray:
    """(K,) how near the middle of their row parts lie."""
    axis = int(np.argmax(np.ptp(centers, axis=0)))
    spread = float(np.ptp(centers[:, axis]))
    if spread == 0.0:
        return np.ones(len(centers))
    middle = (centers[:, axis].max() + centers[:, axis].min()) / 2
    return np.asarray(1.0 - np.abs(centers[:, axis] - middle) / (spread / 2))
