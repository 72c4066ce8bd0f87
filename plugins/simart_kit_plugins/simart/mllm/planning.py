"""Memory that training takes on each GPU, by arithmetic: FSDP2 in mixed precision, or LoRA."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from .counts import VOXEL_TOKENS, parameter_counts
from .memory import GB
from .sizes import MllmSize, load_size

_LONG, _SHORT = 4, 2
"""Bytes of float32 and bfloat16."""
# AdamW keeps two means.
_ADAM = 2 * _LONG
# Logits as they are computed, in float32 for the loss, and their gradient.
_LOGIT = _SHORT + 2 * _LONG
_LORA_RANK = 16
_PLANS = (("tiny", 1, False), ("2b", 1, False), ("2b", 8, False), ("8b", 8, False), ("8b", 32, False))
_LORA_PLANS = (("8b", 1, True), ("8b", 8, True))


@dataclass(frozen=True, slots=True)
class TrainingMemory:
    """Bytes on each GPU.

    Attributes:
        weights: this GPU's share.
        gradients: likewise, of what is trained.
        optimizer: likewise.
        gathered: weights that are whole for a while: two layers, the embeddings and the head, with the
            gradients of these; 0 on one GPU, which has all of them anyway.
        activations: what is kept for the backward pass with checkpointing, one layer's inside, and logits.
    """

    weights: float
    gradients: float
    optimizer: float
    gathered: float
    activations: float

    @property
    def total(self) -> float:
        """All of them."""
        return self.weights + self.gradients + self.optimizer + self.gathered + self.activations


def training_memory(
    size: MllmSize, gpus: int, *, tokens: int = 8192, lora: bool = False, rank: int = _LORA_RANK
) -> TrainingMemory:
    """What a GPU holds when a model is trained on several.

    Args:
        size: of the model.
        gpus: that share it.
        tokens: of the sequences on a GPU at once.
        lora: train adapters and the voxel tokens' rows only; the rest stays in bfloat16.
        rank: of the adapters.
    """
    counts = parameter_counts(size)
    trained = lora_parameters(size, rank) if lora else counts.total
    frozen = counts.total if lora else 0
    layer = counts.layers / size.text.layers
    root = counts.embeddings + counts.head
    gathered = _SHORT * (2 * layer + (1 if lora else 2) * root) if gpus > 1 else 0.0
    return TrainingMemory(
        weights=(_LONG * trained + _SHORT * frozen) / gpus,
        gradients=_LONG * trained / gpus,
        optimizer=_ADAM * trained / gpus,
        gathered=gathered,
        activations=tokens * _token_bytes(size),
    )


def lora_parameters(size: MllmSize, rank: int = _LORA_RANK) -> int:
    """Numbers that LoRA trains: two thin matrices beside each large one of the text layers, and new rows."""
    text = size.text
    queries, keys = text.heads * text.head_dim, text.key_heads * text.head_dim
    attention = 2 * (text.hidden + queries) + 2 * (text.hidden + keys)
    adapters = rank * text.layers * (attention + 3 * (text.hidden + text.feed_forward))
    rows = VOXEL_TOKENS * text.hidden
    return adapters + rows * (1 if size.tie_embeddings else 2)


def memory_table(tokens: int = 8192) -> str:
    """Markdown table of the presets: gigabytes (10^9 bytes) on each GPU."""
    head = ("model", "trained", "GPUs", "weights", "gradients", "AdamW", "gathered", "activations", "total")
    rows = [_row(name, gpus, lora, tokens) for name, gpus, lora in (*_PLANS, *_LORA_PLANS)]
    ruler = ["---", "---"] + ["---:"] * (len(head) - 2)
    return "\n".join(_line(cells) for cells in (head, ruler, *rows)) + "\n"


def _row(name: str, gpus: int, lora: bool, tokens: int) -> list[str]:
    plan = training_memory(load_size(name), gpus, tokens=tokens, lora=lora)
    parts = (plan.weights, plan.gradients, plan.optimizer, plan.gathered, plan.activations, plan.total)
    return [name, "LoRA" if lora else "all", str(gpus), *(f"{value / GB:.1f}" for value in parts)]


def _line(cells: Iterable[str]) -> str:
    return f"| {' | '.join(cells)} |"


def _token_bytes(size: MllmSize) -> float:
    """Activations of a token: each layer's input, the inside of one layer, and its logits."""
    text, counts = size.text, parameter_counts(size)
    queries, keys = text.heads * text.head_dim, text.key_heads * text.head_dim
    # Two norms and two sums; queries, keys, values and what attention gives; four forms of the perceptron.
    inside = 4 * text.hidden + 3 * queries + 4 * keys + 4 * text.feed_forward
    logits = _LOGIT * counts.embeddings / text.hidden
    return _SHORT * (text.layers * text.hidden + inside) + logits
