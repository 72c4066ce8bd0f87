"""Examples, their files, and a network that learns from them."""

import math
from dataclasses import replace

import numpy as np
import pytest
import torch
from simart_kit_plugins.nano.config import NanoConfig
from simart_kit_plugins.nano.examples import example
from simart_kit_plugins.nano.generate.catalogue import CATEGORIES
from simart_kit_plugins.nano.generate.category import named
from simart_kit_plugins.nano.generate.data_set import generated
from simart_kit_plugins.nano.generate.objects import GeneratedObject
from simart_kit_plugins.nano.learning import batch_of, targets_of
from simart_kit_plugins.nano.losses import _of_pieces, _paired, losses
from simart_kit_plugins.nano.network import NanoNetwork
from simart_kit_plugins.nano.reading import MOST_PAIRED
from simart_kit_plugins.nano.store import load, save, stored
from simart_kit_plugins.nano.truth import KINDS
from simart_kit_plugins.nano.varying import fused, placed

from .test_generated_objects import MADE

torch.set_num_threads(1)
NAMES = ("cabinet", "drawer_chest", "laptop", "chair")


@pytest.fixture(scope="module")
def examples():
    """Four objects of each of four categories, seen in some way."""
    made = [generated(named(name, CATEGORIES), 3, k) for name in NAMES for k in range(4)]
    return [stored(example(one, np.random.default_rng(k), 0.3)) for k, one in enumerate(made)]


def small(**changes):
    base = {"channels": 32, "layers": 2, "heads": 4, "hidden": 48, "point_channels": 16}
    return NanoConfig(**(base | {"labels": ("door", "drawer", "screen"), "categories": NAMES} | changes))


def test_a_placed_object_fills_the_unit_cube_and_its_joints_move_with_it():
    for seed in range(8):
        seen = placed(MADE, np.random.default_rng(seed))
        points = np.concatenate([body.triangles for body in seen.bodies]).reshape(-1, 3)
        low, high = points.min(axis=0), points.max(axis=0)
        assert (high - low).max() == pytest.approx(1)
        assert np.allclose(low + high, 0, atol=1e-9)
        door = seen.bodies[1]
        # The hinge is the upright edge of the door next to the body's corner, and opening leads away from it.
        assert np.abs(door.motion.axis[2]) == pytest.approx(1)
        inside = door.triangles.reshape(-1, 3)
        reach = np.linalg.norm(np.cross(inside - door.motion.origin, door.motion.axis), axis=1)
        assert reach.min() < 1e-9
        away = inside[reach.argmax()] - door.motion.origin
        body = seen.bodies[0].triangles.reshape(-1, 3).mean(axis=0) - door.motion.origin
        assert np.cross(door.motion.axis, away) @ body < 0


def test_a_slide_shrinks_with_its_object():
    seen = placed(MADE, np.random.default_rng(1))
    before = np.concatenate([body.triangles for body in MADE.bodies]).reshape(-1, 3)
    after = np.concatenate([body.triangles for body in seen.bodies]).reshape(-1, 3)
    drawer = seen.bodies[3].motion
    along = int(np.abs(drawer.axis).argmax())
    # Whatever the stretch, the travel is the same share of the object's depth: 0.4 of 0.56.
    assert np.abs(drawer.axis).max() == pytest.approx(1, abs=0.1)
    share = drawer.upper / np.ptp(after[:, along])
    assert share == pytest.approx(0.4 / np.ptp(before[:, 1]), rel=0.15)


def test_fused_pieces_have_no_gaps_in_their_numbers():
    piece = np.repeat(np.arange(30), 20)
    points = np.random.default_rng(0).normal(size=(600, 3))
    changed = fused(piece, points, np.random.default_rng(5))
    assert np.array_equal(np.unique(changed), np.arange(changed.max() + 1))
    assert not np.array_equal(changed, piece)


def test_an_example_has_candidates_for_each_part_that_shows(examples):
    rights = []
    for one in examples:
        assert len(one.own) == one.piece.max() + 1 == len(one.part) == len(one.gap)
        assert one.candidates.sum() == len(one.numbers) == len(one.right)
        assert set(one.number.tolist()) <= set(one.part.tolist()) - {0}
        starts = np.cumsum(one.candidates) - one.candidates
        for start, count, kind in zip(starts, one.candidates, one.kind, strict=True):
            if KINDS[kind] in ("revolute", "prismatic", "continuous"):
                rights.append((one.right[start : start + count] != 0).any())
    assert len(rights) > 20
    assert np.mean(rights) >= 0.95


def test_a_static_object_has_no_part_to_tell(examples):
    chairs = [one for one in examples if one.category == "chair"]
    assert chairs
    assert all(len(one.number) == 0 and not one.part.any() for one in chairs)


def test_examples_are_the_same_after_a_file(examples, tmp_path):
    save(examples, tmp_path / "some.npz")
    found = load(tmp_path / "some.npz")
    assert len(found) == len(examples)
    for one, other in zip(examples, found, strict=True):
        for name in (
            "points",
            "normals",
            "colors",
            "piece",
            "own",
            "gap",
            "part",
            "kind",
            "travel",
            "numbers",
        ):
            assert np.array_equal(getattr(one, name), getattr(other, name)), name
        assert one.label.tolist() == other.label.tolist()
        assert (one.category, one.size) == (other.category, pytest.approx(other.size))
    assert [path.name for path in tmp_path.iterdir()] == ["some.npz"]


