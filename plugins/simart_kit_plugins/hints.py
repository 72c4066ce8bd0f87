"""Joint predictor `hints`: the joints of a segmenter that predicts parts and joints at once."""

from __future__ import annotations

from typing import TYPE_CHECKING

from simart_kit import JointPredictor, Segmentation, hookimpl

if TYPE_CHECKING:
    from simart_kit import Joint, Mesh
    from simart_kit.hookspecs import Register


class Hints(JointPredictor):
    """Passes the segmenter's own joint hints on; where it has none, joints are those of `geometric`."""

    name = "hints"

    def predict(self, mesh: Mesh, segmentation: Segmentation) -> tuple[Joint, ...]:
        """The hints, which may be none at all; or what geometry says of a segmenter's bare parts."""
        if segmentation.joints is not None:
            return segmentation.joints
        from .geometric.predictor import GeometricJoints

        return GeometricJoints(seed=self.seed).predict(mesh, segmentation)


@hookimpl
def register_joint_predictors(register: Register) -> None:
    """Register `hints`."""
    register(Hints)
