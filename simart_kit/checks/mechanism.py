"""What a simulator reads in a file: rigid bodies and joints, in one frame, whatever the format."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ..arrays import FloatArray, Vec3
from ..asset import Asset, JointKind, MassProperties
from ..errors import BadInputError
from ..kinematics import turned_about

WORLD = "world"
"""What carries a joint that hangs on no body."""


@dataclass(frozen=True, eq=False)
class Body:
    """A rigid body at rest, in the world's frame.

    Attributes:
        name: unique.
        mass: inertial properties; None where the file has none.
        colliders: (V, 3) corners of each collision shape [m]; those of a round one lie on its surface.
    """

    name: str
    mass: MassProperties | None
    colliders: tuple[FloatArray, ...] = ()


@dataclass(frozen=True)
class Link:
    """A joint at rest, in the world's frame.

    Attributes:
        name: unique.
        kind: of the joint.
        parent: the body that carries it; "world" where none does.
        child: the body that it moves.
        origin: (3,) a point on the axis [m].
        axis: (3,) unit direction.
        lower: lowest position [rad | m], None without limits.
        upper: highest position [rad | m], None without limits.
        damping: [N*m*s/rad | N*s/m].
        friction: dry friction [N*m | N].
        armature: inertia added to the joint [kg*m^2 | kg].
    """

    name: str
    kind: JointKind
    parent: str
    child: str
    origin: Vec3
    axis: Vec3
    lower: float | None = None
    upper: float | None = None
    damping: float = 0.0
    friction: float = 0.0
    armature: float = 0.0

    @property
    def rigid(self) -> bool:
        """Whether it cannot move: formats write a joint without travel as fixed."""
        return self.kind == "fixed" or (self.lower is not None and self.lower == self.upper)


@dataclass(frozen=True, eq=False)
class Mechanism:
    """Bodies and joints of one object.

    Attributes:
        bodies: all of them.
        links: between them; bodies that none of them moves stand still.
        excluded: pairs of bodies that pass through each other by order of the file.
        passing: those that do so because a joint connects them, without the file's order.
    """

    bodies: tuple[Body, ...]
    links: tuple[Link, ...]
    excluded: frozenset[frozenset[str]] = frozenset()
    passing: frozenset[frozenset[str]] = frozenset()

    @cached_property
    def body(self) -> Mapping[str, Body]:
        """The bodies by name."""
        return {body.name: body for body in self.bodies}

    @cached_property
    def moving(self) -> tuple[Link, ...]:
        """The joints that are anything but fixed."""
        return tuple(link for link in self.links if link.kind != "fixed")

    @cached_property
    def order(self) -> tuple[Body, ...]:
        """The bodies, each after the one that carries it.

        Raises:
            BadInputError: they are no tree.
        """
        carrier = {link.child: link.parent for link in self.links}
        order = [body for body in self.bodies if carrier.get(body.name) not in self.body]
        for body in order:  # grows while it is gone through
            order += [self.body[link.child] for link in self.links if link.parent == body.name]
        if len(order) != len(self.bodies) or len(carrier) != len(self.links):
            raise BadInputError("the joints are no tree: a loop, or a body with two joints above it")
        return tuple(order)

    @cached_property
    def moved(self) -> frozenset[str]:
        """Names of the bodies that may move, the base being fixed."""
        above, found = {link.child: link for link in self.links}, set[str]()
        for body in self.order:
            link = above.get(body.name)
            if link and (link.kind != "fixed" or link.parent in found):
                found.add(body.name)
        return frozenset(found)

    @cached_property
    def bounds(self) -> FloatArray:
        """(2, 3) of all collision shapes [m]; of centres of mass where there are none."""
        points = [p for body in self.bodies for p in body.colliders]
        points += [np.array([body.mass.center]) for body in self.bodies if body.mass]
        if not points:
            raise BadInputError("the object has neither masses nor collision shapes")
        every = np.concatenate(points)
        return np.array([every.min(axis=0), every.max(axis=0)])

    @property
    def diagonal(self) -> float:
        """Length of its bounding box's diagonal [m]."""
        return float(np.linalg.norm(self.bounds[1] - self.bounds[0]))

    def posed(self, positions: Mapping[str, float]) -> dict[str, FloatArray]:
        """`posed_T_rest` (4, 4) of each body, with joints of one axis at these positions [rad | m]."""
        above = {link.child: link for link in self.links}
        found = {WORLD: np.eye(4)}
        for body in self.order:
            link = above.get(body.name)
            found[body.name] = (
                found[link.parent] @ _motion(link, positions.get(link.name, 0.0)) if link else np.eye(4)
            )
        return {body.name: found[body.name] for body in self.bodies}


def of_asset(asset: Asset) -> Mechanism:
    """What every file of an asset should say."""
    bodies = [
        Body(part.name, part.mass, tuple(shape.vertices for shape in part.collision)) for part in asset.parts
    ]
    links = [
        Link(
            j.name,
            j.kind,
            j.parent,
            j.child,
            j.origin,
            j.axis,
            j.limits.lower if j.limits else None,
            j.limits.upper if j.limits else None,
            j.damping,
            j.friction,
            j.armature,
        )
        for j in asset.joints
    ]
    return Mechanism(tuple(bodies), tuple(links))


def _motion(link: Link, position: float) -> FloatArray:
    """(4, 4) motion of what hangs on a joint, in the world's frame at rest."""
    motion, axis = np.eye(4), np.array(link.axis)
    if link.kind in ("revolute", "continuous"):
        return turned_about(axis, np.array(link.origin), position)
    if link.kind == "prismatic":
        motion[:3, 3] = axis * position
    return motion
