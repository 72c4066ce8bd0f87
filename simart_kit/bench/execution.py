"""Executability: whether an object loads in MuJoCo, settles, and each of its joints travels its range.

Protocol: the base is fixed; 2 s of gravity; then each joint is driven to both ends of its range, alone, with
contacts on, the others held at rest and gravity compensated. It has to come within 5 % of its range of either
end. Asked is whether the way is free: friction, springs and rotor inertia of joints are taken out for that,
and how strong a motor would have to be is not judged.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Literal

import numpy as np

from ..arrays import FloatArray
from ..kinematics import LEAST_TRAVEL
from .mujoco_driving import REACHED, Driver, one_axis_joints, rest_positions
from .mujoco_loading import LoadError, load_model, one_line, quiet_mujoco

if TYPE_CHECKING:
    import mujoco

SETTLE_SECONDS = 2.0
TRAVEL_SECONDS = 1.0
MOST_JOINTS = 64
"""Of more joints than these, as many are driven, evenly chosen."""
_TIMESTEP = 0.0005, 0.002  # [s]; that of the file, within these
_CALM = 0.5  # speed of joints in the end [rad/s | m/s]
_OVER = 0.02, 0.001  # how far a joint may stand over a limit: of its range, and [rad | m]


@dataclass(frozen=True)
class JointTravel:
    """How far a joint came.

    Attributes:
        name: of the joint.
        kind: "hinge" or "slide".
        reached_lower: whether it came to its lower end; the rest of a continuous joint.
        reached_upper: the same of the upper end; a full turn of a continuous joint.
        tolerance: by how much it may miss an end [rad | m].
        reason: what kept it, in one line; "" when it reached both ends.
    """

    name: str
    kind: Literal["hinge", "slide"]
    reached_lower: bool
    reached_upper: bool
    tolerance: float
    reason: str = ""


@dataclass(frozen=True)
class Execution:
    """What a simulator makes of an object.

    Attributes:
        loads: whether MuJoCo takes the file.
        settles: whether nothing breaks or flies off in 2 s of gravity.
        travels: share of the hinges and slides that reach both ends; 1 when there are none, 0 when it does
            not load.
        reason: what failed first, in one line; "" when nothing did.
        joints: those that were driven.
    """

    loads: bool
    settles: bool
    travels: float
    reason: str = ""
    joints: tuple[JointTravel, ...] = ()

    @property
    def executable(self) -> bool:
        """Whether it loads, settles, and every joint travels."""
        return self.loads and self.settles and self.travels == 1.0


def execute(
    file: Path, settle_seconds: float = SETTLE_SECONDS, travel_seconds: float = TRAVEL_SECONDS
) -> Execution:
    """Load, settle and drive an object.

    The simulation has the timestep of the file, within 0.5 .. 2 ms. It settles when MuJoCo has warned of
    nothing, every joint stands within its limits (by 2 % of its range) and is slower than 0.5 rad/s or m/s:
    doors may fall open, but what swings without damping does not settle.

    Args:
        file: MJCF or URDF, from this program or another.
        settle_seconds: of gravity [s].
        travel_seconds: for a whole range of a joint [s].
    """
    try:
        model = load_model(file)
    except LoadError as error:
        return Execution(loads=False, settles=False, travels=0.0, reason=f"does not load: {error}")
    model.opt.timestep = float(np.clip(model.opt.timestep, *_TIMESTEP))
    with quiet_mujoco():
        unsettled = _unsettled(model, settle_seconds)
        joints = joint_travels(model, travel_seconds)
    travels = float(np.mean([not joint.reason for joint in joints])) if joints else 1.0
    reasons = [unsettled, *[f"joint '{joint.name}' {joint.reason}" for joint in joints if joint.reason]]
    first = next(filter(None, reasons), "")
    return Execution(loads=True, settles=not unsettled, travels=travels, reason=first, joints=joints)


def _unsettled(model: mujoco.MjModel, seconds: float) -> str:
    """What goes wrong under gravity, in one line; "" when nothing does."""
    import mujoco

    data = mujoco.MjData(model)
    data.qpos[:] = rest_positions(model)
    for steps in range(math.ceil(seconds / model.opt.timestep)):
        try:
            mujoco.mj_step(model, data)
        except mujoco.FatalError as error:
            return f"does not settle: {one_line(error)}"
        if data.warning.number.any():
            kind = int(data.warning.number.argmax())
            return (
                f"does not settle: MuJoCo warns of {_warning(kind)} after {steps * model.opt.timestep:.2f} s"
            )
    for joint in range(model.njnt):
        wrong = _astray(model, data, joint)
        if wrong:
            return f"does not settle: joint '{_name(model, joint)}' {wrong}"
    return ""


def _astray(model: mujoco.MjModel, data: mujoco.MjData, joint: int) -> str:
    """What is wrong with where a joint is and how fast; "" when nothing is."""
    dof = int(model.jnt_dofadr[joint])
    following = model.jnt_dofadr[joint + 1] if joint + 1 < model.njnt else model.nv
    speed = float(np.abs(data.qvel[dof:following]).max())
    if joint in one_axis_joints(model) and model.jnt_limited[joint]:
        lower, upper = model.jnt_range[joint]
        position = float(data.qpos[model.jnt_qposadr[joint]])
        over = _OVER[0] * (upper - lower) + _OVER[1]
        if not lower - over <= position <= upper + over:
            return f"is at {position:.3g}, outside its range {lower:.3g} .. {upper:.3g}"
    return "" if speed < _CALM else f"still moves at {speed:.2g} per second"


def joint_travels(
    model: mujoco.MjModel,
    seconds: float = TRAVEL_SECONDS,
    way: Callable[[int], FloatArray] | None = None,
) -> tuple[JointTravel, ...]:
    """Drive each hinge and slide to both ends of its range; the model is changed.

    Args:
        model: on a fixed base.
        seconds: for a whole range [s].
        way: of a joint that is held up, (nq,) positions from which it may try again, the others being held
            there: a rack behind a door, with the door open.
    """
    import mujoco

    model.opt.disableflags |= int(mujoco.mjtDisableBit.mjDSBL_ACTUATION)
    model.opt.integrator = int(mujoco.mjtIntegrator.mjINT_IMPLICITFAST)
    for inside in (model.dof_armature, model.dof_frictionloss, model.dof_damping, model.jnt_stiffness):
        inside[:] = 0.0
    mujoco.mj_setConst(model, mujoco.MjData(model))  # contacts are as stiff as what they hold is heavy
    moving = one_axis_joints(model)
    chosen = np.linspace(0, len(moving) - 1, min(len(moving), MOST_JOINTS)).round().astype(int)
    driver = Driver(model, seconds)
    found = [_travel(model, driver, moving[index]) for index in chosen]
    if way:
        for place, index in enumerate(chosen):
            if found[place].reason:
                again = _travel(model, driver, moving[index], way(moving[index]))
                found[place] = found[place] if again.reason else again
    return tuple(found)


def _travel(
    model: mujoco.MjModel, driver: Driver, joint: int, start_at: FloatArray | None = None
) -> JointTravel:
    name, kind = _name(model, joint), _kind(model, joint)
    lower, upper = _range(model, joint)
    if not upper - lower >= LEAST_TRAVEL:
        stated = tuple(float(value) for value in model.jnt_range[joint])
        fault = f"has no travel: its limits are {stated[0]:.3g} .. {stated[1]:.3g}"
        return JointTravel(name, kind, False, False, 0.0, fault)
    tolerance = REACHED * (upper - lower)
    found = [driver.reach(joint, end, upper - lower, start_at) for end in (lower, upper)]
    reached = [abs(place - end) <= tolerance for place, end in zip(found, (lower, upper), strict=True)]
    reason = ""
    if not all(reached):
        missed = reached.index(False)
        end, place = (lower, upper)[missed], found[missed]
        stops = f"stops at {place:.3g}" if np.isfinite(place) else "makes the simulation break"
        reason = f"{stops} on its way to {end:.3g} (range {lower:.3g} .. {upper:.3g})"
    return JointTravel(name, kind, reached[0], reached[1], tolerance, reason)


def _range(model: mujoco.MjModel, joint: int) -> tuple[float, float]:
    """Where a joint has to go: its limits, or a full turn of a hinge that has none.

    Limits that MuJoCo ignores, as URDF's reversed ones, are still what the file says.
    """
    lower, upper = (float(value) for value in model.jnt_range[joint])
    if lower == upper and not model.jnt_limited[joint] and _kind(model, joint) == "hinge":
        rest = float(rest_positions(model)[model.jnt_qposadr[joint]])
        return rest, rest + 2 * np.pi
    return lower, upper


def _kind(model: mujoco.MjModel, joint: int) -> Literal["hinge", "slide"]:
    import mujoco

    return "hinge" if model.jnt_type[joint] == int(mujoco.mjtJoint.mjJNT_HINGE) else "slide"


def _name(model: mujoco.MjModel, joint: int) -> str:
    return str(model.joint(joint).name) or f"number {joint}"


def _warning(kind: int) -> str:
    import mujoco

    return str(mujoco.mjtWarning(kind).name).removeprefix("mjWARN_")
