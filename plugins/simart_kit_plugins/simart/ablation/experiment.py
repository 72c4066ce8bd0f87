"""Train and judge each row of the ablation on the same data with the same budget."""

from __future__ import annotations

import csv
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

import torch

from simart_kit.arrays import BoolArray
from simart_kit.errors import BadInputError, OutputError
from simart_kit.output import claimed

from ..models import VoxelConfig, VoxelModel, build_model
from ..training import checkpointing
from ..training.grids import Grids
from ..training.log import LOG_FILE, LogRow
from ..training.loop import train
from .autoencoder import start_from
from .budget import Budget
from .coding import Emptiness, as_force_sparse, coding, coding_without, emptiness
from .judging import Judgement, judge
from .lengths import Cells, Lengths, cells_kept, lengths
from .variants import DENSE, Variant

CELLS: Cells = (8, 8, 8)
# Of a row that begins: tells what is done with its rows of the log.
Watch = Callable[[Variant, VoxelConfig], Callable[[LogRow], None]]


@dataclass(frozen=True, eq=False)
class Block:
    """Data to judge on, never trained on.

    Attributes:
        title: what it is.
        grids: its grids.
    """

    title: str
    grids: Grids


@dataclass(frozen=True, eq=False)
class Row:
    """A line of the table of reconstruction.

    Attributes:
        key: of the variant; dense-dropped for the dense model without the code of emptiness.
        title: for people.
        config: of the model.
        parameters: number of the model's weights.
        seconds: that the steps of training took [s]; None for a row that was not trained itself.
        judgements: a judgement for each block.
    """

    key: str
    title: str
    config: VoxelConfig
    parameters: int
    seconds: float | None
    judgements: tuple[Judgement, ...]


@dataclass(frozen=True, eq=False)
class Ablation:
    """Both tables.

    Attributes:
        budget: of each row.
        blocks: what was judged on.
        rows: reconstruction.
        lengths: token counts, for each block.
        emptiness: of the dense model; None without that row.
    """

    budget: Budget
    blocks: tuple[Block, ...]
    rows: tuple[Row, ...]
    lengths: tuple[Lengths, ...]
    emptiness: Emptiness | None


@dataclass(frozen=True, eq=False)
class _Trained:
    """A variant's rows, and what its model keeps of each block if it is the dense one."""

    rows: tuple[Row, ...]
    kept: tuple[BoolArray, ...] | None = None
    emptiness: Emptiness | None = None


def check_run(run: Path, variants: Sequence[Variant], resume: bool) -> None:
    """Refuse a folder that has a row of these already, unless the run goes on.

    Raises:
        BadInputError: it has.
    """
    for variant in variants:
        found = checkpointing.latest(run / variant.key)
        if found is not None and not resume:
            raise BadInputError(
                f"{run} has an ablation already, row {variant.key} up to {found.name}: "
                "go on with --resume, or choose another --run"
            )


def perform(
    config: VoxelConfig,
    budget: Budget,
    variants: Sequence[Variant],
    grids: Grids,
    blocks: Sequence[Block],
    run: Path,
    watch: Watch,
    start: VoxelModel | None = None,
) -> Ablation:
    """Train what is not trained yet, and judge all rows.

    Args:
        config: that each variant changes.
        budget: of each row, for `grids`.
        variants: at least one.
        grids: to train on.
        blocks: to judge on.
        run: has a folder for each row.
        watch: follows the training.
        start: whose encoder and decoder all rows begin with, instead of random ones.

    Raises:
        BadInputError: a row was begun with another config, budget or other grids, or diverges.
        OutputError: the folder cannot be written, or another run is writing to it.
    """
    configs = {variant.key: variant.of(config) for variant in variants}
    try:
        run.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise OutputError(f"cannot write the ablation to {run}: {error.strerror}") from error
    done: dict[str, _Trained] = {}
    with claimed(run):
        # Rows that were begun come first: one that does not fit is then told before others are trained.
        for variant in sorted(variants, key=lambda v: checkpointing.latest(run / v.key) is None):
            folder, own = run / variant.key, configs[variant.key]
            model = build_model(own, budget.training.seed)
            if start is not None:
                start_from(model, start)
            train(model, grids, budget.training, folder, True, watch(variant, own))
            done[variant.key] = _trained(variant, model.eval(), grids, blocks, seconds_of(folder))
    kept = done[DENSE].kept if DENSE in done else None
    counts = [
        lengths(block.grids, CELLS, None if kept is None else kept[i]) for i, block in enumerate(blocks)
    ]
    rows = tuple(row for variant in variants for row in done[variant.key].rows)
    null = done[DENSE].emptiness if DENSE in done else None
    return Ablation(budget, tuple(blocks), rows, tuple(counts), null)


def seconds_of(run: Path) -> float:
    """What the log of a finished run says that its steps took [s]."""
    with (run / LOG_FILE).open(encoding="utf-8", newline="") as file:
        return float(list(csv.DictReader(file))[-1]["seconds"])


@torch.no_grad()
def _trained(
    variant: Variant, model: VoxelModel, grids: Grids, blocks: Sequence[Block], seconds: float
) -> _Trained:
    judged = tuple(judge(model, block.grids, coding(model)) for block in blocks)
    size = sum(parameter.numel() for parameter in model.parameters())
    row = Row(variant.key, variant.title, model.config, size, seconds, judged)
    if variant.key != DENSE:
        return _Trained((row,))
    null = emptiness(model, grids)
    if null is None:
        return _Trained((row,))
    reader, without = as_force_sparse(model), coding_without(model, null.code)
    dropped = tuple(judge(reader, block.grids, without) for block in blocks)
    kept = tuple(cells_kept(model, block.grids, null.code) for block in blocks)
    title = f"{variant.title}, code {null.code} dropped"
    second = Row(f"{variant.key}-dropped", title, model.config, size, None, dropped)
    return _Trained((row, second), kept, null)
