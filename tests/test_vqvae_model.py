import numpy as np
import pytest
import torch
from simart_kit_plugins.simart.vqvae.blocks import ChannelNorm, ResBlock
from simart_kit_plugins.simart.vqvae.initialise import initialise_codebook, initialise_zero_token
from simart_kit_plugins.simart.vqvae.losses import dice_loss
from simart_kit_plugins.simart.vqvae.model import SparseVQVAE
from simart_kit_plugins.simart.vqvae.stages import stage_parameters
from torch.nn import functional

from simart_kit.errors import BadInputError

from .vqvae_cases import generator, lively, small, two_grids, two_grids_occupied

MODES = ("zero", "force-sparse", "dense")


def trained(config, steps=4, seed=0):
    """A few steps of both stages, and the losses on the way."""
    model, draw, totals = SparseVQVAE(config, seed), generator(seed), []
    initialise_codebook(model, [two_grids()], draw)
    for stage in (1, 2):
        optimiser = torch.optim.AdamW(stage_parameters(model, stage), lr=1e-3)
        for _ in range(steps):
            optimiser.zero_grad()
            output = model(two_grids())
            output.losses.total.backward()
            optimiser.step()
            model.quantiser.update(output.features, output.codes, draw)
            totals.append(output.losses.total.item())
    return model, totals


def weights(model):
    return {name: tensor.clone() for name, tensor in model.state_dict().items()}


def same(a, b):
    return all(torch.equal(a[name], b[name]) for name in a)


def test_one_seed_gives_one_model_and_leaves_the_callers_random_numbers_alone():
    torch.manual_seed(5)
    expected = torch.rand(3)
    torch.manual_seed(5)
    first = weights(SparseVQVAE(small(), seed=1))
    assert torch.equal(torch.rand(3), expected)
    assert same(first, weights(SparseVQVAE(small(), seed=1)))
    assert not same(first, weights(SparseVQVAE(small(), seed=2)))


@pytest.mark.parametrize("update", ["loss", "ema"])
def test_two_stages_of_training_lower_the_loss_and_repeat_exactly(update):
    config = small(codebook_update=update, revive_after=2, dice_weight=1.0)
    model, totals = trained(config)
    again, same_totals = trained(config)
    assert totals == same_totals
    assert same(weights(model), weights(again))
    assert totals[-1] < totals[0]


def test_stage_1_changes_codebook_and_first_layer_of_the_decoder_only_and_stage_2_everything():
    model = SparseVQVAE(small())
    names = {id(parameter): name for name, parameter in model.named_parameters()}
    assert {names[id(p)] for p in stage_parameters(model, 1)} == {
        "quantiser.zero_token",
        "quantiser.entries",
        "decoder.input_layer.weight",
        "decoder.input_layer.bias",
    }
    assert {id(p) for p in stage_parameters(model, 2)} == set(names)


@pytest.mark.parametrize(("mode", "empty"), [("zero", 0), ("force-sparse", -1)])
def test_encoding_marks_exactly_the_empty_cells(mode, empty):
    encoded = lively(SparseVQVAE(small(mode=mode))).encode(two_grids())
    assert torch.equal(encoded.occupied, two_grids_occupied())
    assert torch.equal(encoded.codes == empty, ~two_grids_occupied())
    assert encoded.codes.dtype == torch.int64


def test_dense_encoding_gives_every_cell_a_code_and_still_tells_which_are_occupied():
    encoded = lively(SparseVQVAE(small(mode="dense"))).encode(two_grids())
    assert torch.equal(encoded.occupied, two_grids_occupied())
    assert ((encoded.codes >= 0) & (encoded.codes < 9)).all()


def test_an_empty_grid_has_no_token_and_a_full_one_all():
    model = lively(SparseVQVAE(small()))
    assert not model.encode(torch.zeros(1, 1, 16, 16, 16)).codes.any()
    assert (model.encode(torch.ones(1, 1, 16, 16, 16)).codes > 0).all()


@pytest.mark.parametrize("dtype", [torch.bool, torch.uint8, torch.float64])
def test_the_type_of_the_voxels_does_not_matter(dtype):
    model = lively(SparseVQVAE(small()))
    assert torch.equal(model.encode(two_grids().to(dtype)).codes, model.encode(two_grids()).codes)


@pytest.mark.parametrize("mode", MODES)
@pytest.mark.parametrize(
    ("grid", "layout"), [("2x2x2", "spatial"), ("4x2x2", "spatial"), ("2x2x4", "flat-view")]
)
def test_decoding_the_codes_gives_the_logits_of_training(mode, grid, layout):
    model = lively(SparseVQVAE(small(mode=mode, grid=grid, layout=layout)))
    output = model(two_grids())
    assert output.logits.shape == (2, 1, 16, 16, 16)
    assert torch.equal(model.decode(model.encode(two_grids()).codes), output.logits)


