"""What a joint predictor must keep."""

from __future__ import annotations

import numpy as np

from ...assemble import assemble
from ...asset import Asset, Joint
from ...mesh import Mesh
from ...stages import JointPredictor, PartGuess, Segmentation
from .. import meshes
from ..fingerprint import fingerprint
from .stages import StageContract


class JointPredictorContract(StageContract):
    """For JointPredictors."""

    kind = JointPredictor

    def mesh(self) -> Mesh:
        """The object: by default a cabinet with a door and a drawer."""
        return meshes.cabinet_mesh()

    def segmentation(self) -> Segmentation:
        """Its parts, with joint hints."""
        return _segmentation(meshes.cabinet_asset())

    def test_joins_known_parts(self) -> None:
        segmentation = self.segmentation()
        joints = self.make().predict(self.mesh(), segmentation)
        assert isinstance(joints, tuple), f"predict() returned {type(joints).__name__}, expected a tuple"
        assert all(isinstance(joint, Joint) for joint in joints), "predict() must return Joint values"
        known = {part.name for part in segmentation.parts}
        unknown = {end for j in joints for end in (j.parent, j.child)} - known
        assert not unknown, f"joints name parts that do not exist: {', '.join(sorted(unknown))}"

    def test_axes_are_unit_vectors(self) -> None:
        for joint in self.make().predict(self.mesh(), self.segmentation()):
            assert np.isclose(np.linalg.norm(joint.axis), 1.0, atol=1e-6), (
                f"axis of {joint.name}: {joint.axis}"
            )

    def test_joints_are_a_tree(self) -> None:
        mesh, segmentation = self.mesh(), self.segmentation()
        joints = self.make().predict(mesh, segmentation)
        assemble("asset", mesh, segmentation, joints, np.eye(4))

    def test_works_on_a_single_part(self) -> None:
        asset = meshes.static_asset()
        assert self.make().predict(asset.mesh, _segmentation(asset)) == (), "a single part has no joint"

    def test_same_answer_every_time(self) -> None:
        mesh, segmentation = self.mesh(), self.segmentation()
        one, two = (self.make().predict(mesh, segmentation) for _ in range(2))
        assert fingerprint(one) == fingerprint(two), (
            "make generators with numpy.random.default_rng(self.seed)"
        )

    def test_leaves_its_inputs_alone(self) -> None:
        mesh, segmentation = self.mesh(), self.segmentation()
        before = fingerprint((mesh, segmentation))
        self.make().predict(mesh, segmentation)
        assert fingerprint((mesh, segmentation)) == before, "predict() changed its inputs"


def _segmentation(asset: Asset) -> Segmentation:
    """What a perfect segmenter says of an asset."""
    parts = tuple(PartGuess(part.name, label=part.label) for part in asset.parts)
    return Segmentation(asset.face_part, parts, joints=asset.joints)
