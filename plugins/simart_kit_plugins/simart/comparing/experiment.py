"""Train and judge each row on the same records with the same budget."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path

from simart_kit.errors import OutputError
from simart_kit.output import claimed

from ..ablation.coding import Emptiness
from ..dataset.record import Record
from ..default_model import LoadedModel
from ..finetune.plan import FinetunePlan
from ..mllm.building import build
from ..mllm.simart_model import SimartModel
from ..mllm.sizes import load_size
from .asking import answers
from .counting import OutputTokens, output_tokens
from .data import SharedData, shared_data, texts, voxel_grids
from .dense_form import written_densely
from .dropping import Recode, Recoder
from .examples import RowExamples, left_out
from .no_zero_token import codec_without_zero_token
from .rows import Row
from .scoring import RowScore, scored
from .training import Budget, Spent, trained

CODEC_FOLDER = "codec"
Say = Callable[[str], None]
# Lines of progress of a row.
_LINES = 10


@dataclass(frozen=True)
class Order:
    """What a command line asks for.

    Attributes:
        rows: at least one.
        data: folders of instruction data.
        out: folder of the results.
        budget: of each row; None to count tokens only.
        plan: how rows are trained and judged, with the budget's steps.
        counted: training records whose tokens are counted.
        codec: voxel model of the data's codes; None for the shipped one.
        without_zero: folder of a voxel model without zero token; None to train one.
        codec_steps: of its training.
        device: auto, cpu or cuda.
    """

    rows: tuple[Row, ...]
    data: tuple[Path, ...]
    out: Path
    budget: Budget | None
    plan: FinetunePlan
    counted: int
    codec: Path | None
    without_zero: Path | None
    codec_steps: int
    device: str


@dataclass(frozen=True)
class Result:
    """A row's.

    Attributes:
        row: it.
        tokens: of true answers.
        left_out: share of the counted records that are longer than a training example may be.
        spent: by its training; None where tokens are counted only, or all examples are too long.
        score: of its answers.
        codec: score of the true answers in its codes: no answer can be better.
    """

    row: Row
    tokens: OutputTokens
    left_out: float = 0.0
    spent: Spent | None = None
    score: RowScore | None = None
    codec: RowScore | None = None


@dataclass(frozen=True)
class Comparison:
    """All rows.

    Attributes:
        order: what was asked for.
        results: of the rows.
        grid: cells of the voxel tokens, such as "16x8x8".
        judged: number of held-out objects.
        emptiness: what the voxel model without zero token makes of empty cells; None without such a row.
    """

    order: Order
    results: tuple[Result, ...]
    grid: str
    judged: int
    emptiness: Emptiness | None


def perform(order: Order, say: Say, keep: Callable[[Comparison], object]) -> Comparison:
    """Train and judge as ordered.

    Args:
        order: what is asked for.
        say: told what goes on, a line at a time.
        keep: given what is done after each row, so that nothing is lost when a later one is stopped.

    Raises:
        BadInputError: the data, a model or an option cannot be used.
        OutputError: the folder cannot be written, or another run is writing to it.
    """
    plan = order.plan
    data = shared_data(order.data, order.codec, plan, order.counted, any(row.picture for row in order.rows))
    try:
        order.out.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise OutputError(f"cannot write to {order.out}: {error.strerror}") from error
    with claimed(order.out):
        dropping, emptiness = _dropping(order, data, say)
        cells = "x".join(map(str, data.codec.grid.shape))
        found = Comparison(order, (), cells, len(data.judged), emptiness)
        for row in order.rows:
            codec = dropping if row.dropped and dropping is not None else data.codec
            done = _Row(row, order, data, codec, say).result()
            found = replace(found, results=(*found.results, done))
            keep(found)
    return found


def _dropping(order: Order, data: SharedData, say: Say) -> tuple[LoadedModel | None, Emptiness | None]:
    """The voxel model without zero token, where a row needs it."""
    if not any(row.dropped for row in order.rows):
        return None, None
    grids, run = voxel_grids(data, order.plan), order.out / CODEC_FOLDER
    return codec_without_zero_token(
        data.codec, grids, order.without_zero, run, order.codec_steps, order.plan.seed, say
    )


class _Row:
    """A row at work."""

    def __init__(self, row: Row, order: Order, data: SharedData, codec: LoadedModel, say: Say) -> None:
        self.row, self.order, self.data, self.codec, self.say = row, order, data, codec, say
        self.recode: Recode = Recoder(data.codec.model, codec.model) if row.dropped else _as_it_is
        self.plan = order.plan.model_copy(update={"picture_share": float(row.picture)})

    def result(self) -> Result:
        """Count, train and judge."""
        bundle = self._bundle()
        tokens = output_tokens(bundle, self.data.counted, self.recode)
        self.say(f"row {self.row.key}: {tokens.all:.0f} tokens an answer")
        if self.order.budget is None:
            return Result(self.row, tokens)
        maker = RowExamples(bundle, self.plan, self.recode)
        missing = left_out(maker, self.data.counted, self.plan.longest)
        if missing == 1:
            return Result(self.row, tokens, missing)
        spent = self._trained(bundle, maker, self.order.budget)
        own = [self.recode(record) for record in self.data.judged]
        asked = [record for record in own if record is not None]
        given = iter(answers(bundle, asked, self.plan.longest))
        found = [None if record is None else next(given) for record in own]
        known = [None if record is None else record.answer for record in own]
        model, grid = self.codec.model, self.codec.grid
        score = scored(self.data.truths, found, model, grid)
        return Result(self.row, tokens, missing, spent, score, scored(self.data.truths, known, model, grid))

    def _bundle(self) -> SimartModel:
        bundle = build(load_size(self.plan.size), self.codec, self.plan.seed, texts(self.data, self.plan))
        shown = {"prompt": self.plan.prompt, "picture": self.row.picture}
        bundle = replace(bundle, settings=bundle.settings.model_copy(update=shown))
        return written_densely(bundle) if self.row.dense else bundle

    def _trained(self, bundle: SimartModel, maker: RowExamples, budget: Budget) -> Spent:
        every = max(1, self.plan.steps // _LINES)

        def progress(step: int, loss: float) -> None:
            if step % every == 0:
                self.say(f"row {self.row.key}: step {step}  loss {loss:.3f}")

        own = replace(budget, plan=self.plan)
        return trained(bundle, self.data.records, maker, own, self.order.device, progress)


def _as_it_is(record: Record) -> Record | None:
    return record
