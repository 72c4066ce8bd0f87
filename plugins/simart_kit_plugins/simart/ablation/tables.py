"""The ablation as tables of text, for a terminal and for Markdown."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from datetime import timedelta

from simart_kit.bench.numbers import counted

from ..token_counts import SequenceLength, TokenCounts
from .experiment import Ablation, Row
from .judging import Judgement, Scores
from .lengths import Lengths
from .verdict import verdicts

Form = Callable[[TokenCounts], SequenceLength]
NOTES = (
    "MSE and CD: means over grids, times 1e5. CD: sum of the two mean squared distances between the middles "
    "of occupied voxels, with the side of the cube as 1.",
    "First what the decoder makes of the codes alone, also in cells without one. Then masked: cells without "
    "a token are off, as the product decodes, for a token string tells which these are.",
    "lost: grids of which no voxel came back, unmasked; each counts as a CD of 150000.",
)


@dataclass(frozen=True)
class Table:
    """A table.

    Attributes:
        title: above it.
        rows: the first is its head.
        notes: below it.
    """

    title: str
    rows: tuple[tuple[str, ...], ...]
    notes: tuple[str, ...] = ()


def tables(ablation: Ablation) -> tuple[Table, ...]:
    """Budget, then reconstruction and token counts of each block."""
    blocks = range(len(ablation.blocks))
    return (
        _budget(ablation),
        *(_reconstruction(ablation, block) for block in blocks),
        *(_lengths(ablation, block) for block in blocks),
    )


def budget_line(ablation: Ablation) -> str:
    """What each row was given, on one line."""
    budget = ablation.budget
    training = budget.training
    start = f", from an autoencoder of {budget.autoencoder} steps" if budget.autoencoder else ""
    return (
        f"Each row: {training.stage1_steps} + {training.stage2_steps} steps of {training.batch_size} grids = "
        f"{budget.seen} grids seen, {budget.seen / budget.grids:.1f} times each of {budget.grids}; "
        f"seed {training.seed}, {training.device}, {training.precision}{start}"
    )


def verdict_lines(ablation: Ablation) -> tuple[str, ...]:
    """Whether the zero token beat force-sparse, for each block; or that this cannot be told."""
    found = verdicts(ablation)
    if not found:
        return ("Zero token against force sparse: needs both rows, zero and force-sparse.",)
    return tuple(verdict.text() for verdict in found)


def _budget(ablation: Ablation) -> Table:
    head = ("", "tokens", "mode", "codes", "parameters", "steps", "grids seen", "seconds")
    trained = [row for row in ablation.rows if row.seconds is not None]
    budget = ablation.budget
    rows = [
        (
            *(row.title, row.config.grid, row.config.mode, str(row.config.codebook_size)),
            *(f"{row.parameters:,}", str(budget.training.steps), str(budget.seen), _whole(row.seconds)),
        )
        for row in trained
    ]
    total = sum(row.seconds or 0 for row in trained)
    notes = (f"{budget_line(ablation)}; {timedelta(seconds=round(total))} in all.",)
    return Table("Budget", (head, *rows), notes)


def _reconstruction(ablation: Ablation, number: int) -> Table:
    block = ablation.blocks[number]
    head = ("", "MSE", "CD", "IoU", "lost", "masked MSE", "masked CD", "masked IoU", "codes used")
    rows = [_scored(row, number) for row in ablation.rows]
    alike = all(_same(row.judgements[number]) for row in ablation.rows)
    more = ("Masked is the same: this model decodes nothing where there is no token.",) if alike else ()
    notes = NOTES if block is ablation.blocks[-1] else ()
    title = f"Reconstruction of {block.title}: {counted(len(block.grids), 'grid')}"
    return Table(title, (head, *rows), (*notes, *more))


def _same(judged: Judgement) -> bool:
    """Whether the mask takes no voxel away."""
    return judged.alone.iou == judged.masked.iou and judged.alone.cd_squared == judged.masked.cd_squared


def _scored(row: Row, number: int) -> tuple[str, ...]:
    judged = row.judgements[number]
    used = f"{judged.usage.used} of {judged.usage.entries}"
    return (row.title, *_scores(judged.alone), str(judged.alone.nothing), *_scores(judged.masked), used)


def _scores(scores: Scores) -> tuple[str, str, str]:
    return f"{scores.mse * 1e5:.1f}", f"{scores.cd_squared * 1e5:.2f}", f"{scores.iou:.3f}"


def _lengths(ablation: Ablation, number: int) -> Table:
    found = ablation.lengths[number]
    head = ("", "parts summed", "fewer cells", "fewer tokens", "whole", "fewer cells", "fewer tokens")
    rows = [
        ("Dense", *_form(found, lambda counts: counts.dense)),
        ("Force sparse", *(_form(found, lambda counts: counts.force_sparse) if found.forced else "-" * 6)),
        ("Zero sparse", *_form(found, lambda counts: counts.zero_sparse)),
    ]
    many = f"{counted(found.objects, 'object')} with {counted(found.parts, 'part')} in all"
    block = ablation.blocks[number]
    title = f"Mean tokens an object, {block.title}: {many}, in 8x8x8 cells"
    return Table(title, (head, *rows), (_emptiness(ablation),) if block is ablation.blocks[-1] else ())


def _form(found: Lengths, form: Form) -> tuple[str, ...]:
    return (*_against(found.summed, form, found.objects), *_against(found.whole, form, found.objects))


def _against(counts: TokenCounts, form: Form, objects: int) -> tuple[str, str, str]:
    """Mean tokens of a form, and the shares of cells and of tokens that it saves against the dense one."""
    own = form(counts)
    cells, tokens = 1 - own.cells / counts.dense.cells, 1 - own.tokens / counts.dense.tokens
    return f"{own.tokens / objects:.1f}", f"{cells:.1%}", f"{tokens:.1%}"


def _emptiness(ablation: Ablation) -> str:
    null = ablation.emptiness
    if null is None:
        return "Force sparse needs row dense: its model tells which cells it keeps."
    return (
        f"Force sparse: cells whose code in row dense is not {null.code}, which {null.share:.1%} of the "
        f"empty cells of the training data have, and {null.geometry:.1%} of the occupied ones; "
        f"99 % of the empty cells share {counted(null.codes, 'code')}."
    )


def _whole(seconds: float | None) -> str:
    return "-" if seconds is None else f"{seconds:.0f}"
