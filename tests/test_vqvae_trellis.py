"""Importing TRELLIS' weights; the names and shapes here are written down from its published files' layout."""

import numpy as np
import pytest
import torch
from safetensors.torch import load_file, save_file
from simart_kit_plugins.simart.vqvae.checkpoint import load_checkpoint, save_checkpoint
from simart_kit_plugins.simart.vqvae.config import VqvaeConfig
from simart_kit_plugins.simart.vqvae.model import SparseVQVAE
from simart_kit_plugins.simart.vqvae.space_to_depth import space_to_depth
from simart_kit_plugins.simart.vqvae.trellis import import_trellis

from simart_kit.errors import BadInputError

from .vqvae_cases import generator, small, two_grids

# Small, but with TRELLIS' two blocks a level and two in the middle: names and indices are the real ones.
SMALL = small(blocks_per_level=2, middle_blocks=2)


def res_block(name, channels):
    convolution = {"weight": (channels, channels, 3, 3, 3), "bias": (channels,)}
    shapes = {"norm1": {"weight": (channels,), "bias": (channels,)}, "conv1": convolution}
    shapes |= {"norm2": shapes["norm1"], "conv2": convolution}
    return {f"{name}.{layer}.{kind}": shape for layer, s in shapes.items() for kind, shape in s.items()}


def convolution(name, out, into, edge):
    return {f"{name}.weight": (out, into, edge, edge, edge), f"{name}.bias": (out,)}


def encoder_shapes(a, b, c):
    """ss_enc: two blocks, down, two blocks, down, two blocks, two in the middle; 2 x 8 channels out."""
    shapes = convolution("input_layer", a, 1, 3)
    shapes |= res_block("blocks.0", a) | res_block("blocks.1", a) | convolution("blocks.2.conv", b, a, 2)
    shapes |= res_block("blocks.3", b) | res_block("blocks.4", b) | convolution("blocks.5.conv", c, b, 2)
    shapes |= res_block("blocks.6", c) | res_block("blocks.7", c)
    shapes |= res_block("middle_block.0", c) | res_block("middle_block.1", c)
    shapes |= {"out_layer.0.weight": (c,), "out_layer.0.bias": (c,)}
    return shapes | convolution("out_layer.2", 16, c, 3)


def decoder_shapes(a, b, c):
    """ss_dec: two in the middle, two blocks, up to 8 x the next channels, two, up, two; one logit out."""
    shapes = convolution("input_layer", c, 8, 3)
    shapes |= res_block("middle_block.0", c) | res_block("middle_block.1", c)
    shapes |= res_block("blocks.0", c) | res_block("blocks.1", c) | convolution("blocks.2.conv", 8 * b, c, 3)
    shapes |= res_block("blocks.3", b) | res_block("blocks.4", b) | convolution("blocks.5.conv", 8 * a, b, 3)
    shapes |= res_block("blocks.6", a) | res_block("blocks.7", a)
    shapes |= {"out_layer.0.weight": (a,), "out_layer.0.bias": (a,)}
    return shapes | convolution("out_layer.2", 1, a, 3)


def half(name):
    """Published: convolutions of the torso in float16; norms, first and last layers in float32."""
    return name.startswith(("blocks.", "middle_block.")) and ".norm" not in name


def synthetic(path, shapes, seed):
    draw, tensors = generator(seed), {}
    for name, shape in shapes.items():
        values = torch.randn(shape, generator=draw) * 0.02
        tensors[name] = values.half() if half(name) else values
    save_file(tensors, path)
    return path


@pytest.fixture
def files(tmp_path):
    return (
        synthetic(tmp_path / "ss_enc.safetensors", encoder_shapes(4, 8, 16), 1),
        synthetic(tmp_path / "ss_dec.safetensors", decoder_shapes(4, 8, 16), 2),
    )


def holds(module, path):
    """Whether a module's weights are exactly those of a file, in float32."""
    state, given = module.state_dict(), load_file(path)
    return state.keys() == given.keys() and all(
        state[name].dtype == torch.float32 and torch.equal(state[name], tensor.float())
        for name, tensor in given.items()
    )


def test_published_names_map_onto_ours_and_half_precision_becomes_float32(files):
    model = import_trellis(*files, SMALL)
    assert holds(model.encoder, files[0])
    assert holds(model.decoder, files[1])
    assert torch.isfinite(model(two_grids()).losses.total)


