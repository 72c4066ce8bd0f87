"""Measures decoding under the grammar with random weights: python -m tests.bench_grammar [SAMPLES].

A Qwen3-VL with random weights writes answers by sampling, which must all parse; then some of them are written
again without jumps, a token a pass. Last, answers like those of a trained model are written, which name
the prompt's voxels: random weights go through the same passes, but are told what to choose. Times are those
that the process computed, so that other work on the machine matters little.
"""

from __future__ import annotations

import sys
import time
from collections.abc import Sequence
from dataclasses import dataclass, replace
from types import SimpleNamespace
from typing import Any

import numpy as np
import torch
from simart_kit_plugins.simart.answer.parsing import parse_answer
from simart_kit_plugins.simart.answer.values import ObjectAnswer
from simart_kit_plugins.simart.grammar.decoding import Generated, generate
from simart_kit_plugins.simart.grammar.grammar import Grammar
from simart_kit_plugins.simart.tokens import VoxelTokens
from torch import Tensor, nn

from simart_kit.arrays import IntArray

from .grammar_models import GRID, grammar, random_answer, tiny_model

MAX_PARTS = 4


@dataclass(frozen=True)
class Trial:
    """What was measured.

    Attributes:
        tokens: of all answers.
        forced: tokens that the grammar left no choice about.
        different: answers that occur once.
        jumping: time with jumps [s].
        walking: time without [s]; 0 where that was not measured.
    """

    tokens: int
    forced: int
    different: int
    jumping: float
    walking: float = 0.0


def sample(pair: Grammar, seeds: Sequence[int], batch: int, *, walk: bool) -> Trial:
    """Sample an answer for each seed, and check that it is complete and parses.

    Args:
        pair: the grammar.
        seeds: of cells, prompts and sampling.
        batch: answers at a time.
        walk: whether they are written without jumps too, and must be the same.
    """
    made: list[Generated] = []
    jumping = walking = 0.0
    write(pair, seeds[:1], jump=True)  # the first time includes imports and making the model
    for first in range(0, len(seeds), batch):
        chosen = seeds[first : first + batch]
        start = time.process_time()
        jumped = write(pair, chosen, jump=True)
        jumping += time.process_time() - start
        if walk:
            start = time.process_time()
            walked = write(pair, chosen, jump=False)
            walking += time.process_time() - start
            assert [a.ids.tolist() for a in jumped] == [b.ids.tolist() for b in walked]
        made += jumped
    texts = [pair.text(one.ids) for one in made]
    for seed, one, text in zip(seeds, made, texts, strict=True):
        assert one.complete
        answer = parse_answer(text, GRID, allowed=cells_of(seed))
        assert 1 <= len(answer.parts) <= MAX_PARTS
    tokens, forced = sum(len(one.ids) for one in made), sum(int(one.forced.sum()) for one in made)
    return Trial(tokens, forced, len(set(texts)), jumping, walking)


def cells_of(seed: int) -> IntArray:
    """(C,) two to five cells of the input that a sample is asked about."""
    rng = np.random.default_rng(seed)
    return np.sort(rng.choice(GRID.cells, rng.integers(2, 6), replace=False))


def write(pair: Grammar, seeds: Sequence[int], *, jump: bool) -> list[Generated]:
    """One batch of answers to prompts of eight random tokens and the object's voxels."""
    prompts = []
    for seed in seeds:
        rng, cells = np.random.default_rng(seed), cells_of(seed)
        whole = VoxelTokens(GRID, cells, rng.integers(1, GRID.codebook, len(cells)))
        prompts.append([*rng.integers(10, 200, 8).tolist(), *pair.vocabulary.encode(whole).tolist()])
    machines = [pair.answer_machine(cells_of(seed)) for seed in seeds]
    model, inputs = tiny_model(pair), inputs_of(prompts)
    return generate(model, inputs, machines, temperature=1.0, seed=seeds, max_tokens=4096, jump=jump)


def inputs_of(prompts: list[list[int]]) -> dict[str, Tensor]:
    """Prompts, padded on the left."""
    longest = max(map(len, prompts))
    ids = torch.tensor([[0] * (longest - len(prompt)) + prompt for prompt in prompts])
    length = torch.tensor([len(prompt) for prompt in prompts])
    mask = torch.arange(longest) >= longest - length[:, None]
    return {"input_ids": ids, "attention_mask": mask.long()}


