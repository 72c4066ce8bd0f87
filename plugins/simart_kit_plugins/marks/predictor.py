"""Joint predictor `p3sam-vlm`: how the parts of any segmenter move, by a vision-language model."""

from __future__ import annotations

from typing import TYPE_CHECKING

from simart_kit import JointPredictor, Segmentation

from ..vlm import VlmOptions

if TYPE_CHECKING:
    from simart_kit import Mesh
    from simart_kit.asset import Joint
    from simart_kit.spec.values import Spec
    from simart_kit.stages import Prediction

    from ..vlm import Vlm


class VlmJoints(JointPredictor):
    """Kind, parent and axis of every part, chosen by a vision-language model among drawn letters.

    Args:
        options: which model.
        seed: unused by it.
        vlm: that is asked; None: the one of the options.
    """

    name = "p3sam-vlm"

    class Options(VlmOptions):
        """Which model is asked."""

    options: Options

    def __init__(self, options: Options | None = None, *, seed: int = 0, vlm: Vlm | None = None) -> None:
        super().__init__(options, seed=seed)
        self._vlm = vlm

    def predict(self, mesh: Mesh, segmentation: Segmentation) -> tuple[Joint, ...]:
        """Joints of all parts but the one that the model takes for the body.

        Raises:
            BadInputError: the model cannot be asked, or gives no usable answer.
        """
        return self.prediction(mesh, segmentation, None).joints

    def predict_to(self, mesh: Mesh, segmentation: Segmentation, spec: Spec) -> tuple[Joint, ...]:
        """As `predict`, the model being told what a person states; errors are the same."""
        return self.prediction(mesh, segmentation, spec).joints

    def prediction(self, mesh: Mesh, segmentation: Segmentation, spec: Spec | None) -> Prediction:
        """The joints, the questions with their pictures and answers, and what these took.

        Raises:
            BadInputError: the model cannot be asked, or gives no usable answer.
        """
        from simart_kit.stages import Prediction

        from ..vlm import open_vlm
        from .prompts import SYSTEM
        from .talk import Talk
        from .whole_parts import part_joints
        from .wishes import wishes_text

        if len(segmentation.parts) == 1:
            return Prediction(())
        talk = Talk(self._vlm or open_vlm(self.options), SYSTEM, self.options)
        names = tuple(part.name for part in segmentation.parts)
        joints = part_joints(talk, mesh, segmentation.face_part, names, wishes_text(spec))
        return Prediction(joints, talk.notes("joints"), talk.evidence, talk.usage())
