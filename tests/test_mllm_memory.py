"""Memory of language models: what is needed, what there is, and what is said when it does not suffice."""

import json
from pathlib import Path

import pytest
import torch
from simart_kit_plugins.simart.mllm import memory
from simart_kit_plugins.simart.mllm.base import extend_base
from simart_kit_plugins.simart.mllm.bundle import load_bundle, save_bundle
from simart_kit_plugins.simart.mllm.counts import parameter_counts
from simart_kit_plugins.simart.mllm.memory import memory_told, needed_bytes, require_memory
from simart_kit_plugins.simart.mllm.placing import Placing, placing
from simart_kit_plugins.simart.mllm.sizes import load_size
from simart_kit_plugins.simart.mllm.weights import Choices

from simart_kit.errors import BadInputError

from .mllm_folders import micro_codec, micro_model, plain_folder

GPU = Placing("cuda", "bfloat16")
LARGE = load_size("8b")


def test_the_8b_model_in_bfloat16_takes_two_bytes_a_number_its_cache_and_some_room() -> None:
    weights = 2 * parameter_counts(LARGE, 0).total
    cache = 8192 * 147_456
    assert needed_bytes(LARGE, GPU) == pytest.approx(1.05 * weights + cache + 1.5e9)


def test_four_bits_take_less_than_eight_and_these_less_than_sixteen() -> None:
    kinds = [Placing("cuda", "bfloat16", kind) for kind in ("4bit", "8bit", "none")]
    four, eight, sixteen = (needed_bytes(LARGE, kind) for kind in kinds)
    assert four < 0.8 * eight < 0.8 * 0.8 * sixteen


def test_too_little_memory_is_told_with_both_numbers(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(memory, "available_bytes", lambda _: 11.04e9)
    with pytest.raises(BadInputError) as error:
        require_memory("Qwen/Qwen3-VL-8B-Instruct", LARGE, GPU)
    needed = needed_bytes(LARGE, GPU) / 1e9
    assert f"needs {needed:.1f} GB of memory on cuda and 11.0 GB are free" in str(error.value)
    assert "quantisation 4bit" in str(error.value)


def test_memory_that_suffices_or_is_unknown_is_no_reason_to_refuse(monkeypatch: pytest.MonkeyPatch) -> None:
    told: list[float | None] = [80e9, None]
    monkeypatch.setattr(memory, "available_bytes", lambda _: told.pop())
    require_memory("a", LARGE, GPU)
    require_memory("a", LARGE, GPU)
    assert told == []


def test_the_8b_model_runs_on_a_cpu_only_if_slow_is_allowed(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(memory, "available_bytes", lambda _: 80e9)
    cpu = Placing("cpu", "bfloat16")
    with pytest.raises(BadInputError, match=r"8\.8 billion parameters, .* one token a second: .*allow_slow"):
        require_memory("a", LARGE, cpu)
    require_memory("a", LARGE, cpu, allow_slow=True)
    require_memory("a", load_size("2b"), cpu)


def test_allowing_slow_does_not_conjure_memory(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(memory, "available_bytes", lambda _: 8e9)
    with pytest.raises(BadInputError, match=r"and 8\.0 GB are free"):
        require_memory("a", LARGE, Placing("cpu", "bfloat16"), allow_slow=True)


def test_a_large_base_is_refused_before_its_weights_are_looked_at(tmp_path: Path) -> None:
    plain_folder(tmp_path)
    table = json.loads((tmp_path / "config.json").read_text())
    table["text_config"].update(hidden_size=4096, num_hidden_layers=36, intermediate_size=12288)
    (tmp_path / "config.json").write_text(json.dumps(table))
    for shard in tmp_path.glob("*.safetensors"):
        shard.write_bytes(b"")
    with pytest.raises(BadInputError, match="a CPU runs at about one token a second"):
        extend_base(str(tmp_path), micro_codec(), choices=Choices(device="cpu"))


@pytest.mark.parametrize(
    "error",
    [
        torch.OutOfMemoryError("CUDA out of memory. Tried to allocate 2.00 GiB.\nGPU 0 has ..."),
        MemoryError(),
        RuntimeError("[enforce fail] DefaultCPUAllocator: can't allocate memory: you tried to ..."),
        RuntimeError("DefaultCPUAllocator: not enough memory: you tried to allocate 99 bytes."),
    ],
)
def test_running_out_of_memory_is_told_in_one_line(error: BaseException) -> None:
    with (
        pytest.raises(BadInputError, match="out of memory while asking the model") as told,
        memory_told("asking the model"),
    ):
        raise error
    assert "\n" not in str(told.value)


def test_other_errors_are_not_called_a_lack_of_memory() -> None:
    with pytest.raises(RuntimeError, match="shapes differ"), memory_told("asking the model"):
        raise RuntimeError("shapes differ")


def test_running_out_of_memory_while_reading_weights_is_told(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    folder = save_bundle(micro_model(), tmp_path / "m")

    def full(*_: object, **__: object) -> None:
        raise torch.OutOfMemoryError("CUDA out of memory. Tried to allocate 2.00 GiB.")

    monkeypatch.setattr("transformers.Qwen3VLForConditionalGeneration.from_pretrained", full)
    with pytest.raises(BadInputError, match=r"while loading .*m on cpu \(CUDA out of memory\. Tried"):
        load_bundle(str(folder), device="cpu")


def test_free_memory_is_what_linux_tells(tmp_path: Path) -> None:
    (tmp_path / "meminfo").write_text("MemTotal:  16 kB\nMemFree: 1 kB\nMemAvailable:     2048 kB\n")
    assert memory._system_bytes(tmp_path / "meminfo") == 2048 * 1024


def test_without_that_file_it_is_all_that_the_machine_has(tmp_path: Path) -> None:
    found = memory._system_bytes(tmp_path / "none")
    assert found is not None
    assert found >= 1e8


@pytest.mark.parametrize(("limit", "left"), [("1000000\n", 700_000.0), ("max\n", None)])
def test_a_container_leaves_what_its_limit_allows(tmp_path: Path, limit: str, left: float | None) -> None:
    (tmp_path / "memory.max").write_text(limit)
    (tmp_path / "memory.stat").write_text("anon 300000\nfile 500000\n")
    assert memory._container_bytes(tmp_path) == left
    assert memory._container_bytes(tmp_path / "none") is None


@pytest.mark.parametrize(("parameters", "dtype"), [(6_000_000, "float32"), (2_100_000_000, "bfloat16")])
def test_a_cpu_gets_float32_unless_the_model_is_large(parameters: int, dtype: str) -> None:
    assert placing("cpu", "auto", "none", parameters) == Placing("cpu", dtype, "none")


def test_a_dtype_that_is_asked_for_is_taken() -> None:
    assert placing("cpu", "bfloat16", "none", 1).dtype == "bfloat16"
