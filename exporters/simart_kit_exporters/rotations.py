"""Rotations in the forms that formats write: angles about fixed axes, and quaternions."""

from __future__ import annotations

import numpy as np

from simart_kit.arrays import FloatArray, Vec3


def roll_pitch_yaw(rotation: FloatArray) -> Vec3:
    """Angles [rad] about the fixed x, y and z axes, in that order, of a (3, 3) rotation, as URDF writes them.

    Yaw is undone before roll is read off. That is exact also where pitch is a right angle: yaw and roll then
    turn about the same line, and roll takes what yaw leaves.
    """
    yaw = np.arctan2(rotation[1, 0], rotation[0, 0])
    cosine, sine = np.cos(yaw), np.sin(yaw)
    x_row = cosine * rotation[0] + sine * rotation[1]
    y_row = cosine * rotation[1] - sine * rotation[0]
    pitch = np.arctan2(-rotation[2, 0], x_row[0])
    roll = np.arctan2(-y_row[2], y_row[1])
    return (float(roll), float(pitch), float(yaw))
