"""A stage as the rules look at it: its prims once, sorted by what they are for physics."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from ..arrays import FloatArray
from ..errors import BadInputError

if TYPE_CHECKING:
    from pxr import Usd, UsdGeom


@dataclass(frozen=True, eq=False)
class UsdScene:
    """Views on a stage, at its earliest time.

    Attributes:
        stage: an open stage, which is only read.
    """

    stage: Usd.Stage

    @cached_property
    def prims(self) -> tuple[Usd.Prim, ...]:
        """Active, defined prims, those of instances included, parents first."""
        from pxr import Usd

        return tuple(self.stage.Traverse(Usd.TraverseInstanceProxies(Usd.PrimDefaultPredicate)))

    @cached_property
    def bodies(self) -> tuple[Usd.Prim, ...]:
        """Rigid bodies that are enabled, kinematic ones included."""
        return tuple(prim for prim in self.prims if is_body(prim))

    @cached_property
    def colliders(self) -> tuple[Usd.Prim, ...]:
        """Prims that collide."""
        from pxr import UsdPhysics

        return tuple(prim for prim in self.prims if prim.HasAPI(UsdPhysics.CollisionAPI))

    @cached_property
    def joints(self) -> tuple[Usd.Prim, ...]:
        """Joints of any type."""
        from pxr import UsdPhysics

        return tuple(prim for prim in self.prims if prim.IsA(UsdPhysics.Joint))

    @cached_property
    def has_physics(self) -> bool:
        """Whether anything on the stage is meant for a simulator."""
        return bool(self.bodies or self.colliders or self.joints)

    @cached_property
    def metres(self) -> float:
        """Metres in a unit of length."""
        from pxr import UsdGeom

        return float(UsdGeom.GetStageMetersPerUnit(self.stage))

    @cached_property
    def _frames(self) -> UsdGeom.XformCache:
        from pxr import Usd, UsdGeom

        return UsdGeom.XformCache(Usd.TimeCode.EarliestTime())

    def pose(self, prim: Usd.Prim) -> FloatArray:
        """`world_T_prim` (4, 4): takes points of a prim to the stage's frame, in units of the stage."""
        return np.array(self._frames.GetLocalToWorldTransform(prim)).T

    @cached_property
    def _boxes(self) -> UsdGeom.BBoxCache:
        from pxr import Usd, UsdGeom

        names = UsdGeom.Tokens
        purposes = [names.default_, names.render, names.proxy, names.guide]
        return UsdGeom.BBoxCache(Usd.TimeCode.EarliestTime(), purposes)

    def bounds(self, body: Usd.Prim) -> FloatArray | None:
        """(2, 3) corners of the box around all below a prim in its own frame; None where nothing is."""
        box = self._boxes.ComputeUntransformedBound(body).ComputeAlignedRange()
        return None if box.IsEmpty() else np.array([box.GetMin(), box.GetMax()])

    def shapes(self, body: Usd.Prim) -> tuple[Usd.Prim, ...]:
        """The gprims of a body, without those of bodies below it."""
        return self._shapes.get(body.GetPath(), ())

    @cached_property
    def _shapes(self) -> dict[Any, tuple[Usd.Prim, ...]]:
        from pxr import UsdGeom

        found: dict[Any, tuple[Usd.Prim, ...]] = {}
        for prim in self.prims:
            if prim.IsA(UsdGeom.Gprim):
                owner = body_of(prim)
                if owner:
                    found[owner.GetPath()] = (*found.get(owner.GetPath(), ()), prim)
        return found


def is_body(prim: Usd.Prim) -> bool:
    """Whether a prim is a rigid body that is enabled."""
    from pxr import UsdPhysics

    return prim.HasAPI(UsdPhysics.RigidBodyAPI) and stated(prim, "physics:rigidBodyEnabled") is not False


def body_of(prim: Usd.Prim) -> Usd.Prim | None:
    """The rigid body that a prim is, or is a part of."""
    while prim and not prim.IsPseudoRoot():
        if is_body(prim):
            return prim
        prim = prim.GetParent()
    return None


def stated(prim: Usd.Prim, name: str) -> Any:
    """What is authored for an attribute, at the earliest time; None where nothing is.

    Raises:
        BadInputError: the file is damaged, and holds a value of a type that there is not.
    """
    from pxr import Usd

    attribute = prim.GetAttribute(name)
    if not attribute or not attribute.HasAuthoredValue():
        return None
    try:
        return attribute.Get(Usd.TimeCode.EarliestTime())
    except TypeError as error:
        raise BadInputError(f"{prim.GetPath()} has a damaged value of {name}: export it again") from error
