"""How unlike what it was trained on a network finds an object, and the numbers that tell it."""

from dataclasses import replace

import numpy as np
import pytest
from simart_kit_plugins.nano.array_network import ArrayNetwork
from simart_kit_plugins.nano.cloud import Cloud
from simart_kit_plugins.nano.config import NanoConfig
from simart_kit_plugins.nano.network import NanoNetwork
from simart_kit_plugins.nano.novelty import TokenStatistics, gathered, moments_of, tokens_of
from simart_kit_plugins.nano.predicting import predict
from simart_kit_plugins.nano.stored_model import read_model
from simart_kit_plugins.nano.voting import say
from simart_kit_plugins.nano.weights import save_network

CONFIG = NanoConfig(channels=16, layers=2, heads=2, hidden=16, point_channels=8)


@pytest.fixture(scope="module")
def trained():
    return NanoNetwork(CONFIG, 0)


@pytest.fixture(scope="module")
def network(trained):
    return ArrayNetwork(CONFIG, {name: t.detach().numpy() for name, t in trained.state_dict().items()})


def stack(count, seed, apart=0.2, gray=0.5):
    """Boxes over each other, as the points of their surfaces."""
    generator = np.random.default_rng(seed)
    points, normals = generator.uniform(-0.1, 0.1, (count, 40, 3)), np.zeros((count, 40, 3))
    side = generator.integers(0, 3, (count, 40, 1))
    np.put_along_axis(points, side, 0.1 * generator.choice([-1, 1], (count, 40, 1)), axis=2)
    np.put_along_axis(normals, side, 1.0, axis=2)
    points[..., 2] += apart * np.arange(count)[:, None]
    size = count * 40
    points = points.reshape(-1, 3) - points.reshape(-1, 3).mean(axis=0)
    piece = np.repeat(np.arange(count), 40)
    colors = np.full((size, 3), gray) + generator.normal(0, 0.02, (size, 3))
    return Cloud(
        points / np.ptp(points), normals.reshape(-1, 3), colors, piece, np.full(size, 1 / size), count
    )


def told_of(network, clouds):
    return gathered([moments_of(tokens_of(say(network, one))) for one in clouds])


def novelty(statistics, network, cloud):
    return statistics.novelty(tokens_of(say(network, cloud)))


def test_what_was_gathered_from_is_one_new_and_what_is_unlike_it_more(network):
    stacks = [stack(2 + seed % 6, seed) for seed in range(40)]
    statistics = told_of(network, stacks)
    own = np.mean([novelty(statistics, network, one) for one in stacks])
    # A direction with hardly any spread counts less than its own.
    assert 0.5 < own <= 1.0 + 1e-3
    new = np.mean([novelty(statistics, network, stack(2 + seed % 6, seed)) for seed in range(40, 60)])
    assert new == pytest.approx(own, rel=0.3)
    assert novelty(statistics, network, stack(4, 99, gray=1.0)) > 2 * new
    assert novelty(statistics, network, stack(4, 99, apart=2.0)) > 1.5 * new


def test_tokens_are_white_after_whitening(network):
    stacks = [stack(4, seed) for seed in range(60)]
    statistics = told_of(network, stacks)
    tokens = np.concatenate([tokens_of(say(network, one))[1].reshape(-1, CONFIG.channels) for one in stacks])
    white = (tokens - statistics.mean[1]) @ statistics.whitening[1]
    covariance = np.cov(white.T, bias=True)
    assert np.abs(covariance - np.diag(np.diag(covariance))).max() < 0.02
    assert np.diag(covariance).max() < 1.02
    assert np.median(np.diag(covariance)) > 0.5


def test_an_object_counts_as_much_however_many_pieces_it_has(network):
    few, many = stack(2, 1), stack(12, 2, gray=0.9)
    once = told_of(network, [few, many])
    alone = [told_of(network, [one]) for one in (few, many)]
    np.testing.assert_allclose(once.mean, (alone[0].mean + alone[1].mean) / 2, atol=1e-5)


def test_one_object_alone_has_finite_statistics(network):
    statistics = told_of(network, [stack(1, 0)])
    assert np.isfinite(statistics.whitening).all()
    assert np.isfinite(novelty(statistics, network, stack(3, 1)))


def test_a_prediction_tells_how_new_the_object_is_and_without_statistics_that_nobody_knows(network):
    statistics = told_of(network, [stack(3, seed) for seed in range(10)])
    cloud = stack(3, 11)
    assert predict(network, cloud, 4, statistics).novelty == novelty(statistics, network, cloud)
    alone = predict(network, cloud, 4)
    assert alone.novelty == np.inf
    assert replace(alone, discord=1.0).recognised is False


def test_statistics_are_kept_with_the_weights(trained, network, tmp_path):
    statistics = told_of(network, [stack(3, seed) for seed in range(10)])
    save_network(trained, tmp_path / "with", statistics=statistics)
    save_network(trained, tmp_path / "without")
    kept = read_model(tmp_path / "with")
    assert isinstance(kept.statistics, TokenStatistics)
    np.testing.assert_allclose(kept.statistics.mean, statistics.mean, rtol=1e-3, atol=1e-4)
    np.testing.assert_allclose(kept.statistics.whitening, statistics.whitening, rtol=1e-3, atol=1e-3)
    assert kept.weights.keys() == read_model(tmp_path / "without").weights.keys()
    assert read_model(tmp_path / "without").statistics is None
