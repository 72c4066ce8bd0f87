"""What a stage may do beyond its one method: take a spec or help in, and tell how it came to its joints."""

from __future__ import annotations

from typing import Protocol, runtime_checkable

from ..asset import Joint
from ..beside import ALONE, Beside
from ..mesh import Mesh
from ..stages import JointPredictor, Prediction, Segmentation, Segmenter
from .values import Spec


@runtime_checkable
class SpecSegmenter(Protocol):
    """A segmenter that may find other parts where a spec says so."""

    def segment_to(self, mesh: Mesh, spec: Spec) -> Segmentation:
        """What `segment` says where that is as stated, else what comes nearest to it."""


@runtime_checkable
class HelpedSegmenter(Protocol):
    """A segmenter that can let another process do some of what takes long."""

    def segment_beside(self, mesh: Mesh, spec: Spec | None, beside: Beside) -> Segmentation:
        """The same as `segment` gives, or `segment_to` where there is a spec."""


@runtime_checkable
class SpecPredictor(Protocol):
    """A joint predictor that may choose other joints where a spec says so."""

    def predict_to(self, mesh: Mesh, segmentation: Segmentation, spec: Spec) -> tuple[Joint, ...]:
        """What `predict` says where that is as stated, else what comes nearest to it."""


@runtime_checkable
class TellingPredictor(Protocol):
    """A joint predictor that has notes, evidence or usage beside its joints."""

    def prediction(self, mesh: Mesh, segmentation: Segmentation, spec: Spec | None) -> Prediction:
        """What `predict` says, or `predict_to` where there is a spec, and how it came about."""


def segment_by(stage: Segmenter, mesh: Mesh, spec: Spec | None, beside: Beside = ALONE) -> Segmentation:
    """What a segmenter says, and of a spec if it takes one in, with help if it takes any."""
    if isinstance(stage, HelpedSegmenter):
        return stage.segment_beside(mesh, spec, beside)
    if spec is not None and isinstance(stage, SpecSegmenter):
        return stage.segment_to(mesh, spec)
    return stage.segment(mesh)


def predict_by(
    stage: JointPredictor, mesh: Mesh, segmentation: Segmentation, spec: Spec | None
) -> tuple[Joint, ...]:
    """What a joint predictor says, and of a spec if it takes one in."""
    if spec is not None and isinstance(stage, SpecPredictor):
        return stage.predict_to(mesh, segmentation, spec)
    return stage.predict(mesh, segmentation)


def prediction_by(
    stage: JointPredictor, mesh: Mesh, segmentation: Segmentation, spec: Spec | None
) -> Prediction:
    """What a joint predictor says, and how it came to it if it tells."""
    if isinstance(stage, TellingPredictor):
        return stage.prediction(mesh, segmentation, spec)
    return Prediction(predict_by(stage, mesh, segmentation, spec))
