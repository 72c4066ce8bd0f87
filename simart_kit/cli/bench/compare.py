"""`simart-kit bench compare`."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from ..common import print_json, print_rows, warn
from ..options import Json, Verbose

if TYPE_CHECKING:
    from ...bench.compare import Comparison


def compare(
    a: Annotated[Path, typer.Argument(metavar="A", help="Folder of a benchmark run.")],
    b: Annotated[Path, typer.Argument(metavar="B", help="Folder of another, of the same objects.")],
    json: Json = False,
    verbose: Verbose = False,
) -> None:
    """Compare two runs, object by object.

    Paired differences with 95 % bootstrap intervals; all metrics with -v.
    """
    from ...bench.compare import changed_rows, compare, metric_rows

    comparison = compare(a, b)
    if json:
        print_json(comparison.table())
        return
    warn(_warnings(comparison))
    print(f"A  {a}: {comparison.a.system}, {len(comparison.failed_a)} failed")
    print(f"B  {b}: {comparison.b.system}, {len(comparison.failed_b)} failed")
    print(f"{comparison.a.protocol}, {len(comparison.objects)} object(s) in both")
    print_rows(metric_rows(comparison, headline=not verbose), "  ")
    changed = changed_rows(comparison)
    if len(changed) > 1:
        print("changed most:")
        print_rows(changed, "  ")


def _warnings(comparison: Comparison) -> list[str]:
    """What makes the two less comparable."""
    texts = list(comparison.notes)
    for run, names in (("A", comparison.only_a), ("B", comparison.only_b)):
        if names:
            texts.append(f"{len(names)} object(s) are in {run} only and not compared: {', '.join(names)}")
    return texts
