import numpy as np
import pytest
import torch
from scipy.spatial.distance import cdist
from simart_kit_plugins.simart.vqvae.kmeans import kmeans, nearest
from simart_kit_plugins.simart.vqvae.quantiser import Quantiser
from simart_kit_plugins.simart.vqvae.usage import count_codes, usage

from simart_kit.errors import BadInputError

from .vqvae_cases import generator, small

OCCUPIED = torch.tensor([[[[True, False], [True, True]], [[False, False], [True, False]]]])
MODES = ("zero", "force-sparse", "dense")


def quantiser(**changes):
    """Two numbers a token: 2 latent channels, as many tokens as latent cells."""
    torch.manual_seed(0)
    return Quantiser(small(resolution=8, latent_channels=2, **changes))


def with_entries(values, **changes):
    made = quantiser(**changes)
    with torch.no_grad():
        made.entries.copy_(torch.tensor(values))
        if made.config.codebook_update == "ema":
            made.ema_sum.copy_(made.entries)
    return made


def features(seed=1):
    return torch.randn(1, 2, 2, 2, 2, generator=generator(seed), requires_grad=True)


def quantised_cells(mode):
    return torch.ones_like(OCCUPIED) if mode == "dense" else OCCUPIED


@pytest.mark.parametrize("mode", MODES)
def test_a_quantised_cell_has_the_nearest_entry_as_scipy_finds_it(mode):
    made, given, picked = quantiser(mode=mode), features(), quantised_cells(mode)
    out = made(given, OCCUPIED)
    entries = made.entries.detach().numpy()
    rows = cdist(given.detach()[picked].numpy(), entries).argmin(1)
    assert np.array_equal(out.codes[picked].numpy(), rows + made.first_code)
    assert np.array_equal(out.vectors[picked].detach().numpy(), entries[rows])


def test_mode_zero_gives_empty_cells_code_0_and_the_zero_token_and_no_other_cell():
    made = quantiser()
    out = made(features(), OCCUPIED)
    assert torch.equal(out.codes == 0, ~OCCUPIED)
    assert torch.equal(out.vectors[~OCCUPIED], made.zero_token.expand(4, 2))


def test_an_occupied_cell_never_takes_the_zero_token_not_even_when_that_is_nearest():
    made = quantiser()
    given = made.zero_token.detach().expand(1, 2, 2, 2, 2)
    assert (made(given, torch.ones_like(OCCUPIED)).codes > 0).all()


def test_mode_force_sparse_fills_empty_cells_with_zeros_and_has_no_zero_token():
    made = quantiser(mode="force-sparse")
    out = made(features(), OCCUPIED)
    assert made.zero_token is None
    assert len(made.entries) == 9
    assert torch.equal(out.codes == -1, ~OCCUPIED)
    assert not out.vectors[~OCCUPIED].any()


def test_mode_dense_quantises_every_cell():
    out = quantiser(mode="dense")(features(), torch.zeros_like(OCCUPIED))
    assert (out.codes >= 0).all()


@pytest.mark.parametrize("mode", MODES)
def test_looking_codes_up_gives_exactly_what_quantising_gave(mode):
    made = quantiser(mode=mode)
    out = made(features(), OCCUPIED)
    assert torch.equal(made.lookup(out.codes), out.vectors)


@pytest.mark.parametrize(
    ("mode", "code", "range_"),
    [("zero", 9, "0..8"), ("zero", -1, "0..8"), ("force-sparse", -2, "-1..8"), ("dense", -1, "0..8")],
)
def test_a_code_that_is_not_in_the_codebook_is_refused(mode, code, range_):
    with pytest.raises(BadInputError, match=f"code {code} is not in the codebook: .* {range_}"):
        quantiser(mode=mode).lookup(torch.full((1, 2, 2, 2), code))


