"""Plans of fine-tunings: presets, changes, the learning rate."""

from __future__ import annotations

import json

import pytest
from simart_kit_plugins.simart.finetune.plan import changed_plan, packaged_plans, read_plan, write_plan

from simart_kit.errors import BadInputError

from .finetune_cases import plan


def test_presets_are_read_and_written_back(tmp_path):
    assert list(packaged_plans()) == ["2b", "8b", "tiny"]
    for name in packaged_plans():
        write_plan(read_plan(name), tmp_path / "plan.json")
        assert read_plan(str(tmp_path / "plan.json")) == read_plan(name)
        assert read_plan(name).size == name


def test_the_large_preset_is_for_32_processes():
    assert read_plan("8b").lanes % 32 == 0
    assert read_plan("8b").fsdp
    assert read_plan("8b").packing
    assert read_plan("8b").steps == 30_000


def test_the_rate_rises_on_a_line_and_falls_on_a_cosine():
    rates = plan(steps=110, warm_up=10, learning_rate=1.0, lowest_rate=0.2)
    assert rates.rate(0) == pytest.approx(0.1)
    assert rates.rate(9) == pytest.approx(1.0)
    assert rates.rate(10) == pytest.approx(1.0)
    assert rates.rate(60) == pytest.approx(0.6)  # half way: the mean of 1 and 0.2
    assert 0.2 <= rates.rate(109) < 0.201


def test_a_shorter_run_has_a_shorter_warm_up():
    assert changed_plan(read_plan("tiny"), {"steps": 50}).warm_up == 5


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ({"longest": 4096}, "batch_tokens 1024 cannot hold the longest, 4096"),
        ({"multiple": 100}, "multiples of 100"),
        ({"picture_share": 2.0}, "picture_share"),
        ({"fsdp": True, "weights": "bf16"}, "fp32"),
    ],
)
def test_what_cannot_be_is_refused(changes, said):
    with pytest.raises(BadInputError, match=said):
        plan(**changes)


def test_unknown_presets_and_keys_are_refused(tmp_path):
    with pytest.raises(BadInputError, match="2b, 8b, tiny"):
        read_plan("huge")
    document = json.loads(packaged_plans()["tiny"].read_text())
    document["plan"]["speed"] = 3
    (tmp_path / "plan.json").write_text(json.dumps(document))
    with pytest.raises(BadInputError, match=r"plan\.speed"):
        read_plan(str(tmp_path / "plan.json"))
