"""New models: random weights of a given size, or a pretrained Qwen3-VL with voxel tokens added."""

from __future__ import annotations

import copy
from collections.abc import Iterable
from typing import TYPE_CHECKING

from simart_kit.extras import require_extra

from ..default_model import LoadedModel
from .embeddings import start_embeddings
from .extra import quiet
from .settings import settings_of
from .simart_model import SimartModel
from .sizes import MllmSize
from .tokenizing import IMAGE, VIDEO, VISION_END, VISION_START, extended, small_tokenizer

if TYPE_CHECKING:
    from transformers import PreTrainedTokenizerFast, Qwen3VLConfig, Qwen3VLForConditionalGeneration

# Rows of an embedding are a multiple of this, which matrix products like.
_PAD = 64
_ROTARY_BASE = 5_000_000


def build(size: MllmSize, codec: LoadedModel, seed: int = 0, texts: Iterable[str] = ()) -> SimartModel:
    """A new model; the same arguments give the same one.

    Args:
        size: with a base the base is extended (see `base.extend_base`), without one weights are random.
        codec: the voxel model whose codes its tokens are.
        seed: of the weights.
        texts: what a model without base shall write in few tokens, such as answers; its tokenizer is
            trained on them. A base brings its own tokenizer.

    Raises:
        BadInputError: the extra is not installed, or the base cannot be had.
    """
    require_extra("mllm", "the language model")
    if size.base:
        from .base import extend_base

        return extend_base(size.base, codec, seed)
    import torch
    from transformers import Qwen3VLForConditionalGeneration

    tokenizer = small_tokenizer(texts, size.tokenizer_size)
    with quiet(), torch.random.fork_rng(devices=[]):  # the caller's random numbers go on as before
        torch.default_generator.manual_seed(seed)
        model = Qwen3VLForConditionalGeneration(model_config(size, tokenizer))
        return simart_model(model.eval(), tokenizer, codec, seed=seed)


def simart_model(
    model: Qwen3VLForConditionalGeneration,
    tokenizer: PreTrainedTokenizerFast,
    codec: LoadedModel,
    *,
    base: str = "",
    seed: int = 0,
) -> SimartModel:
    """A plain Qwen3-VL and its tokenizer as a SIMART model.

    Args:
        model: changed in place: its embeddings grow where they have too few rows (Qwen's have some to spare,
            and must not shrink), and the new tokens' rows are filled.
        tokenizer: is copied.
        codec: the voxel model whose codes the tokens are.
        base: where the weights are from, for the settings.
        seed: of the new rows.
    """
    import torch

    tokenizer, vocabulary = extended(tokenizer, codec.grid)
    # Resizing writes into the config, which other models may share.
    model.config = copy.deepcopy(model.config)
    rows = model.get_input_embeddings().weight.shape[0]
    if len(tokenizer) > rows:
        with torch.random.fork_rng(devices=[]):
            torch.default_generator.manual_seed(seed)  # of the rows that only fill up
            model.resize_token_embeddings(len(tokenizer), pad_to_multiple_of=_PAD, mean_resizing=False)
    start_embeddings(model, vocabulary, codec, seed)
    settings = settings_of(vocabulary, codec, base=base, seed=seed)
    return SimartModel(model, tokenizer, vocabulary, codec, settings)


def model_config(size: MllmSize, tokenizer: PreTrainedTokenizerFast) -> Qwen3VLConfig:
    """The config of a model of a size that reads with a tokenizer, before the voxel tokens are added."""
    from transformers import Qwen3VLConfig

    special = tokenizer.convert_tokens_to_ids([IMAGE, VIDEO, VISION_START, VISION_END])
    image, video, start, end = special
    return Qwen3VLConfig(
        text_config=_text_table(size, tokenizer),
        vision_config=_vision_table(size),
        image_token_id=image,
        video_token_id=video,
        vision_start_token_id=start,
        vision_end_token_id=end,
        tie_word_embeddings=size.tie_embeddings,
        bos_token_id=None,
        eos_token_id=tokenizer.eos_token_id,
        pad_token_id=tokenizer.pad_token_id,
    )


def _text_table(size: MllmSize, tokenizer: PreTrainedTokenizerFast) -> dict[str, object]:
    text = size.text
    return {
        "vocab_size": _PAD * -(-len(tokenizer) // _PAD),
        "hidden_size": text.hidden,
        "intermediate_size": text.feed_forward,
        "num_hidden_layers": text.layers,
        "num_attention_heads": text.heads,
        "num_key_value_heads": text.key_heads,
        "head_dim": text.head_dim,
        "max_position_embeddings": text.positions,
        "tie_word_embeddings": size.tie_embeddings,
        "eos_token_id": tokenizer.eos_token_id,
        "pad_token_id": tokenizer.pad_token_id,
        "rope_parameters": {
            "rope_type": "default",
            "rope_theta": _ROTARY_BASE,
            "mrope_section": list(text.rotary),
            "mrope_interleaved": True,
        },
    }


def _vision_table(size: MllmSize) -> dict[str, object]:
    vision = size.vision
    return {
        "depth": vision.depth,
        "hidden_size": vision.hidden,
        "intermediate_size": vision.feed_forward,
        "num_heads": vision.heads,
        "patch_size": vision.patch,
        "spatial_merge_size": vision.merge,
        "temporal_patch_size": 2,
        "out_hidden_size": size.text.hidden,
        "num_position_embeddings": vision.positions,
        "deepstack_visual_indexes": list(vision.deepstack),
    }
