"""Check `travel`: each joint can be driven through its whole range, with contacts on."""

from __future__ import annotations

from pydantic import Field

from ..arrays import FloatArray
from ..stages import Check
from ..stages import Options as StageOptions
from . import CheckResult
from .names import joint_name
from .subject import Subject
from .ways import told


class Travel(Check):
    """A motor without friction drives each joint from rest to both ends, others at rest or out of its way."""

    name = "travel"
    drives = True

    class Options(StageOptions):
        """How fast."""

        seconds: float = Field(default=1.0, gt=0, le=60, description="For the whole range of a joint [s].")

    options: Options

    def check(self, subject: Subject) -> CheckResult:
        """Which ends are reached."""
        from ..bench.execution import joint_travels
        from ..bench.mujoco_loading import quiet_mujoco

        simulation, waits = subject.simulation, dict[str, tuple[str, ...]]()

        def way(joint: int) -> FloatArray:
            found = simulation.ways.way(joint)
            waits[joint_name(simulation.model, joint)] = found.opened
            return found.positions

        with quiet_mujoco():
            found = joint_travels(simulation.fresh(), self.options.seconds, way)
        wrong = [f"{joint.name} {joint.reason}" for joint in found if joint.reason]
        waited = {j.name: waits[j.name] for j in found if not j.reason and waits.get(j.name)}
        sound = f"{len(found)} joints reach both ends" if found else "static: nothing travels"
        rows = {j.name: {"lower": j.reached_lower, "upper": j.reached_upper} for j in found}
        text = "; ".join(wrong) or sound + told(waited)
        return CheckResult(self.name, not wrong, text, {"joints": rows, "waits": waited})
