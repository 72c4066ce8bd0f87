"""When the network knows an object."""

import numpy as np
import pytest
from simart_kit_plugins.nano.predicting import is_known

SURE = np.array([0.99, 0.98, 0.01, 0.0])
TORN, LOST = np.array([0.99, 0.7, 0.1, 0.0]), np.array([0.99, 0.6, 0.4, 0.0])


@pytest.mark.parametrize(
    ("chance", "moves", "known"),
    [
        (0.999, SURE, True),
        (0.999, TORN, True),
        (0.999, LOST, False),  # a box that it takes for a range hood
        (0.95, SURE, True),
        (0.95, TORN, False),  # surely a door, but which of its pieces move?
        (0.6, SURE, False),
    ],
)
def test_an_object_is_known_by_its_category_and_by_what_moves(chance, moves, known):
    assert is_known(chance, moves) is known
