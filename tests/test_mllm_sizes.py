"""Sizes of language models: presets, numbers of parameters, and the memory that follows from them."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from simart_kit_plugins.simart.mllm.counts import VOXEL_TOKENS, cache_numbers, parameter_counts, size_of
from simart_kit_plugins.simart.mllm.extra import quiet
from simart_kit_plugins.simart.mllm.planning import lora_parameters, memory_table, training_memory
from simart_kit_plugins.simart.mllm.sizes import PRESETS, load_size, preset_path

from simart_kit.errors import BadInputError

from .mllm_folders import micro_model, micro_size, shared_model

# What the hub tells of the two models, whose embeddings have 151936 rows.
PUBLISHED = {"2b": 2_127_532_032, "8b": 8_767_123_696}
ROWS = 151_936


@pytest.mark.parametrize("name", ["2b", "8b"])
def test_the_large_presets_have_the_published_number_of_parameters(name: str) -> None:
    size = load_size(name).model_copy(update={"tokenizer_size": ROWS})
    assert parameter_counts(size, voxel_tokens=0).total == PUBLISHED[name]


@pytest.mark.parametrize("tied", [True, False])
def test_the_arithmetic_is_that_of_a_real_model(tied: bool) -> None:
    bundle = shared_model() if tied else micro_model(tied=False)
    size = micro_size(tied).model_copy(update={"tokenizer_size": bundle.vocabulary.first_id})
    expected = sum(parameter.numel() for parameter in bundle.model.parameters())
    assert parameter_counts(size, voxel_tokens=1 + 512 + 4096).total == expected


def test_a_size_can_be_read_back_from_a_config() -> None:
    bundle = shared_model()
    rows = bundle.model.get_input_embeddings().weight.shape[0]
    assert size_of(bundle.model.config) == micro_size().model_copy(update={"tokenizer_size": rows})


def test_the_tiny_preset_has_a_few_million_parameters_and_no_base() -> None:
    size = load_size("tiny")
    assert size.base == ""
    assert 3e6 < parameter_counts(size).total < 8e6


def test_the_large_presets_name_their_hub_ids() -> None:
    assert [load_size(name).base for name in ("2b", "8b")] == [
        "Qwen/Qwen3-VL-2B-Instruct",
        "Qwen/Qwen3-VL-8B-Instruct",
    ]


def test_a_file_of_the_same_form_is_a_size_too(tmp_path: Path) -> None:
    table = json.loads(preset_path("tiny").read_text())
    table["text"]["layers"] = 2
    (tmp_path / "own.json").write_text(json.dumps(table))
    assert load_size(str(tmp_path / "own.json")).text.layers == 2


@pytest.mark.parametrize(
    ("part", "field", "value", "told"),
    [
        ("text", "key_heads", 3, "key_heads 3 does not divide heads 4"),
        ("text", "rotary", [12, 12, 10], "must sum to half of head_dim 64"),
        ("text", "rotary", [8, 12, 12], "a third at most"),
        ("vision", "heads", 3, "a multiple of 4 times heads 3"),
        ("vision", "positions", 250, "must be a square"),
        ("vision", "deepstack", [3], "must name layers 0..2"),
        ("vision", "colour", 1, "Extra inputs"),
    ],
)
def test_impossible_sizes_are_refused(
    tmp_path: Path, part: str, field: str, value: object, told: str
) -> None:
    table = json.loads(preset_path("tiny").read_text())
    table[part][field] = value
    (tmp_path / "own.json").write_text(json.dumps(table))
    with pytest.raises(BadInputError, match=told) as error:
        load_size(str(tmp_path / "own.json"))
    assert "\n" not in str(error.value)


def test_an_unknown_preset_is_refused_with_those_there_are() -> None:
    with pytest.raises(BadInputError, match=r"'7b' is not known: use tiny, 2b, 8b or a \.json file"):
        load_size("7b")


def test_the_cache_of_the_8b_model_takes_147_kilobytes_a_token() -> None:
    # 36 layers x 8 heads x 128 numbers, a key and a value, 2 bytes each.
    assert 2 * cache_numbers(load_size("8b")) == 147_456


def test_all_weights_on_32_gpus_take_16_bytes_a_parameter_shared() -> None:
    size = load_size("8b")
    plan = training_memory(size, 32)
    shared = plan.weights + plan.gradients + plan.optimizer
    assert shared == pytest.approx(16 * parameter_counts(size).total / 32)
    # Two layers of 192,946,432 numbers; embeddings and head of 160,896 x 4096 with their gradients; 2 bytes.
    layer = 4096 * (4096 + 1024 + 1024 + 4096) + 3 * 4096 * 12288 + 2 * 128 + 2 * 4096
    assert plan.gathered == pytest.approx(2 * (2 * layer + 4 * 160_896 * 4096), rel=1e-6)


def test_one_gpu_gathers_nothing_and_lora_keeps_most_weights_in_two_bytes() -> None:
    size = load_size("8b")
    plan = training_memory(size, 1, lora=True)
    trained = lora_parameters(size)
    assert plan.gathered == 0
    assert plan.weights == 2 * parameter_counts(size).total + 4 * trained
    assert plan.gradients + plan.optimizer == 12 * trained


def test_lora_trains_as_many_numbers_as_peft_counts() -> None:
    from peft import LoraConfig, get_peft_model

    bundle = micro_model()
    layers = r".*language_model.*\.(q_proj|k_proj|v_proj|o_proj|gate_proj|up_proj|down_proj)"
    with quiet():
        adapted = get_peft_model(bundle.model, LoraConfig(r=4, target_modules=layers))
    trained = sum(p.numel() for p in adapted.parameters() if p.requires_grad)
    assert lora_parameters(micro_size(), rank=4) == trained + VOXEL_TOKENS * micro_size().text.hidden


def test_the_table_has_a_row_for_each_plan_with_a_total_that_adds_up() -> None:
    lines = memory_table().splitlines()
    assert "| 8b | all | 32 |" in memory_table()
    for line in lines[2:]:
        *parts, total = [float(cell) for cell in line.split("|")[4:-1]]
        assert sum(parts) == pytest.approx(total, abs=0.3)
    assert {line.split("|")[1].strip() for line in lines[2:]} == set(PRESETS)
