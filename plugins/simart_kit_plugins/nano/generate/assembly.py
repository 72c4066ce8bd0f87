"""Moving things before they are on an object, and the putting together."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import ArrayLike

from simart_kit.arrays import FloatArray

from ...shapes.dice import Dice
from ...shapes.primitives import Pieces
from .objects import Body, Look, Motion, Surface, surface


@dataclass(frozen=True, eq=False)
class Leaf:
    """Something that moves, with what moves on it.

    Attributes:
        name: in snake case; made unique on its object.
        label: what it is, in plain words.
        surfaces: in the frame of the object.
        motion: against what it hangs on.
        children: what hangs on it, such as a handle that turns.
    """

    name: str
    label: str
    surfaces: tuple[Surface, ...]
    motion: Motion
    children: tuple[Leaf, ...] = field(default=())

    def moved(self, offset: ArrayLike) -> Leaf:
        """Shifted by (3,)."""
        return self._placed(np.eye(3), np.asarray(offset, dtype=np.float64))

    def turned(self, matrix: FloatArray, about: ArrayLike = (0.0, 0.0, 0.0)) -> Leaf:
        """Turned by a (3, 3) rotation about a point."""
        center = np.asarray(about, dtype=np.float64)
        return self._placed(matrix, center - matrix @ center)

    def with_children(self, *children: Leaf) -> Leaf:
        """With more things on it."""
        return replace(self, children=self.children + children)

    def _placed(self, matrix: FloatArray, step: FloatArray) -> Leaf:
        return Leaf(
            self.name,
            self.label,
            tuple(one.placed(matrix, step) for one in self.surfaces),
            self.motion.placed(matrix, step),
            tuple(child._placed(matrix, step) for child in self.children),
        )


class Assembly:
    """An object while it is put together.

    Args:
        label: of its root.
    """

    def __init__(self, label: str = "body") -> None:
        self._label = label
        self._fixed: dict[Look, list[FloatArray]] = {}
        self._bodies: list[Body] = []

    def fix(self, pieces: Pieces, look: Look) -> None:
        """Make pieces part of the root."""
        if pieces:
            self._fixed.setdefault(look, []).extend(pieces)

    def dress(self, *surfaces: Surface) -> None:
        """Make surfaces part of the root."""
        for one in surfaces:
            self.fix([one.triangles], one.look)

    def fix_leaf(self, leaf: Leaf) -> None:
        """Make what looks as if it moved part of the root."""
        self.dress(*leaf.surfaces)
        for child in leaf.children:
            self.fix_leaf(child)

    def add(self, leaf: Leaf, parent: int = 0) -> int:
        """Hang a leaf and its children on a body; the number of the leaf's."""
        taken = {body.name for body in self._bodies} | {self._label}
        name, count = leaf.name, 1
        while name in taken:
            count += 1
            name = f"{leaf.name}_{count}"
        self._bodies.append(Body(name, leaf.label, leaf.surfaces, parent, leaf.motion))
        number = len(self._bodies)
        for child in leaf.children:
            self.add(child, number)
        return number

    def bodies(self) -> Sequence[Body]:
        """The root and all that moves, shifted to stand on z = 0."""
        looks = tuple(surface(pieces, look) for look, pieces in self._fixed.items())
        made = [Body(self._label, self._label.replace("_", " "), looks), *self._bodies]
        lowest = min(float(one.triangles[..., 2].min()) for body in made for one in body.surfaces)
        return [body.placed(np.eye(3), np.array([0.0, 0.0, -lowest])) for body in made]


def until_moving(maker: Callable[[Dice], Sequence[Body]]) -> Callable[[Dice], Sequence[Body]]:
    """A maker whose objects have something that moves: it is asked again until one has."""

    def make(dice: Dice) -> Sequence[Body]:
        made = maker(dice)
        while len(made) < 2:
            made = maker(dice)
        return made

    return make
