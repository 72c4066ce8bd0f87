"""Check `energy`: with nothing that takes energy out, none is lost or won."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from pydantic import Field

from ..stages import Check
from ..stages import Options as StageOptions
from . import CheckResult
from .subject import Subject

if TYPE_CHECKING:
    import mujoco

    from ..arrays import FloatArray

# Downwards alone it would not move doors and drawers.
SLANTED_GRAVITY = (5.7, 5.7, -5.7)  # [m/s^2]


class Energy(Check):
    """Joints swing freely without friction, damping, limits and contacts, under a gravity that all feel."""

    name = "energy"

    class Options(StageOptions):
        """How long, how fast, how exact."""

        seconds: float = Field(default=1.0, gt=0, le=60, description="How long it swings [s].")
        speed: float = Field(default=1.0, gt=0, description="Of hinges at the start; slides a fifth [rad/s].")
        drift: float = Field(
            default=1e-6, gt=0, description="Of the energy, at most [largest kinetic energy]."
        )

    options: Options

    def check(self, subject: Subject) -> CheckResult:
        """The largest change of the energy."""
        model = subject.simulation.fresh()
        if model.nv == 0:
            return CheckResult(self.name, True, "static: nothing swings")
        drift = _drift(model, self.options)
        text = f"energy changes by {drift:.1e} of what moves"
        return CheckResult(self.name, drift <= self.options.drift, text, {"drift": drift})


def _drift(model: mujoco.MjModel, options: Energy.Options) -> float:
    import mujoco

    off = mujoco.mjtDisableBit
    for bit in (off.mjDSBL_CONTACT, off.mjDSBL_FRICTIONLOSS, off.mjDSBL_LIMIT, off.mjDSBL_ACTUATION):
        model.opt.disableflags |= int(bit)
    model.opt.enableflags |= int(mujoco.mjtEnableBit.mjENBL_ENERGY)
    model.opt.integrator = int(mujoco.mjtIntegrator.mjINT_RK4)
    model.opt.timestep = min(model.opt.timestep, 0.001)
    model.dof_damping[:] = 0.0
    model.opt.gravity[:] = SLANTED_GRAVITY
    data = mujoco.MjData(model)
    data.qvel[:] = start_speeds(model, options.speed)
    mujoco.mj_forward(model, data)
    energies = []
    for _ in range(round(options.seconds / model.opt.timestep / 5)):
        mujoco.mj_step(model, data, nstep=5)
        mujoco.mj_forward(model, data)
        energies.append(np.array(data.energy))
    potential, kinetic = np.array(energies).T
    total = potential + kinetic
    return float(np.abs(total - total[0]).max() / max(kinetic.max(), 1e-12))


def start_speeds(model: mujoco.MjModel, speed: float) -> FloatArray:
    """(nv,) the first of each joint's velocities at a speed [rad/s]; of slides a fifth of it [m/s]."""
    import mujoco

    found, slide = np.zeros(model.nv), int(mujoco.mjtJoint.mjJNT_SLIDE)
    for joint in range(model.njnt):
        found[model.jnt_dofadr[joint]] = speed * (0.2 if int(model.jnt_type[joint]) == slide else 1.0)
    return found
