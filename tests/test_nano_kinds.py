"""How unlike others of its kind an object is, and who is recognised by it."""

from dataclasses import replace

import numpy as np
import pytest
import torch
from simart_kit_plugins.nano.config import NanoConfig
from simart_kit_plugins.nano.kinds import KindStatistics, kinds_of, place_of
from simart_kit_plugins.nano.network import NanoNetwork
from simart_kit_plugins.nano.novelty import TokenStatistics
from simart_kit_plugins.nano.predicting import Prediction
from simart_kit_plugins.nano.stored_model import read_model, shipped_folder
from simart_kit_plugins.nano.training.plan import TrainingPlan
from simart_kit_plugins.nano.training.usual import usual_tokens
from simart_kit_plugins.nano.weights import save_network

torch.set_num_threads(1)
CONFIG = NanoConfig(channels=4, layers=2, heads=2, hidden=4, point_channels=4, categories=("box", "door"))
WIDE = np.array([1.0, 3.0, 0.5, 2.0])


def tokens(*rows):
    """Of an object seen from one side, half way and at the end; what is at the end does not count."""
    middle = np.array(rows, dtype=np.float32)[None]
    return middle, np.full_like(middle, 7.0)


def objects(kind, count, at, seed):
    """Of pieces that lie about a place of the object's own, which lies about that of its kind."""
    dice = np.random.default_rng(seed)
    for _ in range(count):
        place = at + WIDE * dice.normal(size=4)
        yield kind, tokens(place + [1, 0, 0, 0], place - [1, 0, 0, 0])


def measured(told, count):
    return kinds_of([(kind, place_of(one)) for kind, one in told], count)


@pytest.fixture(scope="module")
def kinds():
    return measured([*objects(0, 200, np.zeros(4), 0), *objects(1, 200, np.full(4, 50.0), 1)], 2)


def test_objects_are_as_unlike_their_kind_as_one_and_others_more(kinds):
    new = [kinds.unlikeness(one, kind) for kind, one in objects(1, 200, np.full(4, 50.0), 2)]
    assert np.mean(new) == pytest.approx(1.0, abs=0.1)
    assert min(kinds.unlikeness(one, 0) for _, one in objects(1, 20, np.full(4, 50.0), 3)) > 100


def test_a_way_in_which_objects_of_a_kind_differ_much_counts_less(kinds):
    away = [kinds.unlikeness(tokens(9.0 * np.eye(4)[k]), 0) for k in range(4)]
    assert np.argsort(away).tolist() == np.argsort(-WIDE).tolist()


def test_few_objects_of_a_kind_are_no_nearer_to_it_than_many():
    few = measured([one for seed in range(200) for one in _pair(seed)], 200)
    many = measured(objects(0, 400, np.zeros(4), 5), 1)
    np.testing.assert_allclose(
        np.diag(few.whitening @ few.whitening.T), np.diag(many.whitening @ many.whitening.T), rtol=0.25
    )


def _pair(kind):
    return objects(kind, 2, np.full(4, 10.0 * kind), kind)


def test_nothing_is_like_a_kind_of_which_nothing_was_seen():
    kinds = measured([(0, tokens([0.0, 1.0, 2.0, 3.0])), (2, tokens([1.0, 1.0, 2.0, 2.0]))], 3)
    assert np.isfinite(kinds.whitening).all()
    assert kinds.unlikeness(tokens([0.0, 1.0, 2.0, 3.0]), 1) > 1e4
    assert kinds.unlikeness(tokens([0.0, 1.0, 2.0, 3.0]), 0) == 0


def told(**changes):
    known = Prediction(
        (), (), np.zeros(1, int), np.zeros(1), "box", 0.004, 1.5, {"box": 0.85}, (1.0, 1.0), 1.0
    )
    return replace(known, **changes)


def test_what_is_new_is_recognised_if_it_is_like_what_it_is_surely_taken_for():
    assert told().recognised
    assert not told(unlikeness=3.0).recognised
    assert told(unlikeness=3.0, novelty=1.05).recognised  # no newer than what is usual
    assert not told(categories={"box": 0.7}).recognised
    assert not told(discord=0.006).recognised
    assert not replace(told(), unlikeness=float("inf")).recognised  # of weights without statistics of kinds


def test_statistics_of_kinds_are_kept_with_the_weights(kinds, tmp_path):
    network, plain = (
        NanoNetwork(CONFIG, 0),
        TokenStatistics(np.zeros((2, 4), np.float32), np.stack([np.eye(4, dtype=np.float32)] * 2)),
    )
    save_network(network, tmp_path / "with", statistics=replace(plain, kinds=kinds))
    save_network(network, tmp_path / "without", statistics=plain)
    kept = read_model(tmp_path / "with").statistics
    assert kept is not None
    assert isinstance(kept.kinds, KindStatistics)
    np.testing.assert_allclose(kept.kinds.means, kinds.means, rtol=1e-3)
    np.testing.assert_allclose(kept.kinds.whitening, kinds.whitening, rtol=1e-3, atol=1e-3)
    older = read_model(tmp_path / "without")
    assert older.statistics is not None
    assert older.statistics.kinds is None
    assert older.weights.keys() == read_model(tmp_path / "with").weights.keys()


def test_a_training_measures_so_many_objects_of_each_kind():
    plan = TrainingPlan(held_out=2, of_each=1, network=CONFIG)
    network = NanoNetwork(CONFIG, 0)
    told = list[tuple[int, int]]()
    kinds = usual_tokens(network, plan, 1, lambda *now: told.append(now)).kinds
    assert kinds is not None
    assert told == [(2, 2)]
    assert np.abs(kinds.means).max() < 1e3
    assert np.ptp(kinds.means, axis=0).max() > 0
    assert usual_tokens(network, plan.model_copy(update={"of_each": 0})).kinds is None


def test_the_shipped_weights_know_every_kind():
    stored = read_model(shipped_folder())
    assert stored.statistics is not None
    assert stored.statistics.kinds is not None
    means = stored.statistics.kinds.means
    assert len(means) == len(stored.config.categories)
    assert np.abs(means).max() < 1e3
