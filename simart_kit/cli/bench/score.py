"""`simart-kit bench score`."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Literal

import typer

from ...errors import BadInputError
from ..common import stdout_kept
from ..options import Json, Verbose
from .options import (
    OUT,
    Data,
    Jobs,
    NoPictures,
    Only,
    Out,
    ProtocolName,
    Quiet,
    Retry,
    Timeout,
    Variant,
)

Up = Annotated[
    Literal["+x", "-x", "+y", "-y", "+z", "-z"] | None,
    typer.Option(
        metavar="+x|-x|..|-z",
        help="Up axis of predictions, where it is not the truth's: for URDF and Articulate-AnyMesh "
        "predictions, which do not tell their frame.",
    ),
]
Fit = Annotated[
    Literal["none", "box"],
    typer.Option(
        metavar="none|box",
        help="box: scale and move such predictions into the truth's box.",
    ),
]


def score(
    data: Data,
    predictions: Annotated[
        Path, typer.Argument(metavar="PREDICTIONS", help="Folder with a prediction an object.")
    ],
    variant: Variant = "input",
    protocol: ProtocolName = "simart",
    up: Up = None,
    fit: Fit = "none",
    out: Out = OUT,
    only: Only = None,
    jobs: Jobs = None,
    timeout: Timeout = 600.0,
    no_pictures: NoPictures = False,
    retry: Retry = False,
    json: Json = False,
    verbose: Verbose = False,
    quiet: Quiet = False,
) -> None:
    """Score predictions that exist, of this or of any other system.

    An object without a prediction counts with the worst scores. A run that was stopped goes on where it was
    when the same command is given again. The exit code is 1 if no object could be scored.
    """
    with stdout_kept(json):
        from ...bench.frame import Placement
        from ...bench.run import Plan
        from ...bench.worker import Predictions
        from ...machine import usable_cores
        from .perform import perform, tell

        if predictions.is_file():
            raise BadInputError(f"{predictions} is a file: give its folder")
        if not predictions.is_dir():
            raise BadInputError(f"no such folder: {predictions}")
        folder = predictions.resolve()
        plan = Plan(
            data=data,
            out=out,
            system=Predictions(f"predictions {folder.name}", folder, Placement(up, fit)),
            protocol=protocol,
            variant=variant,
            only=tuple(only or ()),
            jobs=jobs or usable_cores(),
            timeout=timeout,
            pictures=not no_pictures,
            retry=retry,
        )
        outcome = perform(plan, quiet)
    tell(plan, outcome, json, quiet, verbose)
