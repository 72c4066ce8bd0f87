"""What every stage must keep: subclass a contract and the whole test file of a plugin is written.

from simart_kit.testing.contracts import SegmenterContract

class TestMine(SegmenterContract):
    stage = Mine
"""

from .checks import CheckContract
from .exporters import ExporterContract
from .joint_predictors import JointPredictorContract
from .modifiers import ModifierContract
from .segmenters import SegmenterContract
from .stages import StageContract

__all__ = [
    "CheckContract",
    "ExporterContract",
    "JointPredictorContract",
    "ModifierContract",
    "SegmenterContract",
    "StageContract",
]
