from typing import ClassVar

from simart_kit import Plugins
from simart_kit.testing.contracts import ModifierContract

BUILT_IN = Plugins(installed=False)


class TestScale(ModifierContract):
    stage = BUILT_IN.find("modifier", "scale").value


class TestScaleToAHeight(ModifierContract):
    stage = BUILT_IN.find("modifier", "scale").value
    options: ClassVar = {"height": 1.8}


class TestSnap(ModifierContract):
    stage = BUILT_IN.find("modifier", "snap").value


class TestSweep(ModifierContract):
    stage = BUILT_IN.find("modifier", "sweep").value


class TestMass(ModifierContract):
    stage = BUILT_IN.find("modifier", "mass").value


class TestDynamics(ModifierContract):
    stage = BUILT_IN.find("modifier", "dynamics").value


class TestCollision(ModifierContract):
    stage = BUILT_IN.find("modifier", "collision").value


class TestClear(ModifierContract):
    stage = BUILT_IN.find("modifier", "clear").value
