"""A tiny language model with random weights, built once a process."""

from __future__ import annotations

from dataclasses import replace
from functools import lru_cache

import torch
from simart_kit_plugins.simart.default_model import load_model
from simart_kit_plugins.simart.mllm.building import build
from simart_kit_plugins.simart.mllm.bundle import save_bundle
from simart_kit_plugins.simart.mllm.sizes import MllmSize, TextSize, VisionSize

torch.set_num_threads(1)

SIZE = MllmSize(
    base="",
    tie_embeddings=True,
    tokenizer_size=263,
    text=TextSize(
        hidden=32,
        layers=2,
        heads=2,
        key_heads=1,
        head_dim=16,
        feed_forward=32,
        rotary=(4, 2, 2),
        positions=16384,
    ),
    vision=VisionSize(
        hidden=32, depth=1, heads=2, feed_forward=32, patch=16, merge=2, deepstack=(0,), positions=64
    ),
)


@lru_cache(maxsize=1)
def bundle():
    """A Qwen3-VL of two narrow layers around the shipped voxel model; it is asked without a system prompt."""
    made = build(SIZE, load_model(), seed=3)
    return replace(made, settings=made.settings.model_copy(update={"prompt": "none", "picture_size": 64}))


@lru_cache(maxsize=1)
def saved(folder):
    """The folder of that model, written below `folder`."""
    return save_bundle(bundle(), folder / "tiny")
