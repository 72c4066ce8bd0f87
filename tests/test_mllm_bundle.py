"""A language model as a folder: what is written is what is read, and it is written the same every time."""

from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
import torch
from simart_kit_plugins.simart.codec import encode_grids
from simart_kit_plugins.simart.default_model import load_model
from simart_kit_plugins.simart.mllm.base import extend_base
from simart_kit_plugins.simart.mllm.bundle import load_bundle, save_bundle
from simart_kit_plugins.simart.mllm.extra import quiet
from simart_kit_plugins.simart.mllm.simart_model import SimartModel

from simart_kit.errors import BadInputError, OutputError

from .mllm_folders import micro_codec, micro_model, plain_folder, shared_model


@pytest.fixture(autouse=True)
def one_thread() -> Iterator[None]:
    threads = torch.get_num_threads()
    torch.set_num_threads(1)
    yield
    torch.set_num_threads(threads)


def logits(bundle: SimartModel) -> torch.Tensor:
    ids = bundle.tokenizer("<|im_start|>the lid<voxel><xyz_43><mesh_1930>").input_ids
    with torch.no_grad():
        return torch.as_tensor(bundle.model(input_ids=torch.tensor([ids])).logits)


def load(folder: Path) -> SimartModel:
    return load_bundle(str(folder), device="cpu", dtype="float32")


def files(folder: Path) -> dict[str, bytes]:
    return {str(p.relative_to(folder)): p.read_bytes() for p in sorted(folder.rglob("*")) if p.is_file()}


@pytest.mark.parametrize("tied", [True, False])
def test_a_model_comes_back_as_it_was_saved(tmp_path: Path, tied: bool) -> None:
    bundle = micro_model(tied)
    bundle = replace(
        bundle, settings=bundle.settings.model_copy(update={"prompt": "short", "training": {"steps": 7}})
    )
    read = load(save_bundle(bundle, tmp_path / "m"))
    assert torch.equal(logits(read), logits(bundle))
    assert read.vocabulary == bundle.vocabulary
    assert (read.settings.prompt, read.settings.training) == ("short", {"steps": 7})
    assert read.tokenizer.get_vocab() == bundle.tokenizer.get_vocab()
    assert (read.tokenizer.eos_token, read.tokenizer.chat_template) == (
        bundle.tokenizer.eos_token,
        bundle.tokenizer.chat_template,
    )


def test_it_is_divided_into_files_of_the_size_that_is_asked_for(tmp_path: Path) -> None:
    folder = save_bundle(micro_model(tied=False), tmp_path / "m", shard_bytes=700_000)
    shards = sorted(folder.glob("model-*.safetensors"))
    assert [shard.name for shard in shards] == [f"model-0000{i}-of-00003.safetensors" for i in (1, 2, 3)]
    assert max(shard.stat().st_size for shard in shards) < 720_000
    assert torch.equal(logits(load(folder)), logits(micro_model(tied=False)))


def test_the_same_model_gives_the_same_bytes(tmp_path: Path) -> None:
    one, other = (files(save_bundle(micro_model(), tmp_path / name)) for name in "ab")
    assert one == other


def test_saving_over_an_earlier_model_leaves_nothing_of_it(tmp_path: Path) -> None:
    save_bundle(micro_model(), tmp_path / "m", shard_bytes=100_000)
    folder = save_bundle(micro_model(seed=1), tmp_path / "m")
    assert [path.name for path in folder.glob("*.safetensors")] == ["model.safetensors"]
    assert [path.name for path in tmp_path.iterdir()] == ["m"]
    assert torch.equal(logits(load(folder)), logits(micro_model(seed=1)))


def test_half_precision_halves_the_file_and_rounds_the_weights(tmp_path: Path) -> None:
    whole = save_bundle(micro_model(), tmp_path / "a") / "model.safetensors"
    half = save_bundle(micro_model(), tmp_path / "b", dtype="bfloat16") / "model.safetensors"
    assert half.stat().st_size < 0.52 * whole.stat().st_size
    expected = micro_model().model.state_dict()["lm_head.weight"].bfloat16().float()
    assert torch.equal(load(tmp_path / "b").model.state_dict()["lm_head.weight"], expected)


def test_a_folder_with_something_else_in_it_is_not_touched(tmp_path: Path) -> None:
    (tmp_path / "thesis.txt").write_text("years of work")
    with pytest.raises(OutputError, match="something else than a SIMART model"):
        save_bundle(shared_model(), tmp_path)
    assert [path.name for path in tmp_path.iterdir()] == ["thesis.txt"]


