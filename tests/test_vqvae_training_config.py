"""The training config, and the log of a run."""

import csv
import dataclasses

import pytest
from pydantic import ValidationError
from simart_kit_plugins.simart.training.config import (
    TrainingConfig,
    read_training_config,
    write_training_config,
)
from simart_kit_plugins.simart.training.log import Log, LogRow

from simart_kit.errors import BadInputError, OutputError


def test_the_defaults_are_the_stages_of_the_paper():
    assert (TrainingConfig().stage1_steps, TrainingConfig().stage2_steps) == (60_000, 60_000)


def test_a_written_config_is_read_as_it_was(tmp_path):
    config = TrainingConfig(stage1_steps=3, learning_rate=2e-3, precision="bf16", device="cuda:1", seed=7)
    write_training_config(config, tmp_path / "training.json")
    assert read_training_config(tmp_path / "training.json") == config
    with pytest.raises(OutputError, match="cannot write"):
        write_training_config(config, tmp_path)


def test_what_a_file_leaves_out_has_its_default(tmp_path):
    (tmp_path / "a.json").write_text('{"schema": 1, "training": {"learning_rate": 1, "warm_up": 0}}')
    assert read_training_config(tmp_path / "a.json") == TrainingConfig(learning_rate=1.0, warm_up=0)


@pytest.mark.parametrize(
    ("text", "named"),
    [
        ("{", ["file", "Invalid JSON"]),
        ('{"training": {}}', ["schema: Field required"]),
        ('{"schema": 2, "training": {}}', ["schema"]),
        (
            '{"schema": 1, "training": {"steps": 3, "batch_size": 0, "seed": "1", "precision": "fp16"}}',
            ["training.steps", "training.batch_size", "training.seed", "training.precision"],
        ),
        ('{"schema": 1, "training": {"learning_rate": NaN}}', ["learning_rate"]),
        ('{"schema": 1, "training": {"device": "gpu"}}', ["training.device"]),
        ('{"schema": 1, "training": {"stage1_steps": 0, "stage2_steps": 0}}', ["nothing would be trained"]),
    ],
)
def test_every_mistake_of_a_file_is_told_on_one_line(tmp_path, text, named):
    (tmp_path / "training.json").write_text(text)
    with pytest.raises(BadInputError) as caught:
        read_training_config(tmp_path / "training.json")
    told = str(caught.value)
    assert "\n" not in told
    assert all(name in told for name in (*named, "training.json is no training config"))


def test_a_missing_file_is_told(tmp_path):
    with pytest.raises(BadInputError, match=r"cannot read .*none\.json: No such file"):
        read_training_config(tmp_path / "none.json")


def test_a_config_cannot_be_changed_later():
    with pytest.raises(ValidationError):
        TrainingConfig().seed = 1


def test_each_stage_warms_up_and_falls_by_itself():
    rates = [
        TrainingConfig(stage1_steps=6, stage2_steps=4, warm_up=2, decay="cosine", learning_rate=1.0).rate(
            step
        )
        for step in range(10)
    ]
    # Two steps up (1/2, 1), then (1 + cos(pi k / n)) / 2: n = 4 steps in stage 1, n = 2 in stage 2.
    half = 0.5**0.5
    stage1 = [0.5, 1, 1, (1 + half) / 2, 0.5, (1 - half) / 2]
    assert rates == pytest.approx([*stage1, 0.5, 1, 1, 0.5])


def test_a_constant_rate_stays_after_the_warm_up():
    config = TrainingConfig(stage1_steps=0, stage2_steps=4, warm_up=3, learning_rate=3.0)
    assert [config.rate(step) for step in range(4)] == pytest.approx([1, 2, 3, 3])
    short = TrainingConfig(stage1_steps=2, stage2_steps=0, warm_up=4, decay="cosine", learning_rate=4.0)
    assert [short.rate(step) for step in range(2)] == pytest.approx([1, 2])


def row(step):
    return LogRow(step, 1, 1e-3, 0.5, 0.25, 0.1, 0.0, 0.0, 0.75, 3, 2.5, 0, 1.5 * step)


def test_a_log_that_goes_on_drops_what_is_done_again(tmp_path):
    path = tmp_path / "log.csv"
    first = Log(path, 0)
    for step in (10, 20, 30):
        first.add(row(step))
    with path.open("a") as file:
        file.write("40,1,0.0")  # killed while writing
    again = Log(path, 20)
    assert again.seconds == 30.0
    again.add(row(30))
    with path.open(newline="") as file:
        table = list(csv.DictReader(file))
    assert [line["step"] for line in table] == ["10", "20", "30"]
    assert list(table[0]) == [field.name for field in dataclasses.fields(LogRow)]
    assert [float(line["seconds"]) for line in table] == [15.0, 30.0, 45.0]
    assert sorted(p.name for p in tmp_path.iterdir()) == ["log.csv"]


@pytest.mark.parametrize("content", [b"", b"a,b\n1,2\n", b"\xff\xfe\n", None])
def test_a_file_that_is_no_log_is_left_alone(tmp_path, content):
    path = tmp_path / "log.csv"
    if content is None:
        Log(path, 0)
        content = path.read_bytes() + b"10,1,x\n"
    path.write_bytes(content)
    with pytest.raises(BadInputError, match="is no log of a training run"):
        Log(path, 0)
    assert path.read_bytes() == content
