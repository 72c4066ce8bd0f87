"""The comparison as tables, for a terminal, for Markdown, and as numbers."""

from __future__ import annotations

from dataclasses import asdict
from pathlib import Path
from typing import Any

from simart_kit.errors import OutputError
from simart_kit.provenance import write_json

from .experiment import Comparison, Result

JSON_FILE, MARKDOWN_FILE = "ablation.json", "ablation.md"
Rows = tuple[tuple[str, ...], ...]
_SCORES = (
    "Parts are matched by their cells; one that is missed, or whose answer did not end within the limit, "
    "counts: type wrong, IoU 0, CD 0.866. Centre is of parts that turn and are said to. IoU and CD are of "
    "decoded voxels, with the edge of the cube as 1. IoU of codes: the true answers in the row's codes, "
    "which no answer can beat. A row is too long where no example fits the limit."
)
_TOKENS = "Tokens: mean length of the true answers of training records, all parts' voxels and the text."


def score_rows(found: Comparison) -> Rows:
    """The paper's columns, with what each row read."""
    head = ("", "Type", "Centre", "IoU", "cell IoU", "CD", "tokens", "complete", "IoU of codes")
    spent = ("steps", "examples", "left out", "loss")
    return ((*head, *spent), *(_scored(result) for result in found.results))


def token_rows(found: Comparison) -> Rows:
    """Output tokens an object beside the paper's."""
    head = ("", "objects", "parts", "voxel tokens", "text", "tokens", "paper")
    rows = []
    for result in found.results:
        own = result.tokens
        means = (f"{own.parts:.1f}", f"{own.voxels:.0f}", f"{own.text:.0f}", f"{own.all:.0f}")
        rows.append((result.row.title, str(own.objects), *means, str(result.row.paper)))
    return (head, *rows)


def title(found: Comparison) -> str:
    """What the tables are of."""
    budget, plan = found.order.budget, found.order.plan
    if budget is None:
        return f"Output tokens, {found.grid} cells, {found.order.counted} records at most"
    given = f"{plan.steps} steps" if budget.seconds is None else f"{budget.seconds / 60:g} minutes"
    return (
        f"Each row: size {plan.size}, {given} of up to {plan.batch_tokens} tokens, examples of up to "
        f"{plan.longest}, seed {plan.seed}; {found.judged} held-out objects, {found.grid} cells"
    )


def emptiness_line(found: Comparison) -> str:
    """What force sparse leaves out; "" without that row."""
    null = found.emptiness
    if null is None:
        return ""
    return (
        f"Force sparse leaves out code {null.code}, which {null.share:.1%} of the empty cells have and "
        f"{null.geometry:.1%} of the occupied ones; {null.codes} codes cover 99 % of the empty cells."
    )


def notes(found: Comparison) -> tuple[str, ...]:
    """What the columns mean, and what force sparse leaves out."""
    lines = (emptiness_line(found), "" if found.order.budget is None else _SCORES, _TOKENS)
    return tuple(line for line in lines if line)


def document(found: Comparison) -> dict[str, Any]:
    """All numbers, as plain values for JSON."""
    order = found.order
    seconds = None if order.budget is None else order.budget.seconds
    return {
        "schema": 1,
        "grid": found.grid,
        "held_out": found.judged,
        "plan": order.plan.model_dump(mode="json"),
        "trained": order.budget is not None,
        "seconds_a_row": seconds,
        "emptiness": None if found.emptiness is None else asdict(found.emptiness),
        "rows": [_numbers(result) for result in found.results],
    }


def write(found: Comparison) -> tuple[Path, Path]:
    """Write ablation.json and ablation.md.

    Raises:
        OutputError: a file cannot be written.
    """
    numbers, text = found.order.out / JSON_FILE, found.order.out / MARKDOWN_FILE
    write_json(numbers, document(found))
    tables = [token_rows(found)] if found.order.budget is None else [score_rows(found), token_rows(found)]
    lines = [title(found), *map(_markdown, tables), *notes(found)]
    try:
        text.write_text("\n\n".join(lines) + "\n", encoding="utf-8")
    except OSError as error:
        raise OutputError(f"cannot write {text}: {error.strerror}") from error
    return numbers, text


def _scored(result: Result) -> tuple[str, ...]:
    score, spent, codec = result.score, result.spent, result.codec
    if score is None or spent is None or codec is None:
        nothing = ["-"] * 4
        return (result.row.title, "too long", *nothing, f"{result.tokens.all:.0f}", *nothing, "100%", "-")
    return (
        result.row.title,
        f"{score.type:.3f}",
        "-" if score.center is None else f"{score.center:.3f}",
        f"{score.iou:.3f}",
        f"{score.cell_iou:.3f}",
        f"{score.cd:.3f}",
        f"{result.tokens.all:.0f}",
        f"{score.complete:.0%}",
        f"{codec.iou:.3f}",
        str(spent.steps),
        str(spent.examples),
        f"{result.left_out:.0%}",
        "-" if spent.loss is None else f"{spent.loss:.2f}",
    )


def _numbers(result: Result) -> dict[str, Any]:
    return {
        "row": result.row.key,
        "title": result.row.title,
        "paper_tokens": result.row.paper,
        "tokens": asdict(result.tokens) | {"all": result.tokens.all},
        "left_out": result.left_out,
        "training": None if result.spent is None else asdict(result.spent),
        "scores": None if result.score is None else asdict(result.score),
        "scores_of_true_codes": None if result.codec is None else asdict(result.codec),
    }


def _markdown(rows: Rows) -> str:
    head, *body = rows
    lines = [head, ("---", *["---:"] * (len(head) - 1)), *body]
    return "\n".join("| " + " | ".join(line) + " |" for line in lines)
