from simart_kit import Plugins
from simart_kit.testing.contracts import SegmenterContract

BUILT_IN = Plugins(installed=False)


class TestGeometric(SegmenterContract):
    stage = BUILT_IN.find("segmenter", "geometric").value
