"""Stopped and gone on with, a run gives what it would have given: bit for bit."""

import csv
import shutil

import pytest
import torch
from simart_kit_plugins.simart.training.checkpointing import latest
from simart_kit_plugins.simart.training.loop import train
from simart_kit_plugins.simart.vqvae.checkpoint import load_checkpoint

from simart_kit.errors import BadInputError, OutputError

from .test_vqvae_training import box_grids, quick, started

pytestmark = pytest.mark.slow

GRIDS = box_grids()


class KilledError(Exception):
    """Stands in for the signal."""


def kill_at(step):
    def observer(row):
        if row.step == step:
            raise KilledError

    return observer


def killed(folder, step, config, **model):
    with pytest.raises(KilledError):
        train(started(**model), GRIDS, config, folder, observer=kill_at(step))


def weights(folder):
    return (folder / "model" / "model.safetensors").read_bytes()


def moments(folder):
    return (latest(folder) / "optimiser.safetensors").read_bytes()


# Stage 2 begins after step 3: in stage 1; right where it ends; in stage 2, with 0 and 1 steps to do again.
@pytest.mark.parametrize(("every", "kill"), [(2, 3), (3, 4), (2, 6), (2, 7), (100, 2)])
def test_a_killed_run_that_goes_on_gives_the_same_weights(tmp_path, every, kill):
    config = quick(checkpoint_every=every)
    train(started(), GRIDS, config, tmp_path / "whole")
    killed(tmp_path / "killed", kill, config)
    # The model that is handed over for going on does not matter: its weights are those of the checkpoint.
    seed = 0 if latest(tmp_path / "killed") is None else 5
    train(started(seed), GRIDS, config, tmp_path / "killed", resume=True)
    assert weights(tmp_path / "killed") == weights(tmp_path / "whole")
    assert moments(tmp_path / "killed") == moments(tmp_path / "whole")
    with (tmp_path / "killed" / "log.csv").open(newline="") as file:
        assert [line["step"] for line in csv.DictReader(file)] == list("12345678")


def test_running_means_go_on_too(tmp_path):
    config = quick(weight_decay=0.1, decay="cosine", precision="bf16")
    train(started(codebook_update="ema"), GRIDS, config, tmp_path / "whole")
    killed(tmp_path / "killed", 5, config, codebook_update="ema")
    train(started(codebook_update="ema"), GRIDS, config, tmp_path / "killed", resume=True)
    assert weights(tmp_path / "killed") == weights(tmp_path / "whole")


def test_two_runs_with_one_seed_are_identical_and_with_two_are_not(tmp_path):
    for name, seed in (("one", 0), ("two", 0), ("other", 1)):
        train(started(), GRIDS, quick(seed=seed), tmp_path / name)
    assert weights(tmp_path / "one") == weights(tmp_path / "two")
    assert moments(tmp_path / "one") == moments(tmp_path / "two")
    assert weights(tmp_path / "one") != weights(tmp_path / "other")


def test_random_numbers_drawn_elsewhere_change_nothing(tmp_path):
    train(started(), GRIDS, quick(), tmp_path / "one")
    train(started(), GRIDS, quick(), tmp_path / "two", observer=lambda _: torch.rand(3))
    assert weights(tmp_path / "one") == weights(tmp_path / "two")


def test_the_last_two_checkpoints_are_kept_and_can_be_loaded(tmp_path):
    train(started(), GRIDS, quick(), tmp_path)
    names = sorted(path.name for path in (tmp_path / "checkpoints").iterdir())
    assert names == ["step-0000006", "step-0000008"]
    assert load_checkpoint(latest(tmp_path)).config == started().config


def test_a_run_that_was_killed_while_writing_goes_on_from_the_checkpoint_before(tmp_path):
    config = quick()
    train(started(), GRIDS, config, tmp_path / "whole")
    killed(tmp_path / "run", 5, config)
    half = tmp_path / "run" / "checkpoints" / "step-0000006.partial"
    shutil.copytree(latest(tmp_path / "run"), half)
    (half / "optimiser.safetensors").write_bytes(b"half")
    assert latest(tmp_path / "run").name == "step-0000004"
    train(started(), GRIDS, config, tmp_path / "run", resume=True)
    assert weights(tmp_path / "run") == weights(tmp_path / "whole")
    assert not list((tmp_path / "run").rglob("*.partial"))


@pytest.fixture
def stopped(tmp_path):
    killed(tmp_path, 3, quick())
    return tmp_path


def assert_refused(folder, config, message, grids=GRIDS, **model):
    before = {path: path.read_bytes() for path in folder.rglob("*") if path.is_file()}
    with pytest.raises(BadInputError) as caught:
        train(started(**model), grids, config, folder, resume=True)
    assert message in str(caught.value)
    assert "\n" not in str(caught.value)
    assert {path: path.read_bytes() for path in folder.rglob("*") if path.is_file()} == before


def test_a_run_is_not_begun_over_another(stopped):
    with pytest.raises(BadInputError, match="has a run already, up to step-0000002: resume it"):
        train(started(), GRIDS, quick(), stopped)


def test_a_run_goes_on_only_as_the_run_that_it_is(stopped):
    assert_refused(stopped, quick(learning_rate=0.5, seed=3), "(learning_rate 0.003, now 0.5; seed 0, now 3)")
    assert_refused(stopped, quick(), "another model config (codebook_size 9, now 17)", codebook_size=17)
    assert_refused(stopped, quick(), "was trained on other grids", grids=box_grids(4))


def test_what_does_not_touch_the_weights_may_change(stopped, tmp_path_factory):
    whole = tmp_path_factory.mktemp("whole")
    train(started(), GRIDS, quick(), whole)
    train(started(), GRIDS, quick(log_every=4, checkpoint_every=5), stopped, resume=True)
    assert weights(stopped) == weights(whole)


@pytest.mark.parametrize("name", ["model.safetensors", "optimiser.safetensors", "state.json"])
def test_a_damaged_checkpoint_is_told_with_the_way_out(stopped, name):
    path = latest(stopped) / name
    path.write_bytes(path.read_bytes()[:-9])
    assert_refused(stopped, quick(), f"delete {latest(stopped)} to go on from the checkpoint before it")
    path.unlink()
    assert_refused(stopped, quick(), f"{name}: ")


def test_a_finished_run_that_goes_on_stays_as_it_is(tmp_path):
    train(started(), GRIDS, quick(), tmp_path)
    before = {path: path.read_bytes() for path in tmp_path.rglob("*") if path.is_file()}
    model = train(started(4), GRIDS, quick(), tmp_path, resume=True)
    assert {path: path.read_bytes() for path in tmp_path.rglob("*") if path.is_file()} == before
    assert all(parameter.requires_grad for parameter in model.parameters())


def test_a_checkpoint_that_cannot_be_written_is_told(tmp_path):
    (tmp_path / "checkpoints").write_text("")
    with pytest.raises(OutputError, match=r"cannot write the .*checkpoints"):
        train(started(), GRIDS, quick(), tmp_path)
