"""`p3sam` and `particulate` with stand-ins for what they call; each mesh is asked about once."""

import pytest
from simart_kit_plugins.p3sam.segmenter import P3Sam
from simart_kit_plugins.particulate.segmenter import Particulate

from simart_kit.testing.contracts import SegmenterContract


@pytest.fixture(scope="module")
def p3sam(tmp_path_factory):
    """Options that name an installed stand-in."""
    # Here, because the list of built-ins imports this file outside its package.
    from ..p3sam_stand_in import StandIn

    return StandIn(tmp_path_factory.mktemp("p3sam")).options


@pytest.fixture(scope="module")
def particulate(tmp_path_factory):
    """Options that name an installed stand-in."""
    from ..particulate_stand_in import ParticulateStandIn

    return ParticulateStandIn(tmp_path_factory.mktemp("particulate")).options


class TestP3Sam(SegmenterContract):
    stage = P3Sam
    # The stand-ins go by places in metres.
    invariant = False

    @pytest.fixture(autouse=True)
    def _installed(self, p3sam):
        self.options = p3sam


class TestParticulate(SegmenterContract):
    stage = Particulate
    invariant = False

    @pytest.fixture(autouse=True)
    def _installed(self, particulate):
        self.options = particulate
