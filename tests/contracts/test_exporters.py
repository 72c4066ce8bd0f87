from simart_kit import Plugins
from simart_kit.testing.contracts import ExporterContract

BUILT_IN = Plugins(installed=False)


class TestUrdf(ExporterContract):
    stage = BUILT_IN.find("exporter", "urdf").value


class TestMjcf(ExporterContract):
    stage = BUILT_IN.find("exporter", "mjcf").value


class TestUsd(ExporterContract):
    stage = BUILT_IN.find("exporter", "usd").value
