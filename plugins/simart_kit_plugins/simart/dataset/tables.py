"""The statistics of a data set as rows for a terminal."""

from __future__ import annotations

from .manifest import Manifest
from .statistics import PAPER_TOKENS, Statistics, quantile

Rows = list[tuple[str, ...]]
_SHARES = (0.05, 0.5, 0.95)


def summary_rows(counts: Statistics) -> Rows:
    """Objects, states and pairs."""
    pairs = ", ".join(f"{number} {task}" for task, number in counts.pairs.items())
    return [
        ("objects", str(counts.objects), f"{counts.objects - counts.static} move, {counts.static} do not"),
        ("states", str(counts.records), ""),
        ("pairs", str(sum(counts.pairs.values())), pairs),
        ("skipped", str(sum(counts.skipped.values())), ""),
    ]


def token_rows(counts: Statistics) -> Rows:
    """Mean tokens of a record with the paper's numbers, and how they spread.

    The paper's numbers count the symbolic text, too. The force-sparse form has no fewer tokens than are told
    here: it keeps those empty cells, too, whose code is not the one that was taken for emptiness.
    """
    records = max(counts.records, 1)
    means = {
        "zero-sparse": counts.zero_sparse_tokens / records,
        "force-sparse": counts.force_sparse_tokens / records,
        "dense": counts.dense_tokens / records,
    }
    rows: Rows = [("", *means)]
    cells = ["at least " if name == "force-sparse" else "" for name in means]
    rows.append(("ours", *(f"{cell}{mean:.0f}" for cell, mean in zip(cells, means.values(), strict=True))))
    rows.append(("paper, text counted too", *(str(PAPER_TOKENS[name]) for name in means)))
    spread = [str(3 * quantile(counts.part_cells, share)) for share in _SHARES]
    rows.append(("5 %, median, 95 %", " / ".join(spread), "", ""))
    return rows


def skipped_rows(manifest: Manifest, every: bool) -> Rows:
    """Reasons with their numbers; with `every` the first objects, too."""
    rows: Rows = [(str(number), reason) for reason, number in manifest.statistics.skipped.items()]
    if every:
        rows += [("", f"{key}: {fault}") for key, fault in manifest.skipped]
    return rows


def detail_rows(counts: Statistics) -> Rows:
    """Distributions: number of parts, types of parts, sources, categories."""
    parts = [str(quantile(counts.parts, share)) for share in _SHARES]
    return [
        ("parts", f"{' / '.join(parts)} (5 %, median, 95 %)"),
        ("cells of the whole", " / ".join(str(quantile(counts.whole_cells, s)) for s in _SHARES)),
        ("types of parts", _listed(counts.types)),
        ("sources", _listed(counts.sources)),
        ("categories", _listed(counts.categories)),
    ]


def _listed(counts: dict[str, int]) -> str:
    return ", ".join(f"{name or 'none'} {number}" for name, number in counts.items())