def test_a_save_that_fails_leaves_the_earlier_model_whole(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    before = files(save_bundle(micro_model(), tmp_path / "m"))

    def full(*_: object) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("simart_kit_plugins.simart.mllm.saving.write_settings", full)
    with pytest.raises(OutputError, match="No space left"):
        save_bundle(micro_model(seed=1), tmp_path / "m")
    assert files(tmp_path / "m") == before
    assert [path.name for path in tmp_path.iterdir()] == ["m"]


def test_a_process_reads_a_model_once_until_it_is_written_anew(tmp_path: Path) -> None:
    folder = save_bundle(micro_model(), tmp_path / "m")
    first = load(folder)
    assert load(folder) is first
    save_bundle(micro_model(seed=1), folder)
    assert torch.equal(logits(load(folder)), logits(micro_model(seed=1)))


def test_a_codec_of_ones_own_travels_with_the_model(tmp_path: Path) -> None:
    folder = save_bundle(micro_model(), tmp_path / "m")
    assert (folder / "codec" / "model.safetensors").is_file()
    read = load(folder)
    assert read.codec.folder == folder / "codec"
    occupancy = torch.rand(1, 64, 64, 64, generator=torch.Generator().manual_seed(0)).numpy() > 0.99
    (ours,), (theirs,) = (encode_grids(m, occupancy) for m in (read.encoder, micro_model().encoder))
    assert (ours.code == theirs.code).all()


def test_the_shipped_codec_is_not_copied(tmp_path: Path) -> None:
    from simart_kit_plugins.simart.mllm.building import build

    from .mllm_folders import micro_size

    bundle = build(micro_size(), load_model(), 0)
    folder = save_bundle(bundle, tmp_path / "m")
    assert not (folder / "codec").exists()
    assert load(folder).codec.fingerprint == load_model().fingerprint


def test_a_hub_id_that_is_in_the_cache_is_read_without_a_connection(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    commit = "0123456789abcdef0123456789abcdef01234567"
    repository = tmp_path / "models--somebody--simart-micro"
    save_bundle(micro_model(), repository / "snapshots" / commit)
    (repository / "refs").mkdir()
    (repository / "refs" / "main").write_text(commit)
    monkeypatch.setattr("huggingface_hub.constants.HF_HUB_OFFLINE", True)
    monkeypatch.setattr("huggingface_hub.constants.HF_HUB_CACHE", str(tmp_path))
    read = load_bundle("somebody/simart-micro", device="cpu")
    assert torch.equal(logits(read), logits(micro_model()))


def adapted(bundle: SimartModel) -> SimartModel:
    """With an adapter, and the voxel tokens' rows trained, all moved a little."""
    from peft import LoraConfig, get_peft_model

    rows = list(range(bundle.vocabulary.first_id, bundle.vocabulary.first_id + len(bundle.vocabulary)))
    tables = ["embed_tokens"] if bundle.model.config.tie_word_embeddings else ["embed_tokens", "lm_head"]
    config = LoraConfig(
        r=2,
        target_modules=r".*language_model.*\.(q_proj|v_proj)",
        trainable_token_indices=dict.fromkeys(tables, rows),
    )
    with quiet():
        model: Any = get_peft_model(bundle.model, config).eval()
    generator = torch.Generator().manual_seed(0)
    with torch.no_grad():
        for parameter in model.parameters():
            if parameter.requires_grad:
                parameter += 0.1 * torch.randn(parameter.shape, generator=generator)
    return replace(bundle, model=model)


def test_an_adapter_is_written_alone_and_read_beside_a_plain_base(tmp_path: Path) -> None:
    plain_folder(tmp_path / "base")
    bundle = adapted(extend_base(str(tmp_path / "base"), micro_codec(), seed=4))
    folder = save_bundle(bundle, tmp_path / "adapter")
    assert not list(folder.glob("model*.safetensors"))
    assert torch.equal(logits(load(folder)), logits(bundle))


def test_an_adapter_is_read_beside_another_simart_model(tmp_path: Path) -> None:
    base = save_bundle(micro_model(), tmp_path / "base")
    plain = logits(micro_model())
    bundle = adapted(replace(micro_model(), folder=base))
    folder = save_bundle(bundle, tmp_path / "adapter")
    assert torch.equal(logits(load(folder)), logits(bundle))
    assert not torch.allclose(logits(bundle), plain, atol=1e-3)
    assert torch.equal(logits(load(base)), plain)


def test_an_adapter_of_a_base_that_was_never_saved_is_not_written(tmp_path: Path) -> None:
    with pytest.raises(BadInputError, match="save it first"):
        save_bundle(adapted(micro_model()), tmp_path / "adapter")
    assert not list(tmp_path.iterdir())


def test_reading_and_writing_say_nothing_on_the_terminal(
    tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    load(save_bundle(micro_model(), tmp_path / "m", shard_bytes=100_000))
    assert capfd.readouterr() == ("", "")
