"""Putting bodies together one by one, and the pieces that fixtures share."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from simart_kit.arrays import FloatArray, frozen_floats

from ...shapes.dice import Dice
from ...shapes.handles import handle, knob
from ...shapes.placing import Y, at, moved, pointed, rotation, turned
from ...shapes.primitives import Pieces, box, cylinder, open_box, rod, tube
from .objects import Body, Look, Motion, Surface, hinge, slide, surface

PAD = 0.0006
"""Thickness of a button that is only printed on: one that can be pressed stands out [m]."""

Parts = Sequence[tuple[Pieces, Look]]
"""Pieces with what they are made of; those without any piece are left out."""


@dataclass
class _Draft:
    name: str
    label: str
    surfaces: list[Surface]
    parent: int
    motion: Motion | None


class Assembly:
    """An object in the making: a root, and bodies on it by number.

    Args:
        label: of the root.
    """

    def __init__(self, label: str = "body") -> None:
        self._drafts = [_Draft(label.replace(" ", "_"), label, [], -1, None)]

    @property
    def count(self) -> int:
        """Bodies so far, the root included."""
        return len(self._drafts)

    def points(self, number: int) -> FloatArray:
        """(N, 3) corners of a body."""
        return np.concatenate([one.triangles.reshape(-1, 3) for one in self._drafts[number].surfaces])

    def fix(self, pieces: Pieces, look: Look, to: int = 0) -> None:
        """Adds pieces to a body, the root unless told."""
        if pieces:
            self._drafts[to].surfaces.append(surface(pieces, look))

    def add(self, label: str, motion: Motion, parts: Parts, parent: int = 0, name: str = "") -> int:
        """A body; gives its number. Its name is the label's, numbered, unless given."""
        surfaces = [surface(pieces, look) for pieces, look in parts if pieces]
        self._drafts.append(_Draft(self._unused(name or label), label, surfaces, parent, motion))
        return len(self._drafts) - 1

    def graft(
        self, other: Assembly, offset: ArrayLike = (0, 0, 0), turn: FloatArray | None = None, parent: int = 0
    ) -> None:
        """Adds all of another one, turned by (3, 3) and shifted; its root becomes part of `parent`."""
        matrix, step = np.eye(3) if turn is None else turn, np.asarray(offset, dtype=np.float64)
        first = len(self._drafts)
        for number, draft in enumerate(other._drafts):
            surfaces = [_placed(one, matrix, step) for one in draft.surfaces]
            if number == 0:
                self._drafts[parent].surfaces += surfaces
                continue
            assert draft.motion is not None
            above = first + draft.parent - 1 if draft.parent else parent
            motion = draft.motion.placed(matrix, step)
            self._drafts.append(_Draft(self._unused(draft.name), draft.label, surfaces, above, motion))

    def done(self, turn: FloatArray | None = None) -> list[Body]:
        """The bodies, turned by a (3, 3), standing on z = 0."""
        whole = self
        if turn is not None:
            whole = Assembly(self._drafts[0].label)
            whole.graft(self, turn=turn)
        low = min(one.triangles[..., 2].min() for draft in whole._drafts for one in draft.surfaces)
        level, still = np.array([0, 0, -low]), np.eye(3)
        return [
            Body(
                draft.name,
                draft.label,
                tuple(_placed(one, still, level) for one in draft.surfaces),
                draft.parent,
                draft.motion and draft.motion.placed(still, level),
            )
            for draft in whole._drafts
        ]

    def _unused(self, name: str) -> str:
        name, taken = name.replace(" ", "_"), {draft.name for draft in self._drafts}
        stem = name.rstrip("0123456789").rstrip("_")
        number = 2
        while name in taken:
            name, number = f"{stem}_{number}", number + 1
        return name


def _placed(one: Surface, matrix: FloatArray, step: FloatArray) -> Surface:
    there = one.placed(matrix, step)
    if np.linalg.det(matrix) < 0:  # faces keep their outer side
        return Surface(frozen_floats(there.triangles[:, ::-1]), there.look)
    return there


def scaled(bodies: Sequence[Body], scale: float) -> list[Body]:
    """The bodies as many times as large, about 0."""
    return [body.placed(scale * np.eye(3), np.zeros(3)) for body in bodies]


def swing(side: int, x: float, y: float, upper: float, z: float = 0.0) -> Motion:
    """An upright hinge of a leaf that opens to -y: at its left edge (-1) or its right (1)."""
    return hinge((x, y, z), (0, 0, side), upper)


def fall(y: float, z: float, upper: float) -> Motion:
    """A level hinge at the bottom edge of a leaf that opens to -y."""
    return hinge((0, y, z), (1, 0, 0), upper)


def lift(y: float, z: float, upper: float) -> Motion:
    """A level hinge at the back edge of a lid, or at the top edge of a flap, that opens to -y and up."""
    return hinge((0, y, z), (-1, 0, 0), upper)


def pull(upper: float) -> Motion:
    """A slide towards -y."""
    return slide((0, -1, 0), upper)


def press(upper: float) -> Motion:
    """A slide towards y."""
    return slide((0, 1, 0), upper)


