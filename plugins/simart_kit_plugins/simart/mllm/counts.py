"""How many numbers a model of a size has, by arithmetic: known before a weight is read or downloaded."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from .sizes import MllmSize, TextSize, VisionSize

if TYPE_CHECKING:
    from transformers import Qwen3VLConfig

VOXEL_TOKENS = 1 + 1024 + 8192
"""Tokens that the shipped codec adds: <voxel>, 16x8x8 cells and 8192 codes."""
_PAD = 64
# Colours, and pictures that make one patch in time.
_PIXEL = 3 * 2


@dataclass(frozen=True, slots=True)
class ParameterCounts:
    """Numbers of a model.

    Attributes:
        layers: of the language model, with its last norm.
        embeddings: the matrix that tokens are read with.
        head: the matrix that tokens are written with; 0 where it is the same one.
        vision: of the picture encoder and what brings its output to the language model.
    """

    layers: int
    embeddings: int
    head: int
    vision: int

    @property
    def total(self) -> int:
        """All of them."""
        return self.layers + self.embeddings + self.head + self.vision


def parameter_counts(size: MllmSize, voxel_tokens: int = VOXEL_TOKENS) -> ParameterCounts:
    """Parameters of a model of a size with so many voxel tokens added to its tokenizer."""
    rows = _PAD * -(-(size.tokenizer_size + voxel_tokens) // _PAD)
    matrix = rows * size.text.hidden
    return ParameterCounts(
        layers=size.text.layers * _text_layer(size.text) + size.text.hidden,
        embeddings=matrix,
        head=0 if size.tie_embeddings else matrix,
        vision=_vision(size.vision, size.text.hidden),
    )


def cache_numbers(size: MllmSize) -> int:
    """Numbers that the cache keeps for a token: a key and a value for every layer."""
    return 2 * size.text.layers * size.text.key_heads * size.text.head_dim


def size_of(config: Qwen3VLConfig) -> MllmSize:
    """The size that a config describes; its tokenizer has as many tokens as the embeddings have rows."""
    text, vision = config.text_config, config.vision_config
    rope = text.rope_parameters or {}
    return MllmSize.model_validate(
        {
            "base": "",
            "tie_embeddings": bool(config.tie_word_embeddings),
            "tokenizer_size": text.vocab_size,
            "text": {
                "hidden": text.hidden_size,
                "layers": text.num_hidden_layers,
                "heads": text.num_attention_heads,
                "key_heads": text.num_key_value_heads,
                "head_dim": text.head_dim,
                "feed_forward": text.intermediate_size,
                "rotary": tuple(rope.get("mrope_section", (24, 20, 20))),
                "positions": text.max_position_embeddings,
            },
            "vision": {
                "hidden": vision.hidden_size,
                "depth": vision.depth,
                "heads": vision.num_heads,
                "feed_forward": vision.intermediate_size,
                "patch": vision.patch_size,
                "merge": vision.spatial_merge_size,
                "deepstack": tuple(vision.deepstack_visual_indexes),
                "positions": vision.num_position_embeddings,
            },
        }
    )


def _text_layer(text: TextSize) -> int:
    queries, keys = text.heads * text.head_dim, text.key_heads * text.head_dim
    attention = text.hidden * (2 * queries + 2 * keys) + 2 * text.head_dim  # with the norms of both
    return attention + 3 * text.hidden * text.feed_forward + 2 * text.hidden


def _vision(vision: VisionSize, out: int) -> int:
    wide, inner = vision.hidden, vision.feed_forward
    patches = _PIXEL * vision.patch**2 * wide + wide + vision.positions * wide
    attention = _linear(wide, 3 * wide) + _linear(wide, wide)
    layer = attention + _linear(wide, inner) + _linear(inner, wide) + 2 * 2 * wide
    merged = vision.merge**2 * wide
    merger = _linear(merged, merged) + _linear(merged, out)
    deep = len(vision.deepstack) * (merger + 2 * merged)
    return patches + vision.depth * layer + merger + 2 * wide + deep


def _linear(inputs: int, outputs: int) -> int:
    return inputs * outputs + outputs
