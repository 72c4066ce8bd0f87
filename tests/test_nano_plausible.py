"""What lies loose is smaller than what it lies on."""

import numpy as np
import pytest
from simart_kit_plugins.nano.predicting import PredictedPart, plausible

AREA = np.array([0.5, 0.2, 0.3])


@pytest.mark.parametrize(
    ("kind", "pieces", "stays_sure"),
    [
        ("free", [0, 1], False),  # 0.7 of the surface: a lid cannot carry its pot
        ("free", [1, 2], True),
        ("revolute", [0, 1], True),  # a door may well be most of what is seen
    ],
)
def test_what_is_most_of_an_object_does_not_lie_loose_on_it(kind, pieces, stays_sure):
    said = PredictedPart(
        np.array(pieces), "lid", 0.9, kind, np.array([0.0, 0.0, 1.0]), np.zeros(3), 0, 0, 0, 0.9, 0.8
    )
    assert plausible(said, AREA).certainty == (0.8 if stays_sure else 0.0)
