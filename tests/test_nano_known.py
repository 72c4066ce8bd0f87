"""When the network knows an object: what it says of it from several sides."""

import numpy as np
import pytest
from simart_kit_plugins.nano.voting import discord

# Of four pieces, and of three categories, from two sides.
SURE, TORN = [0.99, 0.98, 0.01, 0.0], [0.99, 0.6, 0.4, 0.0]
DOOR, DOOR_OR_GATE, GATE = [0.0, 1.0, 0.0], [0.0, 0.6, 0.4], [0.0, 0.0, 1.0]
KNOWN = 0.002


@pytest.mark.parametrize(
    ("moves", "categories", "known"),
    [
        ((SURE, SURE), (DOOR, DOOR), True),
        ((TORN, TORN), (DOOR, DOOR), True),  # an arm of pliers, either of which may be the one that moves
        ((SURE, SURE), (DOOR_OR_GATE, DOOR_OR_GATE), True),  # what it is makes no difference
        ((SURE, TORN), (DOOR, GATE), False),
        ((SURE, TORN), (DOOR, DOOR_OR_GATE), False),
        ((TORN, TORN), (DOOR,), False),
    ],
)
def test_an_object_is_known_if_it_is_read_alike_from_all_sides(moves, categories, known):
    said = discord(np.array(moves[: len(categories)]), np.array(categories))
    assert (said <= KNOWN) is known


def test_how_far_apart_the_sides_are_is_a_geometric_mean():
    moves = np.array([[0.2, 0.5], [0.4, 0.5]])  # standard deviations 0.1 and 0
    categories = np.array([[0.7, 0.3], [0.5, 0.5]])  # each 0.1 from the mean
    assert discord(moves, categories) == pytest.approx(np.sqrt(0.0501 * 0.1001))


def test_it_does_not_depend_on_the_order_of_sides_or_pieces():
    generator = np.random.default_rng(0)
    moves, categories = generator.random((4, 5)), generator.dirichlet(np.ones(6), 4)
    sides, pieces = generator.permutation(4), generator.permutation(5)
    turned = discord(moves[sides][:, pieces], categories[sides])
    assert turned == pytest.approx(discord(moves, categories))
