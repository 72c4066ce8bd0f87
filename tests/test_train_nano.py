"""`simart-kit train nano`: pool, steps, going on, judging, and what it refuses."""

import json
import re
from dataclasses import replace

import numpy as np
import pytest
import torch
from simart_kit_plugins.nano.config import NanoConfig
from simart_kit_plugins.nano.network import NanoNetwork
from simart_kit_plugins.nano.training import checkpoint, pool
from simart_kit_plugins.nano.training.loop import batch_rows, train, with_names
from simart_kit_plugins.nano.training.plan import UNSEEN, TrainingPlan
from simart_kit_plugins.nano.training.scores import score
from simart_kit_plugins.nano.weights import load_model, save_network

from simart_kit.cli.main import run
from simart_kit.errors import BadInputError

torch.set_num_threads(1)
TINY = NanoConfig(channels=16, layers=1, heads=2, hidden=16, point_channels=8)
PLAN = TrainingPlan(
    objects=12, held_out=4, steps=6, batch_size=4, warm_up=2, checkpoint_every=2, log_every=2, network=TINY
)


@pytest.fixture(scope="module")
def objects(tmp_path_factory):
    """The files of a tiny pool, made once."""
    folder = tmp_path_factory.mktemp("pool")
    files = pool.shards(PLAN, folder, pool.TRAIN)
    told = []
    pool.make(files, 1, lambda *now: told.append(now))
    assert told == [(12, 12)]
    return pool.read(files)


@pytest.fixture
def plan(objects):
    return with_names(PLAN, objects)


def weights(network):
    return {name: tensor.clone() for name, tensor in network.state_dict().items()}


def test_unseen_categories_are_only_in_their_own_pool(objects, tmp_path):
    assert not {one.category for one in objects} & set(UNSEEN)
    (shard,) = pool.shards(PLAN, tmp_path, pool.UNSEEN)
    assert set(shard.names) == set(UNSEEN)
    seen, train_ = pool.shards(PLAN, tmp_path, pool.SEEN), pool.shards(PLAN, tmp_path, pool.TRAIN)
    assert seen[0].names == train_[0].names
    assert (seen[0].stream, seen[0].seed) != (train_[0].stream, train_[0].seed)


def test_a_pool_is_cut_into_files_and_only_missing_ones_are_made(tmp_path, objects):
    files = pool.shards(PLAN.model_copy(update={"objects": 1201}), tmp_path, pool.TRAIN)
    assert [(shard.first, shard.count) for shard in files] == [(0, 500), (500, 500), (1000, 201)]
    for shard in files:
        shard.path.write_bytes(b"as it was")
    pool.make(files, 1, lambda *now: pytest.fail("nothing was to be made"))
    assert all(shard.path.read_bytes() == b"as it was" for shard in files)


def test_objects_of_a_pool_depend_on_their_number_alone(tmp_path, objects):
    (later,) = pool.shards(PLAN, tmp_path, pool.TRAIN)
    later = replace(later, path=tmp_path / "x.npz", first=5, count=2)
    pool.make([later], 1, lambda *_: None)
    for one, other in zip(pool.read([later]), objects[5:7], strict=True):
        assert one.category == other.category
        assert np.array_equal(one.points, other.points)
        assert np.array_equal(one.numbers, other.numbers)


def test_every_pass_takes_each_example_at_most_once_and_alike_sizes_together():
    sizes = np.random.default_rng(0).integers(1, 190, 640).tolist()
    batches = [batch_rows(sizes, 8, seed=1, step=step) for step in range(80)]
    assert sorted(row for batch in batches for row in batch) == list(range(640))
    spread = np.mean([np.ptp([sizes[row] for row in batch]) for batch in batches])
    assert spread < np.mean([np.ptp(sizes[k : k + 8]) for k in range(0, 640, 8)]) / 3
    assert batch_rows(sizes, 8, seed=1, step=80) != batches[0]
    assert batch_rows([3, 4], 8, seed=1, step=5) in ([0, 1], [1, 0])


def test_a_training_goes_on_from_the_weights_of_a_model(plan, objects, tmp_path):
    save_network(train(plan, objects, tmp_path / "first", lambda row: None), tmp_path / "model")
    then = weights(load_model(tmp_path / "model").network)
    further = plan.model_copy(update={"start": str(tmp_path / "model")})
    begun = weights(checkpoint.begun(further).network)
    assert all(torch.equal(begun[name], tensor) for name, tensor in then.items())
    other = further.model_copy(update={"network": plan.network.model_copy(update={"channels": 32})})
    with pytest.raises(BadInputError, match=r"has other channels than this training: begin without --start"):
        checkpoint.begun(other)


