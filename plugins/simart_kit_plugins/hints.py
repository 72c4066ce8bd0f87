"""Joint predictor `hints`: takes the joints of a model that predicts parts and joints at once."""

from __future__ import annotations

from typing import TYPE_CHECKING

from simart_kit import JointPredictor, Segmentation, hookimpl

if TYPE_CHECKING:
    from simart_kit import Joint, Mesh
    from simart_kit.hookspecs import Register


class Hints(JointPredictor):
    """Passes the segmenter's own joint hints on."""

    name = "hints"

    def predict(self, mesh: Mesh, segmentation: Segmentation) -> tuple[Joint, ...]:
        """The hints; raises ValueError when the segmenter gave none."""
        if segmentation.joints is None:
            raise ValueError(
                "the segmenter gave no joint hints: choose another joint predictor, such as geometric"
            )
        return segmentation.joints


@hookimpl
def register_joint_predictors(register: Register) -> None:
    """Register `hints`."""
    register(Hints)
