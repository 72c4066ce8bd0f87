"""Check `travel`: each joint can be driven through its whole range, with contacts on."""

from __future__ import annotations

from pydantic import Field

from ..stages import Check
from ..stages import Options as StageOptions
from . import CheckResult
from .subject import Subject


class Travel(Check):
    """A motor without friction drives each joint from rest to both ends, the others at rest or open."""

    name = "travel"

    class Options(StageOptions):
        """How fast."""

        seconds: float = Field(default=1.0, gt=0, le=60, description="For the whole range of a joint [s].")

    options: Options

    def check(self, subject: Subject) -> CheckResult:
        """Which ends are reached."""
        from ..bench.execution import joint_travels
        from ..bench.mujoco_loading import quiet_mujoco

        with quiet_mujoco():
            found = joint_travels(subject.simulation.fresh(), self.options.seconds, others_open=True)
        wrong = [f"{joint.name} {joint.reason}" for joint in found if joint.reason]
        sound = f"{len(found)} joints reach both ends" if found else "static: nothing travels"
        rows = {j.name: {"lower": j.reached_lower, "upper": j.reached_upper} for j in found}
        return CheckResult(self.name, not wrong, "; ".join(wrong) or sound, {"joints": rows})
