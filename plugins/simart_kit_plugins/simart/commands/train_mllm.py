"""`simart-kit train mllm`."""

from __future__ import annotations

import sys
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from simart_kit.cli.common import print_json, stdout_kept
from simart_kit.cli.options import Json, Verbose

from .train_vqvae import Arithmetic, Quiet, Seed, Threads

if TYPE_CHECKING:
    from ..finetune.run import Order, Outcome

Config = Annotated[
    str, typer.Option("--config", "-c", metavar="NAME|FILE", help="Preset: tiny, 2b or 8b; or a file.")
]
Run = Annotated[Path, typer.Option("--run", metavar="DIR", help="Folder of the run.")]
Data = Annotated[
    list[Path],
    typer.Option("--data", metavar="DIR", help="Instruction data, made with `dataset build`; repeatable."),
]
HeldOut = Annotated[
    Path | None,
    typer.Option(metavar="DIR", help="Data to judge on; default: some objects of --data are kept out."),
]
Start = Annotated[Path | None, typer.Option(metavar="MODEL", help="Folder of a SIMART model to begin with.")]
Codec = Annotated[
    Path | None, typer.Option(metavar="DIR", help="Voxel model of the codes; default: the shipped one.")
]
Resume = Annotated[bool, typer.Option("--resume", help="Go on from the run's last checkpoint.")]
Steps = Annotated[int | None, typer.Option(metavar="N", help="Steps of the optimiser.")]
Tokens = Annotated[int | None, typer.Option(metavar="N", help="Most tokens of a batch.")]
Longest = Annotated[int | None, typer.Option(metavar="N", help="Longer examples are left out.")]
Rate = Annotated[float | None, typer.Option(metavar="X", help="Highest step size of AdamW.")]
Pictures = Annotated[
    float | None, typer.Option(metavar="SHARE", help="Examples that are shown with their picture, 0..1.")
]
Judged = Annotated[int | None, typer.Option(metavar="N", help="Held-out records to answer; 0: none.")]
Every = Annotated[int | None, typer.Option(metavar="N", help="Steps between evaluations; 0: at the end.")]
Device = Annotated[str, typer.Option(metavar="auto|cpu|cuda", help="Where to compute.")]


def train_mllm(
    config: Config,
    data: Data,
    run: Run,
    held_out: HeldOut = None,
    resume: Resume = False,
    start: Start = None,
    codec: Codec = None,
    steps: Steps = None,
    batch_tokens: Tokens = None,
    longest: Longest = None,
    learning_rate: Rate = None,
    picture_share: Pictures = None,
    evaluated: Judged = None,
    evaluate_every: Every = None,
    seed: Seed = None,
    device: Device = "auto",
    precision: Arithmetic = None,
    threads: Threads = None,
    json: Json = False,
    verbose: Verbose = False,
    quiet: Quiet = False,
) -> None:
    """Fine-tune a Qwen3-VL on instruction data.

    What is not given is as in the preset. Several processes, started with `accelerate launch` or `torchrun`,
    share the work. A run that was stopped goes on when the same command is given again with --resume, and
    ends with the weights that it would have had.
    """
    changes = {
        "steps": steps,
        "batch_tokens": batch_tokens,
        "longest": longest,
        "learning_rate": learning_rate,
        "picture_share": picture_share,
        "evaluated": evaluated,
        "evaluate_every": evaluate_every,
        "seed": seed,
        "precision": None if precision is None else precision.value,
    }
    with stdout_kept(json):
        from ..finetune.run import Order

        order = Order(config, tuple(data), run, held_out, resume, start, codec, changes, device, threads)
        outcome = _performed(order, quiet)
    if outcome is not None:
        _tell(outcome, json)


def _performed(order: Order, quiet: bool) -> Outcome | None:
    from ..finetune.checkpointing import latest
    from ..finetune.display import row_line
    from ..finetune.run import perform
    from .training_display import Display, advice

    display = Display(quiet)
    try:
        return perform(order, display.say, lambda row, plan: display.say(row_line(row, plan)))
    except KeyboardInterrupt:
        print(advice(order.run, latest(order.run)), file=sys.stderr)
        raise


def _tell(outcome: Outcome, json: bool) -> None:
    from ..finetune.run import score_lines

    if json:
        document = {"ok": True, "model": str(outcome.model), "log": str(outcome.log)}
        scores = {name: asdict(score) for name, score in outcome.scores.items()}
        print_json(document | {"steps": outcome.steps, "scores": scores})
        return
    print("\n".join(score_lines(outcome.scores)))
    print(f"model: {outcome.model}\nlog: {outcome.log}")
