"""Several codebooks: which one a cell's code is from, and that each has nothing to do with the others."""

import itertools

import pytest
import torch
from scipy.spatial.distance import cdist
from simart_kit_plugins.simart.vqnano.config import VqNanoConfig
from simart_kit_plugins.simart.vqvae.contexts import contexts
from simart_kit_plugins.simart.vqvae.quantiser import Quantiser

from .vqvae_cases import generator

COUNT = 5


def quantiser(**changes):
    """Eight codebooks of four entries each, of three numbers; 4x4x4 tokens of 8 voxels."""
    base = {"resolution": 8, "grid": "4x4x4", "token_channels": 3, "codebook_size": COUNT, "contexts": 8}
    torch.manual_seed(0)
    made = Quantiser(VqNanoConfig(**(base | changes)))
    with torch.no_grad():
        made.entries.copy_(torch.randn(made.entries.shape, generator=generator(1)))
        made.ema_sum.copy_(made.entries)
    return made


def scattered():
    return torch.rand(4, 4, 4, 4, generator=generator(2)) < 0.6


def by_hand(picked):
    """The context of each marked cell in C order, looked up one by one."""
    found = []
    for grid, x, y, z in torch.nonzero(picked).tolist():

        def token(j, k, grid=grid, x=x, y=y, z=z):
            inside = 0 <= y + j < picked.shape[2] and 0 <= z + k < picked.shape[3]
            return bool(inside and picked[grid, x, y + j, z + k])

        found.append(4 * (token(0, -1) and token(0, 1)) + 2 * token(-1, 0) + token(1, 0))
    return found


def test_a_context_says_which_neighbours_along_y_and_whether_both_along_z_have_a_token():
    picked = scattered()
    assert contexts(picked, 8).tolist() == by_hand(picked)
    assert set(by_hand(picked)) == set(range(8))


def test_with_one_codebook_all_cells_are_of_the_first():
    assert contexts(scattered(), 1).tolist() == [0] * int(scattered().sum())


def test_a_feature_becomes_the_nearest_entry_of_its_own_codebook():
    made, picked = quantiser(), scattered()
    found = torch.randn(int(picked.sum()), 3, generator=generator(3))
    out = made.quantise(found, picked)
    codes = made.on_grid(out.codes, picked)
    assert torch.equal(made.entries_of(codes, picked), out.vectors)
    for row, book in enumerate(by_hand(picked)):
        own = made.entries[4 * book : 4 * book + 4]
        assert out.codes[row] == cdist(found[row : row + 1], own).argmin() + 1
        assert torch.equal(out.vectors[row], own[out.codes[row] - 1])


def test_candidates_are_the_entries_of_the_own_codebook_the_nearest_first():
    made, picked = quantiser(), scattered()
    found = torch.randn(int(picked.sum()), 3, generator=generator(3))
    nearest = made.quantise(found, picked).codes
    candidates = made.candidates(found, picked, 3)
    assert torch.equal(candidates[:, 0], nearest)
    for row, book in enumerate(by_hand(picked)):
        order = cdist(found[row : row + 1], made.entries[4 * book : 4 * book + 4])[0].argsort()
        assert candidates[row].tolist() == (order[:3] + 1).tolist()
    assert made.candidates(found, picked, 99).shape == (len(found), 4)


def test_a_step_moves_only_entries_of_codebooks_that_were_used():
    made = quantiser(ema_decay=0.5, revive_after=0)
    picked = torch.zeros(1, 4, 4, 4, dtype=torch.bool)
    picked[0, 1, 1:3, 1] = True  # two cells that follow each other along y: contexts 1 and 2
    before = made.entries.clone()
    codes = made.on_grid(torch.tensor([1, 3]), picked)
    made.update(torch.ones(2, 3), codes, generator())
    moved = torch.nonzero((made.entries - before).abs().amax(1) > 1e-5)[:, 0]
    assert moved.tolist() == [4 * 1 + 0, 4 * 2 + 2]
    # The running count and sum were 1 and the entry; now half of each is the feature's.
    assert torch.allclose(made.entries[moved], (before[moved] + 1) / 2)


def test_dead_entries_take_features_of_their_own_codebook():
    made = quantiser(revive_after=1)
    picked = torch.zeros(1, 4, 4, 4, dtype=torch.bool)
    picked[0, 1, 1:3, 1] = True
    found = torch.tensor([[10.0, 0, 0], [0, 10.0, 0]])
    before = made.entries.clone()
    assert made.update(found, made.on_grid(torch.tensor([1, 1]), picked), generator()) == 2
    changed = (made.entries - before).abs().amax(1) > 1e-5
    for book, feature in ((1, found[0]), (2, found[1])):
        assert (made.entries[4 * book : 4 * book + 4] == feature).all(1).sum() == 1
    assert not changed[:4].any()
    assert not changed[12:].any()


def test_codebooks_start_from_their_own_features_and_without_any_from_those_of_all():
    made = quantiser(codebook_size=3)
    books = torch.tensor([0, 0, 5, 5])
    vectors = torch.tensor([[0.0, 0, 0], [1.0, 0, 0], [100.0, 0, 0], [102.0, 0, 0]])
    made.initialise(vectors, books, generator())
    own = {book: sorted(made.entries[2 * book : 2 * book + 2, 0].tolist()) for book in range(8)}
    assert own[0] == [0, 1]
    assert own[5] == [100, 102]
    # The two centres of all four.
    assert own[3] == [0.5, 101]


@pytest.mark.parametrize("contexts", [1, 8])
def test_every_entry_of_every_codebook_decodes(contexts):
    made = quantiser(contexts=contexts)
    for shape in itertools.product((1, 2), (1, 3), (1, 3)):
        picked = torch.zeros(1, 4, 4, 4, dtype=torch.bool)
        picked[0, : shape[0], : shape[1], : shape[2]] = True
        for code in range(1, COUNT):
            assert made.entries_of(picked.long() * code, picked).shape == (int(picked.sum()), 3)
