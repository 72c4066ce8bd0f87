"""`simart-kit dataset build`."""

from __future__ import annotations

import os
import sys
import time
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from simart_kit.cli.common import print_json, print_rows, stdout_kept
from simart_kit.cli.options import Json, Verbose

if TYPE_CHECKING:
    from collections.abc import Callable

    from ..dataset.manifest import Manifest
    from ..dataset.progress import Progress

Out = Annotated[
    Path, typer.Argument(metavar="OUT", help="Folder of the data set; a killed run goes on in it.")
]
Data = Annotated[
    list[Path] | None,
    typer.Option(
        "--data",
        metavar="FOLDER",
        help="Objects with ground truth, in any format that `bench run` reads; repeatable.",
    ),
]
Generate = Annotated[
    list[str] | None,
    typer.Option("--generate", metavar="CATEGORY|all", help="Made-up objects; repeatable."),
]
Count = Annotated[int, typer.Option("--count", "-n", min=1, metavar="N", help="Objects of each category.")]
Seed = Annotated[int, typer.Option(min=0, metavar="N", help="Decides all that is random.")]
States = Annotated[
    int, typer.Option(min=1, metavar="N", help="Poses of an object that moves, that of its source the first.")
]
Pictures = Annotated[
    bool, typer.Option("--pictures/--no-pictures", help="Render each state, 252x252 pixels.")
]
MaxParts = Annotated[int, typer.Option(min=1, metavar="N", help="Leave objects of more parts out.")]
Workers = Annotated[
    int | None,
    typer.Option(min=1, metavar="N", help="Processes; default: one for each processor. Changes no byte."),
]
ShardSize = Annotated[int, typer.Option(min=1, metavar="N", help="Records of a shard, about.")]
Limit = Annotated[int | None, typer.Option(min=1, metavar="N", help="Stop after so many objects.")]
Model = Annotated[
    Path | None,
    typer.Option("--model", metavar="DIR", help="Folder of a voxel model; default: the shipped one."),
]
Quiet = Annotated[bool, typer.Option("--quiet", "-q", help="Say nothing but the result.")]


def dataset_build(
    out: Out,
    data: Data = None,
    generate: Generate = None,
    count: Count = 1,
    seed: Seed = 0,
    states: States = 20,
    pictures: Pictures = True,
    max_parts: MaxParts = 32,
    workers: Workers = None,
    shard_size: ShardSize = 1000,
    limit: Limit = None,
    model: Model = None,
    json: Json = False,
    verbose: Verbose = False,
    quiet: Quiet = False,
) -> None:
    """Make instruction data for the language model: questions and answers about objects in many states.

    Every object that moves is shown in several poses within its limits, static ones once; of each there are
    voxel tokens, a picture, the parts and joints as the answer, and descriptions of single parts. Written as
    WebDataset shards with a manifest. The same options give the same bytes.
    """
    if not (data or generate):
        raise typer.BadParameter("say what to build from: --data FOLDER or --generate CATEGORY|all")
    with stdout_kept(json):
        from ..dataset.building import Build, build, build_options
        from ..dataset.jobs import find_jobs
        from ..default_model import load_model

        jobs = find_jobs(data or (), generate or (), count, seed)
        codec = load_model(model)
        options = build_options(jobs, codec, states, pictures, max_parts, shard_size, limit)
        processes = min(workers or os.cpu_count() or 1, jobs.total)
        report = _silent if quiet else _reporter(min(jobs.total, limit or jobs.total))
        manifest = build(Build(jobs, options, codec.grid, model, processes), out, report)
    if json:
        print_json({"ok": True, "out": str(out), **manifest.model_dump(mode="json")})
        return
    _print(manifest, out, verbose)


def _silent(progress: Progress) -> None:
    """Say nothing."""


def _reporter(total: int) -> Callable[[Progress], None]:
    """Tells how far a build is, on stderr, after each shard; a rate is that of this run."""
    start, first = time.monotonic(), -1

    def report(progress: Progress) -> None:
        nonlocal first
        counts = progress.statistics
        if first < 0:
            first = counts.records - (progress.shards[-1].records if progress.shards else 0)
        rate = (counts.records - first) / max(time.monotonic() - start, 1e-3)
        print(
            f"{counts.objects} of {total} objects, {counts.records} records, {rate:.1f} records/s",
            file=sys.stderr,
            flush=True,
        )

    return report


def _print(manifest: Manifest, out: Path, verbose: bool) -> None:
    from ..dataset.tables import detail_rows, skipped_rows, summary_rows, token_rows

    shards = manifest.shards
    size = sum(shard.bytes for shard in shards) / 2**20
    print(f"{out}: {manifest.statistics.records} records in {len(shards)} shards, {size:.1f} MiB")
    print_rows(summary_rows(manifest.statistics), "  ")
    print("voxel tokens of an object's answer, parts added up")
    print_rows(token_rows(manifest.statistics), "  ")
    if manifest.statistics.skipped:
        print("left out")
        print_rows(skipped_rows(manifest, verbose), "  ")
    if verbose:
        print("records by")
        print_rows(detail_rows(manifest.statistics), "  ")
