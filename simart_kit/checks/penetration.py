"""Check `penetration`: at rest no two bodies are inside each other, whatever the file excludes."""

from __future__ import annotations

from typing import TYPE_CHECKING

from pydantic import Field

from ..stages import Check
from ..stages import Options as StageOptions
from . import CheckResult, Fault
from .subject import Subject

if TYPE_CHECKING:
    import mujoco

    from .simulation import Contact


class Penetration(Check):
    """Shapes of different bodies do not overlap at rest, with all excludes of the format taken away."""

    name = "penetration"

    class Options(StageOptions):
        """How deep is too deep: either of the two is allowed."""

        depth: float = Field(default=0.001, ge=0, description="Deepest overlap [m].")
        share: float = Field(default=0.005, ge=0, description="The same, of the object's diagonal.")

    options: Options

    def check(self, subject: Subject) -> CheckResult:
        """The deepest contact of each pair of bodies."""
        model = subject.simulation.unfiltered()
        found = sorted(_at_rest(model).values(), key=lambda c: (-c.depth, c.pair))
        allowed = max(self.options.depth, self.options.share * subject.simulation.mechanism.diagonal)
        deep = [c for c in found if c.depth > allowed]
        rows = [{"pair": list(c.pair), "depth": round(c.depth, 6)} for c in found]
        listed = ", ".join(f"{c.pair[0]} in {c.pair[1]} by {c.depth * 1000:.3g} mm" for c in deep)
        deepest = f"the deepest by {found[0].depth * 1000:.2g} mm" if found else "nothing touches"
        text = f"overlap at rest: {listed}" if deep else f"no overlap at rest: {deepest}"
        fault = Fault({}, deep[0].point, deep[0].depth, " in ".join(deep[0].pair)) if deep else None
        return CheckResult(self.name, not deep, text, {"allowed": allowed, "contacts": rows}, fault)


def _at_rest(model: mujoco.MjModel) -> dict[tuple[str, str], Contact]:
    import mujoco

    from ..bench.mujoco_driving import rest_positions
    from .simulation import contacts
    from .ways import meet

    data = mujoco.MjData(model)
    data.qpos[:] = rest_positions(model)
    meet(model, data)
    return contacts(model, data)
