"""Performing a plan with progress, and telling what it found."""

from __future__ import annotations

import sys
from dataclasses import asdict
from typing import TYPE_CHECKING, Any

import typer

from ...bench.frame import MISFIT
from ...bench.numbers import counted
from ...bench.results import RESULTS_FILE, TABLE_FILE
from ...bench.run import Outcome, Plan, left_to_do, run
from ..common import print_json, warn
from .progress import progress
from .table import summary_lines

if TYPE_CHECKING:
    from pathlib import Path


def perform(plan: Plan, quiet: bool) -> Outcome:
    """Run it with progress on stderr; one that is interrupted says how to go on."""
    try:
        with progress(quiet) as watcher:
            return run(plan, watcher)
    except KeyboardInterrupt:
        left = counted(left_to_do(plan), "object")
        print(f"{left} left to do: run the same command again to go on", file=sys.stderr)
        raise


def tell(plan: Plan, outcome: Outcome, json: bool, quiet: bool, verbose: bool) -> None:
    """The table or the document, warnings on stderr; exit code 1 when no object could be scored."""
    scored = any(row.status == "scored" for row in outcome.rows)
    files = {
        "results": plan.out / RESULTS_FILE,
        "table": plan.out / TABLE_FILE,
        "page": outcome.page,
    }
    if not quiet:
        warn(outcome.warnings)
        if verbose:
            print(_notes_line(outcome), file=sys.stderr)
    if json:
        print_json(_document(plan, outcome, scored, files))
    elif not quiet:
        print("\n".join(summary_lines(plan, outcome)))
        print(f"files in {plan.out}:")
        print("\n".join(f"  {word:<10} {path}" for word, path in files.items()))
    if not scored:
        if not json:
            print(f"error: no object could be scored: {_reason(plan, outcome)}", file=sys.stderr)
        raise typer.Exit(1)


def _notes_line(outcome: Outcome) -> str:
    """How many notes there are besides those that warnings are about."""
    notes = [[note for note in row.notes if not note.startswith(MISFIT)] for row in outcome.rows]
    count, objects = sum(map(len, notes)), sum(map(bool, notes))
    return f"{counted(count, 'note')} on {counted(objects, 'object')}: see {outcome.page}"


def _reason(plan: Plan, outcome: Outcome) -> str:
    """Why all failed, where that is the same for all."""
    errors = {row.error for row in outcome.rows}
    return errors.pop() if len(errors) == 1 else f"see {plan.out / RESULTS_FILE}"


def _document(plan: Plan, outcome: Outcome, scored: bool, files: dict[str, Path]) -> dict[str, Any]:
    failed = {row.name: row.error for row in outcome.rows if row.status == "failed"}
    return {
        "ok": scored,
        "folder": str(plan.out),
        "files": {word: str(path) for word, path in files.items()},
        "system": plan.system.name,
        "summary": asdict(outcome.summary),
        "failed": failed,
        "warnings": list(outcome.warnings),
    }
