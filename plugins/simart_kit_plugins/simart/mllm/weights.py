"""Plain Qwen3-VL folders: config, tokenizer and weights, read with every mistake told in one line."""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from simart_kit.errors import BadInputError

from .counts import parameter_counts, size_of
from .extra import quiet
from .hub import located
from .memory import memory_told, require_memory
from .placing import Placing, placing
from .shards import check_weights

if TYPE_CHECKING:
    from transformers import PreTrainedTokenizerFast, Qwen3VLConfig, Qwen3VLForConditionalGeneration

CONFIG_FILE = "config.json"
ARCHITECTURE = "qwen3_vl"
_TIED = "lm_head.weight"


@dataclass(frozen=True, slots=True)
class Choices:
    """What a person may say of where a model goes; see `placing.placing` and `memory.require_memory`."""

    device: str = "auto"
    dtype: str = "auto"
    quantisation: str = "none"
    allow_slow: bool = False


@dataclass(frozen=True, eq=False)
class Plain:
    """A Qwen3-VL as it lies in a folder."""

    model: Qwen3VLForConditionalGeneration
    tokenizer: PreTrainedTokenizerFast
    folder: Path


def load_plain(name: str, choices: Choices, *, voxel_tokens: int = 0, identity: str | None = None) -> Plain:
    """Read a Qwen3-VL; what it needs is compared with what there is before weights are downloaded or read.

    Args:
        name: folder or hub id.
        choices: where it goes.
        voxel_tokens: tokens that will be added, for the memory they take.
        identity: mark that the weights must carry, see `shards.check_weights`.

    Raises:
        BadInputError: files are missing, damaged or of another architecture, or device or memory do not do.
    """
    config = read_config(located(name, weights=False))
    size = size_of(config)
    placed = placing(
        choices.device,
        choices.dtype,
        choices.quantisation,
        parameter_counts(size, voxel_tokens).total,
    )
    require_memory(name, size, placed, voxel_tokens=voxel_tokens, allow_slow=choices.allow_slow)
    folder = located(name, weights=True)
    check_weights(folder, identity)
    tokenizer = read_tokenizer(folder)
    with memory_told(f"loading {name} on {placed.device}"):
        return Plain(_read_model(folder, config, placed), tokenizer, folder)


def read_config(folder: Path) -> Qwen3VLConfig:
    """The config of a folder, in the form of transformers 4.57 or 5.

    Raises:
        BadInputError: there is none, it is damaged, or of another architecture.
    """
    from transformers import Qwen3VLConfig

    path = folder / CONFIG_FILE
    try:
        table = json.loads(path.read_text(encoding="utf-8"))
        architecture = table.get("model_type")
    except OSError as error:
        raise BadInputError(f"cannot read {path}: {error.strerror}; give the folder of a model") from error
    except (ValueError, AttributeError) as error:
        raise BadInputError(f"{path} is damaged: it is no JSON table; download it again") from error
    if architecture != ARCHITECTURE:
        raise BadInputError(
            f"{path} is of architecture '{architecture}', and '{ARCHITECTURE}' is needed: give a Qwen3-VL, "
            "such as Qwen/Qwen3-VL-8B-Instruct"
        )
    try:
        with quiet():
            config = Qwen3VLConfig.from_dict(table)
            size_of(config)
    except Exception as error:  # whatever a wrong value makes its many checks raise
        raise BadInputError(f"{path} is damaged: {_first_line(error)}") from error
    return config


def read_tokenizer(folder: Path) -> PreTrainedTokenizerFast:
    """The tokenizer of a folder; raises BadInputError where files are missing or damaged."""
    from transformers import AutoTokenizer

    names = ("tokenizer.json", "vocab.json")
    if not any((folder / name).is_file() for name in names):
        raise BadInputError(f"{folder} has no tokenizer: neither {' nor '.join(names)} is in it")
    try:
        with quiet():
            tokenizer: PreTrainedTokenizerFast = AutoTokenizer.from_pretrained(folder, local_files_only=True)
    except Exception as error:  # the tokenizers library raises bare ones
        raise BadInputError(f"{folder}: the tokenizer's files are damaged: {_first_line(error)}") from error
    return tokenizer


def _read_model(folder: Path, config: Qwen3VLConfig, placed: Placing) -> Qwen3VLForConditionalGeneration:
    """Weights of checked files, on their device."""
    import torch
    from transformers import Qwen3VLForConditionalGeneration

    with quiet():
        model, read = Qwen3VLForConditionalGeneration.from_pretrained(
            folder,
            config=config,
            dtype=getattr(torch, placed.dtype),
            device_map=None if placed.device == "cpu" else {"": placed.device},
            quantization_config=_quantisation(placed),
            output_loading_info=True,
            ignore_mismatched_sizes=True,  # told below, by name
            local_files_only=True,
            use_safetensors=True,
        )
    _require_fit(folder, read)
    fitted: Qwen3VLForConditionalGeneration = model.eval()
    return fitted


def _require_fit(folder: Path, read: dict[str, Any]) -> None:
    """Raise BadInputError where the weights are not those of the config."""
    problems = {
        "they lack": set(read["missing_keys"]),
        "of another size is": {entry[0] for entry in read["mismatched_keys"]},
        "it has no place for": set(read["unexpected_keys"]) - {_TIED},
    }
    for problem, names in problems.items():
        if names:
            more = f" and {len(names) - 1} more" if len(names) > 1 else ""
            raise BadInputError(
                f"{folder}: the weights are not those of {CONFIG_FILE}: {problem} '{min(names)}'{more}; "
                "give files that were saved together"
            )


def _quantisation(placed: Placing) -> Any:
    """Options of bitsandbytes, or None."""
    if placed.quantisation == "none":
        return None
    import torch
    from transformers import BitsAndBytesConfig

    if placed.quantisation == "8bit":
        return BitsAndBytesConfig(load_in_8bit=True)
    return BitsAndBytesConfig(
        load_in_4bit=True, bnb_4bit_quant_type="nf4", bnb_4bit_compute_dtype=getattr(torch, placed.dtype)
    )


def _first_line(error: BaseException) -> str:
    lines = str(error).strip().splitlines()
    return lines[0] if lines else type(error).__name__
