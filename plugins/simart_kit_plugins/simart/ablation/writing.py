"""The ablation as files: a JSON document and Markdown."""

from __future__ import annotations

import json
from collections.abc import Iterable
from dataclasses import asdict
from pathlib import Path
from typing import Any

from simart_kit.errors import OutputError

from .experiment import Ablation, Block, Row
from .lengths import Lengths
from .tables import Table, tables, verdict_lines
from .verdict import verdicts

JSON_FILE, MARKDOWN_FILE = "ablation.json", "ablation.md"


def document(ablation: Ablation, preset: str) -> dict[str, Any]:
    """All numbers, as plain values for JSON."""
    budget, null = ablation.budget, ablation.emptiness
    return {
        "config": preset,
        "budget": {
            "grids": budget.grids,
            "data": budget.fingerprint,
            "grids_seen": budget.seen,
            "autoencoder_steps": budget.autoencoder,
            "training": budget.training.model_dump(mode="json"),
        },
        "rows": [_row(row, ablation.blocks) for row in ablation.rows],
        "tokens": [
            {"data": block.title} | _lengths(found)
            for block, found in zip(ablation.blocks, ablation.lengths, strict=True)
        ],
        "emptiness": None if null is None else asdict(null),
        "zero_against_force_sparse": [asdict(verdict) for verdict in verdicts(ablation)],
    }


def write(ablation: Ablation, preset: str, run: Path) -> tuple[Path, Path]:
    """Write ablation.json and ablation.md into the folder of the run.

    Raises:
        OutputError: a file cannot be written.
    """
    numbers, text = run / JSON_FILE, run / MARKDOWN_FILE
    _put(numbers, json.dumps(document(ablation, preset), indent=1, ensure_ascii=False) + "\n")
    _put(text, markdown(ablation, preset))
    return numbers, text


def markdown(ablation: Ablation, preset: str) -> str:
    """The tables, and which of zero token and force-sparse is better."""
    pieces = [f"# Ablation of `{preset}`", *map(_markdown_table, tables(ablation)), *verdict_lines(ablation)]
    return "\n\n".join(pieces) + "\n"


def _row(row: Row, blocks: Iterable[Block]) -> dict[str, Any]:
    judged = [
        {
            "data": block.title,
            "grids": len(block.grids),
            "codes_alone": asdict(judgement.alone),
            "other_cells_off": asdict(judgement.masked),
            "usage": asdict(judgement.usage),
        }
        for block, judgement in zip(blocks, row.judgements, strict=True)
    ]
    return {
        "row": row.key,
        "title": row.title,
        "config": row.config.model_dump(mode="json"),
        "parameters": row.parameters,
        "seconds": row.seconds,
        "reconstruction": judged,
    }


def _lengths(found: Lengths) -> dict[str, Any]:
    """Sums over objects, as the table has their means."""
    counts = {"whole": asdict(found.whole), "parts": asdict(found.summed)}
    if not found.forced:
        for table in counts.values():
            table["force_sparse"] = None
    return {"objects": found.objects, "parts_in_all": found.parts, "sums": counts}


def _markdown_table(table: Table) -> str:
    head, *rows = table.rows
    lines = [_line(head), "|---|" + "---:|" * (len(head) - 1), *map(_line, rows)]
    return "\n\n".join([f"## {table.title}", "\n".join(lines), *table.notes])


def _line(cells: Iterable[str]) -> str:
    return "| " + " | ".join(cells) + " |"


def _put(path: Path, text: str) -> None:
    partial = path.with_name(path.name + ".partial")
    try:
        partial.write_text(text, encoding="utf-8")
        partial.replace(path)
    except OSError as error:
        raise OutputError(f"cannot write {path}: {error.strerror}") from error