def test_a_training_that_goes_on_keeps_the_names_that_only_the_model_knows(plan, objects, tmp_path):
    network = plan.network.model_copy(update={"labels": ("a rare part",), "categories": ("a rare thing",)})
    save_network(NanoNetwork(network, 0), tmp_path / "model")
    further = with_names(PLAN.model_copy(update={"start": str(tmp_path / "model")}), objects).network
    assert further.labels == tuple(sorted({"a rare part", *plan.network.labels}))
    assert further.categories == tuple(sorted({"a rare thing", *plan.network.categories}))


def test_names_that_the_start_does_not_know_begin_afresh_and_the_others_keep_their_rows(
    plan, objects, tmp_path
):
    save_network(train(plan, objects, tmp_path / "first", lambda row: None), tmp_path / "model")
    then, labels = weights(load_model(tmp_path / "model").network), plan.network.labels
    network = plan.network.model_copy(update={"labels": ("a new part", *labels[1:])})
    further = plan.model_copy(update={"start": str(tmp_path / "model"), "network": network, "seed": 1})
    fresh, begun = weights(NanoNetwork(network, 1)), weights(checkpoint.begun(further).network)
    for tensor in ("label.weight", "label.bias"):
        assert torch.equal(begun[tensor][1], fresh[tensor][1])
        assert torch.equal(begun[tensor][0], then[tensor][0])
        assert torch.equal(begun[tensor][2:], then[tensor][2:])
    # What is new has nothing to be blended with.
    alone = train(further, objects, tmp_path / "second", lambda row: None)
    new = weights(alone)["label.bias"].clone()
    blend = further.model_copy(update={"start_share": 0.25})
    both = weights(train(blend, objects, tmp_path / "second", lambda row: None))["label.bias"]
    torch.testing.assert_close(both[1], new[1])
    torch.testing.assert_close(both[2:], 0.25 * then["label.bias"][2:] + 0.75 * new[2:])


def test_a_share_of_the_weights_of_the_start_stays_in_the_result(plan, objects, tmp_path):
    save_network(train(plan, objects, tmp_path / "first", lambda row: None), tmp_path / "model")
    start = weights(load_model(tmp_path / "model").network)
    further = plan.model_copy(update={"start": str(tmp_path / "model"), "seed": 1})
    alone = weights(train(further, objects, tmp_path / "second", lambda row: None))
    blend = further.model_copy(update={"start_share": 0.25})
    # The share decides the result alone: a run that is over can be blended anew.
    both = weights(train(blend, objects, tmp_path / "second", lambda row: None))
    assert any(not torch.allclose(start[name], alone[name]) for name in start)
    for name, tensor in both.items():
        torch.testing.assert_close(tensor, 0.25 * start[name] + 0.75 * alone[name])


def test_pair_layers_are_trained_with_all_else_held(plan, objects, tmp_path):
    save_network(train(plan, objects, tmp_path / "first", lambda row: None), tmp_path / "model")
    start = weights(load_model(tmp_path / "model").network)
    further = plan.model_copy(update={"start": str(tmp_path / "model"), "only": "pairs", "seed": 1})
    ended = weights(train(further, objects, tmp_path / "second", lambda row: None))
    changed = {name for name, tensor in ended.items() if not torch.equal(tensor, start[name])}
    assert changed
    assert {name.split(".")[0] for name in changed} == {"pairs"}
    again = checkpoint.load(further, tmp_path / "second").network
    assert {n.split(".")[0] for n, p in again.named_parameters() if p.requires_grad} == {"pairs"}


def test_a_run_that_was_killed_ends_with_the_weights_it_would_have_had(plan, objects, tmp_path):
    whole = train(plan, objects, tmp_path / "whole", lambda row: None)

    class KilledError(Exception):
        pass

    def kill(row):
        if row.step == 4:
            raise KilledError

    with pytest.raises(KilledError):
        train(plan, objects, tmp_path / "killed", kill)
    rows = []
    ended = train(plan, objects, tmp_path / "killed", rows.append)
    # The checkpoint of step 2 is the last that was written.
    assert [row.step for row in rows] == [4, 6]
    for name, tensor in weights(whole).items():
        assert torch.equal(tensor, weights(ended)[name]), name


