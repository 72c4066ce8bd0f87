"""What of a model is trained: all of it, or low-rank adapters."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, TypeAlias

from ..mllm.extra import quiet
from ..vocabulary import Vocabulary
from .plan import FinetunePlan, Lora

if TYPE_CHECKING:
    from peft import PeftModel
    from transformers import Qwen3VLForConditionalGeneration

Model: TypeAlias = "Qwen3VLForConditionalGeneration | PeftModel"


def trainable(model: Model, vocabulary: Vocabulary, plan: FinetunePlan) -> Model:
    """The model with what the plan trains, and nothing else, open to gradients."""
    model.requires_grad_(True)
    if plan.lora is not None:
        return with_adapters(model, vocabulary, plan.lora, plan.seed)
    if not plan.train_vision:
        model.model.visual.requires_grad_(False)
    return model


def with_adapters(model: Model, vocabulary: Vocabulary, lora: Lora, seed: int) -> Model:
    """The model with adapters on its language layers; of its embeddings, the voxel tokens' rows are trained.

    To train the embeddings as a whole would cost 1.3 billion parameters of the 8B model, the rows cost some
    70 million.
    """
    import torch
    from peft import LoraConfig, get_peft_model

    rows = list(range(vocabulary.first_id, vocabulary.first_id + len(vocabulary)))
    tied = model.config.tie_word_embeddings
    tables = {"embed_tokens": rows} if tied else {"embed_tokens": rows, "lm_head": rows}
    config = LoraConfig(
        r=lora.rank,
        lora_alpha=lora.alpha,
        lora_dropout=lora.dropout,
        target_modules=lora.targets,
        trainable_token_indices=tables,
    )
    with quiet(), torch.random.fork_rng(devices=[]):
        torch.default_generator.manual_seed(seed)
        return get_peft_model(model, config)


def plain_model(model: Model) -> Any:
    """The Qwen3-VL itself, which holds the adapters if there are any."""
    return model.get_base_model() if hasattr(model, "peft_config") else model
