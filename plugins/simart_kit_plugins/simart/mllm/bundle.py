"""A SIMART model from a folder or the hub: weights, tokenizer and codebook, checked against one another."""

from __future__ import annotations

from functools import lru_cache
from pathlib import Path

from simart_kit.errors import BadInputError
from simart_kit.extras import require_extra
from simart_kit.provenance import file_hash

from ..default_model import LoadedModel, load_model
from .extra import quiet
from .hub import located
from .memory import memory_told
from .saving import ADAPTER_CONFIG, CODEC_FOLDER, TOKENIZER_FILE, SaveDtype, save_bundle
from .settings import SETTINGS_FILE, Settings, read_settings, settings_of
from .shards import ADAPTER_FILE, check_file
from .simart_model import SimartModel
from .tokenizing import require_names
from .weights import Choices, load_plain, read_tokenizer

__all__ = ["SaveDtype", "Settings", "SimartModel", "load_bundle", "read_codec", "save_bundle", "settings_of"]


def load_bundle(
    name: str,
    *,
    device: str = "auto",
    dtype: str = "auto",
    quantisation: str = "none",
    allow_slow: bool = False,
) -> SimartModel:
    """Read a SIMART model, ready to be asked; a process reads the same one once.

    Args:
        name: folder, or hub id; a folder with an adapter names its base.
        device: "auto" (a GPU where there is one), "cpu", "cuda" or such as "cuda:1".
        dtype: "auto", "float32", "bfloat16" or "float16"; see `placing.placing`.
        quantisation: "none", or "8bit" or "4bit" through bitsandbytes, on GPUs.
        allow_slow: run models of billions of parameters on a CPU too.

    Raises:
        BadInputError: the extra is not installed; there is no such model, or it is no SIMART model; files are
            missing, damaged or not of one model; or device or memory do not do, with numbers.
    """
    require_extra("mllm", "the language model")
    settings_file = Path(name).expanduser() / SETTINGS_FILE
    # A model that was written anew is read anew; the hub is not asked twice.
    written = settings_file.stat().st_mtime_ns if settings_file.is_file() else 0
    return _loaded(name, Choices(device, dtype, quantisation, allow_slow), written)


@lru_cache(maxsize=2)
def _loaded(name: str, choices: Choices, written: int) -> SimartModel:
    """Keep what `_read` reads; `written` [ns] tells a folder from what was in it before."""
    return _read(name, choices)


def _read(name: str, choices: Choices) -> SimartModel:
    folder = located(name, weights=False)
    settings = read_settings(folder)
    codec = read_codec(folder, settings)
    if (folder / ADAPTER_CONFIG).is_file():
        return _adapted(name, choices, settings, codec)
    plain = load_plain(name, choices, identity=settings.identity)
    bundle = SimartModel(plain.model, plain.tokenizer, settings.vocabulary, codec, settings, plain.folder)
    _require_tokenizer(bundle)
    return bundle


def _adapted(name: str, choices: Choices, settings: Settings, codec: LoadedModel) -> SimartModel:
    """A base with the adapter of a folder on it."""
    from peft import PeftModel

    folder = located(name, weights=True)
    if not (folder / ADAPTER_FILE).is_file():
        raise BadInputError(f"{folder} has no weights: {ADAPTER_FILE} is missing")
    check_file(folder / ADAPTER_FILE, settings.identity)
    if not settings.base:
        raise BadInputError(f"{folder / SETTINGS_FILE} names no base for the adapter beside it")
    start = _base(folder, settings, choices, codec)
    if start.settings.codec != settings.codec:
        raise BadInputError(
            f"wrong codebook: the adapter in {folder} was made for codes of {settings.codec}, and its base "
            f"{settings.base} for {start.settings.codec}"
        )
    if start.vocabulary != settings.vocabulary:
        raise BadInputError(
            f"{folder}: the adapter was made for voxel tokens from id {settings.first_id} on, and its base "
            f"{settings.base} has them from {start.vocabulary.first_id} on"
        )
    try:
        with quiet(), memory_told(f"loading {name}"):
            adapted = PeftModel.from_pretrained(start.model, folder, local_files_only=True).eval()
    except (ValueError, RuntimeError, KeyError) as error:
        first = str(error).strip().splitlines()[0]
        raise BadInputError(
            f"{folder}: the adapter does not fit its base {settings.base}: {first}"
        ) from error
    bundle = SimartModel(adapted, read_tokenizer(folder), settings.vocabulary, codec, settings, folder)
    _require_tokenizer(bundle)
    return bundle


def _base(folder: Path, settings: Settings, choices: Choices, codec: LoadedModel) -> SimartModel:
    """What an adapter is for: a plain Qwen3-VL with the voxel tokens added, or another SIMART model."""
    from .base import extend_base

    beside = folder / settings.base
    base = str(beside) if beside.is_dir() else settings.base
    if (located(base, weights=False) / SETTINGS_FILE).is_file():
        return _read(base, choices)  # its own copy, since an adapter changes what it is put on
    return extend_base(base, codec, settings.seed, choices)


def read_codec(folder: Path, settings: Settings) -> LoadedModel:
    """The voxel model of a SIMART model's folder, or the shipped one where it has none of its own.

    Raises:
        BadInputError: its codes are not those that the settings name.
    """
    own = folder / CODEC_FOLDER
    codec = load_model(own if own.is_dir() else None)
    if codec.fingerprint != settings.codec:
        raise BadInputError(
            f"wrong codebook: {folder / SETTINGS_FILE} was made for codes of {settings.codec}, and "
            f"{codec.folder} is {codec.fingerprint}; put the right voxel model in {own}"
        )
    if codec.grid != settings.vocabulary.grid:
        raise BadInputError(f"{folder}: its voxel tokens are of {settings.vocabulary.grid}, not {codec.grid}")
    return codec


def _require_tokenizer(bundle: SimartModel) -> None:
    """Raise BadInputError unless tokenizer and weights are those that the settings are of."""
    folder, settings = bundle.folder, bundle.settings
    assert folder is not None
    found = file_hash(folder / TOKENIZER_FILE) if (folder / TOKENIZER_FILE).is_file() else "no file"
    if found != settings.tokenizer:
        raise BadInputError(
            f"{folder / TOKENIZER_FILE} is not the tokenizer of this model: its hash is {found[:16]}, and "
            f"{SETTINGS_FILE} says {settings.tokenizer[:16]}"
        )
    require_names(bundle.tokenizer, bundle.vocabulary)
    rows, tokens = bundle.model.get_input_embeddings().weight.shape[0], len(bundle.tokenizer)
    if tokens > rows:
        raise BadInputError(f"{folder}: the tokenizer has {tokens} tokens and the weights only {rows} rows")
