"""Training runs of a shrunk model: what they learn, what stops them, what they leave."""

import csv
import dataclasses
import math

import numpy as np
import pytest
import torch
from safetensors.torch import load_file
from simart_kit_plugins.simart.training.config import TrainingConfig, read_training_config
from simart_kit_plugins.simart.training.evaluation import evaluate
from simart_kit_plugins.simart.training.grids import Grids, pack
from simart_kit_plugins.simart.training.loop import train
from simart_kit_plugins.simart.training.window import batch_iou
from simart_kit_plugins.simart.vqvae.checkpoint import load_checkpoint
from simart_kit_plugins.simart.vqvae.model import SparseVQVAE
from simart_kit_plugins.simart.vqvae.stages import stage_parameters

from simart_kit.errors import BadInputError, OutputError
from simart_kit.output import claimed
from simart_kit.testing.meshes import boxes_mesh
from simart_kit.voxels import cube_frame, voxelise

from .vqvae_cases import lively, small


def box_grids(count=5, resolution=16):
    """Plates with a post at one corner, each of another width: most cells above the plate are empty."""
    bounds = [[((0, 0, 0), (4, 4, 0.4)), ((0, 0, 0), (0.4 + i / 4, 0.4, 4))] for i in range(count)]
    meshes = [boxes_mesh(pair) for pair in bounds]
    grids = [voxelise(m.triangles, cube_frame(m.bounds, resolution)).occupancy for m in meshes]
    return Grids(resolution, pack(np.stack(grids)), tuple(f"post {i}" for i in range(count)))


def quick(**changes):
    base = {
        "stage1_steps": 3,
        "stage2_steps": 5,
        "batch_size": 2,
        "learning_rate": 3e-3,
        "warm_up": 1,
        "checkpoint_every": 2,
        "log_every": 1,
    }
    return TrainingConfig(**(base | changes))


def started(seed=0, **changes):
    return SparseVQVAE(small(revive_after=2, **changes), seed)


def state(model):
    return {name: tensor.clone() for name, tensor in model.state_dict().items()}


def same(one, two):
    return one.keys() == two.keys() and all(torch.equal(one[name], two[name]) for name in one)


def test_the_loss_falls_and_what_was_learned_is_kept(tmp_path):
    rows = []
    schedule = {"stage1_steps": 10, "stage2_steps": 40, "log_every": 10, "checkpoint_every": 50}
    config = quick(batch_size=3, augment=False, **schedule)
    model = train(SparseVQVAE(small()), box_grids(), config, tmp_path, observer=rows.append)
    losses = [row.reconstruction for row in rows]
    # An even guess costs ln 2 a voxel; knowing only how many voxels are on costs their entropy.
    share = float(box_grids().occupancy(range(5)).mean())
    entropy = -share * math.log(share) - (1 - share) * math.log(1 - share)
    assert losses[0] > 0.9 * math.log(2)
    assert losses[-1] < entropy
    assert rows[-1].iou > 0.5 > rows[0].iou
    assert same(state(load_checkpoint(tmp_path / "model")), state(model))
    assert read_training_config(tmp_path / "training.json") == config


def test_stage_1_changes_only_what_it_trains(tmp_path):
    model = lively(started())
    before = state(model)
    train(model, box_grids(), quick(stage2_steps=0), tmp_path)
    trained = {id(p) for p in stage_parameters(model, 1)}
    names = {name for name, p in model.named_parameters() if id(p) in trained}
    changed = {name for name, tensor in model.state_dict().items() if not torch.equal(tensor, before[name])}
    assert changed - {"quantiser.idle_steps"} == names
    assert all(parameter.requires_grad for parameter in model.parameters())


@pytest.mark.parametrize("start", [True, False])
def test_entries_start_from_the_data_or_stay_as_they_were(tmp_path, start):
    model = SparseVQVAE(small(revive_after=0))
    before = model.quantiser.entries.detach().clone()
    config = quick(stage1_steps=1, stage2_steps=0, learning_rate=1e-9, start_codebook=start)
    train(model, box_grids(), config, tmp_path)
    assert torch.allclose(model.quantiser.entries, before, rtol=0, atol=1e-7) is not start


def test_torch_is_left_as_it_was(tmp_path):
    draws = torch.random.get_rng_state()
    train(started(), box_grids(), quick(stage2_steps=1), tmp_path)
    assert not torch.are_deterministic_algorithms_enabled()
    assert torch.equal(torch.random.get_rng_state(), draws)


def test_the_log_has_a_row_for_each_that_the_observer_is_told(tmp_path):
    rows = []
    train(started(), box_grids(), quick(log_every=3), tmp_path, observer=rows.append)
    assert [(row.step, row.stage) for row in rows] == [(3, 1), (6, 2), (8, 2)]
    with (tmp_path / "log.csv").open(newline="") as file:
        for row, line in zip(rows, csv.DictReader(file), strict=True):
            values = dataclasses.asdict(row)
            assert {name: float(text) for name, text in line.items()} == pytest.approx(values, rel=1e-5)
    assert all(0 <= row.iou <= 1 and 1 <= row.codes_used <= 8 and row.perplexity <= 8 for row in rows)
    assert rows[0].seconds < rows[1].seconds < rows[2].seconds


