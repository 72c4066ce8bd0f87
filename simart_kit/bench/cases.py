"""Truth and Prediction: what a reader makes of files, and what a protocol compares."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from ..mesh import UpAxis
from .articulation import Articulation


@dataclass(frozen=True, eq=False)
class Truth:
    """An object whose parts and joints are known.

    Attributes:
        name: of the object, unique in its data set.
        articulation: in the frame of `mesh`.
        category: such as "cabinet", or "".
        mesh: the file to convert; None where the format has no single mesh.
        up: which axis of the frame points up.
        metres_per_unit: length of a unit [m]; None where nobody said.
        notes: what the reader decided or could not take over.
    """

    name: str
    articulation: Articulation
    category: str = ""
    mesh: Path | None = None
    up: UpAxis = "+y"
    metres_per_unit: float | None = 1.0
    notes: tuple[str, ...] = ()


@dataclass(frozen=True, eq=False)
class Prediction:
    """What a system says about an object.

    Attributes:
        articulation: in the frame of the truth.
        simulator_file: URDF or MJCF file to load in a simulator, or None.
        notes: what the reader decided, such as how frames were matched.
    """

    articulation: Articulation
    simulator_file: Path | None = None
    notes: tuple[str, ...] = ()
