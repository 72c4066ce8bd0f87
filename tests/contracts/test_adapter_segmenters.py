from typing import ClassVar

import numpy as np
import pytest

from simart_kit import BadInputError, Plugins
from simart_kit.bench.articulation import Articulation, Link, LinkJoint
from simart_kit.recipe import read_options
from simart_kit.testing.contracts import SegmenterContract
from simart_kit.testing.meshes import cabinet_asset, cabinet_mesh, static_asset

BUILT_IN = Plugins(installed=False)


@pytest.fixture(scope="module")
def home(tmp_path_factory):
    """What other systems would write about the contract's cabinet, in the frame of its mesh."""
    # Here, because the list of built-ins imports this file outside its package.
    from ..bench_predictions import write_anymesh, write_particulate, write_urdf

    folder = tmp_path_factory.mktemp("files")
    asset = cabinet_asset()
    links = [Link("body")]
    for joint in asset.joints:
        limits = (joint.limits.lower, joint.limits.upper)
        links.append(
            Link(joint.child, 0, LinkJoint(joint.kind, joint.axis, joint.origin, *limits, joint.name))
        )
    whole = Articulation("cabinet", asset.mesh.vertices, asset.mesh.faces, asset.face_part, tuple(links))
    write_particulate(folder, "particulate", whole)
    write_anymesh(folder, "anymesh", whole)
    write_urdf(folder, "truth", whole, np.eye(4))
    np.save(folder / "a_face_ids.npy", np.where(np.arange(108) % 12, asset.face_part, -1))
    (folder / "cluster_out").mkdir()
    for count in (2, 3):
        np.save(folder / "cluster_out" / f"a_0_{count:02d}.npy", np.minimum(asset.face_part, count - 1))
    return folder


class OfOneObject(SegmenterContract):
    """Of a segmenter whose files are of the cabinet: no other object is labelled by them."""

    file = ""

    @pytest.fixture(autouse=True)
    def _find_files(self, home):
        self.home = home

    def make(self):
        return self.stage(
            read_options(self.stage, {"file": str(self.home / self.file), **self.options}), seed=0
        )

    def test_works_on_a_single_box(self):
        with pytest.raises(BadInputError, match=r"not of this mesh|labels 108 faces, the mesh has 12"):
            self.make().segment(static_asset().mesh)

    def test_finds_the_parts(self):
        found = self.make().segment(cabinet_mesh())
        order = np.unique(found.face_part[[0, 60, 84]], return_inverse=True)[1]
        assert len(found.parts) == 3
        np.testing.assert_array_equal(found.face_part, np.repeat(found.face_part[[0, 60, 84]], [60, 24, 24]))
        assert len(set(order.tolist())) == 3

    def test_needs_a_file(self):
        with pytest.raises(BadInputError, match=r"--set segmenter\.options\.file="):
            self.stage().segment(cabinet_mesh())


class TestLabelFiles(OfOneObject):
    stage = BUILT_IN.find("segmenter", "label-files").value
    file = "a_face_ids.npy"


class TestP3samFiles(OfOneObject):
    stage = BUILT_IN.find("segmenter", "p3sam-files").value
    file = "."


class TestPartfieldFiles(OfOneObject):
    stage = BUILT_IN.find("segmenter", "partfield-files").value
    file = "cluster_out"
    options: ClassVar = {"clusters": 3}


class TestParticulateFiles(OfOneObject):
    stage = BUILT_IN.find("segmenter", "particulate-files").value
    file = "particulate"


class TestAnymeshFiles(OfOneObject):
    stage = BUILT_IN.find("segmenter", "anymesh-files").value
    file = "anymesh"


class TestTruthFiles(OfOneObject):
    stage = BUILT_IN.find("segmenter", "truth-files").value
    file = "truth/truth.urdf"
