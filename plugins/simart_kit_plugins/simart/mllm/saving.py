"""A SIMART model as a folder, which any program that reads Qwen3-VL folders can read too."""

from __future__ import annotations

import copy
import json
import shutil
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Literal

from simart_kit.errors import BadInputError, OutputError
from simart_kit.provenance import file_hash, write_json

from ..default_model import WEIGHTS_FILE as CODEC_WEIGHTS
from ..default_model import default_model_folder
from .extra import quiet
from .settings import SETTINGS_FILE, Settings, write_settings
from .shards import ADAPTER_FILE, IDENTITY, INDEX_FILE, sort_metadata
from .simart_model import SimartModel

if TYPE_CHECKING:
    from torch import Tensor

SaveDtype = Literal["keep", "float32", "bfloat16", "float16"]
CODEC_FOLDER = "codec"
TOKENIZER_FILE = "tokenizer.json"
SHARD_BYTES = 4_000_000_000
ADAPTER_CONFIG = "adapter_config.json"
_HEAD = "lm_head.weight"


def save_bundle(
    bundle: SimartModel,
    folder: Path,
    *,
    dtype: SaveDtype = "keep",
    shard_bytes: int = SHARD_BYTES,
    weights: Mapping[str, Tensor] | None = None,
) -> Path:
    """Write a folder that `load_bundle` reads; the same model gives the same bytes.

    The folder is put in place as a whole: what is interrupted leaves an earlier one as it was. Of a model
    with an adapter the adapter alone is written, to be read beside its base. The codec is copied into the
    folder unless it is the one that comes with the package.

    Args:
        bundle: on any device.
        folder: made, or replaced if it holds a SIMART model.
        dtype: of the weights in the file.
        shard_bytes: most bytes of a weights file (a matrix is never divided).
        weights: state dict to write instead of the model's, such as one gathered from several processes.

    Returns:
        The folder.

    Raises:
        OutputError: the folder cannot be written, or holds something else.
        BadInputError: the model is quantised, or has an adapter and a base that was never saved.
    """
    if getattr(bundle.model, "is_quantized", False):
        raise BadInputError("a quantised model cannot be saved: load it without quantisation")
    if folder.exists() and not (folder / SETTINGS_FILE).is_file() and any(folder.iterdir()):
        raise OutputError(f"{folder} holds something else than a SIMART model: give a new folder")
    partial = folder.with_name(f"{folder.name}.partial")
    try:
        shutil.rmtree(partial, ignore_errors=True)
        partial.mkdir(parents=True)
        _write(bundle, partial, dtype, shard_bytes, weights)
        _replace(folder, partial)
    except OSError as error:
        raise OutputError(f"cannot write the model to {folder}: {error}") from error
    finally:
        shutil.rmtree(partial, ignore_errors=True)
    return folder


def _write(
    bundle: SimartModel,
    folder: Path,
    dtype: SaveDtype,
    shard_bytes: int,
    weights: Mapping[str, Tensor] | None,
) -> None:
    with quiet():
        bundle.tokenizer.save_pretrained(folder)
    update = {"tokenizer": file_hash(folder / TOKENIZER_FILE)}
    settings = bundle.settings.model_copy(update=update)
    if hasattr(bundle.model, "get_base_model"):
        settings = settings.model_copy(update={"base": _adapter_base(bundle)})
        _write_adapter(bundle, settings, folder, dtype, weights)
    else:
        _write_config(bundle, folder, dtype)
        state = dict(bundle.model.state_dict() if weights is None else weights)
        if bundle.model.config.tie_word_embeddings:  # one matrix under two names
            state.pop(_HEAD, None)
        _write_weights(state, settings, folder, dtype, shard_bytes)
    _copy_codec(bundle, folder)
    write_settings(settings, folder)


