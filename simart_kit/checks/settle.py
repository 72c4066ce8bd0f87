"""Check `settle`: dropped on a floor with a free base, the object comes to rest upright."""

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


class Settle(Check):
    """Dropped from 2 cm it rests after three seconds, upright, on the floor, and nothing broke."""

    name = "settle"

    class Options(StageOptions):
        """The drop and what is at rest."""

        height: float = Field(default=0.02, ge=0, description="Of the drop [m].")
        seconds: float = Field(default=3.0, gt=0, le=60, description="Until it must be at rest [s].")
        speed: float = Field(default=1e-3, gt=0, description="Of the base at rest, at most [m/s].")
        tilt: float = Field(default=1.0, gt=0, description="Of the base, at most [degrees].")
        sink: float = Field(default=0.005, gt=0, description="Lower or higher than it stood, at most [m].")

    options: Options

    def check(self, subject: Subject) -> CheckResult:
        """Speed, tilt and height of the base in the end, and MuJoCo's warnings."""
        model = subject.simulation.dropped(self.options.height)
        if not _free_joints(model):
            return CheckResult(self.name, True, "joints hang on the world: there is no base to drop")
        found = _drop(model, self.options)
        bad = {
            f"MuJoCo warned {found['warnings']:g} times": found["warnings"] > 0,
            f"it still moves at {found['speed']:.2g} m/s": not found["speed"] <= self.options.speed,
            f"it tilts by {found['tilt']:.2g} degrees": not found["tilt"] <= self.options.tilt,
            f"it is {found['sink'] * 1000:.3g} mm lower than it stood": (
                not abs(found["sink"]) <= self.options.sink
            ),
        }
        wrong = [text for text, is_wrong in bad.items() if is_wrong]
        sound = f"at rest {self.options.seconds:g} s after a drop from {self.options.height * 100:g} cm"
        return CheckResult(self.name, not wrong, "; ".join(wrong) or sound, found)


def _drop(model: mujoco.MjModel, options: Settle.Options) -> dict[str, float]:
    """What became of the base, which is the heaviest of things that lie or stand loose."""
    import mujoco

    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    base = max(_free_joints(model), key=lambda joint: model.body_subtreemass[model.jnt_bodyid[joint]])
    then, then_up = _pose(model, data, base)
    mujoco.mj_step(model, data, nstep=round(options.seconds / model.opt.timestep))
    (height, up), dof = _pose(model, data, base), model.jnt_dofadr[base]
    return {
        "speed": float(np.linalg.norm(data.qvel[dof : dof + 3])),
        "tilt": float(np.degrees(np.arctan2(np.linalg.norm(np.cross(up, then_up)), up @ then_up))),
        "sink": then - options.height - height,
        "warnings": float(data.warning.number.sum()),
    }


def _free_joints(model: mujoco.MjModel) -> list[int]:
    import mujoco

    return [j for j in range(model.njnt) if int(model.jnt_type[j]) == int(mujoco.mjtJoint.mjJNT_FREE)]


def _pose(model: mujoco.MjModel, data: mujoco.MjData, joint: int) -> tuple[float, FloatArray]:
    """Height of a free base [m], and (3,) what is up for it, in its own coordinates."""
    body = model.jnt_bodyid[joint]
    return float(data.xpos[body][2]), np.array(data.xmat[body].reshape(3, 3)[2])