def test_the_order_of_points_and_the_company_of_other_objects_change_nothing(examples):
    network = NanoNetwork(small(), 0).eval()
    one, other = examples[0], max(examples, key=lambda e: len(e.own))
    with torch.no_grad():
        alone, both = network(batch_of([one])), network(batch_of([one, other]))
    size = len(one.own)
    for name in ("together", "moves", "kind", "label"):
        first, second = getattr(alone, name)[0, :size], getattr(both, name)[0, :size]
        first, second = (v[:, :size] if name == "together" else v for v in (first, second))
        assert torch.allclose(first, second, atol=1e-4), name
    assert torch.allclose(alone.together, alone.together.transpose(1, 2), atol=1e-5)


def test_pairs_are_looked_at_the_same_in_any_order_and_company(examples):
    network = NanoNetwork(small(pair_channels=8), 0).eval()
    for parameter in network.pairs.parameters():
        parameter.data += 0.2 * torch.randn(parameter.shape, generator=torch.Generator().manual_seed(1))
    few = [e for e in examples if len(e.own) <= MOST_PAIRED]
    one, other = few[0], max(few, key=lambda e: len(e.own))
    size, most = len(one.own), len(other.own)
    with torch.no_grad():
        batch = batch_of([one, other])
        both = network.paired(batch, network(batch), torch.tensor([0, 1]), most)
        batch = batch_of([one])
        alone = network.paired(batch, network(batch), torch.tensor([True]), size)
    assert (alone - both[:1, :size, :size]).abs().max() < 1e-3
    assert torch.allclose(alone, alone.transpose(1, 2), atol=1e-4)


def test_what_pairs_teach_stays_in_their_layers_and_objects_of_many_pieces_teach_none(examples):
    network = NanoNetwork(small(), 0)
    few = [e for e in examples if len(e.own) <= MOST_PAIRED][:3]
    batch, targets = batch_of(few), targets_of(few, network.config)
    losses(network, batch, network(batch), targets).terms["paired"].backward()
    learning = {name for name, p in network.named_parameters() if p.grad is not None and p.grad.any()}
    assert {name.split(".")[0] for name in learning} == {"pairs"}
    many = replace(batch, there=torch.ones(len(few), MOST_PAIRED + 1, dtype=torch.bool))
    assert _paired(network, many, network(batch), targets).item() == 0


def test_strangers_that_move_too_have_their_share_of_what_a_piece_costs():
    """A body of two pieces, two parts of one, and a wrong word about these two alone."""
    part = torch.tensor([[0, 0, 1, 2]])
    logits = torch.where(part[:, :, None] == part[:, None], 30.0, -30.0)
    logits[0, [2, 3], [3, 2]] = 0.0
    # Each of the two has three strangers, one of which moves.
    for neighbours, expected in ((0.0, math.log(2) / 3), (0.5, math.log(2) * (0.5 / 3 + 0.5))):
        cost, weight = _of_pieces(logits, part, neighbours, 0.3)
        assert cost[0].tolist() == pytest.approx([0, 0, expected, expected], abs=1e-6)
        assert weight[0].tolist() == pytest.approx([0.15, 0.15, 1, 1])


def test_the_same_seed_gives_the_same_network():
    one, two, other = NanoNetwork(small(), 1), NanoNetwork(small(), 1), NanoNetwork(small(), 2)
    assert all(torch.equal(a, b) for a, b in zip(one.parameters(), two.parameters(), strict=True))
    assert not torch.equal(one.moves.weight, other.moves.weight)


def test_a_parts_carrier_is_looked_for_among_the_parts_of_its_own_object(examples):
    network = NanoNetwork(small()).eval()
    several = [e for e in examples if len(e.number) > 1][:3]

    def cost(some):
        batch = batch_of(some)
        return losses(network, batch, network(batch), targets_of(some, network.config)).terms["carrier"]

    with torch.no_grad():
        alone = [cost([one]).item() for one in several]
        together = cost(several).item()
    counts = [len(one.number) for one in several]
    assert together == pytest.approx(np.average(alone, weights=counts), abs=1e-4)
    assert min(alone) > 0


def test_objects_without_parts_have_a_finite_loss():
    still = GeneratedObject("chair", (MADE.bodies[0],))
    some = [stored(example(still, np.random.default_rng(0), 0.3))]
    network, batch = NanoNetwork(small(), 0), batch_of(some)
    found = losses(network, batch, network(batch), targets_of(some, network.config))
    found.total.backward()
    assert torch.isfinite(found.total)
    assert found.terms["right"].item() == 0


def test_a_short_training_lowers_every_loss_and_beats_chance(examples):
    network = NanoNetwork(small(), 0)
    optimiser = torch.optim.AdamW(network.parameters(), lr=3e-3)
    some = sorted(examples, key=lambda one: len(one.own))[:8]  # those of fewest pieces: seconds, not a minute
    batch, targets = batch_of(some), targets_of(some, network.config)
    first = losses(network, batch, network(batch), targets)
    for _ in range(50):
        optimiser.zero_grad()
        losses(network, batch, network(batch), targets).total.backward()
        optimiser.step()
    with torch.no_grad():
        reading = network(batch)
        last = losses(network, batch, reading, targets)
    lower = {name: last.terms[name] < first.terms[name] for name in first.terms}
    assert all(lower.values()), lower
    real = targets.part >= 0
    moving = targets.part[real] > 0
    right = ((reading.moves[real] > 0) == moving).float().mean().item()
    assert right > max(moving.float().mean().item(), 1 - moving.float().mean().item()) + 0.05