def shell(width: float, depth: float, height: float, wall: float) -> FloatArray:
    """An open box that stands on z = 0, its mouth at y = -depth / 2."""
    turn = rotation((1, 0, 0), np.pi / 2)
    return turned([open_box((width, height, depth), wall)], turn)[0] + [0, depth / 2, height / 2]


def rack(dice: Dice, width: float, depth: float, height: float) -> Pieces:
    """A grate of wires, or a basket where it has a height, its floor at z = 0."""
    wire = min(width, depth) * dice.between(0.008, 0.02)
    along = np.linspace(-width / 2, width / 2, dice.whole(6, 14))
    across = np.linspace(-depth / 2, depth / 2, dice.whole(3, 6))
    pieces = at(box((wire, depth, wire)), [(x, 0, 0) for x in along])
    pieces += at(box((width, wire, wire)), [(0, y, 0) for y in across])
    if height > 0:
        edge = [(x, y, height / 2) for x in along[::2] for y in across[[0, -1]]]
        edge += [(x, y, height / 2) for x in along[[0, -1]] for y in across[1:-1]]
        pieces += at(box((wire, wire, height)), edge)
        pieces += at(box((width, wire, wire)), [(0, s * depth / 2, height) for s in (-1, 1)])
        pieces += at(box((wire, depth, wire)), [(s * width / 2, 0, height) for s in (-1, 1)])
        if dice.chance(0.6):
            tine = height * dice.between(0.4, 0.9)
            pieces += at(
                box((wire, wire, tine)), [(x, y, tine / 2) for x in along[1:-1] for y in across[1:-1]]
            )
    return pieces


def disc(radius: float, thick: float, sides: int = 18) -> FloatArray:
    """A flat cylinder about y, from y = 0 to y = -thick."""
    return pointed(cylinder(radius, thick, sides), Y) - [0, thick / 2, 0]


def dial(dice: Dice, radius: float) -> Pieces:
    """A knob before y = 0, mostly with a grip or a pointer that shows how it is turned."""
    if dice.chance(0.35):
        thick = radius * dice.between(0.3, 0.6)
        grip = box((radius * 0.4, radius * dice.between(0.5, 1.0), radius * 2), (0, -thick, 0))
        return [disc(radius, thick, 16), grip]
    pieces = knob(dice, radius)
    front = min(piece[..., 1].min() for piece in pieces)
    if dice.chance(0.6):
        pieces.append(box((radius * 0.15, radius * 0.1, radius * 0.4), (0, front, radius * 0.45)))
    return pieces


def turning(dice: Dice, origin: ArrayLike, axis: ArrayLike = (0, 1, 0)) -> Motion:
    """What a dial does: it turns between stops."""
    upper = dice.pick((1.57, 2.4, 3.14, 4.7, 5.2))
    if dice.chance(0.2):
        return hinge(origin, axis, upper / 2, -upper / 2)
    return hinge(origin, axis, upper)


def lever(dice: Dice, reach: float, radius: float) -> Pieces:
    """A door lever on the plane y = 0, turning about y through 0 and pointing to x."""
    off = dice.between(0.035, 0.06)
    style = dice.unit()
    neck = rod((0, 0, 0), (0, -off, 0), radius, 10)
    if style < 0.45:
        return [neck, rod((-radius, -off, 0), (reach, -off, 0), radius, 10)]
    if style < 0.8:
        size = (reach + radius, radius, radius * dice.between(1.5, 3.0))
        return [neck, box(size, (reach / 2 - radius / 2, -off, 0))]
    tip = rod((reach, -off, 0), (reach, -off * 0.3, 0), radius * 0.9, 10)
    return [neck, rod((0, -off, 0), (reach, -off, 0), radius * 0.9, 10), tip]


def rosette(dice: Dice, high: float) -> Pieces:
    """A round or long plate before y = 0, `high` to both sides of 0 at most."""
    if dice.chance(0.5):
        return [disc(dice.between(0.022, 0.03), 0.008)]
    wide = dice.between(0.035, 0.06)
    return moved([box((wide, 0.006, 2 * high))], (0, -0.003, 0))


def holder(dice: Dice, length: float, upright: bool = False) -> Pieces:
    """A handle along x, or z, before y = 0: as thick and as far off as a hand needs, however long it is."""
    if length < 0.16 or dice.chance(0.1):
        return handle(dice, min(length, 0.2), upright)
    thick, off = dice.between(0.008, 0.024), dice.between(0.025, 0.055)
    reach = length / 2 - thick * dice.pick((0.5, 0.5, 2.0, 4.0))
    style = dice.unit()
    if style < 0.4:
        grip = [box((length, thick * dice.pick((0.5, 1.0)), thick * dice.between(1.0, 1.8)), (0, -off, 0))]
    elif style < 0.75:
        grip = [rod((-length / 2, -off, 0), (length / 2, -off, 0), thick / 2, 10)]
    else:
        along = np.linspace(-1, 1, 9)
        arch = -off * (1 - np.abs(along) ** dice.between(2, 8))
        grip = [tube(np.column_stack([along * length / 2, arch, 0 * along]), thick / 2, 8)]
        reach = 0.0
    if reach:
        posts = [(s * reach, -off / 2, 0) for s in (-1, 1)]
        grip += at(box((thick * 0.9, off, thick * 0.9)), posts)
    return turned(grip, rotation((0, 1, 0), np.pi / 2)) if upright else grip
