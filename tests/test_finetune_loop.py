"""Fine-tuning: what is learnt, stopped runs that go on, and what is refused."""

from __future__ import annotations

import csv
import os
import signal
from dataclasses import replace

import pytest
import torch
from safetensors.torch import load_file
from simart_kit_plugins.simart.finetune.checkpointing import latest
from simart_kit_plugins.simart.finetune.loop import finetune
from simart_kit_plugins.simart.mllm.bundle import load_bundle

from simart_kit.errors import BadInputError

from .finetune_cases import box, data, model, plan

pytestmark = pytest.mark.slow


def shards(picture=False):
    """Two shards of six records."""
    return [[box(6 * shard + number, picture=picture) for number in range(6)] for shard in range(2)]


def run(folder, config, seed=0, records=None, **options):
    records = data(folder / "data", shards()) if records is None else records
    return finetune(model(seed), records, config, folder / "run", device="cpu", **options)


def weights(folder):
    return (folder / "run" / "model" / "model.safetensors").read_bytes()


def logged(folder):
    with (folder / "run" / "log.csv").open(newline="") as file:
        return list(csv.DictReader(file))


def stop_at(step):
    def observer(row):
        if row.step == step:
            os.kill(os.getpid(), signal.SIGINT)

    return observer


def test_a_small_set_is_learnt_and_the_model_can_be_loaded(tmp_path):
    config = plan(steps=30, learning_rate=0.01, log_every=10, checkpoint_every=30, grounding_share=0.0)
    folder = run(tmp_path, config)
    rows = logged(tmp_path)
    assert float(rows[-1]["loss"]) < 0.5 * float(rows[0]["loss"])
    assert float(rows[-1]["right_number"]) > float(rows[0]["right_number"])
    loaded = load_bundle(str(folder), device="cpu")
    assert loaded.settings.prompt == "none"
    assert loaded.settings.picture
    assert loaded.settings.training["steps"] == 30


# Stopped after step 3 by Ctrl-C, which keeps step 3; and killed after it, when step 2 was kept.
@pytest.mark.parametrize(("kept", "precision"), [(3, "bf16"), (2, "fp32")])
def test_a_run_that_goes_on_gives_the_same_weights(tmp_path, kept, precision):
    config = plan(steps=5, precision=precision, lanes=2, picture_share=0.5)
    records = data(tmp_path / "data", shards(picture=True))
    run(tmp_path / "whole", config, records=records)

    def kill(row):
        if row.step == 3:
            raise RuntimeError("killed")

    stopped, error = (stop_at(3), KeyboardInterrupt) if kept == 3 else (kill, RuntimeError)
    with pytest.raises(error):
        run(tmp_path / "parts", config, records=records, observer=stopped)
    assert latest(tmp_path / "parts" / "run").name == f"step-{kept:07d}"
    # The model that is handed over for going on does not matter: its weights are those of the checkpoint.
    run(tmp_path / "parts", config, seed=5, records=records, resume=True)
    assert weights(tmp_path / "parts") == weights(tmp_path / "whole")
    assert [row["step"] for row in logged(tmp_path / "parts")] == list("12345")
    steps = ("step", "loss", "norm", "tokens")
    rows = [[{name: row[name] for name in steps} for row in logged(tmp_path / n)] for n in ("whole", "parts")]
    assert rows[0] == rows[1]


def test_layers_that_are_computed_again_change_nothing(tmp_path):
    records = data(tmp_path / "data", shards(picture=True))
    config = plan(steps=2, picture_share=0.5)
    run(tmp_path / "kept", config, records=records)
    again = config.model_copy(update={"checkpoint_layers": True})
    run(tmp_path / "again", again, records=records)
    assert weights(tmp_path / "again") == weights(tmp_path / "kept")


def test_a_frozen_vision_tower_stays_as_it_was(tmp_path):
    config = plan(steps=2, picture_share=1.0, train_vision=False)
    run(tmp_path, config, records=data(tmp_path / "data", shards(picture=True)))
    before, after = model().model.state_dict(), load_file(tmp_path / "run" / "model" / "model.safetensors")
    frozen = [name for name in after if ".visual." in name]
    assert frozen
    assert all(torch.equal(after[name], before[name]) for name in frozen)
    assert not torch.equal(
        after["model.language_model.norm.weight"], before["model.language_model.norm.weight"]
    )


def test_lanes_read_other_records_and_two_shards_give_one_each(tmp_path):
    records = data(tmp_path, shards())
    first, second = ({r.key for r in records.training(0, 0, lane, 2)} for lane in range(2))
    assert first | second == {r.key for shard in shards() for r in shard}
    assert not first & second
    third = [{r.key for r in records.training(0, 0, lane, 3)} for lane in range(3)]
    assert [len(keys) for keys in third] == [4, 4, 4]
    assert len(set.union(*third)) == 12


def test_held_out_objects_are_never_trained_on(tmp_path):
    many = [[box(number, state) for number in range(100) for state in range(2)]]
    records = data(tmp_path, many, held_out=0.2)
    judged = records.judged(1000)
    trained = {r.object for r in records.training(0, 0, 0, 1)}
    assert 10 <= len(judged) <= 30
    assert len(trained) == 100 - len(judged)
    assert not trained & {r.object for r in judged}
    assert [r.key for r in records.judged(3)] == [r.key for r in judged[:3]]


def test_a_run_is_gone_on_with_only_as_it_began(tmp_path):
    config = plan(steps=2)
    run(tmp_path, config)
    with pytest.raises(BadInputError, match="has a run already, up to step-0000002"):
        run(tmp_path, config)
    with pytest.raises(BadInputError, match=r"steps 2, now 3"):
        run(tmp_path, plan(steps=3), resume=True)
    with pytest.raises(BadInputError, match="records tests, now others"):
        run(
            tmp_path,
            config,
            records=replace(data(tmp_path / "data", shards()), fingerprint="others"),
            resume=True,
        )
    share = latest(tmp_path / "run") / "rank-00000.safetensors"
    share.write_bytes(share.read_bytes()[:5000])
    with pytest.raises(BadInputError, match="damaged"):
        run(tmp_path, config, resume=True)


def test_no_example_that_fits_is_told(tmp_path):
    with pytest.raises(BadInputError, match="no example of at most 64 tokens"):
        run(tmp_path, plan(longest=64))


def test_a_loss_that_is_not_finite_ends_the_run(tmp_path):
    bundle = model()
    with torch.no_grad():
        bundle.model.model.language_model.layers[0].mlp.down_proj.weight.fill_(float("nan"))
    with pytest.raises(BadInputError, match=r"not finite at step 1 .* no checkpoint was written yet"):
        finetune(bundle, data(tmp_path, shards()), plan(), tmp_path / "run", device="cpu")
