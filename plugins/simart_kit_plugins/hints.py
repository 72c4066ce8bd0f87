"""Joint predictor `hints`: the joints of a segmenter that predicts parts and joints at once."""

from __future__ import annotations

from typing import TYPE_CHECKING

from simart_kit import JointPredictor, Segmentation, hookimpl

if TYPE_CHECKING:
    from simart_kit import Joint, Mesh
    from simart_kit.hookspecs import Register
    from simart_kit.spec.values import Spec

    from .geometric.predictor import GeometricJoints


class Hints(JointPredictor):
    """Passes the segmenter's own joint hints on; where it has none, joints are those of `geometric`."""

    name = "hints"

    def predict(self, mesh: Mesh, segmentation: Segmentation) -> tuple[Joint, ...]:
        """The hints, which may be none at all; or what geometry says of a segmenter's bare parts."""
        if segmentation.joints is not None:
            return segmentation.joints
        return self._of_geometry().predict(mesh, segmentation)

    def predict_to(self, mesh: Mesh, segmentation: Segmentation, spec: Spec) -> tuple[Joint, ...]:
        """The hints; of parts whose hint is not as a spec states, what geometry says that is."""
        from simart_kit.spec.places import part_places
        from simart_kit.spec.wishes import wishes_of

        if segmentation.joints is None:
            return self._of_geometry().predict_to(mesh, segmentation, spec)
        wishes = wishes_of(spec, segmentation.parts, mesh.bounds)
        labels = [guess.label or guess.name for guess in segmentation.parts]
        places = part_places(mesh, segmentation.face_part, labels)
        names = [guess.name for guess in segmentation.parts]
        hints = {joint.child: joint for joint in segmentation.joints}
        fit = zip(names, wishes, places, strict=True)
        missed = [name for name, wish, place in fit if not wish.granted(hints.get(name), place)]
        if not missed:
            return segmentation.joints
        said = {j.child: j for j in self._of_geometry().predict_to(mesh, segmentation, spec)}
        for name in missed:
            index = names.index(name)
            if name in said and wishes[index].granted(said[name], places[index]):
                hints[name] = said[name]
        return tuple(hints.values())

    def _of_geometry(self) -> GeometricJoints:
        from .geometric.predictor import GeometricJoints

        return GeometricJoints(seed=self.seed)


@hookimpl
def register_joint_predictors(register: Register) -> None:
    """Register `hints`."""
    register(Hints)