def test_decoding_within_the_occupied_cells_turns_all_other_voxels_off_and_changes_no_other():
    model = lively(SparseVQVAE(small()))
    encoded = model.encode(two_grids())
    free, bound = model.decode(encoded.codes), model.decode(encoded.codes, encoded.occupied)
    allowed = torch.zeros(2, 1, 16, 16, 16, dtype=torch.bool)
    allowed[0, 0, :8] = True
    allowed[1, 0, 8:, :8, 8:] = True
    assert torch.equal(bound[allowed], free[allowed])
    assert (bound[~allowed] == -torch.inf).all()


def test_losses_agree_with_numpy():
    config = small(beta=0.3, dice_weight=0.7)
    model = lively(SparseVQVAE(config))
    output = model(two_grids())
    logits, truth = output.logits.detach().double().numpy(), two_grids().double().numpy()
    chance = 1 / (1 + np.exp(-logits))
    bce = -np.mean(truth * np.log(chance) + (1 - truth) * np.log1p(-chance))
    overlaps = [(2 * (p * t).sum() + 1) / (p.sum() + t.sum() + 1) for p, t in zip(chance, truth, strict=True)]
    occupied = two_grids_occupied().numpy()
    found = output.features.double().numpy()[occupied]
    entries = model.quantiser.entries.detach().double().numpy()
    squares = ((found[:, None] - entries) ** 2).sum(2).min(1)
    distance = squares.sum() / (5 * 64)  # 5 occupied cells of 64 numbers
    terms = output.losses
    assert terms.reconstruction.item() == pytest.approx(bce, rel=1e-5)
    assert terms.dice.item() == pytest.approx(1 - np.mean(overlaps), rel=1e-5)
    assert terms.codebook.item() == pytest.approx(distance, rel=1e-5)
    assert terms.commitment.item() == pytest.approx(distance, rel=1e-5)
    assert terms.total.item() == pytest.approx(bce + 0.7 * (1 - np.mean(overlaps)) + 1.3 * distance, rel=1e-5)


def test_dice_of_a_sure_and_right_answer_is_zero_and_of_a_sure_and_wrong_one_nearly_one():
    truth = two_grids()
    sure = (truth * 2 - 1) * 50
    assert dice_loss(sure, truth).item() == pytest.approx(0, abs=1e-6)
    # Wrong everywhere: no overlap, and all 4096 voxels of an object in the sum: 1 - 1/4097.
    assert dice_loss(-sure, truth).item() == pytest.approx(4096 / 4097)


def test_the_zero_token_learns_from_the_decoder_alone():
    model = lively(SparseVQVAE(small()))
    terms = model(two_grids()).losses
    token = model.quantiser.zero_token
    (terms.codebook + terms.commitment).backward(retain_graph=True)
    assert token.grad is None
    terms.reconstruction.backward()
    assert token.grad.any()


def test_entries_learn_from_the_codebook_loss_alone_and_the_encoder_from_the_other_two():
    model = lively(SparseVQVAE(small()))
    terms = model(two_grids()).losses
    first = model.encoder.input_layer.weight
    terms.codebook.backward(retain_graph=True)
    assert first.grad is None
    assert model.quantiser.entries.grad.any()
    model.zero_grad()
    terms.reconstruction.backward(retain_graph=True)
    assert model.quantiser.entries.grad is None
    assert first.grad.any()
    model.zero_grad()
    terms.commitment.backward()
    assert model.quantiser.entries.grad is None
    assert first.grad.any()


def test_half_precision_keeps_losses_and_codebook_in_float32():
    model = lively(SparseVQVAE(small()))
    with torch.autocast("cpu", dtype=torch.bfloat16):
        output = model(two_grids())
    output.losses.total.backward()
    assert output.losses.total.dtype == torch.float32
    assert output.losses.total.item() == pytest.approx(model(two_grids()).losses.total.item(), rel=0.1)
    assert torch.isfinite(model.encoder.input_layer.weight.grad).all()


def test_initialising_sets_the_zero_token_to_the_mean_feature_of_empty_cells():
    model = lively(SparseVQVAE(small()))
    features = model.features(two_grids())[0].detach()
    assert initialise_codebook(model, [two_grids()[:1], two_grids()[1:]], generator()) == 5
    expected = np.mean(
        [features[b, x, y, z].numpy() for b, x, y, z in torch.nonzero(~two_grids_occupied())], 0
    )
    np.testing.assert_allclose(model.quantiser.zero_token.detach().numpy(), expected, rtol=1e-5, atol=1e-6)
    assert model(two_grids()).losses.codebook.item() == pytest.approx(0, abs=1e-9)  # 5 features, 8 entries


def test_the_zero_token_stays_when_no_cell_is_empty_and_modes_without_one_ignore_it():
    model = lively(SparseVQVAE(small()))
    before = model.quantiser.zero_token.detach().clone()
    initialise_zero_token(model, torch.ones(1, 1, 16, 16, 16))
    assert torch.equal(model.quantiser.zero_token, before)
    dense = SparseVQVAE(small(mode="dense"))
    assert initialise_codebook(dense, [two_grids()], generator()) == 16


