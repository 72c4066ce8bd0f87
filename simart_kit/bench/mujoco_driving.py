"""Driving one joint of a MuJoCo model along its range, with contacts on."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ..arrays import BoolArray, FloatArray

if TYPE_CHECKING:
    import mujoco

REACHED = 0.05
"""Share of its range by which a joint may miss an end."""
_PULL = (
    40.0  # acceleration [ranges/s^2] up to which it is driven: a drawer of 0.3 m by a little over its weight
)
_DRIVE, _HOLD = 30.0, 60.0  # natural frequencies [1/s] of the driven joint and of those held at rest
_LEAST = 0.2  # of the time for a whole range that the shortest way takes
_AFTER = 0.5  # of it to get there after the goal has


class Driver:
    """Moves one joint and holds the others, by forces that a motor with gravity compensation would give.

    The force is M a + bias - passive (computed torque), with a critically damped pull towards a goal that
    moves smoothly. The pull is limited, so that contacts hold it.

    Args:
        model: its actuators are off.
        seconds: for a whole range.
    """

    def __init__(self, model: mujoco.MjModel, seconds: float) -> None:
        import mujoco

        self._model, self._data, self._seconds = model, mujoco.MjData(model), seconds
        self._rest = rest_positions(model)
        self._follows = _followers(model)

    def reach(self, joint: int, target: float, travel: float, start_at: FloatArray | None = None) -> float:
        """Drive from rest towards a position; returns where the joint is in the end [rad | m].

        Args:
            joint: a hinge or slide.
            target: position [rad | m].
            travel: length of its range [rad | m], above 0.
            start_at: (nq,) positions where all others are held; the default is rest.

        Returns:
            A position within REACHED of `travel` if it got there; NaN where the simulation broke.
        """
        import mujoco

        model, data = self._model, self._data
        address, dof = int(model.jnt_qposadr[joint]), int(model.jnt_dofadr[joint])
        mujoco.mj_resetData(model, data)
        data.qpos[:] = goal = self._rest.copy() if start_at is None else start_at.copy()
        start = float(goal[address])
        ramp = self._seconds * (_LEAST + (1 - _LEAST) * min(abs(target - start) / travel, 1.0))
        steps = int(np.ceil((ramp + _AFTER * self._seconds) / model.opt.timestep))
        try:
            for step in range(steps):
                phase = min(np.pi * step * model.opt.timestep / ramp, np.pi)
                goal[address] = start + (target - start) * (1 - np.cos(phase)) / 2
                self._step(dof, goal, (target - start) * np.sin(phase) * np.pi / (2 * ramp), travel)
                if data.warning.number.any():
                    return float("nan")
                if phase == np.pi and abs(data.qpos[address] - target) <= REACHED * travel:
                    break
        except mujoco.FatalError:
            return float("nan")
        return float(data.qpos[address])

    def _step(self, dof: int, goal: FloatArray, speed: float, travel: float) -> None:
        """One step towards `goal` positions, the driven joint at a `speed`."""
        import mujoco

        model, data = self._model, self._data
        mujoco.mj_step1(model, data)
        error, force = np.zeros(model.nv), np.zeros(model.nv)
        mujoco.mj_differentiatePos(model, error, 1.0, data.qpos, goal)
        wanted = _HOLD**2 * error - 2 * _HOLD * data.qvel
        wanted[self._follows] = 0.0
        pull = _DRIVE**2 * error[dof] + 2 * _DRIVE * (speed - data.qvel[dof])
        wanted[dof] = np.clip(pull, -_PULL * travel, _PULL * travel)
        mujoco.mj_mulM(model, data, force, wanted)
        force += data.qfrc_bias - data.qfrc_passive
        data.qfrc_applied[:] = force
        mujoco.mj_step2(model, data)


def rest_positions(model: mujoco.MjModel) -> FloatArray:
    """(nq,) positions as the file has them, those of limited hinges and slides within their limits."""
    rest = np.array(model.qpos0)
    for joint in one_axis_joints(model):
        if model.jnt_limited[joint]:
            address = model.jnt_qposadr[joint]
            rest[address] = np.clip(rest[address], *model.jnt_range[joint])
    return rest


def one_axis_joints(model: mujoco.MjModel) -> list[int]:
    """Indices of hinges and slides."""
    import mujoco

    kinds = (int(mujoco.mjtJoint.mjJNT_HINGE), int(mujoco.mjtJoint.mjJNT_SLIDE))
    return [index for index in range(model.njnt) if int(model.jnt_type[index]) in kinds]


def _followers(model: mujoco.MjModel) -> BoolArray:
    """(nv,) what is coupled to another joint, and so cannot be held while that one moves."""
    import mujoco

    follows = np.zeros(model.nv, dtype=bool)
    for index in np.flatnonzero(model.eq_type == int(mujoco.mjtEq.mjEQ_JOINT)):
        for joint in (model.eq_obj1id[index], model.eq_obj2id[index]):
            if model.eq_active0[index] and joint >= 0:
                follows[model.jnt_dofadr[joint]] = True
    return follows
