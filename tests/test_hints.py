"""The joint predictor `hints`: what the segmenter says, and geometry where it says nothing."""

from simart_kit_plugins.geometric.predictor import GeometricJoints
from simart_kit_plugins.geometric.segmenter import Geometric
from simart_kit_plugins.hints import Hints

from simart_kit import Joint, PartGuess, Segmentation
from simart_kit.testing.meshes import cabinet_asset

MESH = cabinet_asset().mesh


def test_joints_of_the_segmenter_are_passed_on():
    found = Geometric().segment(MESH)
    joint = Joint("turn", "continuous", found.parts[0].name, found.parts[1].name)
    said = Segmentation(found.face_part, found.parts, joints=(joint,))
    assert Hints().predict(MESH, said) == (joint,)


def test_no_joint_at_all_is_an_opinion():
    found = Geometric().segment(MESH)
    assert Hints().predict(MESH, Segmentation(found.face_part, found.parts, joints=())) == ()


def test_parts_without_hints_get_joints_by_geometry():
    found = Geometric().segment(MESH)
    bare = Segmentation(found.face_part, tuple(PartGuess(p.name, label=p.label) for p in found.parts))
    joints = Hints().predict(MESH, bare)
    assert len(joints) == 2
    assert joints == GeometricJoints().predict(MESH, bare)
