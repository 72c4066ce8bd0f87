"""Check `timestep`: half the time step gives the same motion."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from pydantic import Field

from ..stages import Check
from ..stages import Options as StageOptions
from . import CheckResult
from .energy import start_speeds
from .subject import Subject

if TYPE_CHECKING:
    import mujoco

    from ..arrays import FloatArray


class Timestep(Check):
    """Given a swing at mid-range, joints come as far with steps of 2 ms as with those of 1 ms.

    Contact is off where half-open parts stand in each other: these would burst apart, and not move.
    """

    name = "timestep"

    class Options(StageOptions):
        """How long, and how near."""

        seconds: float = Field(default=1.0, gt=0, le=60, description="How long it moves [s].")
        speed: float = Field(default=0.3, ge=0, description="Of hinges at the start; slides a fifth [rad/s].")
        step: float = Field(default=0.002, gt=0, le=0.1, description="The longer time step [s].")
        difference: float = Field(default=1e-3, gt=0, description="Of positions in the end [rad | m].")

    options: Options

    def check(self, subject: Subject) -> CheckResult:
        """The largest difference of a joint."""
        model = subject.simulation.fresh()
        if model.nv == 0:
            return CheckResult(self.name, True, "static: no step is too long")
        _without_bursting(model)
        step, seconds = self.options.step, self.options.seconds
        swing = start_speeds(model, self.options.speed)
        longer, shorter = (_end(model, swing, dt, seconds) for dt in (step, step / 2))
        found = float(np.abs(longer - shorter).max())
        text = f"steps of {step * 1000:g} and {step * 500:g} ms differ by {found:.1e}"
        return CheckResult(self.name, found <= self.options.difference, text, {"difference": found})


def _without_bursting(model: mujoco.MjModel) -> None:
    """Contact off if half-open parts stand in each other, such as the propellers of a drone half unfolded."""
    import mujoco

    from .simulation import middle
    from .ways import meet

    data = mujoco.MjData(model)
    data.qpos[:] = middle(model)
    meet(model, data)
    if (data.contact.dist < 0).any():
        model.opt.disableflags |= int(mujoco.mjtDisableBit.mjDSBL_CONTACT)


def _end(model: mujoco.MjModel, swing: FloatArray, step: float, seconds: float) -> FloatArray:
    """(nq,) positions after a while from mid-range."""
    import mujoco

    from .simulation import middle

    model.opt.timestep = step
    data = mujoco.MjData(model)
    data.qpos[:], data.qvel[:] = middle(model), swing
    mujoco.mj_step(model, data, nstep=round(seconds / step))
    return np.array(data.qpos)
