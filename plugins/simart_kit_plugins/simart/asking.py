"""A model that was loaded is asked: for an object's parts and joints, or for one part by its description."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache
from typing import TYPE_CHECKING, Generic, TypeVar

from simart_kit.errors import BadInputError

from .answer.parsing import parse_answer, parse_grounding
from .answer.values import ObjectAnswer
from .prompt.values import Prompt
from .tokens import VoxelTokens

if TYPE_CHECKING:
    from .grammar.decoding import Generated
    from .grammar.grammar import Grammar
    from .grammar.machine import Machine
    from .mllm.simart_model import SimartModel

T = TypeVar("T")


@dataclass(frozen=True, slots=True)
class Sampling:
    """How an answer is chosen.

    Attributes:
        max_tokens: longest answer.
        max_parts: most parts in it.
        temperature: 0 takes the likeliest token each time.
        seed: of the choices.
    """

    max_tokens: int = 4096
    max_parts: int = 16
    temperature: float = 0.0
    seed: int = 0


@dataclass(frozen=True, slots=True)
class Word:
    """A token of an answer.

    Attributes:
        text: of it.
        probability: that the model gave it, 0..1.
        forced: whether the grammar left no choice, so that the model was not asked.
    """

    text: str
    probability: float
    forced: bool


@dataclass(frozen=True, slots=True)
class Said(Generic[T]):
    """An answer.

    Attributes:
        text: as the model gave it.
        value: what it means.
        words: its tokens; none of a model on a server.
        source: who gave it, for people.
        remarks: on how it came about.
    """

    text: str
    value: T
    words: tuple[Word, ...]
    source: str
    remarks: tuple[str, ...] = ()


def ask_answer(bundle: SimartModel, prompt: Prompt, sampling: Sampling) -> Said[ObjectAnswer]:
    """An object's parts and joints; the grammar lets through what can be read, and nothing else.

    Raises:
        BadInputError: the answer does not end within `max_tokens`, the prompt is of another grid, or memory
            runs out.
    """
    grid, cells = prompt.voxels.grid, prompt.voxels.index
    grammar = _grammar(bundle, sampling.max_parts)
    machine = grammar.answer_machine(cells)
    return _asked(
        bundle, grammar, prompt, machine, sampling, lambda text: parse_answer(text, grid, allowed=cells)
    )


def ask_part(bundle: SimartModel, prompt: Prompt, sampling: Sampling) -> Said[VoxelTokens]:
    """The voxels of the part that a grounding question means; errors are those of `ask_answer`."""
    grid, cells = prompt.voxels.grid, prompt.voxels.index
    grammar = _grammar(bundle, sampling.max_parts)
    machine = grammar.grounding_machine(cells)
    return _asked(bundle, grammar, prompt, machine, sampling, lambda text: parse_grounding(text, grid, cells))


def _asked(
    bundle: SimartModel,
    grammar: Grammar,
    prompt: Prompt,
    machine: Machine,
    sampling: Sampling,
    read: Callable[[str], T],
) -> Said[T]:
    from .grammar.decoding import generate
    from .mllm.memory import memory_told
    from .prompt.processor import Processor

    with memory_told("asking the model"):
        device = bundle.model.device
        inputs = {key: value.to(device) for key, value in Processor.of(bundle).inputs([prompt]).items()}
        (made,) = generate(
            bundle.model,
            inputs,
            [machine],
            temperature=sampling.temperature,
            seed=sampling.seed,
            max_tokens=sampling.max_tokens,
        )
    if not made.complete:
        raise BadInputError(
            f"the answer does not end within max_tokens, {sampling.max_tokens}: "
            "raise segmenter.options.max_tokens"
        )
    text = grammar.text(made.ids)
    name = "a model that is not saved" if bundle.folder is None else f"model {bundle.folder.name}"
    return Said(text, read(text), _words(grammar, made), name)


@lru_cache(maxsize=4)
def _grammar(bundle: SimartModel, max_parts: int) -> Grammar:
    """Kept, because it reads all of a tokenizer's vocabulary."""
    from .grammar.grammar import Grammar

    return Grammar(bundle.tokenizer, bundle.vocabulary, max_parts=max_parts)


def _words(grammar: Grammar, made: Generated) -> tuple[Word, ...]:
    texts = [grammar.text([number]) for number in made.ids.tolist()]
    rows = zip(texts, made.probability.tolist(), made.forced.tolist(), strict=True)
    return tuple(Word(*row) for row in rows)
