"""Names in a MuJoCo model, where a file of others may have none."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import mujoco


def body_name(model: mujoco.MjModel, body: int) -> str:
    """Of a body; its number where it has no name."""
    return str(model.body(body).name) or f"body {body}"


def joint_name(model: mujoco.MjModel, joint: int) -> str:
    """Of a joint; its number where it has no name."""
    return str(model.joint(joint).name) or f"joint {joint}"
