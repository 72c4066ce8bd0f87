"""placo: URDF on Pinocchio, as its solvers for humanoids load it."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import placo
from verdict import Positions, Reading, main, rows


def read(path: Path, positions: Positions) -> Reading:
    """What the robot says; placo wants an absolute path."""
    robot = placo.RobotWrapper(str(path.resolve()))
    joints = list(robot.joint_names())
    return {
        "errors": [],
        "poses": [poses(robot, joints, at) for at in positions],
        "limits": {name: limits(robot, name) for name in joints},
    }


def poses(robot: Any, joints: list[str], positions: Mapping[str, float]) -> dict[str, Any]:
    """Pose of every link at joint positions."""
    for name in joints:
        robot.set_joint(name, positions.get(name, 0.0))
    robot.update_kinematics()
    links = [frame.name for frame in robot.model.frames if str(frame.type) == "BODY"]
    return {name: rows(robot.get_T_world_frame(name)) for name in links if name != "universe"}


def limits(robot: Any, joint: str) -> list[float] | None:
    """Range of a joint, or None where it turns for ever."""
    lower, upper = rows(robot.get_joint_limits(joint))
    return None if lower == -float("inf") and upper == float("inf") else [lower, upper]


if __name__ == "__main__":
    main(read)
