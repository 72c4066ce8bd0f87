"""Options that `bench run` and `bench score` share."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

OUT = Path("out/bench")

Data = Annotated[Path, typer.Argument(metavar="DATA", help="Folder of objects with ground truth.")]
Run = Annotated[Path, typer.Argument(metavar="DIR", help="Folder of a benchmark run.")]
ProtocolName = Annotated[
    str, typer.Option(metavar="NAME", help="How to score: simart, particulate, s2o or urdf-anything.")
]
Variant = Annotated[
    str,
    typer.Option(metavar="NAME", help="A mesh NAME.glb beside input.glb of SIMART-Bench objects."),
]
Out = Annotated[
    Path, typer.Option("--out", "-o", metavar="DIR", help="Folder of the run; one begun is gone on with.")
]
Only = Annotated[
    list[str] | None,
    typer.Option(metavar="PATTERN", help="Only objects named so, such as 'fridge*'; may be repeated."),
]
Jobs = Annotated[
    int | None,
    typer.Option("--jobs", "-j", min=1, metavar="N", help="Objects at a time; default: one a processor."),
]
Timeout = Annotated[
    float, typer.Option(min=0, metavar="SECONDS", help="Longest time of an object; 0: no limit.")
]
NoPictures = Annotated[bool, typer.Option("--no-pictures", help="Draw no pictures for the page.")]
Retry = Annotated[bool, typer.Option("--retry", help="Do objects again that failed.")]
Quiet = Annotated[bool, typer.Option("--quiet", "-q", help="Say nothing but errors.")]
