"""What a generated object is: bodies made of surfaces, and how they move.

Frame: right-handed, x left -> right, y front -> back, z up; objects face -y and stand on z = 0 [m].
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike

from simart_kit.arrays import FloatArray, frozen_floats, unit
from simart_kit.asset import JointKind
from simart_kit.triangles import areas

from ...shapes.primitives import Pieces


@dataclass(frozen=True)
class Look:
    """What a surface is made of.

    Attributes:
        material: key of the material table.
        color: (r, g, b) sRGB, 0..255.
    """

    material: str
    color: tuple[int, int, int]


@dataclass(frozen=True, eq=False)
class Surface:
    """Triangles of one look.

    Attributes:
        triangles: (F, 3, 3) [m].
        look: of all of them.
    """

    triangles: FloatArray
    look: Look

    def placed(self, matrix: FloatArray, offset: FloatArray) -> Surface:
        """After x -> matrix x + offset."""
        return Surface(frozen_floats(self.triangles @ matrix.T + offset), self.look)


@dataclass(frozen=True, eq=False)
class Motion:
    """How a body moves against its parent, in the object's frame and from the pose it is modelled in.

    Attributes:
        kind: revolute, continuous, prismatic, ball or free.
        axis: (3,) unit; of no meaning for ball and free.
        origin: (3,) a point on the axis [m]; of no meaning for prismatic and free.
        lower, upper: limits [rad | m], lower <= 0 <= upper; 0 where the kind has none.
    """

    kind: JointKind
    axis: FloatArray
    origin: FloatArray
    lower: float = 0.0
    upper: float = 0.0

    def placed(self, matrix: FloatArray, offset: FloatArray) -> Motion:
        """After x -> matrix x + offset; slides grow with it, and a mirror turns the sense of turns round."""
        along = matrix @ self.axis
        slides = self.kind == "prismatic"
        length = float(np.linalg.norm(along)) if slides else 1.0
        sense = 1.0 if slides else float(np.sign(np.linalg.det(matrix)))
        return Motion(
            self.kind,
            frozen_floats(unit(sense * along)),
            frozen_floats(matrix @ self.origin + offset),
            self.lower * length,
            self.upper * length,
        )


@dataclass(frozen=True, eq=False)
class Body:
    """Surfaces that move as one.

    Attributes:
        name: in snake case, such as "left_door"; unique in its object.
        label: what it is, such as "door".
        surfaces: at least one, with at least one triangle.
        parent: number of the body it hangs on, lower than its own; -1 for the root, which is the first.
        motion: None for the root.
    """

    name: str
    label: str
    surfaces: tuple[Surface, ...]
    parent: int = -1
    motion: Motion | None = None

    @property
    def triangles(self) -> FloatArray:
        """(F, 3, 3) of all surfaces [m]."""
        return np.concatenate([surface.triangles for surface in self.surfaces])

    @property
    def material(self) -> str:
        """Key of the material table of what most of its surface is of."""
        of_each: dict[str, float] = {}
        for one in self.surfaces:
            stuff = one.look.material
            of_each[stuff] = of_each.get(stuff, 0.0) + float(areas(one.triangles).sum())
        return max(of_each, key=lambda stuff: of_each[stuff])

    def placed(self, matrix: FloatArray, offset: FloatArray) -> Body:
        """After x -> matrix x + offset."""
        shapes = tuple(one.placed(matrix, offset) for one in self.surfaces)
        motion = None if self.motion is None else self.motion.placed(matrix, offset)
        return replace(self, surfaces=shapes, motion=motion)


@dataclass(frozen=True, eq=False)
class GeneratedObject:
    """An object in the pose its motions count from.

    Attributes:
        category: such as "cabinet".
        bodies: the root first, parents before their children.
    """

    category: str
    bodies: tuple[Body, ...]


def surface(pieces: Pieces, look: Look) -> Surface:
    """Pieces of one look."""
    return Surface(frozen_floats(np.concatenate(pieces)), look)


def root(surfaces: Sequence[Surface], label: str = "body") -> Body:
    """The body that all others hang on."""
    return Body(label, label, tuple(surfaces))


def hinge(origin: ArrayLike, axis: ArrayLike, upper: float, lower: float = 0.0) -> Motion:
    """Turns about a line, right-handed, between limits [rad]."""
    return _motion("revolute", axis, origin, lower, upper)


def slide(axis: ArrayLike, upper: float, lower: float = 0.0) -> Motion:
    """Shifts along an axis between limits [m]."""
    return _motion("prismatic", axis, (0, 0, 0), lower, upper)


def spin(origin: ArrayLike, axis: ArrayLike) -> Motion:
    """Turns about a line without end."""
    return _motion("continuous", axis, origin, 0.0, 0.0)


def ball(origin: ArrayLike) -> Motion:
    """Turns every way about a point."""
    return _motion("ball", (0, 0, 1), origin, 0.0, 0.0)


def free() -> Motion:
    """Only lies there, such as a lid that can be lifted off."""
    return _motion("free", (0, 0, 1), (0, 0, 0), 0.0, 0.0)


def _motion(kind: JointKind, axis: ArrayLike, origin: ArrayLike, lower: float, upper: float) -> Motion:
    along = unit(np.asarray(axis, dtype=np.float64))
    return Motion(kind, frozen_floats(along), frozen_floats(origin), float(lower), float(upper))