@pytest.mark.parametrize("batches", [[], [torch.zeros(1, 1, 16, 16, 16)]])
def test_a_codebook_cannot_be_started_from_nothing(batches):
    with pytest.raises(BadInputError, match="no voxel of the given shapes is on"):
        initialise_codebook(SparseVQVAE(small()), batches, generator())


@pytest.mark.parametrize("shape", [(16, 16, 16), (1, 1, 8, 8, 8), (1, 2, 16, 16, 16), (1, 1, 16, 16)])
def test_a_grid_of_another_shape_is_refused(shape):
    with pytest.raises(BadInputError, match=r"this model reads \(B, 1, 16, 16, 16\)"):
        SparseVQVAE(small()).encode(torch.zeros(shape))


def test_codes_and_cells_of_another_shape_are_refused():
    model, codes = SparseVQVAE(small()), torch.zeros(1, 2, 2, 2, dtype=torch.int64)
    with pytest.raises(
        BadInputError, match=r"^codes of shape \(1, 4, 2, 2\): this model reads \(B, 2, 2, 2\)"
    ):
        model.decode(torch.zeros(1, 4, 2, 2, dtype=torch.int64))
    with pytest.raises(BadInputError, match=r"^occupied cells of shape \(2, 2, 2\)"):
        model.decode(codes, torch.ones(2, 2, 2, dtype=torch.bool))
    with pytest.raises(BadInputError, match=r"code 9 is not in the codebook: this model's codes are 0\.\.8"):
        model.decode(codes + 9)


def test_the_channel_norm_is_that_of_numpy_at_each_voxel_and_keeps_the_type():
    norm = ChannelNorm(3, eps=1e-5)
    with torch.no_grad():
        norm.weight.copy_(torch.tensor([1.0, 2.0, 3.0]))
        norm.bias.copy_(torch.tensor([0.0, 0.5, 1.0]))
    x = torch.randn(2, 3, 2, 2, 2, generator=generator()) * 4 + 1
    given = x.numpy()
    normed = (given - given.mean(1, keepdims=True)) / np.sqrt(given.var(1, keepdims=True) + 1e-5)
    expected = normed * np.array([1, 2, 3]).reshape(3, 1, 1, 1) + np.array([0, 0.5, 1]).reshape(3, 1, 1, 1)
    np.testing.assert_allclose(norm(x).detach().numpy(), expected, rtol=1e-4, atol=1e-5)
    assert norm(x.half()).dtype == torch.float16


def test_a_new_residual_block_passes_its_input_on():
    x = torch.randn(1, 4, 3, 3, 3, generator=generator())
    assert torch.equal(ResBlock(4, 4)(x), x)
    widening = ResBlock(4, 6)
    assert torch.equal(widening(x), widening.skip_connection(x))


def norm(x, weights, name):
    moved = x.movedim(1, -1)
    scaled = functional.layer_norm(
        moved, moved.shape[-1:], weights[f"{name}.weight"], weights[f"{name}.bias"]
    )
    return scaled.movedim(-1, 1)


def conv(x, weights, name, **how):
    return functional.conv3d(x, weights[f"{name}.weight"], weights[f"{name}.bias"], **how)


def block(x, weights, name):
    h = conv(functional.silu(norm(x, weights, f"{name}.norm1")), weights, f"{name}.conv1", padding=1)
    return x + conv(functional.silu(norm(h, weights, f"{name}.norm2")), weights, f"{name}.conv2", padding=1)


def test_encoder_and_decoder_apply_the_named_weights_in_the_order_of_trellis():
    model = lively(SparseVQVAE(small(channels=(4, 6), resolution=4, latent_channels=3)))
    w = dict(model.encoder.state_dict())
    h = block(conv(two := torch.ones(1, 1, 4, 4, 4), w, "input_layer", padding=1), w, "blocks.0")
    h = block(conv(h, w, "blocks.1.conv", stride=2), w, "blocks.2")
    h = functional.silu(norm(block(h, w, "middle_block.0"), w, "out_layer.0"))
    mean = conv(h, w, "out_layer.2", padding=1)[:, :3]
    torch.testing.assert_close(model.encoder(two), mean)
    w = dict(model.decoder.state_dict())
    h = block(block(conv(mean, w, "input_layer", padding=1), w, "middle_block.0"), w, "blocks.0")
    h = conv(h, w, "blocks.1.conv", padding=1).reshape(1, 4, 2, 2, 2, 2, 2, 2)
    h = torch.einsum("bcijkxyz->bcxiyjzk", h).reshape(1, 4, 4, 4, 4)
    h = functional.silu(norm(block(h, w, "blocks.2"), w, "out_layer.0"))
    torch.testing.assert_close(model.decoder(mean), conv(h, w, "out_layer.2", padding=1))