def test_gradients_pass_straight_through_occupied_cells_and_stop_at_empty_ones():
    made, given = quantiser(), features()
    weights = torch.randn(1, 2, 2, 2, 2, generator=generator(5))
    (made(given, OCCUPIED).vectors * weights).sum().backward()
    assert torch.equal(given.grad[OCCUPIED], weights[OCCUPIED])
    assert not given.grad[~OCCUPIED].any()
    assert made.entries.grad is None  # the decoder's gradient bypasses the entries
    # The zero token stands in all four empty cells: its gradient is the sum of theirs.
    torch.testing.assert_close(made.zero_token.grad, weights[~OCCUPIED].sum(0))


def test_codebook_and_commitment_losses_reach_entries_and_features_only_and_never_the_zero_token():
    made, given = quantiser(), features()
    out = made(given, OCCUPIED)
    out.codebook_loss.backward()
    assert given.grad is None
    assert made.entries.grad is not None
    out.commitment_loss.backward()
    assert given.grad[OCCUPIED].any()
    assert not given.grad[~OCCUPIED].any()
    assert made.zero_token.grad is None


def test_both_losses_are_the_mean_squared_distance_over_occupied_cells():
    made = with_entries([[0.0, 0.0], [10.0, 0.0]], codebook_size=3)
    given = torch.zeros(1, 2, 2, 2, 2)
    given[OCCUPIED] = torch.tensor([[1.0, 0.0], [0.0, 2.0], [9.0, 3.0], [10.0, 0.0]])
    out = made(given, OCCUPIED)
    # Squares off (0,0): 1 and 4; off (10,0): 1 + 9 and 0. Sum 15 over 4 cells of 2 numbers.
    assert out.codes[OCCUPIED].tolist() == [1, 1, 2, 2]
    assert out.codebook_loss.item() == pytest.approx(15 / 8)
    assert out.commitment_loss.item() == pytest.approx(15 / 8)


def test_without_a_quantised_cell_losses_are_zero_and_nothing_breaks():
    made, given = quantiser(), features()
    nothing = torch.zeros_like(OCCUPIED)
    out = made(given, nothing)
    (out.codebook_loss + out.commitment_loss).backward()
    assert out.codebook_loss.item() == out.commitment_loss.item() == 0
    assert made.update(given.detach(), out.codes, generator()) == 0


def test_a_running_mean_moves_as_worked_out_by_hand():
    made = with_entries([[0.0, 0.0], [10.0, 0.0]], codebook_size=3, codebook_update="ema", ema_decay=0.75)
    given = torch.zeros(1, 2, 2, 2, 2)
    given[OCCUPIED] = torch.tensor([[1.0, 0.0], [0.0, 2.0], [2.0, 2.0], [0.0, 0.0]])
    out = made(given, OCCUPIED)
    assert out.codebook_loss.item() == 0
    made.update(given, out.codes, generator())
    # All four chose entry 0. Count: .75*1 + .25*4 = 1.75. Sum: .75*(0,0) + .25*(3,4) = (.75, 1).
    # Entry 1 was not chosen: count .75, sum (7.5, 0), so it stays at (10, 0).
    assert made.ema_count.tolist() == [1.75, 0.75]
    torch.testing.assert_close(made.entries, torch.tensor([[0.75 / 1.75, 1 / 1.75], [10.0, 0.0]]))


def test_an_entry_long_unused_keeps_its_place_when_it_is_not_to_be_revived():
    never = {"codebook_size": 3, "revive_after": 0}
    made = with_entries([[0.0, 0.0], [10.0, 0.0]], codebook_update="ema", ema_decay=0.1, **never)
    given = torch.zeros(1, 2, 2, 2, 2)
    for _ in range(60):  # .1^60 is below what float32 holds
        assert made.update(given, made(given, OCCUPIED).codes, generator()) == 0
    assert made.entries[1].tolist() == pytest.approx([10.0, 0.0], rel=1e-5)


