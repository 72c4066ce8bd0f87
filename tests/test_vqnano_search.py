"""Encoding by trial: what it tries, and that what comes back is never worse than without."""

import torch
from simart_kit_plugins.simart.codec import nearest_codes
from simart_kit_plugins.simart.training.grids import Grids, pack
from simart_kit_plugins.simart.vqnano import search
from simart_kit_plugins.simart.vqnano.blocks import neighbour_rows
from simart_kit_plugins.simart.vqnano.model import VqNano
from simart_kit_plugins.simart.vqnano.search import Trial, best_codes
from simart_kit_plugins.simart.vqvae.initialise import initialise_codebook

from .test_vqnano import nano, random_grids
from .vqvae_cases import generator, lively


def trained(candidates: int) -> tuple[VqNano, torch.Tensor]:
    """A model with random networks and a codebook of its own features, and grids."""
    grids = random_grids(count=4)
    model = lively(nano(codebook_size=17, candidates=candidates))
    initialise_codebook(model, [grids], generator())
    return model, grids


def trial_of(model, grids):
    blocks, _, picked = model._blocks(grids)
    features, _ = model.features(grids)
    return Trial(model, blocks[picked], picked, neighbour_rows(picked)), features[picked]


def test_one_candidate_is_the_nearest_code():
    model, grids = trained(candidates=1)
    trial, features = trial_of(model, grids)
    nearest = model.quantiser.quantise(features, trial.picked).codes
    assert torch.equal(best_codes(model, trial.truth, features, trial.picked), nearest)


def test_a_model_that_takes_the_nearest_codes_shares_its_weights_and_leaves_the_other_as_it_is():
    model, grids = trained(candidates=6)
    quick = nearest_codes(model)
    trial, features = trial_of(model, grids)
    nearest = model.quantiser.quantise(features, trial.picked).codes
    assert torch.equal(quick.encode(grids).codes[trial.picked], nearest)
    assert model.config.candidates == 6
    assert next(quick.parameters()) is next(model.parameters())


def test_trying_candidates_costs_less_and_each_is_one_of_the_nearest():
    model, grids = trained(candidates=6)
    trial, features = trial_of(model, grids)
    codes = best_codes(model, trial.truth, features, trial.picked)
    candidates = model.quantiser.candidates(features, trial.picked, 6)
    assert (codes[:, None] == candidates).any(1).all()
    with torch.no_grad():
        before, after = trial.costs(candidates[:, 0]).sum(), trial.costs(codes).sum()
    assert after < 0.99 * before
    assert torch.equal(model.encode(grids).codes[trial.picked], codes)


def test_cells_are_tried_again_when_those_around_them_have_changed(monkeypatch):
    model, grids = trained(candidates=6)
    trial, features = trial_of(model, grids)
    again = best_codes(model, trial.truth, features, trial.picked)
    monkeypatch.setattr(search, "_SWEEPS", 1)
    once = best_codes(model, trial.truth, features, trial.picked)
    with torch.no_grad():
        assert trial.costs(again).sum() < trial.costs(once).sum()


def test_the_cost_of_a_cell_is_its_wrong_voxels_and_a_share_of_the_cross_entropy():
    model, grids = trained(candidates=1)
    trial, features = trial_of(model, grids)
    codes = model.quantiser.quantise(features, trial.picked).codes
    grid = model.quantiser.on_grid(codes, trial.picked)
    from simart_kit_plugins.simart.vqnano.blocks import block_view

    with torch.no_grad():
        logits = block_view(model.decode(grid), model.config.cells).flatten(4)[trial.picked].double()
        costs = trial.costs(codes)
    truth = trial.truth.double()
    entropy = (torch.logaddexp(torch.zeros(()), logits) - truth * logits).sum(1)
    expected = ((logits > 0) != trial.truth).sum(1) + 0.3 * entropy
    assert torch.allclose(costs.double(), expected, rtol=1e-4)


def test_a_grid_is_encoded_the_same_alone_and_beside_others():
    model, grids = trained(candidates=4)
    together = model.encode(grids).codes
    alone = torch.cat([model.encode(grid[None]).codes for grid in grids])
    assert torch.equal(together, alone)


def test_what_comes_back_right_is_left_as_it_is():
    model, _ = trained(candidates=4)
    nothing = Grids(16, pack(torch.zeros(1, 16, 16, 16, dtype=torch.bool).numpy()), ("empty",))
    empty = torch.from_numpy(nothing.occupancy([0]))[:, None]
    assert (model.encode(empty).codes == 0).all()
