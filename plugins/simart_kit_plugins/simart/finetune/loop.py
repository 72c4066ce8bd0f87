"""The fine-tuning of a language model on instruction data."""

from __future__ import annotations

import contextlib
from collections.abc import Callable
from dataclasses import astuple, dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING

from simart_kit.errors import BadInputError, OutputError
from simart_kit.output import claimed

from ..mllm.extra import quiet
from ..mllm.saving import save_bundle
from ..mllm.simart_model import SimartModel
from . import checkpointing
from .adapters import Model, trainable
from .choices import Rows
from .examples import ExampleMaker
from .lanes import Lane, Place
from .log import LOG_FILE, CsvLog
from .machine import machine, sharded, whole_state
from .objective import Objective
from .optimiser import make_optimiser, set_rate, trained_tensors
from .plan import FinetunePlan, write_plan
from .records import Records
from .rows import LOG_COLUMNS, LogRow, Window
from .step import DivergedError, agreed, train_step
from .stopping import StopRequest, stop_requests

if TYPE_CHECKING:
    from accelerate import Accelerator
    from torch.optim import AdamW

PLAN_FILE, MODEL_FOLDER, BASE_FOLDER = "plan.json", "model", "base"
Observer = Callable[[LogRow], None]
Judge = Callable[[SimartModel, int], None]


@dataclass(frozen=True, eq=False)
class _Run:
    """All that steps need."""

    folder: Path
    plan: FinetunePlan
    bundle: SimartModel
    records: Records
    accelerator: Accelerator
    objective: Objective
    optimiser: AdamW
    lanes: tuple[Lane, ...]
    step: int
    tokens: int

    @property
    def shared_out(self) -> bool:
        """Whether no process has all the weights."""
        return self.plan.fsdp and self.accelerator.num_processes > 1


def finetune(
    bundle: SimartModel,
    records: Records,
    plan: FinetunePlan,
    run: Path,
    *,
    resume: bool = False,
    device: str = "auto",
    observer: Observer | None = None,
    judge: Judge | None = None,
) -> Path:
    """Train a model, from its weights or from the last checkpoint of the run.

    The same model, records and plan give the same weights, whether or not the run was stopped and gone on
    with, on one kind of device with one version of torch and one number of processes. A step is the same
    for any number of processes, but for rounding.

    Args:
        bundle: the model to begin with; its weights are changed.
        records: what to train on.
        plan: schedule, data and arithmetic.
        run: folder of the run: plan.json, log.csv, checkpoints/ and model/, the newest evaluated bundle.
        resume: go on from the last checkpoint; without one the run begins.
        device: auto, cpu or cuda.
        observer: told each row of the log.
        judge: given the model when it is to be evaluated, and the steps done; not while weights are
            shared out.

    Returns:
        Folder of the trained model, `run`/model; with low-rank adapters these alone, beside their base.

    Raises:
        BadInputError: the folder has a run and `resume` is off or does not fit, the plan does not fit the
            machine, no example is short enough, or a loss is not finite: checkpoints then stay as they are.
        OutputError: the folder cannot be written, or another run is writing to it.
        KeyboardInterrupt: somebody stopped the run; a checkpoint was written first.
    """
    _make(run)
    with machine(plan, device) as accelerator, stop_requests() as request:
        alone = claimed(run) if accelerator.is_main_process else contextlib.nullcontext()
        with alone:
            begun = _begin(bundle, records, plan, run, resume, accelerator)
            _take_steps(begun, request, observer, judge)
            return _finished(begun)


def _make(run: Path) -> None:
    try:
        run.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise OutputError(f"cannot write the run to {run}: {error.strerror}") from error


def check_run(run: Path, resume: bool) -> Path | None:
    """The checkpoint to go on from; raises BadInputError for a run that is there and not to be resumed."""
    found = checkpointing.latest(run)
    if found is not None and not resume:
        raise BadInputError(
            f"{run} has a run already, up to {found.name}: go on with --resume, or choose another --run"
        )
    return found


def _begin(
    bundle: SimartModel,
    records: Records,
    plan: FinetunePlan,
    run: Path,
    resume: bool,
    accelerator: Accelerator,
) -> _Run:
    checkpoint = check_run(run, resume)
    bundle = _asked_as_trained(bundle, plan)
    maker = ExampleMaker(bundle, plan)
    if plan.lora is not None and bundle.folder is None and not bundle.settings.base:
        if accelerator.is_main_process:
            save_bundle(bundle, run / BASE_FOLDER)
        bundle = replace(bundle, folder=run / BASE_FOLDER)
    bundle = replace(bundle, model=_trainable(bundle, plan))
    objective, optimiser = _prepared(bundle, plan, accelerator)
    start = state = _state(plan, bundle, records, accelerator, 0, 0, [Place()] * plan.lanes)
    if checkpoint is not None:
        state = checkpointing.read_state(checkpoint, start)
        tensors = trained_tensors(objective, optimiser)
        checkpointing.read_share(checkpoint, accelerator.process_index, tensors)
    elif accelerator.is_main_process:
        write_plan(plan, run / PLAN_FILE)
    own = range(accelerator.process_index, plan.lanes, accelerator.num_processes)
    lanes = tuple(Lane(records, maker, plan, number, state.place(number)) for number in own)
    return _Run(
        run, plan, bundle, records, accelerator, objective, optimiser, lanes, state.step, state.tokens
    )


