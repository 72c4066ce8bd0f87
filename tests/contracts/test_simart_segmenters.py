import pytest
from simart_kit_plugins.simart.segmenter import Simart

from simart_kit.recipe import read_options
from simart_kit.testing.contracts import SegmenterContract


@pytest.fixture(scope="module")
def model(tmp_path_factory):
    """A tiny model with random weights."""
    # Here, because the list of built-ins imports this file outside its package.
    from ..mllm_cases import saved

    return saved(tmp_path_factory.mktemp("simart"))


class TestSimart(SegmenterContract):
    stage = Simart
    # A grid of voxels rounds as the mesh lies.
    invariant = False

    @pytest.fixture(autouse=True)
    def _find_model(self, model):
        self.model = model

    def make(self):
        options = {"model": str(self.model), "max_parts": 2, "vision": "off"}
        return self.stage(read_options(self.stage, options), seed=0)
