"""`simart-kit train vqvae`."""

from __future__ import annotations

import sys
from dataclasses import asdict
from enum import StrEnum
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from simart_kit.cli.common import load_plugins, print_json, stdout_kept
from simart_kit.cli.options import Json, PluginFiles, Verbose
from simart_kit.errors import BadInputError

if TYPE_CHECKING:
    from simart_kit.plugins import Plugins

    from .training_run import Order, Outcome


class Precision(StrEnum):
    """Arithmetic of the convolutions."""

    FP32 = "fp32"
    BF16 = "bf16"


Config = Annotated[
    str, typer.Option("--config", "-c", metavar="NAME|FILE", help="Preset, such as nano or full; or a file.")
]
Run = Annotated[Path, typer.Option("--run", metavar="DIR", help="Folder of the run.")]
Data = Annotated[
    list[Path] | None,
    typer.Option("--data", metavar="DIR", help="Folder of meshes to train on; may be repeated."),
]
Procedural = Annotated[
    int, typer.Option("--procedural", min=0, metavar="N", help="Generated objects to train on.")
]
HeldOut = Annotated[
    int, typer.Option(min=0, metavar="N", help="Generated objects to judge the model on; 0: none.")
]
Resume = Annotated[bool, typer.Option("--resume", help="Go on from the run's last checkpoint.")]
Start = Annotated[Path | None, typer.Option(metavar="MODEL", help="Folder of a model to begin with.")]
KeepCodebook = Annotated[
    bool, typer.Option("--keep-codebook", help="Begin with the codes of --start, not with new ones.")
]
Stage1 = Annotated[int | None, typer.Option(metavar="N", help="Steps that train the codebook's side.")]
Stage2 = Annotated[int | None, typer.Option(metavar="N", help="Steps that train all.")]
Batch = Annotated[int | None, typer.Option(metavar="N", help="Grids a step.")]
Rate = Annotated[float | None, typer.Option(metavar="X", help="Step size of AdamW.")]
Seed = Annotated[int | None, typer.Option(metavar="N", help="Decides all that is random.")]
Device = Annotated[str | None, typer.Option(metavar="cpu|cuda", help="Where to compute; also cuda:N.")]
Arithmetic = Annotated[Precision | None, typer.Option(help="Arithmetic of the convolutions.")]
Threads = Annotated[int | None, typer.Option(min=1, metavar="N", help="Processors to use.")]
Quiet = Annotated[bool, typer.Option("--quiet", "-q", help="Say nothing but the result.")]


def train_vqvae(
    config: Config,
    run: Run,
    data: Data = None,
    procedural: Procedural = 0,
    held_out: HeldOut = 64,
    resume: Resume = False,
    start: Start = None,
    keep_codebook: KeepCodebook = False,
    stage1_steps: Stage1 = None,
    stage2_steps: Stage2 = None,
    batch_size: Batch = None,
    learning_rate: Rate = None,
    seed: Seed = None,
    device: Device = None,
    precision: Arithmetic = None,
    threads: Threads = None,
    plugin: PluginFiles = None,
    json: Json = False,
    verbose: Verbose = False,
    quiet: Quiet = False,
) -> None:
    """Train a sparse 3D VQ-VAE, in two stages.

    What is not given is as in the preset. A run that was stopped goes on when the same command is given again
    with --resume, and ends with the weights that it would have had. Voxels of meshes are kept in ~/.cache.
    """
    if keep_codebook and start is None:
        raise BadInputError("--keep-codebook keeps the codes of a model: give it with --start")
    changes = {
        "stage1_steps": stage1_steps,
        "stage2_steps": stage2_steps,
        "batch_size": batch_size,
        "learning_rate": learning_rate,
        "seed": seed,
        "device": device,
        "precision": None if precision is None else precision.value,
        "start_codebook": False if keep_codebook else None,
    }
    with stdout_kept(json):
        from .training_run import Order

        order = Order(config, run, tuple(data or ()), procedural, held_out, resume, start, changes, threads)
        outcome = _performed(order, load_plugins(plugin), quiet)
    _tell(outcome, run, json)


def _performed(order: Order, plugins: Plugins, quiet: bool) -> Outcome:
    from ..training.checkpointing import latest
    from .training_display import Display, advice
    from .training_run import perform

    try:
        return perform(order, plugins, Display(quiet))
    except KeyboardInterrupt:
        print(advice(order.run, latest(order.run)), file=sys.stderr)
        raise


def _tell(outcome: Outcome, run: Path, json: bool) -> None:
    from ..training.log import LOG_FILE
    from .training_display import judged

    scores = outcome.held_out
    if json:
        document = {"ok": True, "model": str(outcome.model), "log": str(run / LOG_FILE)}
        document |= {"steps": outcome.steps, "grids": outcome.grids}
        print_json(document | {"held_out": None if scores is None else asdict(scores)})
        return
    if scores is not None:
        print(f"held-out: {judged(scores)} ({scores.count} grids)")
    print(f"model: {outcome.model}")
    print(f"log: {run / LOG_FILE}")
