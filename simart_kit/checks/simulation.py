"""An object in MuJoCo, in the variants that checks need."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from ..bench.mujoco_driving import one_axis_joints, rest_positions
from .mechanism import Mechanism
from .names import body_name
from .reading import compiled_spec, read_spec
from .ways import Ways

if TYPE_CHECKING:
    import mujoco

    from ..arrays import FloatArray

# How deep a joint may go into what stays and yet open for another: [m], and a share of the diagonal.
_GRAZE, _GRAZE_SHARE = 0.002, 0.005


@dataclass(frozen=True)
class Contact:
    """Two bodies that touch.

    Attributes:
        pair: their names, in order.
        depth: how deep [m].
        point: (3,) where [m].
    """

    pair: tuple[str, str]
    depth: float
    point: tuple[float, float, float]


@dataclass(frozen=True, eq=False)
class Simulation:
    """A file as MuJoCo takes it.

    Attributes:
        spec: with a fixed base; copy it before a change.
        mechanism: what it says.
    """

    spec: mujoco.MjSpec
    mechanism: Mechanism

    @classmethod
    def of_file(cls, path: Path) -> Simulation:
        """Load a URDF or MJCF file; raises BadInputError when it does not load."""
        from .reading_mujoco import mechanism_of

        spec = _without_looks(read_spec(path))
        return cls(spec, mechanism_of(compiled_spec(spec)))

    @classmethod
    def of_mechanism(cls, mechanism: Mechanism) -> Simulation:
        """Build what MuJoCo has no reader for; raises BadInputError when that cannot be done."""
        from .building import spec_of

        return cls(spec_of(mechanism), mechanism)

    @cached_property
    def model(self) -> mujoco.MjModel:
        """The object on a fixed base, with what the file excludes from contact; not to be changed."""
        return self.fresh()

    @cached_property
    def ways(self) -> Ways:
        """What each joint needs out of its way, with what the file excludes in nobody's way."""
        return Ways(self.model, max(_GRAZE, _GRAZE_SHARE * self.mechanism.diagonal))

    def unfiltered(self) -> mujoco.MjModel:
        """The same with contact between all bodies that are not rigidly connected."""
        import mujoco

        spec = self.spec.copy()
        for exclude in list(spec.excludes):
            spec.delete(exclude)
        model = compiled_spec(spec)
        model.opt.disableflags |= int(mujoco.mjtDisableBit.mjDSBL_FILTERPARENT)
        return model

    def fresh(self) -> mujoco.MjModel:
        """A model of one's own, to be changed."""
        return compiled_spec(self.spec.copy())

    def dropped(self, height: float) -> mujoco.MjModel:
        """The object with a free base, `height` [m] above a floor; what hangs on the world stays there."""
        import mujoco

        spec = self.spec.copy()
        for number, body in enumerate(spec.worldbody.bodies):
            if not body.joints:
                body.add_freejoint(name=f"checks_free_{number}")
        below = [0.0, 0.0, self.mechanism.bounds[0, 2] - height]
        spec.worldbody.add_geom(
            name="checks_floor", type=mujoco.mjtGeom.mjGEOM_PLANE, size=[0, 0, 1], pos=below
        )
        return compiled_spec(spec)


def _without_looks(spec: mujoco.MjSpec) -> mujoco.MjSpec:
    """The spec without what is only seen, where it decides no mass: large meshes take long to compile."""
    for body in spec.bodies:
        for geom in list(body.geoms) if body.explicitinertial else ():
            if not (geom.contype or geom.conaffinity):
                spec.delete(geom)
    used = {geom.meshname for geom in spec.geoms}
    for mesh in list(spec.meshes):
        if mesh.name and mesh.name not in used:
            spec.delete(mesh)
    return spec


def contacts(model: mujoco.MjModel, data: mujoco.MjData) -> dict[tuple[str, str], Contact]:
    """The deepest contact of each pair of bodies, as `mj_collision` left them."""
    deepest: dict[tuple[int, int], int] = {}
    bodies, depths = model.geom_bodyid[data.contact.geom], -data.contact.dist
    for index in np.flatnonzero(depths > 0).tolist():
        one, two = sorted(bodies[index].tolist())
        if depths[index] > depths[deepest.setdefault((one, two), index)]:
            deepest[one, two] = index
    found: dict[tuple[str, str], Contact] = {}
    for (one, two), index in deepest.items():
        first, second = sorted((body_name(model, one), body_name(model, two)))
        x, y, z = data.contact.pos[index].tolist()
        found[first, second] = Contact((first, second), float(depths[index]), (x, y, z))
    return found


def ranges(model: mujoco.MjModel) -> dict[int, tuple[float, float]]:
    """Where each hinge and slide may go [rad | m]; a hinge without limits turns once."""
    found = {}
    for joint in one_axis_joints(model):
        rest = float(rest_positions(model)[model.jnt_qposadr[joint]])
        limited = bool(model.jnt_limited[joint])
        lower, upper = (float(v) for v in model.jnt_range[joint]) if limited else (rest, rest + 2 * np.pi)
        if upper > lower:
            found[joint] = (lower, upper)
    return found


def middle(model: mujoco.MjModel) -> FloatArray:
    """(nq,) positions with each hinge and slide half way."""
    found = rest_positions(model)
    for joint, (lower, upper) in ranges(model).items():
        found[model.jnt_qposadr[joint]] = (lower + upper) / 2
    return found
