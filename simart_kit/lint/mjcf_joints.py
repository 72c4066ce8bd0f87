"""MJCF joints: ranges and signs, with the defaults of their classes filled in."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from .findings import Finding
from .mjcf_bodies import named
from .numbers import limit_findings, sign_findings

if TYPE_CHECKING:
    import mujoco


def joint_findings(spec: mujoco.MjSpec) -> Iterator[Finding]:
    """Breaches by the joints of a model."""
    import mujoco

    one_axis = (int(mujoco.mjtJoint.mjJNT_HINGE), int(mujoco.mjtJoint.mjJNT_SLIDE))
    for joint in spec.joints:
        name = joint.name or f"joint of {named(joint.parent)}"
        signs = {"frictionloss": float(joint.frictionloss), "armature": float(joint.armature)}
        signs["damping"] = float(np.min(joint.damping))
        yield from sign_findings("damping-negative", name, signs)
        if int(joint.type) in one_axis:
            yield from _range_findings(joint, name)


def _range_findings(joint: mujoco.MjsJoint, name: str) -> Iterator[Finding]:
    import mujoco

    lower, upper = (float(value) for value in joint.range)
    if lower == upper:  # of no effect, or refused by MuJoCo itself
        return
    if int(joint.limited) == int(mujoco.mjtLimited.mjLIMITED_FALSE):
        text = f"its range {lower:g} {upper:g} is not in force: set limited, or drop it"
        yield Finding("limit-unused", name, text)
    else:
        yield from limit_findings(name, lower, upper, float(joint.ref))
