"""Protocols and formats as Markdown, for the documentation."""

from __future__ import annotations

import inspect
from collections.abc import Iterable

from .formats import prediction_formats, truth_formats
from .protocols import Metric, Protocol, protocols


def protocols_text() -> str:
    """Every protocol: what it does, its flaws, and a table of its numbers."""
    return "\n".join(_protocol_text(protocol) for protocol in protocols().values())


def formats_text() -> str:
    """Two tables: formats of truths and of predictions, each with the files that it is known by."""
    blocks = []
    for title, readers in (("Truth", truth_formats()), ("Prediction", prediction_formats())):
        rows = [f"| {reader.name} | {reader.layout} |" for reader in readers]
        blocks.append("\n".join([f"| {title} | Files |", "|---|---|", *rows]) + "\n")
    return "\n".join(blocks)


def _protocol_text(protocol: type[Protocol]) -> str:
    flaws = "".join(f"- {flaw}\n" for flaw in protocol.flaws)
    told = f"Kept as it is, though it is wrong:\n\n{flaws}\n" if flaws else ""
    return (
        f"### `{protocol.name}`, version {protocol.version}\n\n{inspect.getdoc(protocol)}\n\n"
        f"Source: {protocol.source}.\n\n{told}{_table(protocol.metrics)}"
    )


def _table(metrics: Iterable[Metric]) -> str:
    rows = [f"| `{m.key}` | {m.better or '-'} | {m.text} |" for m in metrics]
    return "\n".join(["| Key | Better | What |", "|---|---|---|", *rows]) + "\n"
