"""`simart-kit model import-trellis`: a model from TRELLIS' files, or a clear refusal and nothing written."""

import json

import pytest
import torch
from safetensors.torch import load_file, save_file
from simart_kit_plugins.simart.vqvae import config as config_module
from simart_kit_plugins.simart.vqvae.checkpoint import load_checkpoint, save_checkpoint
from simart_kit_plugins.simart.vqvae.model import SparseVQVAE

from simart_kit.cli.main import run

from .vqvae_cases import lively, small

# 16^3 latent cells as at full size, so that the paper's grids and codebooks fit; few channels.
SIZES = {"resolution": 16, "channels": (2,), "blocks_per_level": 1, "middle_blocks": 1}


@pytest.fixture
def home(tmp_path, monkeypatch):
    """A working folder with both files, of a network as small as a test needs."""
    full = config_module.VqvaeConfig
    monkeypatch.setattr(config_module, "VqvaeConfig", lambda **changes: full(**(SIZES | changes)))
    monkeypatch.chdir(tmp_path)
    source = lively(SparseVQVAE(full(**SIZES)), seed=3)
    for part in ("encoder", "decoder"):
        save_file(getattr(source, part).state_dict(), tmp_path / f"{part}.safetensors")
    return tmp_path


def imported(*more, out="out"):
    return run(["model", "import-trellis", "encoder.safetensors", "decoder.safetensors", out, *more])


@pytest.mark.parametrize(
    ("options", "grid", "codes", "preset"),
    [
        ([], "8x8x8", 4096, "--config full --start out "),
        (["--grid", "16x8x8"], "16x8x8", 4096, "--config full-16x8x8 "),
        (["--codebook", "8192"], "8x8x8", 8192, "--config full-8192 "),
        (["--grid", "16x8x8", "--codebook", "8192"], "16x8x8", 8192, "--config FILE --start out "),
    ],
    ids=["plain", "grid", "codebook", "both"],
)
def test_it_writes_a_model_and_says_how_to_go_on(home, capfd, options, grid, codes, preset):
    assert imported(*options) == 0

    out = capfd.readouterr().out
    model = load_checkpoint(home / "out")
    count = sum(parameter.numel() for parameter in model.parameters())
    assert out.startswith(f"out: {count:,} parameters, {grid} tokens, {codes} codes\n")
    assert "codes are still random" in out
    assert f"simart-kit train vqvae {preset}" in out
    assert (model.config.grid, model.config.codebook_size) == (grid, codes)
    given = load_file(home / "encoder.safetensors")
    assert all(model.encoder.state_dict()[name].equal(tensor) for name, tensor in given.items())
    assert {path.name for path in home.iterdir()} == {"decoder.safetensors", "encoder.safetensors", "out"}


def test_json_is_one_document(home, capfd):
    assert imported("--json", out="deep/er/out") == 0

    document = json.loads(capfd.readouterr().out)
    assert (document["ok"], document["model"]) == (True, "deep/er/out")
    assert (document["grid"], document["codebook"]) == ("8x8x8", 4096)
    assert "train vqvae --config full --start deep/er/out" in document["next"]


def test_a_model_and_an_empty_folder_are_replaced(home):
    (home / "empty").mkdir()
    save_checkpoint(SparseVQVAE(small()), home / "old")

    for out in ("empty", "old"):
        assert imported(out=out) == 0
        assert load_checkpoint(home / out).config.codebook_size == 4096
        assert sorted(path.name for path in (home / out).iterdir()) == ["config.json", "model.safetensors"]


def test_a_folder_that_is_no_model_is_refused_and_kept(home, capfd):
    (home / "thesis").mkdir()
    (home / "thesis" / "chapter.txt").write_text("years")
    (home / "settings").mkdir()
    (home / "settings" / "config.json").write_text("{}")

    assert imported(out="thesis") == 2
    told = "thesis holds other things than a model, such as chapter.txt: choose another folder"
    assert capfd.readouterr().err == f"error: {told}\n"
    assert imported(out="settings") == 2
    assert "settings/config.json is no config of a voxel model" in capfd.readouterr().err
    assert imported(out="encoder.safetensors") == 2
    assert "encoder.safetensors is a file: choose a folder" in capfd.readouterr().err
    assert (home / "thesis" / "chapter.txt").read_text() == "years"
    assert (home / "settings" / "config.json").read_text() == "{}"


def test_a_wrong_file_is_told_and_nothing_is_written(home, capfd):
    save_checkpoint(SparseVQVAE(small()), home / "old")
    before = (home / "old" / "model.safetensors").read_bytes()
    save_file({"other": torch.zeros(2)}, home / "decoder.safetensors")

    assert imported(out="old") == 2
    assert imported(out="new") == 2

    for line in capfd.readouterr().err.splitlines():
        assert line.startswith("error: decoder.safetensors does not fit: missing ")
        assert "give TRELLIS' ss_dec_conv3d_16l8_fp16.safetensors" in line
    assert (home / "old" / "model.safetensors").read_bytes() == before
    assert sorted(path.name for path in home.iterdir()) == [
        "decoder.safetensors",
        "encoder.safetensors",
        "old",
    ]


def test_a_write_that_fails_leaves_the_model_that_was_there(home, capfd, monkeypatch):
    save_checkpoint(SparseVQVAE(small()), home / "old")
    before = (home / "old" / "model.safetensors").read_bytes()

    def full_disk(tensors, path):
        path.write_bytes(b"half")
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("safetensors.torch.save_file", full_disk)

    assert imported(out="old") == 2

    assert "No space left on device" in capfd.readouterr().err
    assert (home / "old" / "model.safetensors").read_bytes() == before
    assert {path.name for path in home.iterdir()} == {"decoder.safetensors", "encoder.safetensors", "old"}


@pytest.mark.parametrize("options", [["--grid", "4x4x4"], ["--codebook", "9"]], ids=" ".join)
def test_a_size_that_the_paper_has_not_is_refused(home, capfd, options):
    assert imported(*options) == 2
    assert options[0] in capfd.readouterr().err
