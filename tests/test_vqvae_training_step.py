"""A single step: how far weights go, which decay, and what becomes of the codebook."""

import pytest
import torch
from simart_kit_plugins.simart.training.loop import train
from simart_kit_plugins.simart.training.optimiser import stage_optimiser
from simart_kit_plugins.simart.training.sampling import torch_generator
from simart_kit_plugins.simart.vqvae.model import SparseVQVAE

from .test_vqvae_training import box_grids, quick, state
from .vqvae_cases import lively, small


def largest_change(tmp_path, **changes):
    """Of any weight, by the first step of stage 2 from random weights."""
    model = lively(SparseVQVAE(small(revive_after=0)))
    before = state(model)
    config = quick(stage1_steps=0, stage2_steps=1, start_codebook=False, **changes)
    train(model, box_grids(), config, tmp_path)
    return max((p - before[name]).abs().max().item() for name, p in model.named_parameters())


def test_a_step_goes_as_far_as_the_rate_of_its_warm_up(tmp_path):
    # Adam moves each weight first by rate * g / (|g| + 1e-8): by the rate itself, a tenth of the full one.
    assert largest_change(tmp_path, learning_rate=1e-2, warm_up=10) == pytest.approx(1e-3, rel=1e-2)


def test_gradients_are_clipped_as_a_whole(tmp_path):
    # No gradient is above 1e-12 then, so none of the quotients above is over 1e-4.
    assert largest_change(tmp_path, learning_rate=1e-2, gradient_clip=1e-12) < 1.01e-6


def test_weights_of_convolutions_decay_and_nothing_else():
    model = SparseVQVAE(small())
    optimiser = stage_optimiser(model, 2, quick(weight_decay=0.5))
    names = {id(p): name for name, p in model.named_parameters()}
    decay = {names[id(p)]: group["weight_decay"] for group in optimiser.param_groups for p in group["params"]}
    assert decay.keys() == set(names.values())
    assert decay["quantiser.entries"] == decay["quantiser.zero_token"] == 0
    convolutions = {name for name, p in model.named_parameters() if p.ndim == 5}
    assert {name for name, share in decay.items() if share == 0.5} == convolutions


def test_what_stage_1_does_not_train_costs_no_gradient(tmp_path):
    model = SparseVQVAE(small())
    seen = set()

    def observer(row):
        seen.add((row.stage, model.encoder.input_layer.weight.requires_grad))

    train(model, box_grids(), quick(), tmp_path, observer=observer)
    assert seen == {(1, False), (2, True)}


def test_unused_entries_are_revived_and_counted(tmp_path):
    rows = []
    model = SparseVQVAE(small(codebook_size=65, revive_after=1))
    train(model, box_grids(), quick(batch_size=1), tmp_path, observer=rows.append)
    # A grid has at most 8 cells: of 64 entries, at least 56 are idle after each step, and each of the cells
    # becomes one of them.
    for row in rows:
        assert 1 <= row.codes_used <= row.revived <= 8


def test_running_means_move_without_a_gradient(tmp_path):
    model = SparseVQVAE(small(codebook_update="ema", ema_decay=0.5, revive_after=0))
    before = model.quantiser.entries.clone()
    train(model, box_grids(), quick(start_codebook=False, stage2_steps=0), tmp_path)
    moved = (model.quantiser.entries != before).any(dim=1)
    assert moved.any()
    assert torch.equal(moved, model.quantiser.idle_steps < 3)  # all that were used in the three steps


def test_each_step_and_seed_draws_its_own_numbers():
    draws = [torch.rand(1, generator=torch_generator(*of)) for of in ((0, -1), (0, 0), (0, 1), (1, 0))]
    assert len(set(map(float, draws))) == 4
    assert torch.equal(draws[1], torch.rand(1, generator=torch_generator(0, 0)))
