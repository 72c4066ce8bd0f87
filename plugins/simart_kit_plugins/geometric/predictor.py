"""Joint predictor `geometric`: imported at every start, so that it imports nothing of its own."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from pydantic import Field

import simart_kit
from simart_kit import JointPredictor

if TYPE_CHECKING:
    from simart_kit import Joint, Mesh, Segmentation
    from simart_kit.spec.values import Spec


class GeometricJoints(JointPredictor):
    """A joint for every part but the body, from geometry and the part's label.

    Works with any segmenter. Labels such as "drawer" or "door" count as evidence beside the shape.
    """

    name = "geometric"

    class Options(simart_kit.Options):
        """How far things open where nothing stops them."""

        open_angle: float = Field(default=90.0, gt=0, le=180, description="Travel of a hinge [degrees].")

    options: Options

    def predict(self, mesh: Mesh, segmentation: Segmentation) -> tuple[Joint, ...]:
        """Joints from the body, or from the part that carries a part, to every part."""
        return self._predicted(mesh, segmentation, None)

    def predict_to(self, mesh: Mesh, segmentation: Segmentation, spec: Spec) -> tuple[Joint, ...]:
        """As `predict`; where a spec states another kind or axis, the best of the candidates that fit."""
        return self._predicted(mesh, segmentation, spec)

    def _predicted(self, mesh: Mesh, segmentation: Segmentation, spec: Spec | None) -> tuple[Joint, ...]:
        from .joints import joints_of

        return joints_of(mesh, segmentation, spec, float(np.deg2rad(self.options.open_angle)))
