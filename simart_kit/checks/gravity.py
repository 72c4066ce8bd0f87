"""Check `gravity`: what is opened half way and let go stays there, unless its weight says otherwise."""

from __future__ import annotations

from collections.abc import Mapping
from concurrent.futures import ThreadPoolExecutor
from functools import partial
from typing import TYPE_CHECKING, Any

from pydantic import Field

from ..arrays import FloatArray
from ..bench.mujoco_driving import rest_positions
from ..machine import usable_cores
from ..stages import Check
from ..stages import Options as StageOptions
from . import CheckResult
from .names import joint_name
from .subject import Subject
from .ways import told

if TYPE_CHECKING:
    import mujoco


class Gravity(Check):
    """Joints at mid-range hold for two seconds; those whose weight exceeds their friction are listed."""

    name = "gravity"

    class Options(StageOptions):
        """How long, and how far."""

        seconds: float = Field(default=2.0, gt=0, le=60, description="How long it has to hold [s].")
        drift: float = Field(
            default=0.02, gt=0, le=1, description="Of a joint, at most [share of its range]."
        )
        slack: float = Field(
            default=1e-4,
            ge=0,
            description="And as far in any case: a solver's friction creeps [rad | m].",
        )

    options: Options

    def check(self, subject: Subject) -> CheckResult:
        """Each joint alone, the others at rest, or out of its way where it does not hold so."""
        from .simulation import ranges

        model = subject.simulation.model
        rows, waits = dict[str, dict[str, Any]](), dict[str, tuple[str, ...]]()
        spans: dict[str, tuple[float, float]] = {}
        found, rest = ranges(model), rest_positions(model)
        alone = partial(_held, model, seconds=self.options.seconds, others=rest)
        with ThreadPoolExecutor(usable_cores()) as pool:  # MuJoCo steps without the interpreter
            rested = list(pool.map(alone, found, found.values()))
        for (joint, span), row in zip(found.items(), rested, strict=True):
            name, way = joint_name(model, joint), None
            spans[name], rows[name] = span, row
            if not self._holds(row, span):
                way = subject.simulation.ways.way(joint)
            if way and way.opened:
                held = _held(model, joint, span, self.options.seconds, way.positions)
                if self._holds(held, span):
                    rows[name], waits[name] = held, way.opened
        moved = {name: rows[name] for name, span in spans.items() if not self._holds(rows[name], span)}
        # Weight explains a fall only where it is more than dry friction can hold.
        wrong = [name for name, row in moved.items() if row["weight"] <= row["friction"]]
        falls = [name for name in moved if name not in wrong]
        text = f"drifts, and not by its weight: {', '.join(wrong)}" if wrong else f"{len(rows)} joints hold"
        if not rows:
            text = "static: nothing can droop"
        if falls:
            text += f"; by its own weight falls: {', '.join(falls)}"
        return CheckResult(self.name, not wrong, text + told(waits), {"joints": rows, "waits": waits})

    def _holds(self, row: Mapping[str, float], span: tuple[float, float]) -> bool:
        """Whether a joint is where it was let go; what is not a number is not."""
        most = max(self.options.drift, self.options.slack / (span[1] - span[0]))
        return row["drift"] <= most


def _held(
    model: mujoco.MjModel, joint: int, span: tuple[float, float], seconds: float, others: FloatArray
) -> dict[str, Any]:
    """How far a joint drifts from mid-range, what gravity does there and what friction can hold."""
    import mujoco

    data, dof = mujoco.MjData(model), int(model.jnt_dofadr[joint])
    address = int(model.jnt_qposadr[joint])
    start = (span[0] + span[1]) / 2
    data.qpos[:] = others
    data.qpos[address] = start
    mujoco.mj_forward(model, data)
    weight = abs(float(data.qfrc_bias[dof]))
    mujoco.mj_step(model, data, nstep=round(seconds / model.opt.timestep))
    return {
        "drift": abs(float(data.qpos[address]) - start) / (span[1] - span[0]),
        "weight": weight,
        "friction": float(model.dof_frictionloss[dof]),
    }
