"""Check `realtime`: simulation runs much faster than the clock."""

from __future__ import annotations

import time

from pydantic import Field

from ..stages import Check
from ..stages import Options as StageOptions
from . import CheckResult
from .subject import Subject

# Many short tries: what else the processor does slows it to a half or less, and rarely all the time.
_TRIES, _SETTLING = 100, 0.5  # [s] of simulated time before the first


class Realtime(Check):
    """Resting on a floor it simulates many times as fast as time passes.

    What was measured is told only when it is too slow: a report of two runs is the same to the byte.
    """

    name = "realtime"

    class Options(StageOptions):
        """How fast."""

        factor: float = Field(default=20.0, gt=0, description="Simulated time over processor time, at least.")
        seconds: float = Field(default=0.1, gt=0, le=60, description="Simulated time of a try [s].")

    options: Options

    def check(self, subject: Subject) -> CheckResult:
        """The best of many tries, one after the other, until one is fast enough."""
        import mujoco

        model, best = subject.simulation.dropped(0.0), 0.0
        data, steps = mujoco.MjData(model), max(round(self.options.seconds / model.opt.timestep), 1)
        mujoco.mj_step(model, data, nstep=round(_SETTLING / model.opt.timestep))
        for _ in range(_TRIES):
            start = time.thread_time()
            mujoco.mj_step(model, data, nstep=steps)
            best = max(best, steps * model.opt.timestep / max(time.thread_time() - start, 1e-9))
            if best >= self.options.factor:
                text = f"more than {self.options.factor:g} times as fast as time"
                return CheckResult(self.name, True, text, {"factor": self.options.factor})
        text = f"only {best:.3g} times as fast as time: fewer collision shapes help"
        return CheckResult(self.name, False, text, {"factor": self.options.factor, "measured": best})
