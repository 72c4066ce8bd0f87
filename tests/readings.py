"""What readers of exported files report, whatever the format."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Inertial:
    """Mass [kg], centre (3,) [m] and inertia (3, 3) about it [kg*m^2], in the frame that its reader names."""

    mass: float
    center: Array
    inertia: Array
