"""The small model: blocks, neighbours, the linear start, and the interface of the large one."""

import itertools

import numpy as np
import pytest
import torch
from simart_kit_plugins.simart.models import build_model
from simart_kit_plugins.simart.training.config import TrainingConfig
from simart_kit_plugins.simart.training.loop import train
from simart_kit_plugins.simart.vqnano.blocks import block_view, grid_of_blocks, neighbour_rows
from simart_kit_plugins.simart.vqnano.components import fit_components
from simart_kit_plugins.simart.vqnano.config import VqNanoConfig
from simart_kit_plugins.simart.vqnano.model import VqNano
from simart_kit_plugins.simart.vqvae.checkpoint import load_checkpoint, save_checkpoint
from simart_kit_plugins.simart.vqvae.initialise import initialise_codebook

from simart_kit.errors import BadInputError

from .test_vqvae_training import box_grids
from .vqvae_cases import generator, lively, two_grids, two_grids_occupied


def nano(seed=0, **changes):
    """16^3 voxels in 2x2x2 tokens of 512 voxels."""
    base = {
        "resolution": 16,
        "grid": "2x2x2",
        "codebook_size": 9,
        "token_channels": 6,
        "channels": 8,
        "neighbour_channels": 3,
        "hidden_channels": 8,
        "revive_after": 2,
        "candidates": 1,
    }
    return VqNano(VqNanoConfig(**(base | changes)), seed)


def random_grids(count=3, edge=16, seed=0):
    return torch.rand(count, 1, edge, edge, edge, generator=generator(seed)) < 0.01


def test_a_block_holds_the_voxels_of_its_cell():
    grid = torch.zeros(1, 1, 16, 16, 16)
    grid[0, 0, 5, 9, 15] = 1  # x 4..7 is the second cell of four, y and z 8..15 the second of two
    blocks = block_view(grid, (4, 2, 2))
    assert blocks.shape == (1, 4, 2, 2, 4, 8, 8)
    assert torch.nonzero(blocks).tolist() == [[0, 1, 1, 1, 1, 1, 7]]


def test_blocks_go_back_where_they_came_from_and_all_else_is_filled():
    grids = random_grids().float()
    picked = block_view(grids, (4, 2, 2)).flatten(4).any(-1)
    picked[0] = False
    back = grid_of_blocks(block_view(grids, (4, 2, 2))[picked].flatten(1), picked, 16, fill=-1.0)
    assert torch.equal(back[1:][grids[1:] > 0], grids[1:][grids[1:] > 0])
    assert (back[0] == -1).all()


def test_neighbours_are_those_a_search_by_hand_finds():
    picked = torch.rand(2, 4, 2, 3, generator=generator()) < 0.5
    cells = torch.nonzero(picked).tolist()
    found = neighbour_rows(picked)
    assert found.shape == (len(cells), 27)
    for row, (grid, x, y, z) in enumerate(cells):
        for place, (i, j, k) in enumerate(itertools.product((-1, 0, 1), repeat=3)):
            there = [grid, x + i, y + j, z + k]
            expected = cells.index(there) if there in cells else len(cells)
            assert found[row, place] == expected


@pytest.mark.parametrize("mode", ["zero", "force-sparse", "dense"])
def test_decoding_the_codes_gives_what_training_sees(mode):
    model = lively(nano(mode=mode))
    output = model(two_grids())
    encoded = model.encode(two_grids())
    assert torch.equal(encoded.occupied, two_grids_occupied())
    assert torch.equal(model.decode(encoded.codes), output.logits)
    assert torch.equal(encoded.codes, output.codes)


def test_empty_cells_have_the_reserved_code_and_stay_empty():
    model = lively(nano())
    codes = model.encode(two_grids()).codes
    assert torch.equal(codes > 0, two_grids_occupied())
    voxels = model.decode(codes, two_grids_occupied()) > 0
    inside = block_view(voxels, (2, 2, 2)).flatten(4).any(-1)
    assert not (inside & ~two_grids_occupied()).any()


def test_a_cell_that_is_masked_decodes_to_nothing_though_it_has_a_token():
    model = lively(nano())
    codes = model.encode(two_grids()).codes
    nothing = torch.zeros_like(two_grids_occupied())
    assert (model.decode(codes, nothing) == -torch.inf).all()


def test_every_cell_has_a_token_in_mode_dense():
    codes = lively(nano(mode="dense")).encode(two_grids()).codes
    assert ((codes >= 0) & (codes < 9)).all()


def test_the_zero_token_is_trained_through_the_cells_around():
    model = lively(nano())
    model(two_grids()).losses.total.backward()
    assert model.quantiser.zero_token.grad.abs().sum() > 0


def test_losses_are_over_the_voxels_of_cells_with_a_token():
    model = lively(nano())
    output = model(two_grids())
    # Four cells of the plate and the one of the single voxel, 512 voxels each.
    logits = block_view(output.logits, (2, 2, 2))[two_grids_occupied()].double().numpy()
    truth = block_view(two_grids(), (2, 2, 2))[two_grids_occupied()].double().numpy()
    assert logits.shape == (5, 8, 8, 8)
    expected = np.mean(np.logaddexp(0, logits) - truth * logits)
    assert output.losses.reconstruction.item() == pytest.approx(expected, rel=1e-5)


