"""Readers of truths and predictions. A format is one file with one class; the two tuples below list them."""

from __future__ import annotations

from abc import ABC, abstractmethod
from pathlib import Path
from typing import ClassVar

from ...errors import BadInputError
from ..cases import Prediction, Truth

DEFAULT_VARIANT = "input"


class TruthFormat(ABC):
    """Reads objects whose parts and joints are known.

    Attributes:
        name: of the format.
        layout: one line: which files make an object.
    """

    name: ClassVar[str]
    layout: ClassVar[str]

    @abstractmethod
    def find(self, root: Path) -> dict[str, Path]:
        """The objects of this format below a folder (or that the path itself is): file or folder by name.

        Names are unique, of the object alone (no path), and in a fixed order. Empty when there is none. Only
        looks at file names: a damaged object is found and then fails to be read.
        """

    @abstractmethod
    def read(self, path: Path, variant: str = DEFAULT_VARIANT) -> Truth:
        """Read one object.

        Args:
            path: as `find` gave it.
            variant: which mesh of the object, where the format has several; others raise BadInputError.

        Raises:
            BadInputError: a file is missing, damaged or does not fit the others; names the file.
        """


class PredictionFormat(ABC):
    """Reads what a system predicted for an object.

    Attributes:
        name: of the format.
        layout: one line: which files make a prediction.
        knows_frame: whether the files tell the way to the frame of the truth, so that `read` goes it.
    """

    name: ClassVar[str]
    layout: ClassVar[str]
    knows_frame: ClassVar[bool] = False

    @abstractmethod
    def find(self, root: Path, name: str) -> Path | None:
        """The prediction for the object of this name in a folder of predictions; None when there is none."""

    @abstractmethod
    def read(self, path: Path, truth: Truth) -> Prediction:
        """Read one prediction: in the frame of the truth if its files tell the way there, else in their own.

        Raises:
            BadInputError: a file is missing, damaged or does not fit the truth; names the file.
        """


def truth_formats() -> tuple[TruthFormat, ...]:
    """All formats of truths; of those that find an object, the first reads it."""
    from .mjcf import MjcfTruth
    from .particulate import ParticulateTruth
    from .partnet_mobility import PartNetMobility
    from .physxnet import PhysXNet
    from .simart_bench import SimartBench
    from .urdf import UrdfTruth

    return (SimartBench(), PartNetMobility(), PhysXNet(), ParticulateTruth(), UrdfTruth(), MjcfTruth())


def prediction_formats() -> tuple[PredictionFormat, ...]:
    """All formats of predictions; of those that find an object, the first reads it."""
    from .articulate_anymesh import ArticulateAnyMesh
    from .labels import LabelArray
    from .output_folder import OutputFolder
    from .particulate import ParticulatePrediction
    from .urdf import UrdfPrediction

    return (OutputFolder(), ParticulatePrediction(), ArticulateAnyMesh(), UrdfPrediction(), LabelArray())


def find_truths(root: Path) -> dict[str, tuple[TruthFormat, Path]]:
    """Every object below a folder, in the order of names.

    Raises:
        BadInputError: there is none, or no such folder; says which formats were looked for.
    """
    found: dict[str, tuple[TruthFormat, Path]] = {}
    if not root.exists():
        raise BadInputError(f"no such folder: {root}")
    for reader in truth_formats():
        for name, path in reader.find(root).items():
            found.setdefault(name, (reader, path))
    if not found:
        known = "; ".join(f"{reader.name}: {reader.layout}" for reader in truth_formats())
        raise BadInputError(f"{root} holds no object with ground truth: looked for {known}")
    return dict(sorted(found.items()))


def find_prediction(root: Path, name: str) -> tuple[PredictionFormat, Path]:
    """Who reads the prediction for an object, and where it is.

    Raises:
        BadInputError: there is none, or a folder where it is not clear which file is meant.
    """
    for reader in prediction_formats():
        path = reader.find(root, name)
        if path is not None:
            return reader, path
    raise BadInputError(f"no prediction for '{name}' in {root}")
