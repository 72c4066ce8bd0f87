"""Tokenizers of language models: in Qwen's form, and with the voxel tokens."""

from __future__ import annotations

import unicodedata

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from simart_kit_plugins.simart.mllm.tokenizing import SPECIAL, extended, require_names, small_tokenizer
from simart_kit_plugins.simart.tokens import TokenGrid, VoxelTokens
from simart_kit_plugins.simart.vocabulary import Vocabulary

from simart_kit.errors import BadInputError

from .mllm_folders import TEXTS, shared_model

SMALL, LARGE = TokenGrid(), TokenGrid((16, 8, 8), 8192)


def test_digits_stand_by_themselves_even_where_numbers_repeat() -> None:
    tokenizer = small_tokenizer(["1200 1200 1200"] * 9, 400)
    assert tokenizer.tokenize("1200") == ["1", "2", "0", "0"]


def test_frequent_words_are_one_token() -> None:
    tokenizer = small_tokenizer(["the lid of the box"] * 9, 400)
    assert [tokenizer.decode(i) for i in tokenizer("the lid").input_ids] == ["the", " lid"]


def test_the_same_texts_in_any_order_give_the_same_tokenizer() -> None:
    one, other = small_tokenizer(TEXTS), small_tokenizer(tuple(reversed(TEXTS)))
    assert one.backend_tokenizer.to_str() == other.backend_tokenizer.to_str()


def test_it_has_every_byte_and_the_special_tokens_that_a_prompt_needs() -> None:
    tokenizer = small_tokenizer(())
    assert len(tokenizer) == 256 + len(SPECIAL)
    assert [len(tokenizer(name).input_ids) for name in SPECIAL] == [1] * len(SPECIAL)
    assert (tokenizer.eos_token, tokenizer.pad_token) == ("<|im_end|>", "<|endoftext|>")


@given(st.text(max_size=40))
@settings(max_examples=50, deadline=None)
def test_texts_come_back_as_they_were(text: str) -> None:
    tokenizer = shared_model().tokenizer
    normal = unicodedata.normalize("NFC", text)
    assert tokenizer.decode(tokenizer(normal).input_ids) == normal


def test_a_tokenizer_without_room_for_the_bytes_is_refused() -> None:
    with pytest.raises(BadInputError, match="262 tokens: the bytes and special tokens need 263"):
        small_tokenizer((), 262)


def test_turns_are_written_as_qwen_writes_them() -> None:
    messages = [
        {"role": "system", "content": "Be brief."},
        {"role": "user", "content": [{"type": "image"}, {"type": "text", "text": "Where is the lid?"}]},
    ]
    text = small_tokenizer(()).apply_chat_template(messages, add_generation_prompt=True, tokenize=False)
    assert text == (
        "<|im_start|>system\nBe brief.<|im_end|>\n"
        "<|im_start|>user\n<|vision_start|><|image_pad|><|vision_end|>Where is the lid?<|im_end|>\n"
        "<|im_start|>assistant\n"
    )


@pytest.mark.parametrize("grid", [SMALL, LARGE])
def test_voxel_tokens_follow_the_others_and_are_one_token_each(grid: TokenGrid) -> None:
    plain = small_tokenizer(())
    tokenizer, vocabulary = extended(plain, grid)
    assert vocabulary == Vocabulary(grid, 263)
    assert len(tokenizer) == 263 + 1 + grid.cells + grid.codebook
    tokens = VoxelTokens(grid, np.array([0, 43, grid.cells - 1]), np.array([1, 1930, grid.codebook - 1]))
    assert tokenizer(tokens.atoms()).input_ids == vocabulary.encode(tokens).tolist()


def test_the_tokenizer_that_is_extended_stays_as_it_was() -> None:
    plain = small_tokenizer(())
    extended(plain, SMALL)
    assert len(plain) == 263


def test_voxel_tokens_do_not_vanish_with_the_special_ones() -> None:
    tokenizer = shared_model().tokenizer
    ids = tokenizer("<|im_start|><voxel><xyz_43><mesh_1930><|im_end|>").input_ids
    assert tokenizer.decode(ids, skip_special_tokens=True) == "<voxel><xyz_43><mesh_1930>"


def test_extending_twice_adds_nothing() -> None:
    tokenizer, vocabulary = extended(small_tokenizer(()), SMALL)
    again, same = extended(tokenizer, SMALL)
    assert (len(again), same) == (len(tokenizer), vocabulary)


@pytest.mark.parametrize(("has", "asked"), [(SMALL, LARGE), (LARGE, SMALL)])
def test_voxel_tokens_of_another_grid_are_refused(has: TokenGrid, asked: TokenGrid) -> None:
    tokenizer, _ = extended(small_tokenizer(()), has)
    with pytest.raises(BadInputError, match="voxel tokens"):
        extended(tokenizer, asked)


def test_a_longer_codebook_than_the_vocabulary_knows_is_refused() -> None:
    tokenizer, vocabulary = extended(small_tokenizer(()), SMALL)
    tokenizer.add_tokens(["<mesh_4096>"])
    with pytest.raises(BadInputError, match="more voxel tokens"):
        require_names(tokenizer, vocabulary)
