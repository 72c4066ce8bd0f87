"""Check `settle`: dropped on a floor with a free base, the object comes to rest upright."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from pydantic import Field

from ..hulls import hull_of
from ..moments import solid_moments
from ..stages import Check
from ..stages import Options as StageOptions
from ..triangles import unit_normals
from . import CheckResult
from .subject import Subject

if TYPE_CHECKING:
    import mujoco

    from ..arrays import FloatArray

_DIRECTIONS = 360  # in which a shape may tip over
_LEVEL = 2e-4  # of the diagonal: how far from the plane on which it rests a foot ends
_UNKNOWN = 90.0  # slope of what has no shapes [degrees]: it is judged by its drop


class Settle(Check):
    """Dropped from 2 cm it rests after three seconds, upright, on the floor, and nothing broke.

    What lies on feet of unequal height leans onto them, as scissors on their handles do.
    What could not stand if it were solid all through is mounted somewhere, as a tap is: while its base is
    fixed, it need not.
    """

    name = "settle"

    class Options(StageOptions):
        """The drop and what is at rest."""

        height: float = Field(default=0.02, ge=0, description="Of the drop [m].")
        seconds: float = Field(default=3.0, gt=0, le=60, description="Until it must be at rest [s].")
        speed: float = Field(default=1e-3, gt=0, description="Of the base at rest, at most [m/s].")
        tilt: float = Field(default=1.0, gt=0, description="Of the base, at most [degrees].")
        sink: float = Field(default=0.005, gt=0, description="Lower or higher than it stood, at most [m].")
        stands: float = Field(
            default=5.0,
            ge=0,
            description="A shape that tips over by itself, or when tilted by so much, is mounted [degrees].",
        )

    options: Options

    def check(self, subject: Subject) -> CheckResult:
        """Speed, tilt and height of the base in the end, and MuJoCo's warnings."""
        model = subject.simulation.dropped(self.options.height)
        if not _free_joints(model):
            return CheckResult(self.name, True, "joints hang on the world: there is no base to drop")
        found = _drop(model, self.options)
        found["stands"], found["leans"] = _stance(subject, self.options.sink)
        bad = {
            f"MuJoCo warned {found['warnings']:g} times": found["warnings"] > 0,
            f"it still moves at {found['speed']:.2g} m/s": not found["speed"] <= self.options.speed,
            f"it tilts by {found['tilt']:.2g} degrees": (
                not found["tilt"] <= found["leans"] + self.options.tilt
            ),
            f"it is {found['sink'] * 1000:.3g} mm lower than it stood": (
                not abs(found["sink"]) <= self.options.sink
            ),
        }
        wrong = [text for text, is_wrong in bad.items() if is_wrong]
        if wrong and found["stands"] < self.options.stands and not (found["warnings"] or _floats(subject)):
            return CheckResult(self.name, True, "does not stand by itself: keep its base fixed", found)
        sound = f"at rest {self.options.seconds:g} s after a drop from {self.options.height * 100:g} cm"
        return CheckResult(self.name, not wrong, "; ".join(wrong) or sound, found)


def _drop(model: mujoco.MjModel, options: Settle.Options) -> dict[str, float]:
    """What became of the base, which is the heaviest of things that lie or stand loose."""
    import mujoco

    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    base = max(_free_joints(model), key=lambda joint: model.body_subtreemass[model.jnt_bodyid[joint]])
    then, then_up = _pose(model, data, base)
    mujoco.mj_step(model, data, nstep=round(options.seconds / model.opt.timestep))
    (height, up), dof = _pose(model, data, base), model.jnt_dofadr[base]
    return {
        "speed": float(np.linalg.norm(data.qvel[dof : dof + 3])),
        "tilt": float(np.degrees(np.arctan2(np.linalg.norm(np.cross(up, then_up)), up @ then_up))),
        "sink": then - options.height - height,
        "warnings": float(data.warning.number.sum()),
    }


def _floats(subject: Subject) -> bool:
    """Whether its base is free in use, as an asset or an MJCF file says; others leave it open."""
    import mujoco

    if subject.asset is not None:
        return subject.asset.floating
    file = subject.simulated.get("mjcf")
    if file is None or file.suffix.lower() != ".xml":
        return False
    free = mujoco.mjtJoint.mjJNT_FREE
    return any(joint.type == free for joint in mujoco.MjSpec.from_file(str(file)).joints)


def _stance(subject: Subject, near: float) -> tuple[float, float]:
    """Slope on which its shapes would tip over at rest, and tilt at which they lie on their feet [degrees].

    Args:
        subject: its shapes are all of one density; 90 and 0 where a body has none.
        near: how far above the lowest points others are feet as well [m].
    """
    mechanism = subject.simulation.mechanism
    if not all(body.colliders for body in mechanism.bodies if body.mass and body.mass.mass > 0):
        return _UNKNOWN, 0.0
    shapes = [points for body in mechanism.bodies for points in body.colliders]
    hulls = [hull for hull in map(hull_of, shapes) if hull]
    if not hulls:
        return _UNKNOWN, 0.0
    moments = sum((solid_moments(hull.vertices[hull.faces]).sum(axis=0) for hull in hulls), np.zeros((4, 4)))
    center, points = moments[:3, 3] / moments[3, 3], np.concatenate([hull.vertices for hull in hulls])
    below, normal = _face_below(points, center)
    if below[2] > mechanism.bounds[0, 2] + near:  # it lies on no feet: what is lowest stands for them
        below, normal = mechanism.bounds[0], -np.eye(3)[2]
        feet = points[points[:, 2] <= mechanism.bounds[0, 2] + near]
    else:
        feet = points[np.abs((points - below) @ normal) <= _LEVEL * mechanism.diagonal]
    height = (center - below) @ normal / normal[2]
    angles = np.linspace(0, 2 * np.pi, _DIRECTIONS, endpoint=False)
    ways = np.stack([np.cos(angles), np.sin(angles)], axis=1)
    # How far the centre is inside the feet's hull: where it is nearest to the hull's edge.
    inside = float(((feet[:, :2] - center[:2]) @ ways.T).max(axis=0).min())
    lean = float(np.degrees(np.arccos(min(-normal[2], 1.0))))
    return float(np.degrees(np.arctan2(inside, height))) - lean, lean


def _face_below(points: FloatArray, center: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Highest corner and (3,) normal of the face below a (3,) centre, of the hull of (N, 3) points."""
    hull = hull_of(points)
    assert hull is not None  # of shapes that are thick
    triangles = hull.vertices[hull.faces]
    normals = unit_normals(triangles)
    down = normals[:, 2] < -1e-6
    triangles, normals = triangles[down], normals[down]
    # Below the centre, the plane of the face that is there is above those of all others.
    height = triangles[:, 0, 2] - ((center - triangles[:, 0]) * normals)[:, :2].sum(axis=1) / normals[:, 2]
    below = int(np.argmax(height))
    return triangles[below][triangles[below][:, 2].argmax()], normals[below]


def _free_joints(model: mujoco.MjModel) -> list[int]:
    import mujoco

    return [j for j in range(model.njnt) if int(model.jnt_type[j]) == int(mujoco.mjtJoint.mjJNT_FREE)]


def _pose(model: mujoco.MjModel, data: mujoco.MjData, joint: int) -> tuple[float, FloatArray]:
    """Height of a free base [m], and (3,) what is up for it, in its own coordinates."""
    body = model.jnt_bodyid[joint]
    return float(data.xpos[body][2]), np.array(data.xmat[body].reshape(3, 3)[2])
