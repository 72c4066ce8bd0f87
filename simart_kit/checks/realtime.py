"""Check `realtime`: simulation runs much faster than the clock."""

from __future__ import annotations

import time

from pydantic import Field

from ..stages import Check
from ..stages import Options as StageOptions
from . import CheckResult
from .subject import Subject

_TRIES = 12  # what else the processor does slows some of them


class Realtime(Check):
    """Resting on a floor it simulates many times as fast as time passes.

    What was measured is told only when it is too slow: a report of two runs is the same to the byte.
    """

    name = "realtime"

    class Options(StageOptions):
        """How fast."""

        factor: float = Field(default=20.0, gt=0, description="Simulated time over processor time, at least.")
        seconds: float = Field(default=0.5, gt=0, le=60, description="Simulated time of a try [s].")

    options: Options

    def check(self, subject: Subject) -> CheckResult:
        """The best of a few tries."""
        import mujoco

        model, best = subject.simulation.dropped(0.0), 0.0
        for _ in range(_TRIES):
            data = mujoco.MjData(model)
            start = time.thread_time()
            mujoco.mj_step(model, data, nstep=round(self.options.seconds / model.opt.timestep))
            best = max(best, self.options.seconds / max(time.thread_time() - start, 1e-9))
            if best >= self.options.factor:
                text = f"more than {self.options.factor:g} times as fast as time"
                return CheckResult(self.name, True, text, {"factor": self.options.factor})
        text = f"only {best:.3g} times as fast as time: fewer collision shapes help"
        return CheckResult(self.name, False, text, {"factor": self.options.factor, "measured": best})
