"""`simart-kit model evaluate`."""

from __future__ import annotations

from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from simart_kit.cli.common import load_plugins, print_json, print_rows, stdout_kept
from simart_kit.cli.options import Json, PluginFiles, Verbose
from simart_kit.errors import BadInputError

from .train_vqvae import Quiet

if TYPE_CHECKING:
    from ..training.scores import Score

Model = Annotated[
    Path | None, typer.Argument(metavar="MODEL", help="Folder of a voxel model; default: the shipped one.")
]
HeldOut = Annotated[
    int, typer.Option(min=0, metavar="N", help="Generated objects, of a seed that training cannot have.")
]
Data = Annotated[
    list[Path] | None, typer.Option("--data", metavar="DIR", help="Folder of meshes; may be repeated.")
]
_HEAD = ("", "grids", "IoU", "CD x1e5", "MSE x1e5", "tokens", "empty", "codes used", "perplexity")


def evaluate_model(
    model: Model = None,
    held_out: HeldOut = 64,
    data: Data = None,
    plugin: PluginFiles = None,
    json: Json = False,
    verbose: Verbose = False,
    quiet: Quiet = False,
) -> None:
    """Score a voxel model: how well objects and parts come back from their tokens.

    IoU, CD and MSE are of voxels at 64^3 and means over grids; CD is the sum of the two mean squared
    distances, with the side of the cube as 1. Tokens are cells that need one, empty the share that needs
    none. Do not take what the model was trained on as --data.
    """
    if not held_out and not data:
        raise BadInputError("there is nothing to evaluate on: give --held-out N, --data DIR, or both")
    with stdout_kept(json):
        scores = _scores(model, held_out, data or [], plugin, quiet)
    if json:
        found = {name: [asdict(score) for score in rows] for name, rows in scores.items()}
        print_json({"ok": True, "scores": found})
        return
    for name, rows in scores.items():
        print(name)
        print_rows([_HEAD, *map(_cells, rows)], indent="  ")


def _scores(
    model: Path | None, held_out: int, data: list[Path], plugin: list[Path] | None, quiet: bool
) -> dict[str, tuple[Score, ...]]:
    """Scores by the name of what they are on."""
    from ..default_model import default_model_folder
    from ..training.scores import score
    from ..vqvae.checkpoint import load_checkpoint
    from .training_data import folder_grids, held_out_grids
    from .training_display import Display

    loaded = load_checkpoint(default_model_folder() if model is None else model)
    plugins, display = load_plugins(plugin), Display(quiet)
    edge = loaded.config.resolution
    grids = {str(folder): folder_grids(folder, edge, plugins, display.progress) for folder in data}
    if held_out:
        grids["generated objects"] = held_out_grids(held_out, edge, display.progress)
    return {name: score(loaded, found) for name, found in grids.items()}


def _cells(score: Score) -> tuple[str, ...]:
    evaluation = score.evaluation
    return (
        score.kind,
        str(evaluation.count),
        f"{evaluation.iou:.4f}",
        f"{evaluation.cd_squared * 1e5:.2f}",
        f"{evaluation.mse * 1e5:.1f}",
        f"{score.tokens:.1f}",
        f"{score.empty:.1%}",
        f"{evaluation.usage.used} of {evaluation.usage.entries}",
        f"{evaluation.usage.perplexity:.0f}",
    )