class Told(nn.Module):
    """A model that takes its time, and then prefers what it was told."""

    def __init__(self, model: nn.Module, prompt: int, ids: list[int]) -> None:
        """Tell it the ids of the answer to a prompt of so many tokens."""
        super().__init__()
        self.model, self.prompt, self.ids = model, prompt, torch.tensor([*ids, 0])

    def forward(self, position_ids: Tensor, **rest: Any) -> SimpleNamespace:
        """What the model says, with the next token of the answer above all."""
        logits = self.model(position_ids=position_ids, **rest).logits
        place = position_ids[0, :, -logits.shape[1] :] + 1 - self.prompt
        wanted = self.ids[place.clamp(0, len(self.ids) - 1)]
        return SimpleNamespace(logits=logits.scatter(2, wanted[:, :, None], 1e4))


def copy_voxels(pair: Grammar, seeds: Sequence[int]) -> Trial:
    """Write answers whose parts share out the prompt's 60 to 120 voxels, a tenth of them with a new code."""
    tokens = forced = 0
    jumping = walking = 0.0
    for seed in seeds:
        whole, answer = shared_out(seed)
        encoded = pair.encode_answer(answer, allowed=whole.index)
        prompt = [10, 11, *pair.vocabulary.encode(whole).tolist(), 12]
        told = Told(tiny_model(pair), len(prompt), encoded.ids.tolist())
        times = []
        for jump in (True, False):
            start = time.process_time()
            machine = pair.answer_machine(whole.index)
            (made,) = generate(told, inputs_of([prompt]), [machine], max_tokens=4096, jump=jump)
            times.append(time.process_time() - start)
            assert made.ids.tolist() == encoded.ids.tolist()
        jumping, walking = jumping + times[0], walking + times[1]
        tokens, forced = tokens + len(encoded.ids), forced + int(encoded.forced.sum())
    return Trial(tokens, forced, len(seeds), jumping, walking)


def shared_out(seed: int) -> tuple[VoxelTokens, ObjectAnswer]:
    """Voxels of an object, and an answer whose parts have them."""
    rng = np.random.default_rng(seed)
    cells = np.sort(rng.choice(GRID.cells, rng.integers(60, 121), replace=False))
    whole = VoxelTokens(GRID, cells, rng.integers(1, GRID.codebook, len(cells)))
    answer = random_answer(rng, cells, MAX_PARTS)
    cuts = np.sort(rng.choice(np.arange(1, len(cells)), len(answer.parts) - 1, replace=False))
    code = np.where(rng.random(len(cells)) < 0.1, rng.integers(1, GRID.codebook, len(cells)), whole.code)
    parts = tuple(
        replace(part, voxels=VoxelTokens(GRID, cells[place], code[place]))
        for part, place in zip(answer.parts, np.split(np.arange(len(cells)), cuts), strict=True)
    )
    return whole, replace(answer, parts=parts)


def main() -> None:
    """Print a table."""
    samples = int(sys.argv[1]) if len(sys.argv) > 1 else 10_000
    print("tokenizer  answers     batch  number  differ   tokens  forced  answers/s  times faster by jumps")
    for name, merged in (("bytes", False), ("trained", True)):
        pair = grammar(merged, MAX_PARTS)
        for batch, count in ((1, 20), (8, 80)):
            row(name, "sampled", batch, count, sample(pair, range(count), batch, walk=True))
        row(name, "of voxels", 1, 10, copy_voxels(pair, range(10)))
    trial = sample(grammar(True, MAX_PARTS), range(samples), 32, walk=False)
    row("trained", "sampled", 32, samples, trial)


def row(tokenizer: str, answers: str, batch: int, number: int, trial: Trial) -> None:
    """Print one."""
    faster = f"{trial.walking / trial.jumping:.2f}" if trial.walking else ""
    print(
        f"{tokenizer:9}  {answers:10}  {batch:5}  {number:6}  {trial.different:6}  {trial.tokens:7}  "
        f"{trial.forced / trial.tokens:6.1%}  {number / trial.jumping:9.1f}  {faster}",
        flush=True,
    )


if __name__ == "__main__":
    main()
