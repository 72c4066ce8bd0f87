"""`model evaluate` and `model shrink`, from the command line."""

import json

import pytest
import torch
from safetensors.torch import load_file, save_file
from simart_kit_plugins.simart.models import build_model
from simart_kit_plugins.simart.training.scores import score
from simart_kit_plugins.simart.vqnano.config import VqNanoConfig
from simart_kit_plugins.simart.vqvae.checkpoint import load_checkpoint, save_checkpoint

from simart_kit.cli.main import run

from .test_vqvae_training import box_grids

torch.set_num_threads(1)


@pytest.fixture
def model(tmp_path):
    config = VqNanoConfig(codebook_size=16, channels=8, neighbour_channels=2, hidden_channels=8)
    return save_checkpoint(build_model(config), tmp_path / "model")


def test_wholes_and_parts_are_scored_apart_and_together():
    grids = box_grids(count=3)
    config = VqNanoConfig(resolution=16, grid="2x2x2", codebook_size=9, token_channels=4, channels=8)
    named = type(grids)(16, grids.packed, ("table", "table, part 1", "chair"))
    rows = {row.kind: row for row in score(build_model(config), named)}

    assert {kind: row.evaluation.count for kind, row in rows.items()} == {
        "whole objects": 2,
        "single parts": 1,
        "all": 3,
    }
    together = (2 * rows["whole objects"].evaluation.iou + rows["single parts"].evaluation.iou) / 3
    assert rows["all"].evaluation.iou == pytest.approx(together)
    # A plate at the bottom touches the four lower cells of eight, its post one of the upper ones.
    assert rows["all"].tokens == 5
    assert rows["all"].empty == pytest.approx(3 / 8)


def test_a_model_is_evaluated_on_generated_objects(model, capfd):
    assert run(["model", "evaluate", str(model), "--held-out", "1", "--json"]) == 0
    (rows,) = json.loads(capfd.readouterr().out)["scores"].values()
    assert rows[0]["kind"] == "whole objects"
    assert rows[0]["evaluation"]["count"] == 1
    assert 0 <= rows[0]["evaluation"]["iou"] <= 1

    assert run(["model", "evaluate", str(model), "--held-out", "1", "--quiet"]) == 0
    out, err = capfd.readouterr()
    assert out.splitlines()[0] == "generated objects"
    assert "IoU" in out.splitlines()[1]
    assert err == ""


def test_there_has_to_be_something_to_evaluate_on(model, capfd):
    assert run(["model", "evaluate", str(model), "--held-out", "0"]) == 2
    assert "nothing to evaluate on: give --held-out N, --data DIR" in capfd.readouterr().err


def test_a_folder_without_a_model_is_refused(tmp_path, capfd):
    assert run(["model", "evaluate", str(tmp_path)]) == 2
    assert "config.json" in capfd.readouterr().err


def test_a_shrunk_model_is_less_than_half_as_large_and_still_the_same_model(model, tmp_path, capfd):
    assert run(["model", "shrink", str(model), str(tmp_path / "small")]) == 0
    assert "MB" in capfd.readouterr().out
    sizes = [(folder / "model.safetensors").stat().st_size for folder in (model, tmp_path / "small")]
    assert sizes[1] / sizes[0] < 0.5
    large, small = (load_checkpoint(folder).state_dict() for folder in (model, tmp_path / "small"))
    assert large.keys() == small.keys()
    for name, tensor in large.items():
        if not name.startswith("quantiser."):
            assert torch.equal(small[name], tensor.half().float())
    entries, kept = large["quantiser.entries"], small["quantiser.entries"]
    # Half a step of 127 to the largest value of the channel.
    assert ((kept - entries).abs() <= entries.abs().amax(0) / 127 * 0.501).all()
    assert not small["quantiser.idle_steps"].any()


def test_a_shrunk_model_with_entries_of_another_type_is_refused(model, tmp_path, capfd):
    assert run(["model", "shrink", str(model), str(tmp_path / "small")]) == 0
    path = tmp_path / "small" / "model.safetensors"
    tensors = load_file(path)
    save_file({**tensors, "quantiser.entries": tensors["quantiser.entries"].float()}, path)
    assert run(["model", "evaluate", str(tmp_path / "small")]) == 2
    assert "quantiser.entries is of type F32, not I8" in capfd.readouterr().err


def test_nothing_of_somebody_elses_is_overwritten(model, tmp_path, capfd):
    (tmp_path / "mine").mkdir()
    (tmp_path / "mine" / "notes.txt").write_text("mine")
    assert run(["model", "shrink", str(model), str(tmp_path / "mine")]) == 2
    assert "holds other things than a model, such as notes.txt" in capfd.readouterr().err
    assert [path.name for path in (tmp_path / "mine").iterdir()] == ["notes.txt"]
