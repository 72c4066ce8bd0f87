"""What it costs to say wrongly which way a part opens, how far, and how much of that back."""

import dataclasses
import math

import pytest
import torch
from simart_kit_plugins.nano.config import NanoConfig
from simart_kit_plugins.nano.learning import Targets
from simart_kit_plugins.nano.losses import losses
from simart_kit_plugins.nano.network import Batch, NanoNetwork, PartReading
from simart_kit_plugins.nano.reading import MOST_PAIRED, PiecesRead
from simart_kit_plugins.nano.truth import KINDS

CONFIG = NanoConfig(channels=16, layers=1, heads=2, hidden=16, point_channels=8)
REVOLUTE, PRISMATIC = KINDS.index("revolute"), KINDS.index("prismatic")


def costs(travel, said, kind=REVOLUTE, right=(1.0, -1.0, 0.0)):
    """The three terms of one part with as many candidates; `said` is its (sense, near, reach)."""
    sense, near, reach = said
    read = PartReading(
        torch.zeros(1, len(KINDS)),
        torch.zeros(1, 3),
        torch.tensor([sense]),
        torch.tensor([near]),
        torch.tensor([reach]),
        torch.zeros(1, 16),
    )
    network = NanoNetwork(CONFIG, 0)
    network.parts = lambda *_: read
    none = {field.name: torch.zeros(1, 2) for field in dataclasses.fields(Targets)}
    targets = Targets(
        **none
        | {
            "part": torch.tensor([[0, 1]]),
            "kind": torch.tensor([[-1, kind]]),
            "label": torch.tensor([[-1, 0]]),
            "category": torch.tensor([0]),
            "size": torch.zeros(1),
            "owner": torch.tensor([0]),
            "part_kind": torch.tensor([kind]),
            "right": torch.tensor([right]),
            "travel": torch.tensor([travel]),
            "parent": torch.tensor([-1]),
        }
    )
    pieces = PiecesRead(
        torch.zeros(1, 2, 16),
        torch.zeros(1, 2, 2),
        torch.zeros(1, 2),
        torch.zeros(1, 2, len(KINDS)),
        torch.zeros(1, 2, 1),
        torch.zeros(1, 1),
        torch.zeros(1),
        torch.zeros(1, 2, 16),
    )
    batch = Batch(*(torch.ones(1, MOST_PAIRED + 1) for _ in range(5)))  # too many to look at pairs
    terms = losses(network, batch, pieces, targets).terms
    return [terms[name].item() for name in ("sense", "near", "reach")]


def test_candidates_open_in_the_sense_of_their_own_axes():
    """The second has the other sense, and the third is none of its lines."""
    right, wrong = (4.0, -4.0, 9.0), (-4.0, 4.0, 9.0)
    cost = math.log1p(math.exp(-4.0))
    assert costs((0.0, 1.0), (right, -9.0, (0.0, 0.0)))[0] == pytest.approx(cost, abs=1e-5)
    assert costs((0.0, 1.0), (wrong, -9.0, (0.0, 0.0)))[0] == pytest.approx(4.0 + cost, abs=1e-5)
    assert costs((-1.0, 0.0), (wrong, -9.0, (0.0, 0.0)))[0] == pytest.approx(cost, abs=1e-5)


def test_what_goes_as_far_both_ways_has_no_side():
    sense, near, reach = costs((-0.5, 0.5), ((9.0, 9.0, 9.0), 30.0, (0.0, 0.0)))
    assert (sense, near, reach) == (0, pytest.approx(0), pytest.approx(0))


def test_the_share_on_the_shorter_side_is_half_a_chance():
    assert costs((-0.25, 0.75), ((0.0, 0.0, 0.0), 0.0, (0.0, 0.0)))[1] == pytest.approx(0)
    assert costs((0.25, 0.75), ((0.0, 0.0, 0.0), 0.0, (0.0, 0.0)))[1] == pytest.approx(0.25)


@pytest.mark.parametrize(("kind", "cost"), [(REVOLUTE, 0.0), (PRISMATIC, math.log(2))])
def test_each_kind_of_joint_has_a_reach_of_its_own_in_factors(kind, cost):
    reach = (math.log(0.5), math.log(0.25))
    assert costs((0.0, 0.5), ((0.0, 0.0, 0.0), 0.0, reach), kind)[2] == pytest.approx(cost)


def test_what_has_no_limits_is_not_asked():
    assert costs((0.0, 0.0), ((1.0, 1.0, 1.0), 1.0, (1.0, 1.0)), KINDS.index("continuous")) == [0, 0, 0]