def test_the_linear_start_alone_rebuilds_blocks_that_the_codebook_can_hold():
    # The plates and posts have fewer kinds of blocks than there are codes and components.
    grids = box_grids()
    voxels = torch.from_numpy(grids.occupancy(range(len(grids))))[:, None]
    model = nano(codebook_size=64, token_channels=32)
    kinds = len(np.unique(block_view(voxels, (2, 2, 2)).flatten(4)[model.encode(voxels).occupied], axis=0))
    assert kinds < 32
    fit_components(model, [voxels])
    initialise_codebook(model, [voxels], generator())
    with torch.no_grad():  # without the network's correction of random features
        model.decoder.correction.weight.zero_()
    assert torch.equal(model.decode(model.encode(voxels).codes) > 0, voxels)


def test_the_same_seed_gives_the_same_weights_and_leaves_the_callers_random_numbers():
    torch.manual_seed(3)
    first = torch.rand(1)
    torch.manual_seed(3)
    one, two, other = nano(), nano(), nano(seed=1)
    assert torch.equal(torch.rand(1), first)
    assert all(torch.equal(a, b) for a, b in zip(one.parameters(), two.parameters(), strict=True))
    assert not torch.equal(one.decoder.place, other.decoder.place)


def test_it_is_saved_and_loaded_like_the_large_one(tmp_path):
    model = lively(nano())
    loaded = load_checkpoint(save_checkpoint(model, tmp_path / "model"))
    assert isinstance(loaded, VqNano)
    assert loaded.config == model.config
    assert torch.equal(loaded.decode(loaded.encode(two_grids()).codes), model(two_grids()).logits)


def quick(**changes):
    base = {"stage1_steps": 2, "stage2_steps": 4, "batch_size": 2, "warm_up": 1, "checkpoint_every": 2}
    return TrainingConfig(**(base | changes))


class KilledError(Exception):
    """Stands in for the signal."""


def killed_at_five(row):
    if row.step == 5:
        raise KilledError


def test_a_killed_run_that_goes_on_gives_the_same_weights(tmp_path):
    grids, config = box_grids(), quick(precision="bf16", log_every=1)
    train(nano(), grids, config, tmp_path / "whole")
    with pytest.raises(KilledError):
        train(nano(), grids, config, tmp_path / "killed", observer=killed_at_five)
    train(nano(), grids, config, tmp_path / "killed", resume=True)
    names = [tmp_path / run / "model" / "model.safetensors" for run in ("whole", "killed")]
    assert names[0].read_bytes() == names[1].read_bytes()


def test_stage_one_leaves_the_encoder_as_the_components_made_it(tmp_path):
    grids = box_grids()
    model = nano()
    start = {name: value.clone() for name, value in model.encoder.state_dict().items()}
    train(model, grids, quick(stage2_steps=0), tmp_path / "run")
    now = model.encoder.state_dict()
    changed = {name for name in start if not torch.equal(start[name], now[name])}
    assert changed == {"components.weight", "components.bias"}


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"grid": "3x2x2"}, "grid 3x2x2 does not divide 16 voxels an edge"),
        ({"token_channels": 513}, "token_channels 513 is more than the 512 voxels of a block"),
        ({"channels": 0}, "channels"),
    ],
)
def test_a_config_that_cannot_be_is_refused(changes, message):
    with pytest.raises(ValueError, match=message):
        nano(**changes)


def test_wrong_shapes_and_codes_are_refused():
    model = nano()
    with pytest.raises(BadInputError, match=r"voxel grid of shape \(1, 1, 8, 8, 8\): this model reads"):
        model.encode(torch.zeros(1, 1, 8, 8, 8))
    with pytest.raises(BadInputError, match=r"codes of shape \(1, 2, 2, 3\)"):
        model.decode(torch.zeros(1, 2, 2, 3, dtype=torch.int64))
    with pytest.raises(BadInputError, match=r"code 9 is not in the codebook: this model's codes are 0\.\.8"):
        model.decode(torch.full((1, 2, 2, 2), 9))


def test_an_empty_grid_has_no_token_and_decodes_to_nothing():
    model = nano()
    encoded = model.encode(torch.zeros(1, 1, 16, 16, 16))
    assert not encoded.codes.any()
    assert not (model.decode(encoded.codes) > 0).any()


def test_the_default_is_the_grid_of_the_papers_system_prompt():
    model = build_model(VqNanoConfig())
    assert (model.config.cells, model.config.block, model.config.codebook_size) == (
        (16, 8, 8),
        (4, 8, 8),
        8192,
    )
    # Half precision must stay under 8 MB.
    assert sum(tensor.numel() for tensor in model.parameters()) * 2 + 8191 * 64 * 2 < 8e6
