import numpy as np
import pytest
from simart_kit_plugins.simart.codec import encode_parts
from simart_kit_plugins.simart.tokens_file import PartTokens, TokensFile, write_tokens_file

from simart_kit import Plugins
from simart_kit.provenance import file_hash
from simart_kit.recipe import read_options
from simart_kit.testing.contracts import SegmenterContract
from simart_kit.testing.meshes import cabinet_mesh

BUILT_IN = Plugins(installed=False)
PARTS = {"body": 60, "door": 24, "drawer": 24}


@pytest.fixture(scope="module")
def home(tmp_path_factory):
    """A model that loses nothing, and tokens of the contract's cabinet."""
    # Here, because the list of built-ins imports this file outside its package.
    from ..token_models import use_dictionary

    folder = tmp_path_factory.mktemp("tokens")
    with pytest.MonkeyPatch.context() as patch:
        model = use_dictionary(patch, folder)
        made = encode_parts(model, cabinet_mesh(), np.repeat([0, 1, 2], list(PARTS.values())), tuple(PARTS))
        parts = tuple(PartTokens(name, tokens) for name, tokens in zip(PARTS, made.parts, strict=True))
        fingerprint = file_hash(folder / "model.safetensors")[:16]
        write_tokens_file(TokensFile(fingerprint, made.whole, parts), folder / "parts.json")
        yield folder


class TestTokens(SegmenterContract):
    stage = BUILT_IN.find("segmenter", "tokens").value

    @pytest.fixture(autouse=True)
    def _find_files(self, home):
        self.home = home

    def make(self):
        options = {"file": str(self.home / "parts.json"), "model": str(self.home)}
        return self.stage(read_options(self.stage, options), seed=0)