def test_another_plan_or_a_damaged_checkpoint_is_refused(plan, objects, tmp_path):
    train(plan, objects, tmp_path, lambda row: None)
    other = plan.model_copy(update={"batch_size": 3, "log_every": 5})
    with pytest.raises(BadInputError, match=r"of another plan \(batch_size differ\)"):
        checkpoint.load(other, tmp_path)
    file = tmp_path / "checkpoint" / "state.safetensors"
    file.write_bytes(file.read_bytes()[:200])
    with pytest.raises(BadInputError, match="is damaged"):
        checkpoint.load(plan, tmp_path)


def test_a_score_counts_right_answers(plan, objects, tmp_path):
    network = train(plan, objects, tmp_path, lambda row: None)
    with torch.no_grad():  # says that nothing moves, whatever it reads
        network.moves.weight.zero_()
        network.moves.bias.fill_(-5)
    found = score(network, objects)
    expected = np.mean([(one.part == 0).mean() for one in objects])
    assert found.objects == 12
    assert found.moves == pytest.approx(expected, abs=1e-6)
    assert 0 <= found.candidate <= 1
    assert np.isnan(score(network, []).loss)


@pytest.mark.slow
def test_the_command_trains_goes_on_and_judges(tmp_path, capfd, monkeypatch):
    monkeypatch.chdir(tmp_path)
    small = ["--objects", "6", "--held-out", "2", "--of-each", "1", "--batch-size", "3", "--processes", "1"]
    assert run(["train", "nano", "--run", "out", "--steps", "2", *small, "--json"]) == 0
    out, err = capfd.readouterr()
    scores = json.loads(out)["scores"]
    assert set(scores) == {"categories trained on", "unseen categories"}
    assert scores["unseen categories"]["objects"] == 2
    assert "objects made: 10 of 10" in err
    assert run(["train", "nano", "--run", "out", "--steps", "2", *small]) == 2
    assert "out has a run already: go on with --resume" in capfd.readouterr().err
    # What it was made with need not be said again, and may not be changed.
    made = sorted((tmp_path / "out" / "objects").iterdir())
    assert run(["train", "nano", "--run", "out", "--evaluate", "-q"]) == 0
    out, err = capfd.readouterr()
    assert "unseen categories" in out
    assert err == ""
    assert sorted((tmp_path / "out" / "objects").iterdir()) == made
    assert run(["train", "nano", "--run", "out", "--steps", "3", "--resume"]) == 2
    assert "is of another plan (steps differ)" in capfd.readouterr().err
    assert sorted((tmp_path / "out" / "objects").iterdir()) == made


@pytest.mark.parametrize(
    ("options", "told"),
    [
        (["--evaluate"], "out has no checkpoint to judge: train it first"),
        (["--resume"], "out has no run to go on with: give another --run, or begin without --resume"),
        (["--device", "cuda:99"], "device 'cuda:99' is not on this machine: "),
        (["--learning-rate", "0"], "training options: learning_rate: "),
        (
            ["--start-share", "0.5"],
            "--start-share is the share of a model in the result: name it with --start",
        ),
        (
            ["--only", "pairs"],
            "--only trains some layers of a model that has learnt the others: name it with",
        ),
        (["--only", "lines"], "training options: only: "),
        (["--start-share", "1.5"], "training options: start_share: "),
        (["--device", "abacus"], "training options: device: "),
        (["--precision", "int4"], "training options: precision: "),
    ],
)
def test_a_mistake_is_one_line_and_makes_no_run(tmp_path, capfd, monkeypatch, options, told):
    monkeypatch.chdir(tmp_path)
    assert run(["train", "nano", "--run", "out", *options]) == 2
    (line,) = re.findall(r"^error: .*$", capfd.readouterr().err, re.MULTILINE)
    assert told in line
    assert not (tmp_path / "out").exists()


def test_a_run_below_a_file_is_refused(tmp_path, capfd, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "file").write_text("mine")
    assert run(["train", "nano", "--run", "file/run", "--steps", "1"]) != 0
    (line,) = re.findall(r"^error: .*$", capfd.readouterr().err, re.MULTILINE)
    assert "cannot write the run to file/run" in line