@pytest.mark.parametrize("update", ["loss", "ema"])
def test_an_entry_unused_for_long_enough_becomes_a_feature_of_the_batch(update):
    entries = [[0.0, 0.0], [10.0, 0.0], [0.0, 10.0]]
    made = with_entries(entries, codebook_size=4, codebook_update=update, revive_after=3)
    given = torch.zeros(1, 2, 2, 2, 2)
    near_first = torch.tensor([[1.0, 0.0], [0.0, 1.0], [1.0, 1.0], [2.0, 0.0]])
    given[OCCUPIED] = near_first
    codes = OCCUPIED.long()  # all four chose the first entry
    assert [made.update(given, codes, generator()) for _ in range(2)] == [0, 0]
    assert made.entries[1].tolist() == [10.0, 0.0]
    assert made.update(given, codes, generator()) == 2
    revived = {tuple(row) for row in made.entries[1:].tolist()}
    assert len(revived) == 2  # no feature twice
    assert revived <= {tuple(row) for row in near_first.tolist()}
    assert made.idle_steps.tolist() == [0, 0, 0]


def test_use_starts_the_count_of_idle_steps_anew():
    made = quantiser(codebook_size=3, revive_after=2)
    given, first, second = torch.zeros(1, 2, 2, 2, 2), OCCUPIED.long(), OCCUPIED.long() * 2
    assert [made.update(given, codes, generator()) for codes in (first, second, first, second)] == [0] * 4


def test_kmeans_initialisation_reduces_the_quantisation_error_and_repeats_with_its_seed():
    cloud = torch.randn(400, 2, generator=generator(3)) * 3 + 5
    made = quantiser(codebook_size=33, codebook_update="ema")

    def error():
        return (cloud - made.entries[nearest(cloud, made.entries)]).square().mean().item()

    before = error()
    made.initialise(cloud, torch.zeros(len(cloud), dtype=torch.int64), generator(7))
    first = made.entries.clone()
    assert error() < before / 20
    assert torch.equal(made.ema_sum, first)
    made.initialise(cloud, torch.zeros(len(cloud), dtype=torch.int64), generator(7))
    assert torch.equal(made.entries, first)


def test_kmeans_finds_clusters_that_lie_apart_and_leaves_no_centre_without_vectors():
    corners = torch.tensor([[0.0, 0.0], [100.0, 0.0], [0.0, 100.0], [100.0, 100.0]])
    # 97 vectors at one corner and one at each other: random starts almost surely all lie at the first.
    cloud = torch.cat([corners[:1].repeat(97, 1), corners[1:]])
    for seed in range(5):
        centres = kmeans(cloud, 4, generator(seed))
        assert {tuple(row) for row in centres.tolist()} == {tuple(row) for row in corners.tolist()}


def test_kmeans_of_fewer_vectors_than_clusters_keeps_all_vectors_and_adds_others_near_them():
    cloud = torch.tensor([[0.0, 0.0], [4.0, 0.0], [0.0, 4.0]])
    centres = kmeans(cloud, 8, generator(), iterations=0)
    assert torch.equal(centres[:3].sort(0).values, cloud.sort(0).values)
    assert torch.isfinite(centres).all()
    assert len(torch.unique(centres, dim=0)) == 8


def test_nearest_agrees_with_scipy_over_several_chunks():
    vectors = torch.randn(9000, 3, generator=generator(1))
    entries = torch.randn(17, 3, generator=generator(2))
    assert np.array_equal(nearest(vectors, entries).numpy(), cdist(vectors, entries).argmin(1))


def test_usage_counts_codes_of_geometry_only():
    config = small(codebook_size=5)
    counts = count_codes(torch.tensor([[0, 0, 1, 1], [3, 3, 0, 0]]), config)
    # Codes 1 and 3 half of the time each: as two equally frequent ones. Code 0 is emptiness.
    assert counts.tolist() == [2, 0, 2, 0]
    used = usage(counts)
    assert (used.entries, used.used, used.perplexity) == (4, 2, pytest.approx(2.0))
    assert usage(torch.zeros(4, dtype=torch.int64)).perplexity == 0
    assert count_codes(torch.tensor([-1, 0, 0]), small(mode="force-sparse", codebook_size=2)).tolist() == [
        2,
        0,
    ]
