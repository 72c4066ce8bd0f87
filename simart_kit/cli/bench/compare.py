"""`simart-kit bench compare`."""

from __future__ import annotations

import textwrap
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from ..common import print_json, print_rows, warn
from ..options import Json, Verbose

if TYPE_CHECKING:
    from ...bench.compare import Comparison

_WIDTH = 100


def compare(
    a: Annotated[Path, typer.Argument(metavar="A", help="Folder of a benchmark run.")],
    b: Annotated[Path, typer.Argument(metavar="B", help="Folder of another, of the same objects.")],
    json: Json = False,
    verbose: Verbose = False,
) -> None:
    """Compare two runs, object by object.

    B is better or worse where a paired sign-flip test gives p < 0.05. The intervals are bootstrap intervals,
    too narrow for few objects. All metrics with -v.
    """
    from ...bench.compare import compare
    from ...bench.comparison_text import changed_rows, metric_rows, unpaired_texts
    from ...bench.numbers import counted

    comparison = compare(a, b)
    if json:
        print_json(comparison.table())
        return
    warn(_warnings(comparison))
    print(f"A  {a}: {comparison.a.system}, {len(comparison.failed_a)} failed")
    print(f"B  {b}: {comparison.b.system}, {len(comparison.failed_b)} failed")
    print(f"{comparison.a.protocol}, {counted(len(comparison.objects), 'object')} in both")
    print_rows(metric_rows(comparison, headline=not verbose))
    unpaired = unpaired_texts(comparison, headline=not verbose)
    if unpaired:
        print(_wrapped(f"objects not compared, as only one run has the number: {'; '.join(unpaired)}"))
    changed = changed_rows(comparison)
    if len(changed) > 1:
        print("changed most:")
        print_rows(changed)


def _wrapped(text: str) -> str:
    return textwrap.fill(text, _WIDTH, subsequent_indent="  ", break_on_hyphens=False)


def _warnings(comparison: Comparison) -> list[str]:
    """What makes the two less comparable."""
    from ...bench.numbers import counted, listed

    texts = list(comparison.notes)
    for run, names in (("A", comparison.only_a), ("B", comparison.only_b)):
        if names:
            texts.append(f"{counted(len(names), 'object')} in {run} only, not compared: {listed(names)}")
    return texts
