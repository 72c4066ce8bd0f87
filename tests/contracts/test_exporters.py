from collections.abc import Mapping
from pathlib import Path
from typing import Any, ClassVar

from pxr import Usd

from simart_kit import Plugins
from simart_kit.testing.contracts import ExporterContract

from ..glb_reader import Glb

BUILT_IN = Plugins(installed=False)


class TestUrdf(ExporterContract):
    stage = BUILT_IN.find("exporter", "urdf").value


class TestMjcf(ExporterContract):
    stage = BUILT_IN.find("exporter", "mjcf").value


class TestUsd(ExporterContract):
    stage = BUILT_IN.find("exporter", "usd").value


class TestUsdz(ExporterContract):
    stage = BUILT_IN.find("exporter", "usdz").value

    def moving_joints(self, main: Path) -> int:
        """Prims that the animation moves."""
        stage = Usd.Stage.Open(str(main))
        return sum(any(a.GetNumTimeSamples() for a in prim.GetAttributes()) for prim in stage.Traverse())


class TestGlb(ExporterContract):
    stage = BUILT_IN.find("exporter", "glb").value

    def moving_joints(self, main: Path) -> int:
        """Clips that move one node each."""
        clips = Glb.read(main).json.get("animations", [])
        return len({channel["target"]["node"] for clip in clips for channel in clip["channels"]})


class TestGlbWithPhysics(TestGlb):
    options: ClassVar[Mapping[str, Any]] = {"experimental_physics": True}
