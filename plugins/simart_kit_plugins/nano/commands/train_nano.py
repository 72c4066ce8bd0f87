"""`simart-kit train nano`."""

from __future__ import annotations

import os
import sys
from collections.abc import Mapping
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from simart_kit.cli.common import print_json, print_rows, stdout_kept
from simart_kit.cli.options import Json, Verbose
from simart_kit.errors import BadInputError, OutputError

if TYPE_CHECKING:
    from ..network import NanoNetwork
    from ..training.loop import NanoRow
    from ..training.plan import TrainingPlan
    from ..training.pool import Progress, Shard
    from ..training.scores import NanoScore

Run = Annotated[Path, typer.Option("--run", metavar="DIR", help="Folder of the run.")]
Objects = Annotated[int | None, typer.Option(min=1, metavar="N", help="Made-up objects to train on.")]
Steps = Annotated[int | None, typer.Option(min=1, metavar="N", help="Steps of training.")]
Batch = Annotated[int | None, typer.Option(min=1, metavar="N", help="Objects a step.")]
SkinShare = Annotated[float | None, typer.Option(metavar="X", help="Share of objects that are one skin.")]
ReliefShare = Annotated[
    float | None,
    typer.Option(metavar="X", help="Share of objects that are a closed skin, cut by relief: slow to make."),
]
HeldOut = Annotated[
    int | None,
    typer.Option(
        min=1,
        metavar="N",
        help="Objects to judge on, and to measure novelty by: with fewer than some hundreds, all looks new.",
    ),
]
OfEach = Annotated[
    int | None,
    typer.Option(
        min=0,
        metavar="N",
        help="Objects of each category to measure by how alike they are; with none, fewer are recognised.",
    ),
]
Rate = Annotated[float | None, typer.Option(metavar="X", help="Step size of AdamW.")]
Start = Annotated[
    Path | None,
    typer.Option(
        metavar="DIR", help="Go on from the weights of this model; names that it does not know begin afresh."
    ),
]
StartShare = Annotated[
    float | None,
    typer.Option(metavar="X", help="Share of the weights of --start that stays in the result."),
]
Only = Annotated[
    str | None,
    typer.Option(metavar="pairs", help="Train these layers of the model of --start, and hold all others."),
]
Seed = Annotated[int | None, typer.Option(min=0, metavar="N", help="Decides all that is random.")]
Device = Annotated[str | None, typer.Option(metavar="cpu|cuda", help="Where to compute; also cuda:N.")]
Precision = Annotated[str | None, typer.Option(metavar="fp32|bf16", help="Arithmetic of the network.")]
Processes = Annotated[
    int | None, typer.Option(min=1, metavar="N", help="Make objects with so many processes; default: all.")
]
Resume = Annotated[bool, typer.Option("--resume", help="Go on from the run's last checkpoint.")]
Evaluate = Annotated[bool, typer.Option("--evaluate", help="Only judge what the run has so far.")]
Quiet = Annotated[bool, typer.Option("--quiet", "-q", help="Say nothing but the result.")]
_HEAD = ("", "objects", "loss", "pairs", "pieces", "kind", "candidate", "category")


def train_nano(
    run: Run,
    objects: Objects = None,
    steps: Steps = None,
    batch_size: Batch = None,
    held_out: HeldOut = None,
    of_each: OfEach = None,
    skin_share: SkinShare = None,
    relief_share: ReliefShare = None,
    learning_rate: Rate = None,
    start: Start = None,
    start_share: StartShare = None,
    only: Only = None,
    seed: Seed = None,
    device: Device = None,
    precision: Precision = None,
    processes: Processes = None,
    resume: Resume = False,
    evaluate: Evaluate = False,
    json: Json = False,
    verbose: Verbose = False,
    quiet: Quiet = False,
) -> None:
    """Train the small model that finds parts and joints, on made-up objects.

    The objects are made first and kept in the run's folder. A run that was stopped goes on with --resume, and
    from its first checkpoint on knows its options. The model is in DIR/model at the end, or after --evaluate.
    Twelve categories are never trained on, and judged apart.
    """
    changes = {
        "objects": objects,
        "steps": steps,
        "batch_size": batch_size,
        "held_out": held_out,
        "of_each": of_each,
        "skin_share": skin_share,
        "relief_share": relief_share,
        "learning_rate": learning_rate,
        "start": str(start) if start else None,
        "start_share": start_share,
        "only": only,
        "seed": seed,
        "device": device,
        "precision": precision,
    }
    with stdout_kept(json):
        given = {name: value for name, value in changes.items() if value is not None}
        plan = _plan(given, run, goes_on=resume or evaluate)
        _check(run, plan, resume, evaluate)
        scores = _performed(plan, run, processes or os.cpu_count() or 1, evaluate, quiet)
    if json:
        print_json({"ok": True, "run": str(run), "scores": {k: asdict(v) for k, v in scores.items()}})
        return
    print_rows([_HEAD, *(_cells(name, found) for name, found in scores.items())])
    print("shares right: pairs of pieces, pieces that move, kind and first candidate of parts, categories")


