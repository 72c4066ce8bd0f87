"""Held-out objects as questions to a row's model."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from ..answer.parsing import parse_answer
from ..answer.values import ObjectAnswer
from ..dataset.record import Record
from ..grammar.decoding import generate
from ..mllm.simart_model import SimartModel
from ..prompt.picture import from_png
from ..prompt.processor import Processor
from ..prompt.texts import URDF_QUESTION, system_prompt
from ..prompt.values import Prompt
from .dense_form import grammar_of

_BATCH = 8


def answers(bundle: SimartModel, records: Sequence[Record], longest: int) -> Iterator[ObjectAnswer | None]:
    """A model's answers about whole objects, under the grammar, the likeliest word each time.

    Args:
        bundle: in evaluation mode.
        records: in its codes.
        longest: tokens that question and answer may have together, as in training; an answer that does not
            end within it is None.
    """
    grammar, processor = grammar_of(bundle), Processor.of(bundle)
    device = next(bundle.model.parameters()).device
    for start in range(0, len(records), _BATCH):
        group = records[start : start + _BATCH]
        inputs = processor.inputs([prompt(bundle, record) for record in group])
        lengths = inputs["attention_mask"].sum(dim=1).tolist()
        machines = [grammar.answer_machine(record.voxels.index) for record in group]
        written = generate(
            bundle.model,
            {name: tensor.to(device) for name, tensor in inputs.items()},
            machines,
            max_tokens=max(longest - min(lengths), 1),
        )
        for record, length, given in zip(group, lengths, written, strict=True):
            whole = given.complete and length + len(given.ids) <= longest
            cells, grid = record.voxels.index, bundle.vocabulary.grid
            yield parse_answer(grammar.text(given.ids), grid, allowed=cells) if whole else None


def prompt(bundle: SimartModel, record: Record) -> Prompt:
    """What a model is asked, as its settings say."""
    settings = bundle.settings
    picture = from_png(record.picture) if settings.picture and record.picture is not None else None
    system = system_prompt(bundle.vocabulary.grid, settings.prompt)
    return Prompt(system, URDF_QUESTION, record.voxels, picture)
