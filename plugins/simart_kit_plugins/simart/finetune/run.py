"""A run of `train mllm`: from a preset and data to a trained model and its scores."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Mapping
from dataclasses import asdict, dataclass, field
from itertools import islice
from pathlib import Path

import torch

from simart_kit.provenance import write_json

from ..answer.writing import answer_text
from ..dataset.record import Record
from ..default_model import LoadedModel, load_model
from ..mllm.building import build
from ..mllm.bundle import load_bundle
from ..mllm.simart_model import SimartModel
from ..mllm.sizes import load_size
from ..prompt.texts import system_prompt
from .evaluation import baselines, evaluate
from .log import LOG_FILE
from .loop import BASE_FOLDER, check_run, finetune
from .plan import FinetunePlan, changed_plan, read_plan
from .records import Records, find_records
from .rows import LogRow
from .scores import Score

SCORES_FILE = "scores.json"
# Records whose text the tokenizer of a small model is trained on, and whose answers guesses borrow.
_TEXTS, _BORROWED = 2000, 500
Say = Callable[[str], None]


@dataclass(frozen=True)
class Order:
    """What a command line asks for.

    Attributes:
        preset: name or file.
        data: folders of instruction data.
        run: folder of the run.
        held_out: folder of data to judge on; None to keep objects of `data` out.
        resume: go on with the run.
        start: folder of a model to begin with; None for a new one.
        codec: folder of the voxel model; None for the shipped one.
        changes: of the preset's fields; None for those that stay.
        device: auto, cpu or cuda.
        threads: processors to use; None for as many as torch does by itself.
    """

    preset: str
    data: tuple[Path, ...]
    run: Path
    held_out: Path | None = None
    resume: bool = False
    start: Path | None = None
    codec: Path | None = None
    changes: Mapping[str, object] = field(default_factory=dict)
    device: str = "auto"
    threads: int | None = None


@dataclass(frozen=True)
class Outcome:
    """What a run gave.

    Attributes:
        model: folder of the trained model.
        log: table of the losses.
        steps: taken in all.
        scores: on held-out records, of the model and of guesses that need none, by name.
    """

    model: Path
    log: Path
    steps: int
    scores: Mapping[str, Score]


def perform(order: Order, say: Say, show: Callable[[LogRow, FinetunePlan], None]) -> Outcome | None:
    """Train as ordered; gives None in all processes but the first.

    Args:
        order: what is asked for.
        say: told what goes on, a line at a time.
        show: told each row of the log.

    Raises:
        BadInputError: the preset, an option, the data or the folder of the run cannot be used.
        OutputError: the folder cannot be written.
    """
    plan = changed_plan(read_plan(order.preset), order.changes)
    check_run(order.run, order.resume)
    if order.threads is not None:
        torch.set_num_threads(order.threads)
    codec = load_model(order.codec)
    kept_out = plan.held_out if order.held_out is None else 0.0
    records = find_records(order.data, kept_out, codec.fingerprint)
    judged = _judged(order, records, plan, codec)
    bundle = _bundle(order, plan, records, codec)
    told = " and ".join(map(str, order.data))
    say(f"training {plan.size} for {plan.steps} steps on {told}, {len(judged)} records held out")
    history: list[dict[str, object]] = []

    def judge(model: SimartModel, step: int) -> None:
        found = {"model": evaluate(model, judged)}
        history.append({"step": step, **asdict(found["model"])})
        say("\n".join([f"step {step}:", *score_lines(found)]))

    model = finetune(
        bundle,
        records,
        plan,
        order.run,
        resume=order.resume,
        device=order.device,
        observer=lambda row: show(row, plan),
        judge=judge if judged else None,
    )
    if int(os.environ.get("RANK", "0")):
        return None
    scores = _scores(model, judged, records, order.device) if judged else {}
    named = {name: asdict(value) for name, value in scores.items()}
    write_json(order.run / SCORES_FILE, {"schema": 1, "scores": named, "while_training": history})
    return Outcome(model, order.run / LOG_FILE, plan.steps, scores)


def score_lines(scores: Mapping[str, Score]) -> list[str]:
    """Scores as lines of text."""
    return [f"  {name}: {_told(value)}" for name, value in scores.items()]


def _told(value: Score) -> str:
    found = value.grounding_iou
    grounding = "-" if found is None else f"{found:.3f} of {value.grounded}"
    axis = "-" if value.axis is None else f"{value.axis:.2f} rad"
    line = "-" if value.line is None else f"{value.line:.3f}"
    return (
        f"{value.objects} objects, complete {value.complete:.0%}, part count {value.count:.0%}, "
        f"IoU {value.iou:.3f}, moving {value.moving_iou:.3f}, type {value.type:.3f}, "
        f"spurious {value.spurious:.2f}, axis {axis}, line {line}, "
        f"grounding IoU {grounding}"
    )


def _judged(order: Order, records: Records, plan: FinetunePlan, codec: LoadedModel) -> tuple[Record, ...]:
    if order.held_out is None:
        return records.judged(plan.evaluated)
    return find_records([order.held_out], 1.0, codec.fingerprint).judged(plan.evaluated)


def _bundle(order: Order, plan: FinetunePlan, records: Records, codec: LoadedModel) -> SimartModel:
    """The model that training begins with; a run that goes on with adapters begins with its own base."""
    start = order.start
    if plan.lora is not None and order.resume and (order.run / BASE_FOLDER).is_dir():
        start = order.run / BASE_FOLDER
    if start is not None:
        return load_bundle(str(start), device="cpu", dtype="float32", allow_slow=True)
    return build(load_size(plan.size), codec, plan.seed, _texts(records, plan))


def _texts(records: Records, plan: FinetunePlan) -> Iterator[str]:
    """Text that a small model's tokenizer is made for."""
    for record in islice(records.training(plan.seed, 0, 0, 1), _TEXTS):
        yield system_prompt(record.voxels.grid, plan.prompt)
        yield answer_text(record.answer)
        yield from (pair.question for pair in record.pairs)


def _scores(model: Path, judged: tuple[Record, ...], records: Records, device: str) -> dict[str, Score]:
    bundle = load_bundle(str(model), device=device, allow_slow=True)
    others = tuple(islice(records.training(0, 0, 0, 1), _BORROWED))
    return {"model": evaluate(bundle, judged), **baselines(judged, others)}
