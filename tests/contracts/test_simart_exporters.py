import json
from pathlib import Path

import pytest

from simart_kit import Plugins
from simart_kit.testing.contracts import ExporterContract

BUILT_IN = Plugins(installed=False)


class TestSimartJson(ExporterContract):
    stage = BUILT_IN.find("exporter", "simart-json").value

    @pytest.fixture(autouse=True)
    def _use_a_model_that_loses_nothing(self, tmp_path_factory, monkeypatch):
        # Here, because the list of built-ins imports this file outside its package.
        from ..token_models import use_dictionary

        use_dictionary(monkeypatch, tmp_path_factory.mktemp("codec"))

    def moving_joints(self, main: Path) -> int:
        """Parts of another type than fixed."""
        parts = json.loads(main.read_text())["parts_captions"]
        return sum(part["type"] != "fixed" for part in parts.values())
