"""A Qwen3-VL on this machine, through transformers; nothing watches over its answer but the reader."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from typing import TYPE_CHECKING, Any

import numpy as np

from simart_kit.extras import require_extra

from ..simart.mllm.weights import Choices
from ..simart.prompt.pixels import Patches, PatchGrid, patches
from .values import Completion, Correction, Question
from .wording import correction_text, said_before, system_text

if TYPE_CHECKING:
    from torch import Tensor

    from ..simart.mllm.weights import Plain

_START, _END = "<|im_start|>", "<|im_end|>"
_VISION_START, _VISION_END, _IMAGE = "<|vision_start|>", "<|vision_end|>", "<|image_pad|>"


@dataclass(frozen=True, slots=True)
class Local:
    """A model that is read when it is first asked.

    Attributes:
        model: folder, or hub id such as "Qwen/Qwen3-VL-8B-Instruct".
        choices: where it goes.
        max_tokens: longest answer.
        temperature: 0 takes the likeliest token each time.
        seed: of the sampling.
    """

    model: str
    choices: Choices
    max_tokens: int
    temperature: float
    seed: int

    @property
    def who(self) -> str:
        return f"model {self.model}"

    def say(self, question: Question, correction: Correction | None) -> Completion:
        """What the model says.

        Raises:
            BadInputError: the extra is not installed, the model cannot be had, or memory does not do.
        """
        from ..simart.mllm.memory import memory_told

        require_extra("mllm", "backend transformers")
        plain = _loaded(self.model, self.choices)
        with memory_told("asking the model"):
            inputs = _inputs(plain, question, correction)
            ids = self._generated(plain, inputs)
        end = plain.tokenizer.convert_tokens_to_ids(_END)
        text = plain.tokenizer.decode(ids, skip_special_tokens=True)
        return Completion(text, end in ids, inputs["input_ids"].shape[1], len(ids))

    def _generated(self, plain: Plain, inputs: dict[str, Tensor]) -> list[int]:
        """Ids of the answer."""
        import torch

        from ..simart.mllm.extra import quiet

        sampled = {"do_sample": True, "temperature": self.temperature}
        # A model's own settings for sampling would be warned of where there is none.
        likeliest = {"do_sample": False, "temperature": None, "top_p": None, "top_k": None}
        with torch.inference_mode(), torch.random.fork_rng(), quiet():
            torch.manual_seed(self.seed)
            made: Any = plain.model.generate(
                **inputs,
                max_new_tokens=self.max_tokens,
                eos_token_id=plain.tokenizer.convert_tokens_to_ids(_END),
                pad_token_id=plain.tokenizer.convert_tokens_to_ids(_END),
                **(sampled if self.temperature > 0 else likeliest),
            )
        return [int(number) for number in made[0, inputs["input_ids"].shape[1] :]]


@lru_cache(maxsize=1)
def _loaded(model: str, choices: Choices) -> Plain:
    """Kept, because reading it takes longer than an answer."""
    from ..simart.mllm.weights import load_plain

    return load_plain(model, choices)


def _inputs(plain: Plain, question: Question, correction: Correction | None) -> dict[str, Tensor]:
    """Tensors of one prompt, on the model's device."""
    import torch

    vision = plain.model.config.vision_config
    cut = PatchGrid(vision.patch_size, vision.spatial_merge_size, vision.temporal_patch_size)
    seen = [patches(picture, cut) for picture in question.pictures]
    encoded = plain.tokenizer.encode(_prompt(question, correction, seen), add_special_tokens=False)
    ids = torch.tensor([encoded])
    image = plain.tokenizer.convert_tokens_to_ids(_IMAGE)
    inputs = {
        "input_ids": ids,
        "attention_mask": torch.ones_like(ids),
        "mm_token_type_ids": (ids == image).long(),
    }
    if seen:
        inputs["pixel_values"] = torch.from_numpy(np.concatenate([one.values for one in seen]))
        inputs["image_grid_thw"] = torch.tensor([one.grid for one in seen])
    return {name: value.to(plain.model.device) for name, value in inputs.items()}


def _prompt(question: Question, correction: Correction | None, seen: list[Patches]) -> str:
    """The chat form of Qwen3-VL, up to where the answer begins."""
    shown = "".join(f"{_VISION_START}{_IMAGE * one.tokens}{_VISION_END}" for one in seen)
    turns = [("system", _plain(system_text(question))), ("user", shown + _plain(question.text))]
    if correction:
        said = _plain(said_before(correction))
        turns += [("assistant", said), ("user", _plain(correction_text(correction)))]
    chat = "".join(f"{_START}{role}\n{text}{_END}\n" for role, text in turns)
    return f"{chat}{_START}assistant\n"


def _plain(text: str) -> str:
    """A text that cannot end its turn or pass for a picture, whatever names an object's parts have."""
    return text.replace("<|", "< |")
