"""`simart-kit train vqvae`: what it trains, tells and refuses; a shrunk model on a folder of boxes."""

import json
import re

import pytest
from simart_kit_plugins.simart.commands.training_display import Display
from simart_kit_plugins.simart.training.config import read_training_config
from simart_kit_plugins.simart.training.presets import packaged_presets, read_preset
from simart_kit_plugins.simart.vqvae.checkpoint import load_checkpoint, save_checkpoint
from simart_kit_plugins.simart.vqvae.config import VqvaeConfig
from simart_kit_plugins.simart.vqvae.model import SparseVQVAE

from simart_kit.cli.main import run
from simart_kit.testing.meshes import box

from .vqvae_cases import lively, small

TRAINING = {
    "stage1_steps": 2,
    "stage2_steps": 3,
    "batch_size": 2,
    "warm_up": 1,
    "checkpoint_every": 2,
    "log_every": 1,
}


@pytest.fixture
def home(tmp_path, monkeypatch):
    """A working folder with a config, and with meshes of which one is damaged."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    (tmp_path / "meshes").mkdir()
    for number in range(3):
        vertices, faces = box((0, 0, 0), (1, 0.2 + number / 4, 0.1))
        lines = ["v {} {} {}".format(*v) for v in vertices] + ["f {} {} {}".format(*f) for f in faces + 1]
        (tmp_path / "meshes" / f"{number}.obj").write_text("\n".join(lines) + "\n")
    (tmp_path / "meshes" / "broken.glb").write_text("no glTF")
    write_config(tmp_path / "tiny.json")
    return tmp_path


def write_config(path, model="sparse-vqvae", config=None, **training):
    table = {**small(revive_after=0).model_dump(mode="json"), **(config or {})}
    path.write_text(
        json.dumps({"schema": 1, "model": model, "config": table, "training": TRAINING | training})
    )


def train(*more, folder="out"):
    fixed = ["--config", "tiny.json", "--data", "meshes", "--held-out", "0"]
    return run(["train", "vqvae", *fixed, "--run", folder, *more])


def weights(folder):
    return (folder / "model" / "model.safetensors").read_bytes()


def test_it_trains_and_tells_where_the_model_is(home, capfd):
    assert train() == 0

    out, err = capfd.readouterr()
    assert out == "model: out/model\nlog: out/log.csv\n"
    rows = re.findall(r"^step (\d)/5 stage (\d)  loss \d", err, re.MULTILINE)
    assert rows == [("1", "1"), ("2", "1"), ("3", "2"), ("4", "2"), ("5", "2")]
    assert re.search(r"^warning: .*broken\.glb", err, re.MULTILINE)
    assert "shapes of meshes: 4 of 4" in err
    assert "training tiny.json on 3 grids, 5 steps, cpu" in err
    assert load_checkpoint(home / "out" / "model").config == small(revive_after=0)
    # Each of the three shapes that could be read has a file in the cache.
    assert len(list((home / "cache" / "simart-kit" / "voxels").iterdir())) == 3


def test_options_change_the_preset(home):
    changes = {"stage1-steps": 1, "stage2-steps": 0, "batch-size": 1, "learning-rate": 0.01, "seed": 4}
    options = [text for name, value in changes.items() for text in (f"--{name}", str(value))]

    assert train(*options, "--precision", "bf16", "--device", "cpu", "--threads", "1", "-q") == 0

    config = read_training_config(home / "out" / "training.json")
    assert {name: getattr(config, name.replace("-", "_")) for name in changes} == changes
    assert (config.precision, config.device, config.checkpoint_every) == ("bf16", "cpu", 2)


def test_json_is_one_document_with_the_scores_of_held_out_objects(home, capfd):
    assert train("--procedural", "1", "--held-out", "2", "--json") == 0

    document = json.loads(capfd.readouterr().out)
    assert (document["ok"], document["model"], document["steps"]) == (True, "out/model", 5)
    assert document["grids"] > 3
    assert document["held_out"]["count"] >= 2
    assert 0 <= document["held_out"]["iou"] <= 1
    assert document["held_out"]["usage"]["entries"] == 8


def test_an_interrupted_run_says_how_to_go_on_and_ends_as_if_it_had_not_been(home, capfd, monkeypatch):
    assert train(folder="whole") == 0

    def interrupt_at(step):
        def show(self, row, config, codes):
            if row.step == step:
                raise KeyboardInterrupt

        return show

    with monkeypatch.context() as patch:
        patch.setattr(Display, "row", interrupt_at(1))
        assert train() == 130
        assert "out has no checkpoint yet: the same command begins again" in capfd.readouterr().err
        patch.setattr(Display, "row", interrupt_at(3))
        assert train() == 130
        told = capfd.readouterr().err
        assert "out has a checkpoint, step-0000002: the same command with --resume goes on from it" in told

    assert train() == 2
    assert "out has a run already, up to step-0000002: go on with --resume" in capfd.readouterr().err
    assert train("--resume") == 0
    assert weights(home / "out") == weights(home / "whole")


def test_it_begins_with_another_model_and_keeps_its_codes_if_told(home, capfd):
    # Fields that say how a model is trained may differ: its weights fit.
    given = lively(SparseVQVAE(small(beta=0.5)))
    save_checkpoint(given, home / "given")
    slow = ["--learning-rate", "1e-30", "--start", "given", "-q"]

    assert train(*slow, "--keep-codebook", folder="kept") == 0
    assert train(*slow, folder="new") == 0

    kept, new = (load_checkpoint(home / name / "model").state_dict() for name in ("kept", "new"))
    entries = "quantiser.entries"
    assert all(kept[name].equal(parameter) for name, parameter in given.named_parameters())
    assert new["encoder.input_layer.weight"].equal(kept["encoder.input_layer.weight"])
    assert not new[entries].equal(kept[entries])
    assert train("--keep-codebook", folder="more") == 2
    assert "--keep-codebook keeps the codes of a model: give it with --start" in capfd.readouterr().err


@pytest.mark.parametrize(
    ("options", "told"),
    [
        (["--config", "huge"], "unknown config 'huge': no such file, and the presets are "),
        (["--config", "meshes"], "cannot read config meshes: Is a directory"),
        (["--config", "meshes/0.obj"], "meshes/0.obj is no config of a training: file: Invalid JSON"),
        (["--config", "other.json"], "other.json: model 'gan' is not known: use sparse-vqvae or vq-nano"),
        (["--config", "odd.json"], "odd.json: config of sparse-vqvae: file: Value error, resolution 15"),
        (["--config", "typo.json"], "training.stage3_steps: Extra inputs are not permitted"),
        (["--data", "nowhere"], "nowhere is no folder"),
        (["--batch-size", "0"], "training options: batch_size: Input should be greater than 0"),
        (["--stage1-steps", "0", "--stage2-steps", "0"], "nothing would be trained"),
        (["--device", "cuda:99"], "device 'cuda:99' is not on this machine"),
        (["--device", "abacus"], "training options: device: "),
        (["--precision", "fp8"], "--precision"),
        (["--seed", "4294967295"], "seed 4294967295 is not below 4294967295, the seed of the held-out"),
        (["--start", "nowhere"], "cannot read nowhere/config.json"),
        (["--start", "other"], "other is a model of another config (codebook_size 17, not 9): start with"),
    ],
    ids=lambda value: " ".join(value) if isinstance(value, list) else None,
)
def test_a_mistake_is_one_line_and_makes_no_run(home, capfd, options, told):
    write_config(home / "other.json", model="gan")
    write_config(home / "odd.json", config={"resolution": 15})
    write_config(home / "typo.json", stage3_steps=1)
    save_checkpoint(SparseVQVAE(small(codebook_size=17)), home / "other")

    assert train(*options) == 2

    (line,) = re.findall(r"^error: .*$", capfd.readouterr().err, re.MULTILINE)
    assert told in line
    assert not (home / "out").exists()


def test_without_data_there_is_nothing_to_train_on(home, capfd):
    assert run(["train", "vqvae", "--config", "tiny.json", "--run", "out"]) == 2
    assert "give --data DIR, --procedural N, or both" in capfd.readouterr().err


@pytest.mark.parametrize("name", packaged_presets())
def test_packaged_presets_can_be_read(name):
    assert read_preset(name).config.resolution == 64


@pytest.mark.parametrize(
    ("name", "changes"),
    [
        ("full", {}),
        ("full-16x8x8", {"grid": "16x8x8"}),
        ("full-8192", {"codebook_size": 8192}),
        ("full-force-sparse", {"mode": "force-sparse"}),
        ("full-dense", {"mode": "dense"}),
    ],
)
def test_the_paper_s_configurations_differ_in_one_thing_and_train_in_two_stages(name, changes):
    preset = read_preset(name)

    assert preset.config == VqvaeConfig(**changes)
    assert (preset.training.stage1_steps, preset.training.stage2_steps) == (60_000, 60_000)
