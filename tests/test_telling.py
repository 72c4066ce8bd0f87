"""A joint predictor that tells how it came to its joints: in the report, the recording and provenance."""

import json

import numpy as np
import pytest

import simart_kit as sk
from simart_kit.errors import StageError
from simart_kit.evidence import PictureEvidence, VertexEvidence
from simart_kit.plugins import Plugins
from simart_kit.stages import Prediction
from simart_kit.testing import fakes
from simart_kit.testing.meshes import cabinet_asset, cabinet_mesh
from simart_kit.usage import ModelUsage

from .recordings import paths_in

RECIPE = 'schema = 1\nexport = []\nmodify = []\n[segmenter]\nuse = "fake"\n[joints]\nuse = "telling"\n'
PICTURE = PictureEvidence("asked about the door", np.zeros((4, 6, 3), np.uint8))
USAGE = ModelUsage("a model", 2, 0, 3, 700, 50, 0.25)


def telling(evidence):
    """A predictor with the cabinet's joints that tells a note, some evidence and what it spent."""

    class Telling(sk.JointPredictor):
        name = "telling"

        def predict(self, mesh, segmentation):
            raise AssertionError("a predictor that tells is asked once, by `prediction`")

        def prediction(self, mesh, segmentation, spec):
            assert spec is None
            note = sk.Note("joints", "warning", "the model was not sure")
            return Prediction(cabinet_asset().joints, (note,), evidence, (USAGE,))

    return Telling


def converted(folder, *evidence):
    asset = cabinet_asset(textured=False)
    source = folder / "cupboard.fake"
    source.write_text("cabinet")
    (folder / "recipe.toml").write_text(RECIPE)
    plugins = Plugins()
    guesses = [sk.PartGuess(part.name) for part in asset.parts]
    cabinet = {source: cabinet_mesh(textured=False)}
    plugins.register(
        fakes.plugin(fakes.segmenter(asset.face_part, guesses), telling(evidence), meshes=cabinet)
    )
    return sk.convert(source, folder / "recipe.toml", out=folder / "out", plugins=plugins)


def test_notes_evidence_and_usage_of_a_joint_predictor_reach_the_user(tmp_path):
    made = converted(tmp_path, PICTURE)
    assert made.asset.joints[0].child == "door"
    assert "joints: the model was not sure" in made.report.warnings
    assert any("asked_about_the_door" in path for path in paths_in(made.paths["recording"]))
    (row,) = json.loads(made.paths["provenance"].read_text())["models"]
    spent = {"answers": 2, "cached": 0, "calls": 3, "input_tokens": 700, "output_tokens": 50, "cost": 0.25}
    assert row == {"stage": "joints", "name": "telling", "model": "a model"} | spent


def test_evidence_of_another_mesh_is_the_predictors_fault(tmp_path):
    with pytest.raises(StageError, match=r"joint predictor 'telling' failed .*evidence 'door' has 3 rows"):
        converted(tmp_path, VertexEvidence("door", np.zeros(3, np.float32)))
