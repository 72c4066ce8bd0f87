import pytest
from simart_kit_plugins.nano.config import NanoConfig
from simart_kit_plugins.nano.network import NanoNetwork
from simart_kit_plugins.nano.weights import save_network

from simart_kit import Plugins
from simart_kit.recipe import read_options
from simart_kit.testing.contracts import SegmenterContract

BUILT_IN = Plugins(installed=False)


@pytest.fixture(scope="module")
def model(tmp_path_factory):
    """Weights that nobody trained; they say that everything moves, so that there are parts."""
    config = NanoConfig(channels=16, layers=1, heads=2, hidden=16, point_channels=8)
    network = NanoNetwork(config, 0)
    network.moves.bias.data.fill_(3.0)
    folder = tmp_path_factory.mktemp("model")
    save_network(network, folder)
    return folder


class TestNano(SegmenterContract):
    stage = BUILT_IN.find("segmenter", "nano").value

    @pytest.fixture(autouse=True)
    def _find_model(self, model):
        self.model = model

    def make(self):
        return self.stage(read_options(self.stage, {"model": str(self.model), "least": 0.0}), seed=0)
