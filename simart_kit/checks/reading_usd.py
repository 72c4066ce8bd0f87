"""UsdPhysics of a stage (https://openusd.org/release/api/usd_physics_page_front.html) as a Mechanism."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from ..arrays import FloatArray, mat3, vec3
from ..asset import MassProperties
from ..errors import BadInputError
from .mechanism import WORLD, Body, Link, Mechanism
from .reading_usd_joints import Ends, link_of
from .reading_usd_numbers import moved, rotation, unscaled
from .reading_usd_shapes import shape_points, uniform_inertia

if TYPE_CHECKING:
    from pxr import Usd, UsdPhysics


def read_usd(path: Path) -> Mechanism:
    """What a USD file says of bodies and joints, in metres with z up.

    Raises:
        BadInputError: it cannot be opened, has no rigid body, or has something that no simulator could read.
    """
    from pxr import Tf, Usd

    try:
        stage = Usd.Stage.Open(str(path))
    except Tf.ErrorException as error:
        raise BadInputError(f"cannot open {path.name}: no USD file, or a layer of it is missing") from error
    reader = _Reader(stage)
    if not reader.bodies:
        raise BadInputError(f"{path.name} has no prim with PhysicsRigidBodyAPI: nothing to simulate")
    bodies = tuple(reader.body(prim) for prim in reader.bodies.values())
    return Mechanism(bodies, tuple(reader.links()), reader.excluded(), reader.passing())


class _Reader:
    """Reads the prims of one stage.

    Attributes:
        bodies: prims of rigid bodies, by path.
    """

    def __init__(self, stage: Usd.Stage) -> None:
        from pxr import Usd, UsdGeom, UsdPhysics

        self._prims = list(Usd.PrimRange.Stage(stage, Usd.TraverseInstanceProxies()))
        self._cache = UsdGeom.XformCache(Usd.TimeCode.EarliestTime())
        self._meters = float(UsdGeom.GetStageMetersPerUnit(stage))
        self._kilograms = float(UsdPhysics.GetStageKilogramsPerUnit(stage))
        self._world_T_stage = np.diag([self._meters] * 3 + [1.0])
        if UsdGeom.GetStageUpAxis(stage) == UsdGeom.Tokens.y:
            turn = np.array([[1.0, 0, 0, 0], [0, 0, -1, 0], [0, 1, 0, 0], [0, 0, 0, 1]])
            self._world_T_stage = turn @ self._world_T_stage
        self.bodies = {str(p.GetPath()): p for p in self._prims if p.HasAPI(UsdPhysics.RigidBodyAPI)}
        self._names = _names(self.bodies)

    def body(self, prim: Usd.Prim) -> Body:
        """A rigid body with what collides of it."""
        shapes = tuple(moved(self._world(p), shape_points(p)) for p in self._prims if self._collides(p, prim))
        return Body(self._name(prim), self._mass(prim, shapes), shapes)

    def links(self) -> Iterator[Link]:
        """The joints between bodies, in the order of the stage; what holds a base to the world is none."""
        from pxr import UsdPhysics

        for prim in self._prims:
            if prim.IsA(UsdPhysics.Joint):
                joint = UsdPhysics.Joint(prim)
                parent, child = (self._end(rel) for rel in (joint.GetBody0Rel(), joint.GetBody1Rel()))
                fixed = prim.IsA(UsdPhysics.FixedJoint)
                if child is None and not fixed:
                    raise BadInputError(f"joint {prim.GetPath()}: its body1 is no rigid body")
                if child is not None and not (fixed and parent is None):
                    carrier = self._name(parent) if parent is not None else WORLD
                    ends = Ends(carrier, self._name(child), self._world(child))
                    yield link_of(joint, ends, self._meters)

    def excluded(self) -> frozenset[frozenset[str]]:
        """Pairs that are filtered."""
        from pxr import UsdPhysics

        pairs = set()
        for path, prim in self.bodies.items():
            if prim.HasAPI(UsdPhysics.FilteredPairsAPI):
                targets = UsdPhysics.FilteredPairsAPI(prim).GetFilteredPairsRel().GetTargets()
                others = [self._names[str(t)] for t in targets if str(t) in self._names]
                pairs |= {frozenset((self._names[path], other)) for other in others}
        return frozenset(pairs)

    def passing(self) -> frozenset[frozenset[str]]:
        """Pairs that a joint connects which does not ask for contact between them."""
        from pxr import UsdPhysics

        pairs = set()
        for prim in self._prims:
            joint = UsdPhysics.Joint(prim)
            if prim.IsA(UsdPhysics.Joint) and not joint.GetCollisionEnabledAttr().Get():
                ends = [self._end(rel) for rel in (joint.GetBody0Rel(), joint.GetBody1Rel())]
                pairs.add(frozenset(self._name(end) for end in ends if end is not None))
        return frozenset(pair for pair in pairs if len(pair) == 2)

    def _name(self, body: Usd.Prim) -> str:
        return self._names[str(body.GetPath())]

    def _end(self, relationship: Usd.Relationship) -> Usd.Prim | None:
        """The body at one end of a joint; None for the world."""
        targets = [str(target) for target in relationship.GetTargets()]
        return next((self.bodies[target] for target in targets if target in self.bodies), None)

    def _collides(self, prim: Usd.Prim, body: Usd.Prim) -> bool:
        """Whether a prim is a collision shape of a body, and is switched on."""
        from pxr import UsdPhysics

        if not prim.HasAPI(UsdPhysics.CollisionAPI) or self._owner(prim) != body:
            return False
        return UsdPhysics.CollisionAPI(prim).GetCollisionEnabledAttr().Get() is not False

    def _owner(self, prim: Usd.Prim) -> Usd.Prim | None:
        while prim and not prim.IsPseudoRoot():
            if str(prim.GetPath()) in self.bodies:
                return prim
            prim = prim.GetParent()
        return None

    def _world(self, prim: Usd.Prim) -> FloatArray:
        """(4, 4) from the prim's own coordinates to the world [m]."""
        stage_T_prim = np.array(self._cache.GetLocalToWorldTransform(prim)).T
        return np.asarray(self._world_T_stage @ stage_T_prim)

    def _mass(self, prim: Usd.Prim, shapes: tuple[FloatArray, ...]) -> MassProperties | None:
        """As stated; an inertia or a centre that is not, is that of the shapes filled evenly."""
        from pxr import UsdPhysics

        api = UsdPhysics.MassAPI(prim)
        if not prim.HasAPI(UsdPhysics.MassAPI) or not api.GetMassAttr().HasAuthoredValue():
            return None
        mass, world = float(api.GetMassAttr().Get()) * self._kilograms, self._world(prim)
        even_center, even_inertia = uniform_inertia(shapes)
        stated = api.GetCenterOfMassAttr()
        center = (
            moved(world, np.array([stated.Get()]))[0]
            if stated.HasAuthoredValue() and np.isfinite(stated.Get()).all()
            else even_center
        )
        inertia = self._inertia(api, world)
        return MassProperties(mass, vec3(center), mat3(mass * even_inertia if inertia is None else inertia))

    def _inertia(self, api: UsdPhysics.MassAPI, world: FloatArray) -> FloatArray | None:
        """(3, 3) along the world's axes [kg*m^2]; None where it is left to the shapes, as by zeros."""
        moments = np.array(api.GetDiagonalInertiaAttr().Get(), dtype=np.float64)
        if not moments.any():
            return None
        axes = unscaled(world) @ rotation(api.GetPrincipalAxesAttr().Get())
        return np.asarray(axes @ np.diag(moments * self._kilograms * self._meters**2) @ axes.T)


def _names(paths: dict[str, Usd.Prim]) -> dict[str, str]:
    """Name by path: the prim's own, or its whole path where others are called the same."""
    leaves = [prim.GetName() for prim in paths.values()]
    return {path: p.GetName() if leaves.count(p.GetName()) == 1 else path for path, p in paths.items()}
