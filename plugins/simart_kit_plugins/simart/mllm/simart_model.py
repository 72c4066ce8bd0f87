"""A language model with all that it must not be parted from."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from ..codec import TokenModel, nearest_codes
from ..default_model import LoadedModel
from ..vocabulary import Vocabulary
from .settings import Settings

if TYPE_CHECKING:
    from peft import PeftModel
    from transformers import PreTrainedTokenizerFast, Qwen3VLForConditionalGeneration


@dataclass(frozen=True, eq=False)
class SimartModel:
    """A Qwen3-VL that reads and writes voxel tokens.

    Attributes:
        model: the weights, or a base with an adapter.
        tokenizer: knows the voxel tokens; its eos token ends an answer.
        vocabulary: their ids.
        codec: the voxel model whose codes the tokens are.
        settings: how the model is asked, and the hashes that bind it to the rest.
        folder: where it was read; None for one that was just built.
    """

    model: Qwen3VLForConditionalGeneration | PeftModel
    tokenizer: PreTrainedTokenizerFast
    vocabulary: Vocabulary
    codec: LoadedModel
    settings: Settings
    folder: Path | None = None

    @property
    def encoder(self) -> TokenModel:
        """The codec as objects are encoded for this model: by trial, or with the nearest codes."""
        return nearest_codes(self.codec.model) if self.settings.candidates == 1 else self.codec.model