def test_the_zero_token_is_the_mean_token_of_an_empty_grid(files):
    model = import_trellis(*files, SMALL)
    with torch.no_grad():
        tokens = space_to_depth(model.encoder(torch.zeros(1, 1, 16, 16, 16)), (2, 2, 2), "spatial")
    expected = tokens.reshape(8, 64).numpy().mean(0)
    np.testing.assert_allclose(model.quantiser.zero_token.detach().numpy(), expected, rtol=1e-5, atol=1e-7)
    assert np.abs(expected).max() > 1e-3  # emptiness is no zero vector


def test_modes_without_a_zero_token_import_too(files):
    assert import_trellis(*files, SMALL.model_copy(update={"mode": "dense"})).quantiser.zero_token is None


def refusal(*arguments):
    with pytest.raises(BadInputError) as caught:
        import_trellis(*arguments)
    assert "\n" not in str(caught.value)
    return str(caught.value)


def test_missing_unexpected_and_misshaped_names_are_listed_with_the_file(files):
    tensors = load_file(files[0])
    tensors["blocks.9.conv.weight"] = tensors.pop("blocks.5.conv.weight")
    tensors["input_layer.weight"] = torch.zeros(4, 2, 3, 3, 3)
    save_file(tensors, files[0])
    assert refusal(*files, SMALL) == (
        f"{files[0]} does not fit: missing blocks.5.conv.weight; unexpected blocks.9.conv.weight; "
        "input_layer.weight is (4, 2, 3, 3, 3), not (4, 1, 3, 3, 3): give TRELLIS' "
        "ss_enc_conv3d_16l8_fp16.safetensors, or a config with the channels of the file"
    )


def test_files_in_the_wrong_order_and_a_config_of_other_channels_are_refused(files):
    assert "input_layer.weight is (16, 8, 3, 3, 3), not (4, 1, 3, 3, 3)" in refusal(*files[::-1], SMALL)
    wider = SMALL.model_copy(update={"channels": (4, 8, 32)})
    assert "(16, 8, 2, 2, 2), not (32, 8, 2, 2, 2)" in refusal(*files, wider)


def test_a_damaged_or_missing_file_is_refused(files):
    files[1].write_bytes(files[1].read_bytes()[:-1])
    assert f"cannot read {files[1]}: damaged or no safetensors file" in refusal(*files, SMALL)
    files[1].unlink()
    assert f"cannot read {files[1]}: no such file" in refusal(*files, SMALL)


def count(module):
    return sum(parameter.numel() for parameter in module.parameters())


@pytest.mark.slow
@pytest.mark.timeout(900)
def test_the_full_size_model_trains_a_step_saves_loads_and_imports_trellis(tmp_path):
    config = VqvaeConfig()
    channels = config.channels
    model = SparseVQVAE(config)
    # The published 59.30 M and 73.67 M, counted from the shapes above; they differ from ours if a layer does.
    for part, shapes, millions in (
        (model.encoder, encoder_shapes(*channels), 59.30),
        (model.decoder, decoder_shapes(*channels), 73.67),
    ):
        assert {name: tuple(t.shape) for name, t in part.state_dict().items()} == shapes
        assert count(part) == sum(map(np.prod, shapes.values()))
        assert round(count(part) / 1e6, 2) == millions
    grid = torch.zeros(1, 1, 64, 64, 64)
    grid[0, 0, 20:44, 20:44, 20] = 1  # tokens 2..5 in x and y, 2 in z
    output = model(grid)
    output.losses.total.backward()
    assert output.logits.shape == grid.shape
    assert torch.nonzero(output.codes).tolist() == [[0, x, y, 2] for x in range(2, 6) for y in range(2, 6)]
    assert model.encoder.out_layer[2].weight.grad[:8].any()
    encoder_file = synthetic(tmp_path / "ss_enc.safetensors", encoder_shapes(*channels), 1)
    decoder_file = synthetic(tmp_path / "ss_dec.safetensors", decoder_shapes(*channels), 2)
    imported = import_trellis(encoder_file, decoder_file, config)
    loaded = load_checkpoint(save_checkpoint(imported, tmp_path / "model"))
    assert holds(loaded.encoder, encoder_file)
    assert holds(loaded.decoder, decoder_file)
    assert torch.equal(loaded.quantiser.zero_token, imported.quantiser.zero_token)
