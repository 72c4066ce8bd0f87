from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache

import numpy as np
import pytest
import torch
from simart_kit_plugins.simart.answer.parsing import parse_answer
from simart_kit_plugins.simart.grammar.decoding import Generated, generate
from simart_kit_plugins.simart.grammar.processor import GrammarProcessor
from simart_kit_plugins.simart.grammar.stream import Stream
from simart_kit_plugins.simart.tokens import VoxelTokens
from torch import Tensor
from transformers import LogitsProcessorList

from simart_kit.errors import BadInputError

from .grammar_models import GRID, grammar, tiny_model

CELLS = (np.array([3, 9]), np.array([0, 5, 6, 100]), np.array([511]))
PAIR = grammar(max_parts=2)
PROMPTS = tuple(
    (*text, *PAIR.vocabulary.encode(VoxelTokens(GRID, cells, cells % 7 + 1)).tolist())
    for text, cells in zip(((5, 6, 7, 8, 9, 10, 11), (12, 13), (40, 41, 42, 43)), CELLS, strict=True)
)
IMAGE = 4


def padded(prompts: Sequence[Sequence[int]]) -> dict[str, Tensor]:
    """Prompts as a batch, padded on the left."""
    longest = max(map(len, prompts))
    ids = [[0] * (longest - len(prompt)) + list(prompt) for prompt in prompts]
    mask = [[0] * (longest - len(prompt)) + [1] * len(prompt) for prompt in prompts]
    return {"input_ids": torch.tensor(ids), "attention_mask": torch.tensor(mask)}


def pictured(prompts: Sequence[Sequence[int]]) -> dict[str, Tensor]:
    """The same, each with a picture of 64 x 96 pixels, six visual tokens, at its beginning."""
    inputs = padded([(*[IMAGE] * 6, *prompt) for prompt in prompts])
    pixels = torch.randn(24 * len(prompts), 3 * 2 * 16 * 16, generator=torch.Generator().manual_seed(0))
    kinds = (inputs["input_ids"] == IMAGE).long()
    grid = torch.tensor([[1, 4, 6]] * len(prompts))
    return inputs | {"pixel_values": pixels, "image_grid_thw": grid, "mm_token_type_ids": kinds}


@lru_cache
def answers(
    rows: tuple[int, ...], *, temperature: float = 0.0, seed: int = 0, jump: bool = True, limit: int = 4000
) -> list[Generated]:
    inputs = padded([PROMPTS[row] for row in rows])
    machines = [PAIR.answer_machine(CELLS[row]) for row in rows]
    return generate(
        tiny_model(PAIR), inputs, machines, temperature=temperature, seed=seed, max_tokens=limit, jump=jump
    )


@pytest.mark.parametrize("temperature", [0.0, 1.0])
def test_jumps_change_nothing_but_the_passes(temperature: float) -> None:
    jumped = answers((0, 1, 2), temperature=temperature)
    walked = answers((0, 1, 2), temperature=temperature, jump=False)
    for one, other in zip(jumped, walked, strict=True):
        assert one.complete
        assert one.ids.tolist() == other.ids.tolist()
        assert one.forced.tolist() == other.forced.tolist()
        np.testing.assert_allclose(one.probability, other.probability, rtol=1e-3)


@pytest.mark.parametrize("temperature", [0.0, 1.0])
def test_an_answer_does_not_depend_on_its_batch(temperature: float) -> None:
    together = answers((0, 1, 2), temperature=temperature, seed=3)
    alone = [answers((row,), temperature=temperature, seed=3)[0] for row in range(3)]
    for one, other in zip(together, alone, strict=True):
        assert one.ids.tolist() == other.ids.tolist()
        np.testing.assert_allclose(one.probability, other.probability, rtol=1e-3)


def test_sampled_answers_parse_and_differ() -> None:
    texts = set()
    for seed in range(4):
        for row, made in enumerate(answers((0, 1, 2), temperature=1.5, seed=seed)):
            assert made.complete
            texts.add(PAIR.text(made.ids))
            assert len(parse_answer(PAIR.text(made.ids), GRID, allowed=CELLS[row]).parts) <= 2
            assert (made.probability[made.forced] == 1).all()
            assert (made.probability[~made.forced] < 1).all()
    assert len(texts) == 12


def test_the_limit_cuts_an_answer() -> None:
    whole = answers((0,))[0]
    cut = answers((0,), limit=25)[0]
    assert not cut.complete
    assert cut.ids.tolist() == whole.ids[:25].tolist()
    assert answers((0,), limit=len(whole.ids))[0].complete


def test_the_processor_of_transformers_writes_the_same() -> None:
    inputs = padded(PROMPTS)
    processor = GrammarProcessor([PAIR.answer_machine(cells) for cells in CELLS])
    written = tiny_model(PAIR).generate(
        **inputs, do_sample=False, max_new_tokens=4000, logits_processor=LogitsProcessorList([processor])
    )
    for row, made in zip(
        written[:, inputs["input_ids"].shape[1] :].tolist(), answers((0, 1, 2)), strict=True
    ):
        assert row[: len(made.ids)] == made.ids.tolist()
        assert not any(row[len(made.ids) :])


@pytest.mark.parametrize("picture", [False, True])
def test_the_memory_gives_the_logits_of_a_pass_over_everything(picture: bool) -> None:
    """Runs of different length, tokens taken back, members that leave, holes that are squeezed out."""
    make, model = (pictured if picture else padded), tiny_model(PAIR)
    rng = np.random.default_rng(1)
    with torch.inference_mode():
        stream = Stream(model)
        logits, texts, rows = stream.read(make(PROMPTS)), [list(prompt) for prompt in PROMPTS], [0, 1, 2]
        extra = [0, 0, 0]
        for turn in range(12):
            for place, row in enumerate(rows):
                whole = make([texts[row]])
                if picture:
                    whole["pixel_values"] = make(PROMPTS)["pixel_values"][24 * row : 24 * row + 24]
                expected = model(**whole, use_cache=False).logits[0, -1].numpy()
                np.testing.assert_allclose(logits[place, -1 - extra[place]], expected, atol=2e-4)
            stream.take_back(extra)
            if turn == 8:
                stream.keep([0, 2])
                rows = [0, 2]
            stream.keep(range(len(rows)))
            # One member adds many tokens while the others add one, and one of them two too many.
            lengths = [9 if place == turn % len(rows) else 1 for place in range(len(rows))]
            extra = [2 if place == (turn + 1) % len(rows) else 0 for place in range(len(rows))]
            runs = [rng.integers(20, 200, length).tolist() for length in lengths]
            for row, run in zip(rows, runs, strict=True):
                texts[row] += run
            logits = stream.add([run + [7] * more for run, more in zip(runs, extra, strict=True)], 3)
        assert stream.columns < max(map(len, texts)) * 2


def test_numbers_of_prompts_and_machines_must_agree() -> None:
    with pytest.raises(BadInputError, match="3 prompts, 1 machines and 1 seeds"):
        generate(tiny_model(PAIR), padded(PROMPTS), [PAIR.answer_machine(CELLS[0])], max_tokens=9)
    with pytest.raises(BadInputError, match=r"temperature -1.0 must be 0 or above"):
        answers((0,), temperature=-1.0)
