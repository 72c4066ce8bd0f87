"""`simart-kit bench oracle`."""

from __future__ import annotations

import sys
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from simart_kit.bench.numbers import counted, number
from simart_kit.cli.bench.options import Data, Variant
from simart_kit.cli.common import load_plugins, print_json, print_rows, stdout_kept
from simart_kit.cli.options import Json, PluginFiles, Verbose
from simart_kit.errors import OutputError

if TYPE_CHECKING:
    from collections.abc import Sequence

    from ..oracle.judging import PartResult
    from ..oracle.ladder import Ladder

Model = Annotated[
    Path | None,
    typer.Option(metavar="DIR", help="Folder of nano's weights; without, the steps that need none."),
]
Out = Annotated[
    Path | None, typer.Option("--out", "-o", metavar="FILE", help="Write the numbers of all parts as JSON.")
]


def oracle(
    data: Data,
    variant: Variant = "input",
    model: Model = None,
    out: Out = None,
    plugin: PluginFiles = None,
    json: Json = False,
    verbose: Verbose = False,
) -> None:
    """Tell where the segmenter nano loses parts and joints, step by step.

    Each step puts something of nano's in the place of the truth: its pieces; then its best joint candidates;
    with --model also the joints that the network chooses for true parts, and at last all that it says. -v
    adds a line an object.
    """
    with stdout_kept(json):
        from ..oracle.totals import kind_shares, rungs

        _check(out)
        found, skipped = _climbed(data, variant, model, plugin)
        total, kinds = rungs(found), kind_shares(found)
        document = {
            "ok": True,
            "data": data.resolve().name,
            "variant": variant,
            "model": None if model is None else str(model),
            "ladder": [asdict(rung) for rung in total],
            "candidates": {kind: asdict(share) for kind, share in kinds.items()},
            "objects": [_object(one) for one in found],
            "skipped": skipped,
        }
        if out is not None:
            _write(out, document)
    if json:
        print_json(document)
        return
    if verbose:
        print("\n".join(_line(one) for one in found))
    print(f"{counted(len(found), 'object')}, {_moving(found)}, {len(skipped)} skipped")
    print_rows([_HEAD, *((rung.step, *_cells(rung)) for rung in total)], "  ")
    print("right candidates")
    print_rows([(kind, f"{share.right} of {share.parts}") for kind, share in kinds.items()], "  ")


_HEAD = ("", "part IoU", "parts kept", "Type", "joints right", "invented")


def _climbed(
    data: Path, variant: str, model: Path | None, plugin: list[Path] | None
) -> tuple[list[Ladder], dict[str, str]]:
    """The objects, and why others were skipped, which is told at once."""
    from ..oracle.ladder import Ladder, ladders

    found: list[Ladder] = []
    skipped: dict[str, str] = {}
    for one in ladders(data, load_plugins(plugin), variant, model):
        if isinstance(one, Ladder):
            found.append(one)
        else:
            skipped[one[0]] = one[1]
            print(f"{one[0]}: skipped: {one[1]}", file=sys.stderr, flush=True)
    return found, skipped


def _check(out: Path | None) -> None:
    """Refuse a file that cannot be written before anything is computed."""
    if out is not None and (out.is_dir() or not out.absolute().parent.is_dir()):
        reason = "it is a folder" if out.is_dir() else "its folder does not exist"
        raise OutputError(f"cannot write {out}: {reason}; choose another file with --out")


def _write(out: Path, document: dict[str, Any]) -> None:
    from simart_kit.provenance import write_json

    draft = out.with_name(f".{out.name}")
    try:
        write_json(draft, document)
        draft.replace(out)
    except OSError as error:
        raise OutputError(f"cannot write {out}: {error.strerror or error}") from error


def _object(one: Ladder) -> dict[str, Any]:
    steps = {
        step: {"iou": judged.iou, "type": judged.type, **asdict(judged)} for step, judged in one.steps.items()
    }
    return {"name": one.name, "category": one.category, "steps": steps}


def _moving(found: Sequence[Ladder]) -> str:
    return counted(sum(len(next(iter(one.steps.values())).parts) for one in found), "moving part")


def _line(one: Ladder) -> str:
    """An object: part IoU and right joints a step, and which parts lack a candidate."""
    from ..oracle.totals import lacking

    steps = [
        f"{step} {judged.iou:.3f} {sum(part.joint for part in judged.parts)}/{len(judged.parts)}"
        for step, judged in one.steps.items()
    ]
    missing = [f"{part.name} ({part.kind}{_far(part)})" for part in lacking(one)]
    return "  ".join([one.name, *steps, *(["no candidate:", ", ".join(missing)] if missing else [])])


def _far(part: PartResult) -> str:
    """How far off the best candidate is; there is none for a part without pieces, or with all of them."""
    import numpy as np

    if part.axis is None:
        return ", no pieces"
    line = "" if part.line is None else f", line {part.line:.3f}"
    return f", axis {np.rad2deg(part.axis):.0f} deg{line}"


def _cells(rung: Any) -> tuple[str, ...]:
    shares = (rung.iou, rung.kept, rung.type, rung.joints)
    return (*(number(share) for share in shares), str(rung.invented))
