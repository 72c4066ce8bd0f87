"""`simart-kit model import-trellis`."""

from __future__ import annotations

import shutil
from enum import StrEnum
from pathlib import Path
from shlex import quote
from tempfile import mkdtemp
from typing import TYPE_CHECKING, Annotated

import typer

from simart_kit.cli.common import print_json, stdout_kept
from simart_kit.cli.options import Json, Verbose
from simart_kit.errors import BadInputError, OutputError

if TYPE_CHECKING:
    from ..vqvae.model import SparseVQVAE


class Grid(StrEnum):
    """Grids of the paper, with the preset of `train vqvae` that has each."""

    CUBE = "8x8x8"
    LONG = "16x8x8"


class Codebook(StrEnum):
    """Codebook sizes of the paper."""

    PAPER = "4096"
    DOUBLE = "8192"


Encoder = Annotated[
    Path, typer.Argument(metavar="ENCODER", help="TRELLIS' ss_enc_conv3d_16l8_fp16.safetensors.")
]
Decoder = Annotated[
    Path, typer.Argument(metavar="DECODER", help="TRELLIS' ss_dec_conv3d_16l8_fp16.safetensors.")
]
Out = Annotated[
    Path, typer.Argument(metavar="OUT", help="Folder to write; a model that it holds is replaced.")
]


def import_trellis(
    encoder: Encoder,
    decoder: Decoder,
    out: Out,
    grid: Annotated[Grid, typer.Option(help="Tokens along x, y and z.")] = Grid.CUBE,
    codebook: Annotated[Codebook, typer.Option(help="Codes.")] = Codebook.PAPER,
    json: Json = False,
    verbose: Verbose = False,
) -> None:
    """Make a sparse 3D VQ-VAE of TRELLIS' published weights.

    Its encoder and decoder are those of TRELLIS' sparse-structure VAE, in float32. Its codes are still
    random: train it before use.
    """
    with stdout_kept(json):
        _check_out(out)
        from ..vqvae.config import VqvaeConfig
        from ..vqvae.trellis import import_trellis as imported

        config = VqvaeConfig(grid=grid.value, codebook_size=int(codebook.value))
        model = imported(encoder, decoder, config)
        _put(model, out)
    parameters = sum(parameter.numel() for parameter in model.parameters())
    following = _next(out, grid, codebook)
    if json:
        document = {"ok": True, "model": str(out), "parameters": parameters, "next": following}
        print_json(document | {"grid": grid.value, "codebook": config.codebook_size})
        return
    print(f"{out}: {parameters:,} parameters, {grid.value} tokens, {config.codebook_size} codes")
    print(f"Its codes are still random. {following}")


def _check_out(out: Path) -> None:
    """Refuse a folder with anything but a model of this kind, and a file."""
    from ..vqvae.checkpoint import CONFIG_FILE, WEIGHTS_FILE
    from ..vqvae.config_file import read_config

    if out.exists() and not out.is_dir():
        raise BadInputError(f"{out} is a file: choose a folder")
    names = {path.name for path in out.iterdir()} if out.is_dir() else set()
    other = sorted(names - {CONFIG_FILE, WEIGHTS_FILE})
    if other:
        raise BadInputError(
            f"{out} holds other things than a model, such as {other[0]}: choose another folder"
        )
    if names:
        read_config(out / CONFIG_FILE)


def _put(model: SparseVQVAE, out: Path) -> None:
    """Write the model beside its place and move it in, so that nothing half-written is ever there."""
    from ..vqvae.checkpoint import save_checkpoint

    place = out.resolve()
    try:
        place.parent.mkdir(parents=True, exist_ok=True)
        aside = Path(mkdtemp(prefix=f".{place.name}-", dir=place.parent))
    except OSError as error:
        raise OutputError(f"cannot write the model to {out}: {error.strerror}") from error
    try:
        _swap(save_checkpoint(model, aside / "new"), place, aside / "old")
    except OSError as error:
        raise OutputError(f"cannot write the model to {out}: {error.strerror}") from error
    finally:
        shutil.rmtree(aside, ignore_errors=True)


def _swap(new: Path, place: Path, old: Path) -> None:
    """Move a folder into a place; what was there goes to `old`, or stays if the move fails."""
    if place.exists():
        place.rename(old)
    try:
        new.rename(place)
    except OSError:
        if old.exists():
            old.rename(place)
        raise


def _next(out: Path, grid: Grid, codebook: Codebook) -> str:
    name = {
        (Grid.CUBE, Codebook.PAPER): "full",
        (Grid.LONG, Codebook.PAPER): "full-16x8x8",
        (Grid.CUBE, Codebook.DOUBLE): "full-8192",
    }.get((grid, codebook), "FILE")
    command = f"simart-kit train vqvae --config {name} --start {quote(str(out))} --data DIR --run DIR"
    advice = " (FILE: a preset with this grid and codebook)" if name == "FILE" else ""
    return f"Train it, stage 1 first: {command}{advice}"
