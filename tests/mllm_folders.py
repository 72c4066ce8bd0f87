"""Language models of a few hundred kilobytes, with the files that the hub's Qwen3-VL folders have."""

from __future__ import annotations

import atexit
import copy
import json
import shutil
from functools import lru_cache
from pathlib import Path
from tempfile import mkdtemp
from typing import Any

import torch
from simart_kit_plugins.simart.default_model import LoadedModel, load_model
from simart_kit_plugins.simart.mllm.building import build, model_config
from simart_kit_plugins.simart.mllm.extra import quiet
from simart_kit_plugins.simart.mllm.simart_model import SimartModel
from simart_kit_plugins.simart.mllm.sizes import MllmSize, TextSize, VisionSize
from simart_kit_plugins.simart.mllm.tokenizing import SPECIAL, small_tokenizer
from simart_kit_plugins.simart.vqnano.config import VqNanoConfig
from simart_kit_plugins.simart.vqnano.model import VqNano
from simart_kit_plugins.simart.vqvae.checkpoint import save_checkpoint

TEXTS = ('{"name":"Box","scale":12.5}', "the lid of the box", "the lid opens")
TEXT = TextSize(
    hidden=32, layers=2, heads=2, key_heads=1, head_dim=16, feed_forward=48, rotary=(4, 2, 2), positions=4096
)
VISION = VisionSize(
    hidden=16, depth=2, heads=2, feed_forward=32, patch=16, merge=2, deepstack=(0,), positions=16
)


def micro_size(tied: bool = True) -> MllmSize:
    """A few thousand numbers beside the embeddings."""
    return MllmSize(base="", tie_embeddings=tied, tokenizer_size=300, text=TEXT, vision=VISION)


@lru_cache
def micro_codec(seed: int = 0) -> LoadedModel:
    """A voxel model with random weights, of 8x8x8 cells and 4096 codes in two numbers each."""
    folder = Path(mkdtemp())
    atexit.register(shutil.rmtree, folder)
    config = VqNanoConfig(
        grid="8x8x8",
        codebook_size=4096,
        contexts=8,
        token_channels=2,
        channels=4,
        neighbour_channels=2,
        hidden_channels=4,
        encoder_layers=0,
        decoder_layers=1,
    )
    save_checkpoint(VqNano(config, seed), folder)
    return load_model(folder)


def micro_model(tied: bool = True, seed: int = 0) -> SimartModel:
    """A SIMART model with random weights."""
    return build(micro_size(tied), micro_codec(), seed, TEXTS)


@lru_cache
def shared_model() -> SimartModel:
    """One that tests only look at."""
    return micro_model()


def plain_folder(folder: Path, rows: int = 320, form: str = "4.57") -> Any:
    """Write a plain Qwen3-VL as the hub has it, and return the model.

    Args:
        folder: config.json, shards and their index, vocab.json, merges.txt and the other tokenizer files.
        rows: of the embeddings; the tokenizer has fewer.
        form: of config.json: that of transformers "4.57", as the hub has it, or "5".
    """
    from transformers import Qwen3VLForConditionalGeneration

    tokenizer = small_tokenizer(TEXTS, 300)
    config = model_config(micro_size(tied=False), tokenizer)
    config.text_config.vocab_size = rows
    with torch.random.fork_rng(devices=[]), quiet():
        torch.default_generator.manual_seed(5)
        model = Qwen3VLForConditionalGeneration(config).eval()
        model.save_pretrained(folder, max_shard_size=60_000)
        tokenizer.save_pretrained(folder)
    if form == "4.57":
        _write_old_config(folder / "config.json")
    _write_tokenizer_files(folder, tokenizer)
    return model


def _write_old_config(path: Path) -> None:
    table = json.loads(path.read_text())
    table["transformers_version"] = "4.57.0.dev0"
    table.pop("dtype", None)
    text = table["text_config"]
    rope = text.pop("rope_parameters")
    text["rope_theta"] = rope.pop("rope_theta")
    text["rope_scaling"] = rope
    table["vision_config"].pop("rope_parameters", None)
    table["vision_config"]["model_type"] = "qwen3_vl"
    path.write_text(json.dumps(table))


def _write_tokenizer_files(folder: Path, tokenizer: Any) -> None:
    whole = json.loads(tokenizer.backend_tokenizer.to_str())
    (folder / "vocab.json").write_text(json.dumps(whole["model"]["vocab"]))
    merges = "\n".join(" ".join(pair) for pair in whole["model"]["merges"])
    (folder / "merges.txt").write_text(f"#version: 0.2\n{merges}\n")
    (folder / "chat_template.jinja").unlink()
    (folder / "chat_template.json").write_text(json.dumps({"chat_template": tokenizer.chat_template}))
    (folder / "preprocessor_config.json").write_text(json.dumps({"patch_size": 16, "merge_size": 2}))
    path = folder / "tokenizer_config.json"
    table = json.loads(path.read_text())
    table["additional_special_tokens"] = list(SPECIAL[1:])
    table.pop("extra_special_tokens", None)
    added = copy.deepcopy(whole["added_tokens"])
    table["added_tokens_decoder"] = {str(token.pop("id")): token for token in added}
    table["chat_template"] = tokenizer.chat_template
    path.write_text(json.dumps(table))
