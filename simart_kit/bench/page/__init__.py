"""report.html: a page about a benchmark run, one file that needs no network.

The same rows give the same bytes.
"""

from __future__ import annotations

from collections.abc import Sequence
from importlib.resources import files
from pathlib import Path
from string import Template

from ..describe import untwinned
from ..protocols import Protocol, protocol
from ..results import Summary, summarise
from ..rows import Row, Settings, read_rows, read_settings
from .markup import NOTHING, Markup, tag, text
from .objects import objects_table, ranked
from .overview import categories_table, explanations, heading, summary_table

PAGE_FILE = "report.html"


def write_page(run: Path) -> Path:
    """Write the page of a run into its folder.

    Args:
        run: folder of a benchmark run, with the rows that are done.

    Returns:
        The page.

    Raises:
        BadInputError: the folder is none of a run, or its protocol is not known.
    """
    settings, rows = read_settings(run), read_rows(run)
    scorer = protocol(settings.protocol.partition("/")[0])
    content = page(run, settings, rows, scorer, summarise(rows, scorer))
    path, draft = run / PAGE_FILE, run / f".{PAGE_FILE}"
    draft.write_text(content, encoding="utf-8", newline="\n")
    draft.replace(path)
    return path


def page(run: Path, settings: Settings, rows: Sequence[Row], scorer: Protocol, summary: Summary) -> str:
    """The page as HTML; pictures are read from the run's folder and put into it."""
    headlines = [metric for metric in scorer.metrics if metric.headline]
    others = [metric for metric in untwinned(scorer.metrics) if not metric.headline]
    categories = NOTHING
    if summary.categories:
        categories = _fold("By category", categories_table(summary, headlines))
    return Template(_asset("page.html")).substitute(
        title=text(f"{settings.system} on {settings.data}"),
        style=_asset("page.css"),
        script=_asset("page.js"),
        heading=heading(settings, summary),
        summary=summary_table(summary.all, headlines),
        others=_fold("Further metrics", summary_table(summary.all, others)) if others else NOTHING,
        categories=categories,
        objects=objects_table(run, ranked(rows, scorer), scorer),
        count=str(len(rows)),
        failed=str(summary.all.failed),
        static=str(summary.all.static),
        explanations=explanations(scorer),
    )


def _fold(title: str, table: Markup) -> Markup:
    """A table that is folded away at first."""
    return tag("details", tag("summary", text(title)), tag("div", table, attributes={"class": "scroll"}))


def _asset(name: str) -> str:
    return (files(__package__) / name).read_text(encoding="utf-8")