def _write_config(bundle: SimartModel, folder: Path, dtype: SaveDtype) -> None:
    """config.json, generation_config.json, and how pictures are cut, which other programs ask for."""
    import torch

    config = copy.deepcopy(bundle.model.config)
    config.architectures = [type(bundle.model).__name__]
    if dtype != "keep":
        for part in (config, config.text_config, config.vision_config):
            part.dtype = getattr(torch, dtype)
    with quiet():
        config.save_pretrained(folder)
        if bundle.model.generation_config is not None:
            bundle.model.generation_config.save_pretrained(folder)
    vision = config.vision_config
    pixels = (vision.patch_size * vision.spatial_merge_size) ** 2
    table = {
        "image_processor_type": "Qwen2VLImageProcessor",
        "processor_class": "Qwen3VLProcessor",
        "patch_size": vision.patch_size,
        "merge_size": vision.spatial_merge_size,
        "temporal_patch_size": vision.temporal_patch_size,
        "size": {"shortest_edge": 4 * pixels, "longest_edge": 16384 * pixels},
        "image_mean": [0.5, 0.5, 0.5],
        "image_std": [0.5, 0.5, 0.5],
    }
    write_json(folder / "preprocessor_config.json", table)


def _write_weights(
    weights: Mapping[str, Tensor], settings: Settings, folder: Path, dtype: SaveDtype, shard_bytes: int
) -> None:
    from huggingface_hub import split_torch_state_dict_into_shards

    own = {name: _converted(tensor, dtype) for name, tensor in weights.items()}
    split = split_torch_state_dict_into_shards(own, max_shard_size=shard_bytes)
    for file, names in split.filename_to_tensors.items():
        _save({name: own[name] for name in names}, folder / file, settings)
    if split.is_sharded:
        index = {"metadata": split.metadata, "weight_map": split.tensor_to_filename}
        (folder / INDEX_FILE).write_text(json.dumps(index, indent=2, sort_keys=True) + "\n", encoding="utf-8")


def _write_adapter(
    bundle: SimartModel,
    settings: Settings,
    folder: Path,
    dtype: SaveDtype,
    weights: Mapping[str, Tensor] | None,
) -> None:
    from peft import get_peft_model_state_dict

    config = copy.deepcopy(bundle.model.active_peft_config)
    config.base_model_name_or_path = settings.base
    config.inference_mode = True
    config.save_pretrained(str(folder))
    state = get_peft_model_state_dict(bundle.model, state_dict=weights, save_embedding_layers=False)
    _save({name: _converted(t, dtype) for name, t in state.items()}, folder / ADAPTER_FILE, settings)


def _adapter_base(bundle: SimartModel) -> str:
    """What an adapter is beside: the SIMART model that it was put on, or the plain base that was extended."""
    read = bundle.folder
    own = read is not None and not (read / ADAPTER_CONFIG).is_file()
    base = str(read.resolve()) if read is not None and own else bundle.settings.base
    if not base:
        raise BadInputError(
            "an adapter is read beside its base, and this base was never saved: save it first"
        )
    return base


def _save(tensors: dict[str, Tensor], path: Path, settings: Settings) -> None:
    from safetensors import SafetensorError
    from safetensors.torch import save_file

    try:
        save_file(tensors, path, metadata={"format": "pt", IDENTITY: settings.identity})
    except SafetensorError as error:
        raise OSError(f"{path.name}: {error}") from error
    sort_metadata(path)
    path.chmod(0o644)  # the library makes files that others on the machine cannot read


def _converted(tensor: Tensor, dtype: SaveDtype) -> Tensor:
    import torch

    tensor = tensor.detach().cpu()
    if dtype != "keep" and tensor.is_floating_point():
        tensor = tensor.to(getattr(torch, dtype))
    return tensor.contiguous()


def _copy_codec(bundle: SimartModel, folder: Path) -> None:
    source = bundle.codec.folder
    if bundle.codec.fingerprint == file_hash(default_model_folder() / CODEC_WEIGHTS)[:16]:
        return
    (folder / CODEC_FOLDER).mkdir()
    for name in ("config.json", CODEC_WEIGHTS):
        shutil.copyfile(source / name, folder / CODEC_FOLDER / name)


def _replace(folder: Path, made: Path) -> None:
    """Put a folder that was made in the place of another, which stays until then."""
    if not folder.exists():
        made.rename(folder)
        return
    old = folder.with_name(f"{folder.name}.old")
    shutil.rmtree(old, ignore_errors=True)
    folder.rename(old)
    made.rename(folder)
    shutil.rmtree(old, ignore_errors=True)
