"""Held-out records as questions to a model, decoded under the grammar, and to guesses that need no model."""

from __future__ import annotations

import zlib
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ..answer.parsing import parse_answer, parse_grounding
from ..answer.values import ObjectAnswer
from ..dataset.record import Pair, Record
from ..grammar.decoding import generate
from ..grammar.grammar import Grammar
from ..mllm.simart_model import SimartModel
from ..prompt.picture import from_png
from ..prompt.processor import Processor
from ..prompt.texts import system_prompt
from ..prompt.values import Prompt
from .baselines import borrowed, guessed_cells, still
from .scores import Score, cell_iou, score

if TYPE_CHECKING:
    from torch import Tensor

_BATCH = 8
# What an answer needs besides three tokens a cell: captions of a part, and of the object.
_PART_TOKENS, _OBJECT_TOKENS = 160, 64
# Cells of the input that an answer may name, all parts together, since parts share cells.
_CELLS_SHARED = 2


@dataclass(frozen=True)
class Question:
    """A record and one of its questions."""

    record: Record
    pair: Pair


def evaluate(bundle: SimartModel, records: Sequence[Record]) -> Score:
    """Ask a model about records: for the whole object, and for one of its parts.

    Args:
        bundle: in evaluation mode; it is asked as its settings say.
        records: that it was not trained on.
    """
    whole, parts = questions(records)
    answers = list(_answers(bundle, whole))
    grounding = list(_grounded(bundle, parts))
    return score([question.record.answer for question in whole], answers, grounding)


def baselines(records: Sequence[Record], others: Sequence[Record], seed: int = 0) -> dict[str, Score]:
    """Scores of guesses, by name: nothing moves, and answers to other objects with cells at random.

    Args:
        records: that are asked about.
        others: whose answers are borrowed, such as some of the training.
        seed: of the guesses.
    """
    rng = np.random.default_rng(seed)
    whole, parts = questions(records)
    true = [question.record.answer for question in whole]
    guessed = [cell_iou(guessed_cells(q.record, q.pair, rng), _part_cells(q)) for q in parts]
    found = {"nothing moves": score(true, [still(q.record) for q in whole])}
    if others:
        taken = [borrowed(q.record, others, rng) for q in whole]
        found["borrowed at random"] = score(true, taken, guessed)
    return found


def questions(records: Sequence[Record]) -> tuple[list[Question], list[Question]]:
    """The question for each object as a whole, and one for a part of each that has any."""
    whole, parts = [], []
    for record in records:
        by_task = {task: [p for p in record.pairs if p.task == task] for task in ("urdf", "grounding")}
        if by_task["urdf"]:
            whole.append(Question(record, by_task["urdf"][0]))
        if asked := by_task["grounding"]:
            parts.append(Question(record, asked[zlib.crc32(record.key.encode()) % len(asked)]))
    return whole, parts


def _answers(bundle: SimartModel, asked: Sequence[Question]) -> Iterator[ObjectAnswer | None]:
    """The model's answers; None for one that was not completed."""
    grammar = Grammar(bundle.tokenizer, bundle.vocabulary)
    for group in _groups(asked):
        machines = [grammar.answer_machine(question.record.voxels.index) for question in group]
        longest = max(_longest(question, grammar.max_parts) for question in group)
        written = generate(bundle.model, _inputs(bundle, group), machines, max_tokens=longest)
        for question, given in zip(group, written, strict=True):
            cells = question.record.voxels.index
            text = grammar.text(given.ids)
            grid = bundle.vocabulary.grid
            yield parse_answer(text, grid, allowed=cells) if given.complete else None


def _grounded(bundle: SimartModel, asked: Sequence[Question]) -> Iterator[float]:
    """IoU of the cells that the model names."""
    grammar = Grammar(bundle.tokenizer, bundle.vocabulary)
    for group in _groups(asked):
        machines = [grammar.grounding_machine(question.record.voxels.index) for question in group]
        longest = 8 + 3 * max(len(question.record.voxels.index) for question in group)
        written = generate(bundle.model, _inputs(bundle, group), machines, max_tokens=longest)
        for question, given in zip(group, written, strict=True):
            cells = question.record.voxels.index
            text = grammar.text(given.ids)
            named = parse_grounding(text, bundle.vocabulary.grid, cells) if given.complete else None
            yield 0.0 if named is None else cell_iou(named.index, _part_cells(question))


def _part_cells(question: Question) -> np.ndarray:
    if question.pair.part is None:
        raise ValueError("a question for the whole object asks for no part")
    return np.asarray(question.record.answer.parts[question.pair.part].voxels.index)


def _groups(asked: Sequence[Question]) -> Iterator[Sequence[Question]]:
    """Questions of nearly one length together, which saves padding; the order is kept within a list."""
    for start in range(0, len(asked), _BATCH):
        yield asked[start : start + _BATCH]


def _longest(question: Question, max_parts: int) -> int:
    cells = len(question.record.voxels.index)
    return _OBJECT_TOKENS + _PART_TOKENS * max_parts + 3 * _CELLS_SHARED * cells


def _inputs(bundle: SimartModel, group: Sequence[Question]) -> dict[str, Tensor]:
    system = system_prompt(bundle.vocabulary.grid, bundle.settings.prompt)
    prompts = [
        Prompt(
            system,
            question.pair.question,
            question.record.voxels,
            from_png(question.record.picture)
            if bundle.settings.picture and question.record.picture is not None
            else None,
        )
        for question in group
    ]
    device = next(bundle.model.parameters()).device
    return {name: tensor.to(device) for name, tensor in Processor.of(bundle).inputs(prompts).items()}
