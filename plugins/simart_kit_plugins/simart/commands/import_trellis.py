"""`simart-kit model import-trellis`."""

from __future__ import annotations

from enum import StrEnum
from pathlib import Path
from shlex import quote
from typing import Annotated

import typer

from simart_kit.cli.common import print_json, stdout_kept
from simart_kit.cli.options import Json, Verbose

from .model_folder import check_folder, put_model


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
        check_folder(out)
        from ..vqvae.config import VqvaeConfig
        from ..vqvae.trellis import import_trellis as imported

        config = VqvaeConfig(grid=grid.value, codebook_size=int(codebook.value))
        model = imported(encoder, decoder, config)
        put_model(model, out)
    parameters = sum(parameter.numel() for parameter in model.parameters())
    following = _next(out, grid, codebook)
    if json:
        document = {"ok": True, "model": str(out), "parameters": parameters, "next": following}
        print_json(document | {"grid": grid.value, "codebook": config.codebook_size})
        return
    print(f"{out}: {parameters:,} parameters, {grid.value} tokens, {config.codebook_size} codes")
    print(f"Its codes are still random. {following}")


def _next(out: Path, grid: Grid, codebook: Codebook) -> str:
    name = {
        (Grid.CUBE, Codebook.PAPER): "full",
        (Grid.LONG, Codebook.PAPER): "full-16x8x8",
        (Grid.CUBE, Codebook.DOUBLE): "full-8192",
    }.get((grid, codebook), "FILE")
    command = f"simart-kit train vqvae --config {name} --start {quote(str(out))} --data DIR --run DIR"
    advice = " (FILE: a preset with this grid and codebook)" if name == "FILE" else ""
    return f"Train it, stage 1 first: {command}{advice}"