def test_half_precision_trains_weights_that_stay_whole(tmp_path):
    rows = []
    model = train(started(), box_grids(), quick(precision="bf16"), tmp_path, observer=rows.append)
    assert all(math.isfinite(row.total) for row in rows)
    assert {tensor.dtype for tensor in model.state_dict().values()} == {torch.float32, torch.int64}


def spoil_at(model, step):
    def observer(row):
        if row.step == step:
            with torch.no_grad():
                model.decoder.out_layer[2].bias.fill_(float("nan"))

    return observer


# Checkpoints are written every second step: a weight spoiled after step 3 shows in the loss of step 4, one
# spoiled at step 4 before its checkpoint is written.
@pytest.mark.parametrize(
    ("spoiled", "message"),
    [
        (3, "the loss or its gradient is not finite at step 4 (stage 2, fp32)"),
        (4, "decoder.out_layer.2.bias is not finite at step 4 (stage 2, fp32)"),
    ],
)
def test_a_loss_that_is_not_finite_stops_and_keeps_the_last_good_checkpoint(tmp_path, spoiled, message):
    model = started()
    with pytest.raises(BadInputError) as caught:
        train(model, box_grids(), quick(), tmp_path, observer=spoil_at(model, spoiled))
    good = tmp_path / "checkpoints" / "step-0000002"
    told = str(caught.value)
    assert told.startswith(message)
    assert f"the last good checkpoint is {good}; lower learning_rate, now 0.003" in told
    assert "\n" not in told
    assert all(torch.isfinite(tensor).all() for tensor in load_file(good / "model.safetensors").values())
    assert not (tmp_path / "model").exists()


def test_a_run_that_diverges_at_once_says_that_there_is_no_checkpoint(tmp_path):
    model = started()
    with torch.no_grad():
        model.decoder.out_layer[2].bias.fill_(float("inf"))
    with pytest.raises(BadInputError, match="no checkpoint was written yet; lower learning_rate"):
        train(model, box_grids(), quick(), tmp_path)


def test_what_does_not_fit_is_refused_before_anything_is_written(tmp_path):
    run = tmp_path / "run"
    with pytest.raises(BadInputError, match="grids of 8 voxels an edge: this model reads 16"):
        train(started(), box_grids(resolution=8), quick(), run)
    with pytest.raises(BadInputError, match="device 'cuda:99' is not on this machine"):
        train(started(), box_grids(), quick(device="cuda:99"), run)
    assert not run.exists()
    run.write_text("")
    with pytest.raises(OutputError, match="cannot write the run to"):
        train(started(), box_grids(), quick(), run)


def test_two_runs_do_not_share_a_folder(tmp_path):
    with claimed(tmp_path), pytest.raises(OutputError, match="another run is writing to"):
        train(started(), box_grids(), quick(), tmp_path)


def test_no_grids_are_refused():
    with pytest.raises(BadInputError, match="no grid to train on"):
        Grids(16, np.zeros((0, 512), dtype=np.uint8), ())


@pytest.mark.parametrize("mode", ["zero", "force-sparse", "dense"])
def test_an_evaluation_scores_what_the_codes_alone_bring_back(mode):
    model = lively(SparseVQVAE(small(mode=mode)), seed=3)
    grids = box_grids().occupancy(range(5))
    result = evaluate(model, grids, batch_size=2)
    ious, errors, codes = [], [], []
    for grid in grids:  # one at a time, with sums written out
        encoded = model.encode(torch.from_numpy(grid)[None, None])
        chance = model.decode(encoded.codes).sigmoid()[0, 0].numpy().astype(np.float64)
        if mode != "dense":  # a token speaks of 8 voxels an edge
            chance *= np.kron(encoded.occupied[0].numpy(), np.ones((8, 8, 8)))
        on = chance > 0.5
        ious.append((on & grid).sum() / (on | grid).sum())
        errors.append(((chance - grid) ** 2).mean())
        codes += encoded.codes[encoded.codes >= model.config.first_code].tolist()
    assert result.count == 5
    assert result.iou == pytest.approx(np.mean(ious))
    assert result.mse == pytest.approx(np.mean(errors), rel=1e-5)
    assert result.usage.used == len(set(codes))
    assert 0 < result.cd < 1


def test_an_evaluation_needs_grids_with_voxels():
    with pytest.raises(BadInputError, match="no grid to evaluate"):
        evaluate(started(), [])
    with pytest.raises(BadInputError, match="the true grid is empty"):
        evaluate(started(), np.zeros((1, 16, 16, 16), dtype=bool))
    with pytest.raises(BadInputError, match="this model reads"):
        evaluate(started(), np.ones((1, 8, 8, 8), dtype=bool))


def test_the_overlap_of_a_batch_is_a_mean_over_grids():
    voxels, logits = torch.zeros(3, 1, 2, 2, 2), torch.full((3, 1, 2, 2, 2), -1.0)
    voxels[0, 0, 0, 0] = 1  # two voxels; one of them and one other are decoded: 1 / 3
    logits[0, 0, 0, :, 0] = 1
    voxels[1, 0, 1, 1, 1] = logits[1, 0, 1, 1, 1] = 1  # right: 1; the third is empty and right: 1
    assert batch_iou(logits, voxels) == pytest.approx((1 / 3 + 1 + 1) / 3)
