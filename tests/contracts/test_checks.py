"""Every built-in check keeps the contract."""

from simart_kit import Plugins
from simart_kit.testing.contracts import CheckContract

BUILT_IN = Plugins(installed=False)


class TestFiles(CheckContract):
    stage = BUILT_IN.find("check", "files").value


class TestLint(CheckContract):
    stage = BUILT_IN.find("check", "lint").value


class TestAgreement(CheckContract):
    stage = BUILT_IN.find("check", "agreement").value


class TestMass(CheckContract):
    stage = BUILT_IN.find("check", "mass").value


class TestCollision(CheckContract):
    stage = BUILT_IN.find("check", "collision").value


class TestJoints(CheckContract):
    stage = BUILT_IN.find("check", "joints").value


class TestPenetration(CheckContract):
    stage = BUILT_IN.find("check", "penetration").value


class TestSweep(CheckContract):
    stage = BUILT_IN.find("check", "sweep").value


class TestTravel(CheckContract):
    stage = BUILT_IN.find("check", "travel").value


class TestSettle(CheckContract):
    stage = BUILT_IN.find("check", "settle").value


class TestGravity(CheckContract):
    stage = BUILT_IN.find("check", "gravity").value


class TestPush(CheckContract):
    stage = BUILT_IN.find("check", "push").value


class TestEnergy(CheckContract):
    stage = BUILT_IN.find("check", "energy").value


class TestTimestep(CheckContract):
    stage = BUILT_IN.find("check", "timestep").value


class TestRealtime(CheckContract):
    stage = BUILT_IN.find("check", "realtime").value
