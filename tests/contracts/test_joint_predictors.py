from simart_kit import Plugins
from simart_kit.testing.contracts import JointPredictorContract

BUILT_IN = Plugins(installed=False)


class TestGeometric(JointPredictorContract):
    stage = BUILT_IN.find("joint predictor", "geometric").value


class TestHints(JointPredictorContract):
    stage = BUILT_IN.find("joint predictor", "hints").value
