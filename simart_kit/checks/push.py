"""Check `push`: a robot-sized push opens each joint, or a person lifts it, and its limit stops it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

import numpy as np
from pydantic import Field

from ..arrays import FloatArray, Vec3
from ..bench.mujoco_driving import one_axis_joints, rest_positions
from ..stages import Check
from ..stages import Options as StageOptions
from . import CheckResult, Fault
from .names import joint_name
from .subject import Subject
from .ways import Way, subtree, told

if TYPE_CHECKING:
    import mujoco

    from .simulation import Simulation

_STOPS = 9  # where its weight is felt
_FIRM = 1.25  # times what holds a joint: weight grows on its way
_LIFT, _HOLD = 1.5, 1.25  # times its weight on the joint: to lift it, and to overcome friction that holds it
_RESTING, _AGAIN = 1e-4, 20  # [rad/s | m/s] at its limit, so many times ten steps in a row: it stays there
_LONGER = 4  # times as long is waited for what would cross its range in that time: a gate of 100 kg is slow
_CORNERS = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], dtype=np.float64)


class Push(Check):
    """Pushed to its farther limit from rest, each joint gets there and not beyond it.

    What has to be lifted gets as much more as its weight asks for, up to what a person can, and is listed;
    so is what is too heavy even then.
    """

    name = "push"
    drives = True

    class Options(StageOptions):
        """The push, and what is asked."""

        torque: float = Field(default=5.0, gt=0, description="On hinges, at most [N*m].")
        force: float = Field(default=20.0, gt=0, description="On slides, at most [N].")
        person: float = Field(
            default=150.0,
            ge=0,
            description="On what has to be lifted: at the point farthest from its axis, at most [N].",
        )
        acceleration: float = Field(
            default=15.0,
            gt=0,
            description="Nobody pushes a light knob with a door's force: beyond what holds it, a joint gets "
            "no more than what moves it so [rad/s^2 | m/s^2].",
        )
        seconds: float = Field(
            default=8.0,
            gt=0,
            le=60,
            description="How long; four times as long for what is heavy and still on its way then [s].",
        )
        opens: float = Field(
            default=0.9, ge=0, le=1, description="How far it has to open [share of its range]."
        )
        overshoot: float = Field(default=0.01, gt=0, description="Beyond the limit, at most [rad | m].")

    options: Options

    def check(self, subject: Subject) -> CheckResult:
        """Each limited joint alone, the others at rest, or out of its way where they hold it up."""
        model, waits = subject.simulation.model, dict[str, tuple[str, ...]]()
        rows: dict[str, dict[str, float]] = {}
        for joint in (j for j in one_axis_joints(model) if model.jnt_limited[j]):
            name = joint_name(model, joint)
            rows[name], opened = self._opened(subject.simulation, joint)
            waits |= {name: opened} if opened else {}
        shut = [n for n, row in rows.items() if not row["opened"] >= self.options.opens]
        stuck = [n for n in shut if not rows[n]["heavy"]]
        over = [n for n, row in rows.items() if not row["overshoot"] <= self.options.overshoot]
        texts = []
        if stuck:
            listed = ", ".join(f"{n} ({rows[n]['opened']:.0%})" for n in stuck)
            texts.append(f"{self.options.torque:g} N m or {self.options.force:g} N does not open {listed}")
        if over:
            listed = ", ".join(f"{n} by {rows[n]['overshoot']:.2g}" for n in over)
            texts.append(f"pushed over its limit: {listed}")
        fault = (
            Fault({stuck[0]: rows[stuck[0]]["reached"]}, _anchor(subject, stuck[0]), 0.0, "stuck")
            if stuck
            else None
        )
        text = "; ".join(texts) or _sound(rows, shut) + told(waits)
        return CheckResult(self.name, not texts, text, {"joints": rows, "waits": waits}, fault)

    def _opened(self, simulation: Simulation, joint: int) -> tuple[dict[str, float], tuple[str, ...]]:
        """What became of a joint, and which others are open for it."""
        model = simulation.model
        row = self._moved(model, joint, rest_positions(model))
        if row["opened"] >= self.options.opens:
            return row, ()
        way: Way = simulation.ways.way(joint)
        again = self._moved(model, joint, way.positions) if way.opened else row
        return (again, way.opened) if again["opened"] >= self.options.opens else (row, ())

    def _moved(self, model: mujoco.MjModel, joint: int, others: FloatArray) -> dict[str, float]:
        """What became of a joint at a push, or else at what its weight asks for."""
        row = self._pushed(model, joint, others, 0.0)
        enough = row["opened"] >= self.options.opens or not row["asked"] > row["push"]
        return row if enough else self._pushed(model, joint, others, row["asked"])

    def _pushed(self, model: mujoco.MjModel, joint: int, others: FloatArray, lift: float) -> dict[str, float]:
        import mujoco

        data, dof = mujoco.MjData(model), int(model.jnt_dofadr[joint])
        address = int(model.jnt_qposadr[joint])
        hinge = int(model.jnt_type[joint]) == int(mujoco.mjtJoint.mjJNT_HINGE)
        data.qpos[:] = others
        lower, upper = (float(v) for v in model.jnt_range[joint])
        rest = float(data.qpos[address])
        sign = 1.0 if upper - rest >= rest - lower else -1.0
        limit = upper if sign > 0 else lower
        weight = float(np.abs(_pulls(model, joint, others, (lower, upper))).max())
        uphill = max(0.0, float((sign * _pulls(model, joint, others, (rest, limit))).max()))
        most_push = self.options.torque if hinge else self.options.force
        person = self.options.person * (_reach(model, joint, others) if hinge else 1.0)
        asked = _LIFT * uphill + _HOLD * weight
        force = self._force(model, data, dof, uphill if lift else 0.0, max(most_push, lift))
        data.qfrc_applied[dof] = sign * force
        most = self._farthest(model, data, joint, sign)
        # Bouncing back at the limit does not count against it.
        opened = (most - rest) / (limit - rest) if limit != rest else 1.0
        over = max(sign * (float(data.qpos[address]) - limit), 0.0)
        row = {"opened": min(opened, 1.0), "overshoot": over, "reached": most}
        heavy, lifted = uphill > 0 and asked > max(most_push, person), force > most_push
        row |= {"push": force, "weight": weight, "asked": min(person, asked)}
        return row | {"heavy": heavy, "lifted": lifted}

    def _farthest(self, model: mujoco.MjModel, data: mujoco.MjData, joint: int, sign: float) -> float:
        """How far the applied push brings a joint [rad | m]; `data` is where it is in the end."""
        import mujoco

        address, dof = int(model.jnt_qposadr[joint]), int(model.jnt_dofadr[joint])
        most = float(data.qpos[address])
        limit = float(model.jnt_range[joint, 1 if sign > 0 else 0])
        steps, still = round(self.options.seconds / model.opt.timestep / 10), 0
        under_way = abs(limit - most) / (_LONGER * self.options.seconds)
        for step in range(_LONGER * steps):
            mujoco.mj_step(model, data, nstep=10)
            most = max(most, float(data.qpos[address]), key=lambda q: sign * q)
            speed = sign * float(data.qvel[dof])
            resting = sign * (data.qpos[address] - limit) >= 0 and abs(speed) < _RESTING
            still = still + 1 if resting else 0
            if still == _AGAIN:  # the same push holds it there from now on
                break
            if step >= steps and speed < under_way:
                break
        return most

    def _force(
        self, model: mujoco.MjModel, data: mujoco.MjData, dof: int, uphill: float, most: float
    ) -> float:
        """The push on a joint at rest [N*m | N]."""
        import mujoco

        mujoco.mj_forward(model, data)
        inertia = np.zeros(model.nv)
        mujoco.mj_mulM(model, data, inertia, np.eye(model.nv)[dof])
        holds = float(model.dof_frictionloss[dof]) + max(abs(float(data.qfrc_bias[dof])), uphill)
        enough = _FIRM * holds + self.options.acceleration * float(inertia[dof])
        return min(enough, most)


def _sound(rows: Mapping[str, Mapping[str, float]], heavy: Sequence[str]) -> str:
    """What there is to say of an object that passes, some joints of which are too heavy."""
    if not rows:
        return "nothing to push: no joint has two ends"
    lifted = [f"{n} ({row['push']:.2g})" for n, row in rows.items() if row["lifted"] and n not in heavy]
    text = f"{len(rows) - len(heavy)} joints open at a push and stop at their limits"
    text += f"; lifted with more [N m | N]: {', '.join(lifted)}" if lifted else ""
    weights = [f"{name} ({rows[name]['weight']:.2g})" for name in heavy]
    return text + (f"; too heavy for it [N m | N]: {', '.join(weights)}" if weights else "")


def _pulls(model: mujoco.MjModel, joint: int, others: FloatArray, span: tuple[float, float]) -> FloatArray:
    """(_STOPS,) what holds a joint against gravity on its way [N*m | N]."""
    import mujoco

    data, dof, found = mujoco.MjData(model), int(model.jnt_dofadr[joint]), list[float]()
    for position in np.linspace(*span, _STOPS):
        data.qpos[:] = others
        data.qpos[model.jnt_qposadr[joint]] = position
        mujoco.mj_forward(model, data)
        found.append(float(data.qfrc_bias[dof]))
    return np.array(found)


def _reach(model: mujoco.MjModel, joint: int, others: FloatArray) -> float:
    """How far what a hinge moves reaches from its axis [m]."""
    import mujoco

    data, body, farthest = mujoco.MjData(model), int(model.jnt_bodyid[joint]), 0.0
    data.qpos[:] = others
    mujoco.mj_kinematics(model, data)
    inside = subtree(model, body)
    for geom in (g for g in range(model.ngeom) if inside[int(model.geom_bodyid[g])]):
        middle, half = model.geom_aabb[geom].reshape(2, 3)
        corners = middle + half * _CORNERS
        away = corners @ data.geom_xmat[geom].reshape(3, 3).T + data.geom_xpos[geom] - data.xanchor[joint]
        farthest = max(farthest, float(np.linalg.norm(np.cross(away, data.xaxis[joint]), axis=1).max()))
    return farthest


def _anchor(subject: Subject, name: str) -> Vec3:
    """Where a joint is at rest [m]."""
    return next(link.origin for link in subject.simulation.mechanism.links if link.name == name)
