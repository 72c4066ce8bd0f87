"""Prompts and answers to the model's tensors: our own processor, which needs no torchvision.

A prompt becomes the chat form of Qwen3-VL:

    <|im_start|>system SYSTEM<|im_end|> <|im_start|>user <|vision_start|><|image_pad|>...<|vision_end|>
    <voxel><xyz_43><mesh_1930>...QUESTION<|im_end|> <|im_start|>assistant

as its chat template gives for a user's turn of a picture and a text, the voxels' names and the question. A
prompt without a system text or a picture has no such piece. The voxels are put in as ids and never go through
text.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Protocol

import numpy as np

from simart_kit.arrays import BoolArray, IntArray
from simart_kit.errors import BadInputError

from ..tokens import VOXEL_NAME
from ..vocabulary import Vocabulary
from .pixels import Patches, PatchGrid, patches
from .sequences import IGNORED, TokenSequence, model_inputs, model_targets
from .values import Prompt

if TYPE_CHECKING:
    from torch import Tensor

START, END = "<|im_start|>", "<|im_end|>"
VISION_START, VISION_END, IMAGE = "<|vision_start|>", "<|vision_end|>", "<|image_pad|>"
_SPECIAL = (START, END, VISION_START, VISION_END, IMAGE)


class Tokenizer(Protocol):
    """What is used of a tokenizer of transformers."""

    @property
    def pad_token_id(self) -> Any:
        """Id that fills rows up, or None."""

    def encode(self, text: str, *, add_special_tokens: bool) -> Any:
        """Ids of a text."""

    def get_added_vocab(self) -> dict[str, int]:
        """Ids of the tokens that are no pieces of words, by name."""


class Answer(Protocol):
    """What is used of an encoded answer: ids that end with the end of the turn."""

    @property
    def ids(self) -> IntArray:
        """(T,) token ids."""

    @property
    def forced(self) -> BoolArray:
        """(T,) tokens that the grammar leaves no choice about."""


class Bundle(Protocol):
    """What is used of a loaded model."""

    @property
    def model(self) -> Any:
        """A Qwen3-VL model, with `config.vision_config`."""

    @property
    def tokenizer(self) -> Any:
        """Its tokenizer, with the voxel tokens."""

    @property
    def vocabulary(self) -> Vocabulary:
        """Ids of the voxel tokens."""


@dataclass(frozen=True, eq=False)
class Processor:
    """Makes batches of prompts, and of prompts with answers.

    Attributes:
        tokenizer: of the Qwen family, with the voxel tokens of `vocabulary`.
        vocabulary: ids of the voxel tokens.
        cut: how the vision tower cuts pictures up.

    Raises:
        BadInputError: the tokenizer lacks a special token of Qwen3-VL, or its voxel tokens have other ids.
    """

    tokenizer: Tokenizer
    vocabulary: Vocabulary
    cut: PatchGrid

    def __post_init__(self) -> None:
        """Check that model, tokenizer and vocabulary go together, which no later error would tell."""
        known = self.tokenizer.get_added_vocab()
        for name in _SPECIAL:
            if name not in known:
                raise BadInputError(f"the tokenizer has no token {name}: it must be one of Qwen3-VL")
        if known.get(VOXEL_NAME) != self.vocabulary.first_id:
            raise BadInputError(
                f"the tokenizer's id of {VOXEL_NAME} is not {self.vocabulary.first_id}: "
                "tokenizer and voxel vocabulary are of different models"
            )

    @classmethod
    def of(cls, bundle: Bundle) -> Processor:
        """The processor of a loaded model; raises BadInputError as the class does."""
        vision = bundle.model.config.vision_config
        cut = PatchGrid(vision.patch_size, vision.spatial_merge_size, vision.temporal_patch_size)
        return cls(bundle.tokenizer, bundle.vocabulary, cut)

    @property
    def image(self) -> int:
        """Id of <|image_pad|>, which stands for a visual token."""
        return self._encoded(IMAGE)[0]

    @property
    def pad(self) -> int:
        """Id that fills rows up; the attention mask hides it."""
        found = self.tokenizer.pad_token_id
        return self._encoded(END)[0] if found is None else int(found)

    def ids(self, prompt: Prompt) -> list[int]:
        """Ids of a prompt, up to where the answer begins.

        Raises:
            BadInputError: its voxel tokens are of another grid or codebook.
        """
        return self._ids(prompt, self._patches(prompt))

    def sequence(
        self, prompt: Prompt, answer: Answer | None = None, *, forced_weight: float = 1.0
    ) -> TokenSequence:
        """A prompt, and its answer if there is one, without padding; see `inputs` and `training`."""
        picture = self._patches(prompt)
        head = np.array(self._ids(prompt, picture), dtype=np.int64)
        weights = np.zeros(len(head), dtype=np.float32)
        if answer is None:
            return TokenSequence(head, np.full_like(head, IGNORED), weights, picture)
        ids = np.concatenate([head, answer.ids]).astype(np.int64)
        weights = np.concatenate([weights, np.where(answer.forced, forced_weight, 1.0)]).astype(np.float32)
        return TokenSequence(ids, np.where(weights > 0, ids, IGNORED), weights, picture)

    def inputs(self, prompts: Sequence[Prompt]) -> dict[str, Tensor]:
        """A batch to generate from, filled up on the left; keys as `sequences.model_inputs` gives them.

        Raises:
            BadInputError: a prompt's voxel tokens are of another grid or codebook.
        """
        rows = [self.sequence(prompt) for prompt in prompts]
        return model_inputs(rows, self.pad, self.image, "left")

    def training(
        self, prompts: Sequence[Prompt], answers: Sequence[Answer], *, forced_weight: float = 1.0
    ) -> dict[str, Tensor]:
        """A batch to train on, filled up on the right: what `inputs` has, `labels` and `loss_weights`.

        Args:
            prompts: B of them.
            answers: theirs.
            forced_weight: share in the loss of tokens that the grammar forces; with 0 their labels are
                `IGNORED` too, so that the model's own loss leaves them out. Other shares are for a loss that
                reads `loss_weights`; the model itself does not know that key.

        Raises:
            BadInputError: a prompt's voxel tokens are of another grid or codebook.
        """
        pairs = zip(prompts, answers, strict=True)
        rows = [self.sequence(*pair, forced_weight=forced_weight) for pair in pairs]
        return model_inputs(rows, self.pad, self.image, "right") | model_targets(rows, "right")

    def _patches(self, prompt: Prompt) -> Patches | None:
        return None if prompt.picture is None else patches(prompt.picture, self.cut)

    def _ids(self, prompt: Prompt, picture: Patches | None) -> list[int]:
        system = f"{START}system\n{prompt.system}{END}\n" if prompt.system else ""
        ids = self._encoded(f"{system}{START}user\n")
        if picture is not None:
            ids += [*self._encoded(VISION_START), *[self.image] * picture.tokens, *self._encoded(VISION_END)]
        ids += self.vocabulary.encode(prompt.voxels).tolist()
        return ids + self._encoded(f"{prompt.question}{END}\n{START}assistant\n")

    def _encoded(self, text: str) -> list[int]:
        return list(self.tokenizer.encode(text, add_special_tokens=False))
