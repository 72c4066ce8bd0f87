"""`simart-kit bench vqvae`."""

from __future__ import annotations

import sys
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from simart_kit.cli.common import load_plugins, print_json, print_rows, stdout_kept
from simart_kit.cli.options import Json, PluginFiles, Verbose
from simart_kit.errors import BadInputError

from .train_vqvae import Arithmetic, Device, Quiet, Seed, Threads

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from simart_kit.plugins import Plugins

    from ..ablation.experiment import Ablation, Block
    from ..ablation.variants import Variant
    from ..models import VoxelConfig
    from ..training.config import TrainingConfig
    from ..training.log import LogRow
    from .training_display import Display

Run = Annotated[Path, typer.Option("--run", metavar="DIR", help="Folder of the ablation, with one a row.")]
Config = Annotated[
    str, typer.Option("--config", "-c", metavar="NAME|FILE", help="Preset that all rows start from.")
]
Steps = Annotated[
    int | None, typer.Option(metavar="N", help="Steps of each row; default: those of the preset.")
]
Autoencoder = Annotated[
    int,
    typer.Option(
        min=0,
        metavar="N",
        help="First train encoder and decoder without a codebook for N steps; all rows start from these, "
        "as the paper's do from TRELLIS.",
    ),
]
Procedural = Annotated[int, typer.Option(min=1, metavar="N", help="Generated objects to train on.")]
HeldOut = Annotated[int, typer.Option(min=0, metavar="N", help="Generated objects to judge on.")]
Data = Annotated[
    list[Path] | None,
    typer.Option(
        "--data", metavar="DIR", help="Folder of meshes to judge on, not to train on; may be repeated."
    ),
]
Rows = Annotated[
    str | None,
    typer.Option(
        metavar="NAME,..", help="Of zero, 16x8x8, codebook-x2, force-sparse and dense; default: all."
    ),
]
Resume = Annotated[bool, typer.Option("--resume", help="Go on with this folder; finished rows stay.")]


def bench_vqvae(
    run: Run,
    config: Config = "micro",
    steps: Steps = None,
    autoencoder: Autoencoder = 0,
    procedural: Procedural = 200,
    held_out: HeldOut = 64,
    data: Data = None,
    rows: Rows = None,
    resume: Resume = False,
    seed: Seed = None,
    device: Device = None,
    precision: Arithmetic = None,
    threads: Threads = None,
    plugin: PluginFiles = None,
    json: Json = False,
    verbose: Verbose = False,
    quiet: Quiet = False,
) -> None:
    """Compare configurations of the sparse 3D VQ-VAE.

    Trains each on the same made-up objects for the same number of steps, and prints the paper's two tables:
    how well held-out objects come back, and how many tokens they take. Rows that are done are kept when a run
    that was stopped goes on with --resume.
    """
    if not held_out and not data:
        raise BadInputError("there is nothing to judge on: give --held-out N, --data DIR, or both")
    changes = {
        "seed": seed,
        "device": device,
        "precision": None if precision is None else precision.value,
    }
    with stdout_kept(json):
        from .training_display import Display

        display = Display(quiet)
        plan = _plan(config, steps, autoencoder, changes, rows)
        _check(plan, run, resume)
        _use(threads)
        try:
            objects = _Objects(procedural, held_out, tuple(data or ()), load_plugins(plugin))
            ablation = _performed(plan, objects, run, display, quiet)
        except KeyboardInterrupt:
            print(f"{run} keeps what was done: the same command with --resume goes on", file=sys.stderr)
            raise
        from ..ablation.writing import write

        files = write(ablation, config, run)
    _tell(ablation, config, files, json)


@dataclass(frozen=True)
class _Plan:
    """What is trained, and how."""

    config: VoxelConfig
    training: TrainingConfig
    autoencoder: int
    variants: tuple[Variant, ...]


@dataclass(frozen=True)
class _Objects:
    """What is trained and judged on."""

    procedural: int
    held_out: int
    folders: tuple[Path, ...]
    plugins: Plugins


def _plan(
    config: str, steps: int | None, autoencoder: int, changes: Mapping[str, object], rows: str | None
) -> _Plan:
    from ..ablation.budget import shrunk
    from ..ablation.variants import chosen_variants
    from ..training.presets import read_preset, with_changes

    preset = read_preset(config)
    training = with_changes(shrunk(preset.training, steps), changes)
    return _Plan(preset.config, training, autoencoder, chosen_variants(rows))


def _check(plan: _Plan, run: Path, resume: bool) -> None:
    """Refuse what training would refuse too, but only after the data have been made."""
    from ..ablation.experiment import check_run
    from ..training.device import training_device

    for variant in plan.variants:
        variant.of(plan.config)
    training_device(plan.training.device)
    check_run(run, plan.variants, resume)


def _use(threads: int | None) -> None:
    if threads is not None:
        import torch

        torch.set_num_threads(threads)


def _performed(plan: _Plan, objects: _Objects, run: Path, display: Display, quiet: bool) -> Ablation:
    from ..ablation.autoencoder import autoencoder
    from ..ablation.budget import Budget
    from ..ablation.experiment import perform
    from .training_data import training_grids
    from .training_display import Display

    edge, training = plan.config.resolution, plan.training
    grids = training_grids((), objects.procedural, training.seed, edge, objects.plugins, display.progress)
    blocks = _blocks(objects, edge, display)
    budget = Budget(training, len(grids), grids.fingerprint, plan.autoencoder)
    start = (
        autoencoder(
            plan.config,
            training,
            plan.autoencoder,
            grids,
            run / "autoencoder",
            lambda done, of: display.progress("steps of the autoencoder", done, of),
        )
        if plan.autoencoder
        else None
    )

    def watch(variant: Variant, config: VoxelConfig) -> Callable[[LogRow], None]:
        display.say(f"row {variant.key}: {training.steps} steps on {len(grids)} grids, {training.device}")
        lines, codes = Display(quiet), config.codebook_size - config.first_code
        return lambda row: lines.row(row, training, codes)

    return perform(plan.config, budget, plan.variants, grids, blocks, run, watch, start)


def _blocks(objects: _Objects, edge: int, display: Display) -> list[Block]:
    from ..ablation.experiment import Block
    from .training_data import held_out_grids, training_grids

    found = []
    if objects.held_out:
        grids = held_out_grids(objects.held_out, edge, display.progress)
        found.append(Block("held-out objects", grids))
    for folder in objects.folders:
        grids = training_grids((folder,), 0, 0, edge, objects.plugins, display.progress)
        found.append(Block(str(folder), grids))
    return found


def _tell(ablation: Ablation, config: str, files: tuple[Path, Path], json: bool) -> None:
    from ..ablation.tables import tables, verdict_lines
    from ..ablation.writing import document

    if json:
        print_json({"ok": True, **document(ablation, config), "files": [str(file) for file in files]})
        return
    for table in tables(ablation):
        print(table.title)
        print_rows(table.rows, "  ")
        print("\n".join([*table.notes, ""]))
    print("\n".join(verdict_lines(ablation)))
    print(f"tables: {files[1]}\nnumbers: {files[0]}")
