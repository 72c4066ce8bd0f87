"""What is told of language models that cannot be read: one line, with the file and the way out."""

import json
from collections.abc import Callable
from pathlib import Path

import pytest
import torch
from simart_kit_plugins.simart.default_model import load_model
from simart_kit_plugins.simart.mllm.base import extend_base
from simart_kit_plugins.simart.mllm.bundle import load_bundle, save_bundle
from simart_kit_plugins.simart.vqnano.model import VqNano
from simart_kit_plugins.simart.vqvae.checkpoint import save_checkpoint

from simart_kit.errors import BadInputError
from simart_kit.extras import EXTRAS

from .mllm_folders import micro_codec, micro_model, plain_folder


@pytest.fixture(scope="module")
def sound(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A SIMART model in three files."""
    return save_bundle(micro_model(), tmp_path_factory.mktemp("sound") / "m", shard_bytes=300_000)


@pytest.fixture
def folder(sound: Path, tmp_path: Path) -> Path:
    """A copy that a test may spoil; its large files are links until they are replaced."""
    copy = tmp_path / "m"
    copy.mkdir()
    for path in sound.rglob("*"):
        if path.is_file():
            target = copy / path.relative_to(sound)
            target.parent.mkdir(exist_ok=True)
            target.write_bytes(path.read_bytes())
    return copy


def refusal(name: str | Path, **options: object) -> str:
    """The one line that a person sees."""
    with pytest.raises(BadInputError) as error:
        load_bundle(str(name), **{"device": "cpu", **options})  # type: ignore[arg-type]
    assert "\n" not in str(error.value)
    return str(error.value)


def edit(path: Path, change: Callable[[dict], object]) -> None:  # type: ignore[type-arg]
    table = json.loads(path.read_text())
    change(table)
    path.write_text(json.dumps(table))


def test_a_truncated_shard_is_named_with_its_bytes(folder: Path) -> None:
    shard = sorted(folder.glob("model-*.safetensors"))[1]
    whole = shard.read_bytes()
    shard.write_bytes(whole[:-100])
    told = refusal(folder)
    assert f"{shard} is truncated: it has {len(whole) - 100:,} of {len(whole):,} bytes" in told


@pytest.mark.parametrize("kept", [0, 5, 30])
def test_a_shard_that_ends_in_its_header_is_named(folder: Path, kept: int) -> None:
    shard = sorted(folder.glob("model-*.safetensors"))[0]
    shard.write_bytes(shard.read_bytes()[:kept])
    assert f"{shard} is truncated or no safetensors file" in refusal(folder)


def test_a_header_of_nonsense_is_told(folder: Path) -> None:
    shard = sorted(folder.glob("model-*.safetensors"))[0]
    data = bytearray(shard.read_bytes())
    data[8:20] = b"not a header"
    shard.write_bytes(data)
    assert f"{shard} is damaged: its header cannot be read" in refusal(folder)


def test_a_missing_shard_is_named(folder: Path) -> None:
    shard = sorted(folder.glob("model-*.safetensors"))[1]
    shard.unlink()
    assert f"{folder}: {shard.name} of " in refusal(folder)


def test_a_shard_of_another_model_is_refused(folder: Path, tmp_path: Path) -> None:
    other = micro_model()
    other.tokenizer.add_tokens(["<other>"])
    strange = save_bundle(other, tmp_path / "other", shard_bytes=300_000)
    shard = sorted(folder.glob("model-*.safetensors"))[1]
    shard.write_bytes((strange / shard.name).read_bytes())
    assert f"{shard} belongs to another model" in refusal(folder)


def test_an_index_that_is_damaged_or_wrong_is_told(folder: Path) -> None:
    index = folder / "model.safetensors.index.json"
    edit(index, lambda table: table["weight_map"].update(extra=next(iter(table["weight_map"].values()))))
    assert "lacks 'extra', which model.safetensors.index.json says it has" in refusal(folder)
    index.write_text("{")
    assert f"{index} is damaged" in refusal(folder)


def test_a_folder_without_weights_is_told(folder: Path) -> None:
    (folder / "model.safetensors.index.json").unlink()
    assert f"{folder} has no weights" in refusal(folder)


def test_another_codebook_is_refused_with_both_fingerprints(folder: Path) -> None:
    codec = micro_codec()
    save_checkpoint(VqNano(codec.model.config, 1), folder / "codec")  # type: ignore[arg-type]
    told = refusal(folder)
    assert told.startswith("wrong codebook: ")
    assert f"codes of {codec.fingerprint}" in told
    assert f"{folder / 'codec'} is {load_model(folder / 'codec').fingerprint}" in told


def test_a_model_without_its_codec_is_not_read_with_the_shipped_one(folder: Path) -> None:
    for path in (folder / "codec").iterdir():
        path.unlink()
    (folder / "codec").rmdir()
    assert f"is {load_model().fingerprint}; put the right voxel model in {folder / 'codec'}" in refusal(
        folder
    )


def test_another_tokenizer_is_refused(folder: Path) -> None:
    edit(folder / "tokenizer.json", lambda table: table["model"]["merges"].pop())
    assert f"{folder / 'tokenizer.json'} is not the tokenizer of this model" in refusal(folder)


def test_a_missing_or_damaged_tokenizer_is_told(folder: Path) -> None:
    (folder / "tokenizer.json").write_text("{}")
    assert "the tokenizer's files are damaged" in refusal(folder)
    (folder / "tokenizer.json").unlink()
    assert f"{folder} has no tokenizer" in refusal(folder)


def test_a_folder_that_is_no_simart_model_is_told_what_to_do(tmp_path: Path) -> None:
    plain_folder(tmp_path)
    told = refusal(tmp_path)
    assert f"{tmp_path} is not a SIMART model: it has no simart.json" in told
    assert "simart-kit train mllm" in told


@pytest.mark.parametrize(
    ("change", "told"),
    [
        ({"codebook": 8192}, "the hash of its token names is not that of its grid"),
        ({"colour": 1}, "colour: Extra inputs are not permitted"),
        ({"first_id": "many"}, "first_id: Input should be a valid integer"),
        ({"schema": 2}, "schema: Input should be 1"),
    ],
)
def test_settings_that_are_wrong_are_told(folder: Path, change: dict[str, object], told: str) -> None:
    edit(folder / "simart.json", lambda table: table.update(change))
    assert f"{folder / 'simart.json'} is damaged: {told}" in refusal(folder)


def test_a_config_of_another_architecture_is_refused(folder: Path) -> None:
    edit(folder / "config.json", lambda table: table.update(model_type="qwen2_5_vl"))
    told = refusal(folder)
    assert f"{folder / 'config.json'} is of architecture 'qwen2_5_vl', and 'qwen3_vl' is needed" in told


def test_a_config_that_is_damaged_is_told(folder: Path) -> None:
    edit(folder / "config.json", lambda table: table["text_config"].update(hidden_size="wide"))
    assert f"{folder / 'config.json'} is damaged" in refusal(folder)
    (folder / "config.json").write_text("[")
    assert f"{folder / 'config.json'} is damaged: it is no JSON table" in refusal(folder)
    (folder / "config.json").unlink()
    assert f"cannot read {folder / 'config.json'}: No such file" in refusal(folder)


@pytest.mark.parametrize(
    ("change", "told"),
    [({"num_hidden_layers": 3}, "they lack"), ({"num_hidden_layers": 1}, "it has no place for")],
)
def test_weights_of_another_depth_are_refused(folder: Path, change: dict[str, int], told: str) -> None:
    edit(folder / "config.json", lambda table: table["text_config"].update(change))
    assert f"the weights are not those of config.json: {told} '" in refusal(folder)


def test_weights_of_another_width_are_refused(folder: Path) -> None:
    edit(folder / "config.json", lambda table: table["text_config"].update(intermediate_size=64))
    assert "of another size is 'model.language_model.layers." in refusal(folder)


def test_a_name_that_is_nowhere_is_told(tmp_path: Path) -> None:
    assert "there is no such folder" in refusal(tmp_path / "nothing")
    (tmp_path / "file").write_text("")
    assert "is a file: give the folder" in refusal(tmp_path / "file")


def test_a_hub_id_offline_says_how_to_download_it(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("huggingface_hub.constants.HF_HUB_OFFLINE", True)
    monkeypatch.setattr("huggingface_hub.constants.HF_HUB_CACHE", str(tmp_path))
    told = refusal("somebody/simart-8b")
    assert "as a hub id it is not in the cache while HF_HUB_OFFLINE is set" in told
    assert "`hf download somebody/simart-8b`" in told
    with pytest.raises(BadInputError, match="hf download Qwen/Qwen3-VL-8B-Instruct"):
        extend_base("Qwen/Qwen3-VL-8B-Instruct", micro_codec())


def test_a_missing_library_says_what_to_install(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(EXTRAS, "mllm", ("transformers", "no_such_library"))
    assert refusal("anything") == ("the language model needs no_such_library: pip install 'simart-kit[mllm]'")


@pytest.mark.skipif(torch.cuda.is_available(), reason="there is a GPU")
def test_a_gpu_that_is_absent_is_told(folder: Path) -> None:
    assert "device cuda: torch" in refusal(folder, device="cuda")


@pytest.mark.parametrize(
    ("options", "told"),
    [
        ({"device": "tpu"}, "device 'tpu' is not known: use auto, cpu, cuda or cuda:N"),
        ({"dtype": "int8"}, "dtype 'int8' is not known: use auto, float32, bfloat16, float16"),
        ({"quantisation": "2bit"}, "quantisation '2bit' is not known: use none, 8bit, 4bit"),
        ({"quantisation": "4bit"}, "quantisation 4bit needs a CUDA GPU: use none with device cpu"),
    ],
)
def test_words_that_mean_nothing_here_are_told(folder: Path, options: dict[str, str], told: str) -> None:
    assert refusal(folder, **options) == told
