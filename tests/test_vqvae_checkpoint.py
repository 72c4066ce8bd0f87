import json
import struct

import pytest
import torch
from safetensors.torch import load_file, save_file
from simart_kit_plugins.simart.vqvae.checkpoint import load_checkpoint, save_checkpoint
from simart_kit_plugins.simart.vqvae.config_file import write_config
from simart_kit_plugins.simart.vqvae.model import SparseVQVAE
from simart_kit_plugins.simart.vqvae.weights import read_tensors

from simart_kit.errors import BadInputError, OutputError

from .vqvae_cases import generator, lively, small, two_grids

MODES = ("zero", "force-sparse", "dense")


@pytest.fixture
def folder(tmp_path):
    return save_checkpoint(lively(SparseVQVAE(small())), tmp_path / "model")


def refusal(folder):
    """The one line that loading gives."""
    with pytest.raises(BadInputError) as caught:
        load_checkpoint(folder)
    told = str(caught.value)
    assert "\n" not in told
    assert str(folder) in told
    return told


@pytest.mark.parametrize("update", ["loss", "ema"])
@pytest.mark.parametrize("mode", MODES)
def test_a_saved_model_is_the_same_model(tmp_path, mode, update):
    model = lively(SparseVQVAE(small(mode=mode, codebook_update=update)))
    output = model(two_grids())
    model.quantiser.update(output.features, output.codes, generator())  # so that no buffer is as new
    loaded = load_checkpoint(save_checkpoint(model, tmp_path))
    assert loaded.config == model.config
    state = model.state_dict()
    assert all(torch.equal(tensor, state[name]) for name, tensor in loaded.state_dict().items())
    assert torch.equal(loaded(two_grids()).logits, model(two_grids()).logits)


def test_saving_twice_gives_the_same_bytes_and_leaves_nothing_else(folder):
    before = {path.name: path.read_bytes() for path in folder.iterdir()}
    save_checkpoint(load_checkpoint(folder), folder)
    assert {path.name: path.read_bytes() for path in folder.iterdir()} == before
    assert sorted(before) == ["config.json", "model.safetensors"]


def test_a_folder_that_cannot_be_written_is_told_in_one_line(tmp_path):
    (tmp_path / "taken").write_text("")
    with pytest.raises(OutputError, match=r"cannot write the model to .*taken"):
        save_checkpoint(SparseVQVAE(small()), tmp_path / "taken")


def test_a_wrong_codebook_size_names_file_tensor_and_both_shapes(folder):
    write_config(small(codebook_size=17), folder / "config.json")
    told = refusal(folder)
    assert "model.safetensors does not fit" in told
    assert "quantiser.entries is (8, 64), not (16, 64)" in told


def test_weights_of_other_channels_name_a_few_tensors_and_count_the_rest(folder):
    write_config(small(channels=(4, 8, 12)), folder / "config.json")
    told = refusal(folder)
    assert "encoder.blocks.3.conv.weight is (16, 8, 2, 2, 2), not (12, 8, 2, 2, 2)" in told
    assert " more: give the model.safetensors that was saved with this config.json" in told


def changed(folder, change):
    path = folder / "model.safetensors"
    tensors = load_file(path)
    change(tensors)
    save_file(tensors, path)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (lambda t: t.pop("decoder.out_layer.2.bias"), "missing decoder.out_layer.2.bias"),
        (lambda t: t.update(extra=torch.zeros(1)), "unexpected extra"),
        (
            lambda t: t.update({"quantiser.zero_token": torch.zeros(63)}),
            "quantiser.zero_token is (63,), not (64,)",
        ),
        (
            lambda t: t.update({"quantiser.zero_token": torch.zeros(64, dtype=torch.int32)}),
            "quantiser.zero_token is of type I32",
        ),
        (
            lambda t: t.update({"quantiser.idle_steps": torch.zeros(8)}),
            "quantiser.idle_steps is of type F32, not I64",
        ),
        (lambda t: t["quantiser.zero_token"].fill_(float("nan")), "quantiser.zero_token not finite"),
        (lambda t: t.clear(), "missing encoder.input_layer.weight"),
    ],
)
def test_weights_that_are_not_those_of_the_config_are_refused(folder, change, message):
    changed(folder, change)
    assert message in refusal(folder)


def test_all_mistakes_are_told_at_once(folder):
    def change(tensors):
        tensors["added"] = tensors.pop("decoder.out_layer.2.bias")
        tensors["quantiser.zero_token"] = torch.zeros(3)

    changed(folder, change)
    names = "missing decoder.out_layer.2.bias; unexpected added; quantiser.zero_token is (3,), not (64,)"
    assert names in refusal(folder)


@pytest.mark.parametrize("kept", [0, 7, 100, 0.5, 0.999])
def test_truncated_weights_are_refused(folder, kept):
    path = folder / "model.safetensors"
    whole = path.read_bytes()
    path.write_bytes(whole[: int(kept * len(whole)) if isinstance(kept, float) else kept])
    assert "model.safetensors: damaged or no safetensors file" in refusal(folder)


# A header that promises nine numbers where one follows.
HEADER = json.dumps({"a": {"dtype": "F32", "shape": [9], "data_offsets": [0, 4]}}).encode()
NO_SAFETENSORS = {
    "noise": b"\xff" * 64,
    "endless header": struct.pack("<Q", 2**62) + b"{}",
    "no json": struct.pack("<Q", 4) + b"{{{{",
    "zip archive of a pickle": b"PK\x03\x04" + b"\x00" * 60,
    "too few numbers": struct.pack("<Q", len(HEADER)) + HEADER + b"0000",
}


@pytest.mark.parametrize("content", NO_SAFETENSORS.values(), ids=NO_SAFETENSORS.keys())
def test_what_is_no_safetensors_file_is_refused(folder, content):
    (folder / "model.safetensors").write_bytes(content)
    assert "model.safetensors: damaged or no safetensors file" in refusal(folder)


def test_missing_files_are_refused(folder, tmp_path):
    (folder / "model.safetensors").unlink()
    assert "model.safetensors: no such file" in refusal(folder)
    (folder / "model.safetensors").mkdir()
    assert "cannot read" in refusal(folder)
    assert "config.json: No such file" in refusal(tmp_path / "nowhere")


def test_half_precision_weights_load_as_float32(folder):
    expected = load_checkpoint(folder)
    path, like = folder / "model.safetensors", expected.state_dict()
    save_file({n: t.half() if t.is_floating_point() else t for n, t in load_file(path).items()}, path)
    read = read_tensors(path, like, advice="")
    assert all(read[name].dtype == tensor.dtype for name, tensor in like.items())
    loaded = load_checkpoint(folder)
    assert loaded.quantiser.entries.dtype == torch.float32
    torch.testing.assert_close(loaded.quantiser.entries, expected.quantiser.entries, rtol=1e-3, atol=1e-4)
