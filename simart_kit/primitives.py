"""Primitive collision shapes: what simulators test for contact fastest and most exactly."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, get_args

import numpy as np

from .arrays import FloatArray, Vec3, frozen_floats
from .errors import BadInputError

PrimitiveKind = Literal["box", "cylinder", "sphere"]

_ROUNDING = 1e-9 + 1e-5 * np.eye(3)  # of a rotation times its transpose


@dataclass(frozen=True, eq=False)
class Primitive:
    """A box, a cylinder along its own z, or a sphere.

    Attributes:
        kind: one of `PrimitiveKind`.
        size: (3,) extents along its own axes [m]; of a cylinder diameter, diameter, height; of a sphere
            its diameter three times.
        asset_T_shape: (4, 4) pose of its middle in the asset frame at rest, a rotation and a shift.

    Raises:
        BadInputError: an unknown kind, a size that is not positive, unequal diameters, or no rigid pose.
    """

    kind: PrimitiveKind
    size: Vec3
    asset_T_shape: FloatArray

    def __post_init__(self) -> None:
        object.__setattr__(self, "asset_T_shape", frozen_floats(self.asset_T_shape))
        if self.kind not in get_args(PrimitiveKind):
            raise BadInputError(f"shape '{self.kind}' is not one of {', '.join(get_args(PrimitiveKind))}")
        x, y, z = self.size
        round_ = {"box": True, "cylinder": x == y, "sphere": x == y == z}[self.kind]
        if not (min(self.size) > 0 and np.isfinite(self.size).all() and round_):
            raise BadInputError(f"a {self.kind} cannot have the size {self.size}")
        rotation = self.asset_T_shape[:3, :3]
        off = np.abs(rotation @ rotation.T - np.eye(3))
        if not ((off <= _ROUNDING).all() and np.linalg.det(rotation) > 0):
            raise BadInputError(f"the pose of a {self.kind} is no rotation and shift")

    @property
    def volume(self) -> float:
        """[m^3]."""
        box = float(np.prod(self.size))
        return box * {"box": 1.0, "cylinder": np.pi / 4, "sphere": np.pi / 6}[self.kind]
