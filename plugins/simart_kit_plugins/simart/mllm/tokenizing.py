"""Tokenizers: Qwen's with the voxel tokens added, and a small one that is trained on given texts."""

from __future__ import annotations

import copy
from collections.abc import Iterable
from typing import TYPE_CHECKING

from simart_kit.errors import BadInputError
from simart_kit.extras import require_extra

from ..tokens import TokenGrid
from ..vocabulary import Vocabulary

if TYPE_CHECKING:
    from transformers import PreTrainedTokenizerFast

# Qwen's special tokens that a prompt needs, in the order of their ids there.
END_OF_TEXT, TURN_START, TURN_END = "<|endoftext|>", "<|im_start|>", "<|im_end|>"
VISION_START, VISION_END = "<|vision_start|>", "<|vision_end|>"
IMAGE, VIDEO = "<|image_pad|>", "<|video_pad|>"
SPECIAL = (END_OF_TEXT, TURN_START, TURN_END, VISION_START, VISION_END, IMAGE, VIDEO)

# Turns as Qwen writes them; a picture is one placeholder, which a processor repeats for each visual token.
CHAT_TEMPLATE = (
    "{%- for message in messages -%}"
    "{{ '<|im_start|>' + message.role + '\\n' }}"
    "{%- if message.content is string -%}{{ message.content }}"
    "{%- else -%}{%- for part in message.content -%}"
    "{%- if part.type == 'image' -%}{{ '<|vision_start|><|image_pad|><|vision_end|>' }}"
    "{%- else -%}{{ part.text }}{%- endif -%}"
    "{%- endfor -%}{%- endif -%}"
    "{{ '<|im_end|>\\n' }}"
    "{%- endfor -%}"
    "{%- if add_generation_prompt -%}{{ '<|im_start|>assistant\\n' }}{%- endif -%}"
)


def extended(
    tokenizer: PreTrainedTokenizerFast, grid: TokenGrid
) -> tuple[PreTrainedTokenizerFast, Vocabulary]:
    """A copy of a tokenizer that also knows the voxel tokens, and where their ids are.

    They are added as ordinary tokens: special ones would vanish from decoded text. A tokenizer that has them
    already comes back as it is.

    Raises:
        BadInputError: the tokenizer has voxel tokens of another grid or codebook.
    """
    known = tokenizer.get_added_vocab()
    if "<voxel>" in known:
        vocabulary = Vocabulary(grid, known["<voxel>"])
        require_names(tokenizer, vocabulary)
        return tokenizer, vocabulary
    vocabulary = Vocabulary(grid, len(tokenizer))
    copied = copy.deepcopy(tokenizer)
    from tokenizers import AddedToken

    copied.add_tokens([AddedToken(name, normalized=False, special=False) for name in vocabulary.names])
    require_names(copied, vocabulary)
    return copied, vocabulary


def require_names(tokenizer: PreTrainedTokenizerFast, vocabulary: Vocabulary) -> None:
    """Raise BadInputError unless a tokenizer gives the voxel tokens, and no others, the vocabulary's ids."""
    known = tokenizer.get_vocab()
    for number, name in enumerate(vocabulary.names, vocabulary.first_id):
        if known.get(name) != number:
            raise BadInputError(
                f"the tokenizer gives '{name}' the id {known.get(name)}, not {number}: its voxel tokens are "
                f"of another grid or codebook than {vocabulary.grid}"
            )
    if f"<mesh_{vocabulary.grid.codebook}>" in known or f"<xyz_{vocabulary.grid.cells}>" in known:
        raise BadInputError(f"the tokenizer has more voxel tokens than {vocabulary.grid} has")


def small_tokenizer(texts: Iterable[str], size: int = 2048) -> PreTrainedTokenizerFast:
    """A byte-level tokenizer in Qwen's form, trained on texts; the same texts give the same one.

    Digits stand by themselves, as Qwen's do, and every text in NFC comes back as it was. It ends turns with
    <|im_end|> and pads with <|endoftext|>.

    Args:
        texts: what it shall write in few tokens; none gives one token for each byte.
        size: most tokens, at least 263: the 256 bytes and the special ones.

    Raises:
        BadInputError: the size is too small, or the extra is not installed.
    """
    require_extra("mllm", "a tokenizer")
    least = 256 + len(SPECIAL)
    if size < least:
        raise BadInputError(f"a tokenizer of {size} tokens: the bytes and special tokens need {least}")
    from transformers import Qwen2Tokenizer

    vocabulary, merges = _trained(texts, size - len(SPECIAL))
    tokenizer: PreTrainedTokenizerFast = Qwen2Tokenizer(
        vocab=vocabulary,
        merges=merges,
        eos_token=TURN_END,
        pad_token=END_OF_TEXT,
        unk_token=None,
        extra_special_tokens=list(SPECIAL[1:2] + SPECIAL[3:]),
        model_max_length=262144,
    )
    tokenizer.chat_template = CHAT_TEMPLATE
    return tokenizer


def _trained(texts: Iterable[str], size: int) -> tuple[dict[str, int], list[tuple[str, str]]]:
    """Tokens with their ids, at most `size`, and the pairs that are merged, in order."""
    import json

    from tokenizers import Tokenizer, models, normalizers, pre_tokenizers, trainers
    from transformers import Qwen2Tokenizer

    # Qwen's own division into words comes with an empty tokenizer of its class.
    tokenizer = Tokenizer(models.BPE())
    tokenizer.normalizer = normalizers.NFC()
    tokenizer.pre_tokenizer = Qwen2Tokenizer().backend_tokenizer.pre_tokenizer
    trainer = trainers.BpeTrainer(
        vocab_size=size,
        initial_alphabet=sorted(pre_tokenizers.ByteLevel.alphabet()),
        show_progress=False,
    )
    tokenizer.train_from_iterator(sorted(texts), trainer)
    model = json.loads(tokenizer.to_str())["model"]
    return dict(model["vocab"]), [(a, b) for a, b in model["merges"]]
