"""`p3sam-vlm` with a model that gives one answer to all; it makes the pictures small."""

import pytest

from simart_kit import Plugins
from simart_kit.recipe import read_options
from simart_kit.testing.contracts import JointPredictorContract, SegmenterContract

BUILT_IN = Plugins(installed=False)


def link(name, pieces, kind, parent="body"):
    told = {"name": name, "label": "", "pieces": pieces, "parent": parent, "kind": kind}
    return told | {"material": "wood", "confidence": 50}


LINKS = [link("body", [], "fixed", ""), link("door", [1], "revolute")]
PARTS = [link("body", [0], "fixed", ""), link("door", [1], "revolute"), link("drawer", [2], "prismatic")]


@pytest.fixture
def scripted(monkeypatch):
    """Makes a model that says which links there are, and always the first letter."""
    # Here, because the list of built-ins imports this file outside its package.
    from ..marks_cases import Scripted, small_pictures

    small_pictures(monkeypatch)

    def make(links):
        def letter(question):
            schema = question.answer.model_json_schema()
            return {"letter": schema["properties"]["letter"]["enum"][0], "confidence": 50}

        table = {"category": "thing", "longest_side_m": 1, "links": links}
        return Scripted({"ObjectAnswer": lambda question: table, "AxisAnswer": letter})

    return make


class TestP3SamVlm(SegmenterContract):
    stage = BUILT_IN.find("segmenter", "p3sam-vlm").value
    # A model may say something else of other pixels.
    invariant = False

    @pytest.fixture(autouse=True)
    def _model(self, scripted):
        self.scripted = scripted

    def make(self):
        options = read_options(self.stage, {"proposer": {"use": "geometric"}})
        return self.stage(options, plugins=BUILT_IN, vlm=self.scripted(LINKS))


class TestVlmJoints(JointPredictorContract):
    stage = BUILT_IN.find("joint predictor", "p3sam-vlm").value

    @pytest.fixture(autouse=True)
    def _model(self, scripted):
        self.scripted = scripted

    def make(self):
        return self.stage(vlm=self.scripted(PARTS))
