"""Tokenizers, answers and a tiny random Qwen3-VL for tests of the grammar."""

from __future__ import annotations

from functools import lru_cache
from typing import TYPE_CHECKING

import numpy as np
from simart_kit_plugins.simart.answer.values import PART_TYPES, Motion, ObjectAnswer, PartAnswer
from simart_kit_plugins.simart.answer.writing import answer_text
from simart_kit_plugins.simart.grammar.grammar import Grammar
from simart_kit_plugins.simart.mllm.tokenizing import extended, small_tokenizer
from simart_kit_plugins.simart.tokens import TokenGrid, VoxelTokens

from simart_kit.arrays import IntArray

if TYPE_CHECKING:
    from transformers import Qwen3VLForConditionalGeneration

GRID = TokenGrid()
WORDS = ("Storage", "Box", "door", "left", "drawer_2", "lid", "Wheel", "x", "front-panel", "7")
TABLE = ("Wood", "Plywood", "MDF", "Glass", "Steel", "Aluminium", "Plastic", "Rubber", "Foam")


@lru_cache
def grammar(merged: bool = True, max_parts: int = 16) -> Grammar:
    """The grammar of a small tokenizer; without merges every character is a token."""
    rng = np.random.default_rng(0)
    texts = [answer_text(random_answer(rng, np.arange(40)), atoms=False) for _ in range(60)] if merged else []
    tokenizer, vocabulary = extended(small_tokenizer(texts, 600 if merged else 263), GRID)
    return Grammar(tokenizer, vocabulary, max_parts=max_parts)


def random_answer(rng: np.random.Generator, cells: IntArray, most: int = 5) -> ObjectAnswer:
    """An answer that the grammar can write without rounding, of up to `most` parts in these cells."""
    parts = [random_part(rng, number, cells) for number in range(rng.integers(1, most + 1))]
    return ObjectAnswer(_name(rng), int(rng.integers(1, 5000)) / 10, tuple(parts))


def random_part(rng: np.random.Generator, number: int, cells: IntArray) -> PartAnswer:
    kind = PART_TYPES[rng.integers(len(PART_TYPES))] if number else "fixed"
    return PartAnswer(
        kind,  # type: ignore[arg-type]  # one of PART_TYPES
        _voxels(rng, cells),
        _name(rng),
        int(rng.integers(number)) if number else None,
        _motion(rng, kind),
        TABLE[rng.integers(len(TABLE))] if rng.random() < 0.7 else "",
        int(rng.integers(1, 1000)) / 100 if rng.random() < 0.7 else None,
        int(rng.integers(1, 9000)) / 1000 if rng.random() < 0.7 else None,
    )


def _motion(rng: np.random.Generator, kind: str) -> Motion | None:
    if kind in ("fixed", "free"):
        return None
    x, y, z = rng.integers(0, 201, 3).tolist()
    if kind == "hinge" and rng.random() < 0.5:
        return Motion((x, y, z))
    axis = [(100, 0, 0), (0, -100, 0), (0, 0, 100), (100, -3, 57)][rng.integers(4)]
    largest = 100 if kind == "prismatic" else 200
    lower, upper = int(rng.integers(-largest, 1)), int(rng.integers(0, largest + 1))
    return Motion((x, y, z), axis, (lower, upper) if lower < upper else (lower, upper + 1))


def _voxels(rng: np.random.Generator, cells: IntArray) -> VoxelTokens:
    index = np.sort(rng.choice(cells, rng.integers(1, len(cells) + 1), replace=False))
    return VoxelTokens(GRID, index, rng.integers(1, GRID.codebook, len(index)))


def _name(rng: np.random.Generator) -> str:
    return " ".join(rng.choice(WORDS, rng.integers(0, 4)))[:48].rstrip(" _-")


@lru_cache
def tiny_model(pair: Grammar) -> Qwen3VLForConditionalGeneration:
    """A Qwen3-VL with random weights and two layers for a grammar; id 4 stands for a picture."""
    import torch
    from transformers import Qwen3VLConfig, Qwen3VLForConditionalGeneration

    torch.set_num_threads(1)
    vocabulary = pair.vocabulary
    one_cell = VoxelTokens(GRID, np.array([0]), np.array([1]))
    eos = int(pair.encode_grounding(one_cell).ids[-1])
    text = {
        "vocab_size": vocabulary.first_id + len(vocabulary),
        "hidden_size": 32,
        "intermediate_size": 64,
        "num_hidden_layers": 2,
        "num_attention_heads": 2,
        "num_key_value_heads": 1,
        "head_dim": 16,
        "rope_parameters": {"rope_type": "default", "rope_theta": 10000.0, "mrope_section": [4, 2, 2]},
        "eos_token_id": eos,
        "pad_token_id": 0,
        "tie_word_embeddings": True,
    }
    vision = {
        "depth": 2,
        "hidden_size": 32,
        "intermediate_size": 64,
        "num_heads": 2,
        "patch_size": 16,
        "out_hidden_size": 32,
        "num_position_embeddings": 64,
        "deepstack_visual_indexes": [0],
    }
    torch.manual_seed(0)
    config = Qwen3VLConfig(text_config=text, vision_config=vision, image_token_id=4)
    model = Qwen3VLForConditionalGeneration(config).eval()
    model.generation_config.eos_token_id = eos
    model.generation_config.pad_token_id = 0
    with torch.no_grad():
        # Far from uniform, so that texts differ from each other and greedy choices have no ties.
        model.get_input_embeddings().weight.mul_(20)
    return model
