"""Check `push`: a robot-sized push opens each joint, and its limit stops it."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from pydantic import Field

from ..arrays import FloatArray, Vec3
from ..bench.mujoco_driving import one_axis_joints, opened_positions, rest_positions
from ..stages import Check
from ..stages import Options as StageOptions
from . import CheckResult, Fault
from .names import joint_name
from .subject import Subject

if TYPE_CHECKING:
    import mujoco

_STOPS = 9  # where its weight is felt
_FIRM = 1.25  # times what holds a joint: weight grows on its way


class Push(Check):
    """Pushed to its farther limit from rest, each joint gets there and not beyond it.

    What weighs more on its joint than the push can lift is listed: no arm of that size opens it.
    """

    name = "push"

    class Options(StageOptions):
        """The push, and what is asked."""

        torque: float = Field(default=5.0, gt=0, description="On hinges, at most [N*m].")
        force: float = Field(default=20.0, gt=0, description="On slides, at most [N].")
        acceleration: float = Field(
            default=20.0,
            gt=0,
            description="Nobody pushes a light knob with a door's force: beyond what holds it, a joint gets "
            "no more than what moves it so [rad/s^2 | m/s^2].",
        )
        seconds: float = Field(default=8.0, gt=0, le=60, description="How long [s].")
        opens: float = Field(
            default=0.9, ge=0, le=1, description="How far it has to open [share of its range]."
        )
        overshoot: float = Field(default=0.01, gt=0, description="Beyond the limit, at most [rad | m].")

    options: Options

    def check(self, subject: Subject) -> CheckResult:
        """Each limited joint alone, the others at rest, or open where they hold it up."""
        model = subject.simulation.model
        joints = [j for j in one_axis_joints(model) if model.jnt_limited[j]]
        rows = {joint_name(model, j): self._opened(model, j) for j in joints}
        shut = [n for n, row in rows.items() if not row["opened"] >= self.options.opens]
        stuck = [n for n in shut if not rows[n]["weight"] > rows[n]["push"]]
        over = [n for n, row in rows.items() if not row["overshoot"] <= self.options.overshoot]
        texts = []
        if stuck:
            listed = ", ".join(f"{n} ({rows[n]['opened']:.0%})" for n in stuck)
            texts.append(f"{self.options.torque:g} N m or {self.options.force:g} N does not open {listed}")
        if over:
            listed = ", ".join(f"{n} by {rows[n]['overshoot']:.2g}" for n in over)
            texts.append(f"pushed over its limit: {listed}")
        heavy = [f"{n} ({rows[n]['weight']:.2g})" for n in shut if n not in stuck]
        sound = f"{len(rows) - len(heavy)} joints open at a push and stop at their limits"
        sound += f"; too heavy for it [N m | N]: {', '.join(heavy)}" if heavy else ""
        fault = (
            Fault({stuck[0]: rows[stuck[0]]["reached"]}, _anchor(subject, stuck[0]), 0.0, "stuck")
            if stuck
            else None
        )
        text = "; ".join(texts) or (sound if rows else "static: nothing to push")
        return CheckResult(self.name, not texts, text, {"joints": rows}, fault)

    def _opened(self, model: mujoco.MjModel, joint: int) -> dict[str, float]:
        row = self._pushed(model, joint, rest_positions(model))
        if row["opened"] >= self.options.opens:
            return row
        others_open = self._pushed(model, joint, opened_positions(model, joint))
        return others_open if others_open["opened"] >= self.options.opens else row

    def _pushed(self, model: mujoco.MjModel, joint: int, others: FloatArray) -> dict[str, float]:
        import mujoco

        data, dof = mujoco.MjData(model), int(model.jnt_dofadr[joint])
        address = int(model.jnt_qposadr[joint])
        hinge = int(model.jnt_type[joint]) == int(mujoco.mjtJoint.mjJNT_HINGE)
        data.qpos[:] = others
        lower, upper = (float(v) for v in model.jnt_range[joint])
        rest = float(data.qpos[address])
        sign = 1.0 if upper - rest >= rest - lower else -1.0
        limit = upper if sign > 0 else lower
        weight = _weight(model, joint, others, (lower, upper))
        data.qfrc_applied[dof] = sign * self._force(model, data, dof, hinge)
        most = rest
        for _ in range(round(self.options.seconds / model.opt.timestep / 10)):
            mujoco.mj_step(model, data, nstep=10)
            most = max(most, float(data.qpos[address]), key=lambda q: sign * q)
        # Bouncing back at the limit does not count against it.
        opened = (most - rest) / (limit - rest) if limit != rest else 1.0
        over = max(sign * (float(data.qpos[address]) - limit), 0.0)
        row = {"opened": min(opened, 1.0), "overshoot": over, "reached": most}
        return row | {"push": abs(float(data.qfrc_applied[dof])), "weight": weight}

    def _force(self, model: mujoco.MjModel, data: mujoco.MjData, dof: int, hinge: bool) -> float:
        """The push on a joint at rest [N*m | N]."""
        import mujoco

        mujoco.mj_forward(model, data)
        inertia = np.zeros(model.nv)
        mujoco.mj_mulM(model, data, inertia, np.eye(model.nv)[dof])
        holds = float(model.dof_frictionloss[dof]) + abs(float(data.qfrc_bias[dof]))
        enough = _FIRM * holds + self.options.acceleration * float(inertia[dof])
        return min(enough, self.options.torque if hinge else self.options.force)


def _weight(model: mujoco.MjModel, joint: int, others: FloatArray, span: tuple[float, float]) -> float:
    """What gravity does to a joint at most on its way [N*m | N]."""
    import mujoco

    data, dof, found = mujoco.MjData(model), int(model.jnt_dofadr[joint]), [0.0]
    for position in np.linspace(*span, _STOPS):
        data.qpos[:] = others
        data.qpos[model.jnt_qposadr[joint]] = position
        mujoco.mj_forward(model, data)
        found.append(abs(float(data.qfrc_bias[dof])))
    return max(found)


def _anchor(subject: Subject, name: str) -> Vec3:
    """Where a joint is at rest [m]."""
    return next(link.origin for link in subject.simulation.mechanism.links if link.name == name)