def _asked_as_trained(bundle: SimartModel, plan: FinetunePlan) -> SimartModel:
    """The bundle with settings that tell how it is trained."""
    shown = {"prompt": plan.prompt, "picture": plan.picture_share > 0}
    remarks = {"steps": plan.steps, "size": plan.size, "seed": plan.seed, "batch_tokens": plan.batch_tokens}
    update = {**shown, "training": {**bundle.settings.training, **remarks}}
    return replace(bundle, settings=bundle.settings.model_copy(update=update))


def _trainable(bundle: SimartModel, plan: FinetunePlan) -> Model:
    """The bundle's model as the plan trains it."""
    import torch

    bundle.model.to(torch.bfloat16 if plan.weights == "bf16" else torch.float32)
    model = trainable(bundle.model, bundle.vocabulary, plan).train()
    if plan.checkpoint_layers:
        with quiet():  # transformers 5 renames it, and warns of the name that 4 and 5 share
            model.gradient_checkpointing_enable(gradient_checkpointing_kwargs={"use_reentrant": False})
    return model


def _prepared(bundle: SimartModel, plan: FinetunePlan, accelerator: Accelerator) -> tuple[Objective, AdamW]:
    """The model on this process's device, and a fresh optimiser."""
    shared_out = plan.fsdp and accelerator.num_processes > 1
    rows = Rows.of(bundle.vocabulary) if plan.constrained else None
    objective = Objective(bundle.model, rows, always_see=shared_out)
    if shared_out:
        sharded(objective, plan, accelerator)
    else:
        objective.to(accelerator.device)
    return objective, make_optimiser(objective, plan)


def _take_steps(run: _Run, request: StopRequest, observer: Observer | None, judge: Judge | None) -> None:
    plan, main = run.plan, run.accelerator.is_main_process
    log = CsvLog(run.folder / LOG_FILE, LOG_COLUMNS, run.step) if main else None
    spent = float(log.last[-1]) if log is not None and log.last is not None else 0.0
    window = Window(run.tokens, spent)
    for step in range(run.step, plan.steps):
        set_rate(run.optimiser, plan.rate(step))
        taken = [lane.take() for lane in run.lanes]
        try:
            sums, norm = train_step(run.objective, run.optimiser, taken, plan, run.accelerator)
        except DivergedError as error:
            raise BadInputError(_advice(error, step, run)) from error
        window.add(sums)
        done, last = step + 1, step + 1 == plan.steps
        if last or done % plan.log_every == 0:
            row = window.close(done, plan.rate(step), norm)
            if log is not None:
                log.add(astuple(row))
                if observer is not None:
                    observer(row)
        stop = agreed(request.asked, run.accelerator)
        if stop or last or done % plan.checkpoint_every == 0:
            _keep(run, done, window.tokens)
        if stop and not last:
            raise KeyboardInterrupt
        if not last and plan.evaluate_every and done % plan.evaluate_every == 0:
            _judge(run, done, judge)


def _judge(run: _Run, step: int, judge: Judge | None) -> None:
    """Keep the model of this moment and have it judged; shared-out weights wait for the end."""
    if run.shared_out:
        return
    if run.accelerator.is_main_process:
        save_bundle(run.bundle, run.folder / MODEL_FOLDER)
        if judge is not None:
            run.objective.eval()
            judge(run.bundle, step)
            run.objective.train()
    run.accelerator.wait_for_everyone()


def _finished(run: _Run) -> Path:
    """Write the model, in one piece, by the first process."""
    folder = run.folder / MODEL_FOLDER
    weights = whole_state(run.objective.model) if run.shared_out else None
    if run.accelerator.is_main_process:
        run.objective.eval()
        save_bundle(run.bundle, folder, weights=weights)
    run.accelerator.wait_for_everyone()
    return folder


def _keep(run: _Run, step: int, tokens: int) -> None:
    """Write a checkpoint: every process its share, the first one the state."""
    from accelerate.utils import gather_object

    tensors = trained_tensors(run.objective, run.optimiser)
    checkpointing.write_share(run.folder, step, run.accelerator.process_index, tensors)
    numbers = range(run.accelerator.process_index, run.plan.lanes, run.accelerator.num_processes)
    places = dict(gather_object([(n, lane.place) for n, lane in zip(numbers, run.lanes, strict=True)]))
    run.accelerator.wait_for_everyone()
    if run.accelerator.is_main_process:
        ordered = [places[number] for number in range(run.plan.lanes)]
        state = _state(run.plan, run.bundle, run.records, run.accelerator, step, tokens, ordered)
        checkpointing.publish(run.folder, state)
    run.accelerator.wait_for_everyone()


def _state(
    plan: FinetunePlan,
    bundle: SimartModel,
    records: Records,
    accelerator: Accelerator,
    step: int,
    tokens: int,
    places: list[Place],
) -> checkpointing.State:
    return checkpointing.State(
        schema=1,
        step=step,
        tokens=tokens,
        data=records.fingerprint,
        model=bundle.settings.identity,
        processes=accelerator.num_processes,
        places=tuple((place.epoch, place.pool, place.batch) for place in places),
        plan=plan,
    )


def _advice(error: DivergedError, step: int, run: _Run) -> str:
    kept = checkpointing.latest(run.folder)
    good = "no checkpoint was written yet" if kept is None else f"the last good checkpoint is {kept}"
    return (
        f"{error} at step {step + 1} ({run.plan.precision}): {good}; "
        f"lower learning_rate, now {run.plan.learning_rate:g}, and train into another folder"
    )