def _plan(changes: Mapping[str, object], run: Path, goes_on: bool) -> TrainingPlan:
    """What was asked for; of a run that goes on, all else is as it was."""
    from pydantic import ValidationError

    from ...tables import told
    from ..training import checkpoint
    from ..training.plan import TrainingPlan

    known: dict[str, object] = (
        checkpoint.plan_of(run).model_dump() if goes_on and checkpoint.exists(run) else {}
    )
    try:
        return TrainingPlan.model_validate({**known, **changes})
    except ValidationError as error:
        raise BadInputError(f"training options: {told(error)}") from error


def _check(run: Path, plan: TrainingPlan, resume: bool, evaluate: bool) -> None:
    from ...simart.training.device import training_device
    from ..training import checkpoint
    from ..weights import load_model

    if run.is_file():
        raise BadInputError(f"{run} is a file: choose a folder")
    if evaluate and not checkpoint.exists(run):
        raise BadInputError(f"{run} has no checkpoint to judge: train it first")
    if resume and not (checkpoint.exists(run) or (run / "objects").is_dir()):
        raise BadInputError(f"{run} has no run to go on with: give another --run, or begin without --resume")
    if checkpoint.exists(run):
        if not (resume or evaluate):
            raise BadInputError(f"{run} has a run already: go on with --resume, or choose another --run")
        checkpoint.check_same(checkpoint.plan_of(run), plan, run)
    training_device(plan.device)
    if plan.start_share and not plan.start:
        raise BadInputError("--start-share is the share of a model in the result: name it with --start")
    if plan.only and not plan.start:
        raise BadInputError(
            "--only trains some layers of a model that has learnt the others: name it with --start"
        )
    if plan.start:
        load_model(Path(plan.start))  # what is wrong with it is told before objects are made


def _performed(
    plan: TrainingPlan, run: Path, processes: int, evaluate: bool, quiet: bool
) -> dict[str, NanoScore]:
    from simart_kit.output import claimed

    from ..knowledge import counted
    from ..training import pool
    from ..training.loop import train, with_names
    from ..training.scores import score
    from ..training.usual import usual_tokens
    from ..weights import save_network

    files = {use: pool.shards(plan, run / "objects", use) for use in (pool.TRAIN, pool.SEEN, pool.UNSEEN)}
    try:
        run.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise OutputError(f"cannot write the run to {run}: {error.strerror}") from error
    with claimed(run):
        _make([shard for some in files.values() for shard in some], processes, quiet)
        examples = pool.read(files[pool.TRAIN])
        plan = with_names(plan, examples)
        network = _so_far(plan, run) if evaluate else train(plan, examples, run, _Printer(plan, quiet))
        known = counted(plan.network.categories, plan.seed)
        usual = usual_tokens(network, plan, processes, _progress("measured", quiet))
        save_network(network, run / "model", known, usual)
    judged = {"categories trained on": pool.SEEN, "unseen categories": pool.UNSEEN}
    return {name: score(network, pool.read(files[use])) for name, use in judged.items() if files[use]}


def _make(files: list[Shard], processes: int, quiet: bool) -> None:
    from ..training.pool import make

    make(files, processes, _progress("made", quiet))


def _progress(what: str, quiet: bool) -> Progress:
    def tell(done: int, of: int) -> None:
        if not quiet:
            print(f"objects {what}: {done} of {of}", file=sys.stderr, flush=True)

    return tell


def _so_far(plan: TrainingPlan, run: Path) -> NanoNetwork:
    from ..training import checkpoint

    return checkpoint.result(checkpoint.load(plan, run), plan)


class _Printer:
    """Prints rows of the log on stderr, and how long it still takes."""

    def __init__(self, plan: TrainingPlan, quiet: bool) -> None:
        self._plan, self._quiet = plan, quiet
        self._first: NanoRow | None = None

    def __call__(self, row: NanoRow) -> None:
        if self._quiet:
            return
        self._first = self._first or row
        steps, seconds = row.step - self._first.step, row.seconds - self._first.seconds
        left = f"  {seconds / steps * (self._plan.steps - row.step) / 60:.0f} min left" if steps else ""
        terms = " ".join(f"{name} {value:.3f}" for name, value in row.terms.items())
        text = (
            f"step {row.step}/{self._plan.steps}  loss {row.total:.3f} ({terms})  {row.seconds:.0f} s{left}"
        )
        print(text, file=sys.stderr, flush=True)


def _cells(name: str, found: NanoScore) -> tuple[str, ...]:
    shares = (found.together, found.moves, found.kind, found.candidate, found.category)
    return (name, str(found.objects), f"{found.loss:.3f}", *(f"{share:.3f}" for share in shares))
