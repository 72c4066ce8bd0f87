"""`simart-kit bench mllm`."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from simart_kit.cli.common import print_json, print_rows, stdout_kept
from simart_kit.cli.options import Json, Verbose
from simart_kit.errors import BadInputError

from .train_mllm import Codec, Data, Device, Longest, Rate, Tokens
from .train_vqvae import Arithmetic, Quiet, Seed, Threads

if TYPE_CHECKING:
    from collections.abc import Mapping

    from ..comparing.experiment import Comparison
    from ..comparing.training import Budget
    from ..finetune.plan import FinetunePlan

Out = Annotated[Path, typer.Argument(metavar="OUT", help="Folder of the results.")]
Rows = Annotated[
    str | None,
    typer.Option(metavar="NAME,..", help="Of dense, force-sparse, zero-sparse and vision; default: all."),
]
Steps = Annotated[
    int | None, typer.Option(min=0, metavar="N", help="Steps of each row; 0 counts tokens only.")
]
Minutes = Annotated[
    float | None, typer.Option(metavar="M", help="Time for each row's steps, in place of --steps.")
]
Size = Annotated[str, typer.Option(metavar="NAME|FILE", help="Size of the model: tiny, 2b, 8b; or a file.")]
Judged = Annotated[int, typer.Option(min=1, metavar="N", help="Held-out objects to judge on.")]
Counted = Annotated[int, typer.Option(min=1, metavar="N", help="Records whose tokens are counted.")]
WithoutZero = Annotated[
    Path | None,
    typer.Option(metavar="DIR", help="Voxel model of mode dense, for row force-sparse; default: train one."),
]
CodecSteps = Annotated[int, typer.Option(min=1, metavar="N", help="Steps of its training.")]

_STEPS, _WHEN_TIMED, _POOL, _LONGEST = 300, 1000, 64, 4096
_HELD_OUT = 0.1


def bench_mllm(
    out: Out,
    data: Data,
    rows: Rows = None,
    steps: Steps = None,
    minutes: Minutes = None,
    size: Size = "tiny",
    judged: Judged = 24,
    counted: Counted = 300,
    batch_tokens: Tokens = None,
    longest: Longest = None,
    learning_rate: Rate = None,
    codec: Codec = None,
    codec_without_zero: WithoutZero = None,
    codec_steps: CodecSteps = 100,
    seed: Seed = None,
    device: Device = "auto",
    precision: Arithmetic = None,
    threads: Threads = None,
    json: Json = False,
    verbose: Verbose = False,
    quiet: Quiet = False,
) -> None:
    """Compare forms of voxel sequences: the paper's ablation of the language model.

    Trains a model for each row with the same budget, on the same records in the same order, and prints the
    paper's table: types, centres, IoU and CD of held-out objects, and the tokens of an answer.
    """
    if steps is not None and minutes is not None:
        raise BadInputError("--steps and --minutes are two budgets: give one of them")
    if minutes is not None and minutes <= 0:
        raise BadInputError(f"--minutes {minutes:g}: give more than 0")
    changes = {
        "size": size,
        "batch_tokens": batch_tokens,
        "longest": longest,
        "learning_rate": learning_rate,
        "seed": seed,
        "precision": None if precision is None else precision.value,
        "evaluated": 0 if steps == 0 else judged,
    }
    with stdout_kept(json):
        from ..comparing.experiment import Order, perform
        from ..comparing.report import write
        from ..comparing.rows import chosen_rows
        from .training_display import Display

        chosen, plan = chosen_rows(rows), _plan(steps, minutes, changes)
        _use(threads)
        budget = None if steps == 0 else _budget(plan, minutes)
        given = (counted, codec, codec_without_zero, codec_steps, device)
        order = Order(chosen, tuple(data), out, budget, plan, *given)
        found = perform(order, Display(quiet).say, write)
        files = write(found)
    _tell(found, files, json)


def _plan(steps: int | None, minutes: float | None, changes: Mapping[str, object]) -> FinetunePlan:
    """Preset tiny, changed so that all rows are asked for whole objects and weigh all tokens alike."""
    from ..finetune.plan import KindWeights, changed_plan, read_plan

    own: dict[str, object] = {
        "steps": _WHEN_TIMED if minutes is not None else steps or _STEPS,
        "picture_share": 0.0,
        "grounding_share": 0.0,
        "constrained": True,
        "kinds": KindWeights().model_dump(),
        "pool": _POOL,
        "held_out": _HELD_OUT,
        "batch_tokens": _LONGEST,
        "longest": _LONGEST,
    }
    given = {name: value for name, value in changes.items() if value is not None}
    return changed_plan(read_plan("tiny"), own | given)


def _budget(plan: FinetunePlan, minutes: float | None) -> Budget:
    from ..comparing.training import Budget

    return Budget(plan, None if minutes is None else 60 * minutes)


def _use(threads: int | None) -> None:
    if threads is not None:
        import torch

        torch.set_num_threads(threads)


def _tell(found: Comparison, files: tuple[Path, Path], json: bool) -> None:
    from ..comparing.report import document, notes, score_rows, title, token_rows

    if json:
        print_json({"ok": True, **document(found), "files": [str(file) for file in files]})
        return
    print(title(found))
    if found.order.budget is not None:
        print_rows(score_rows(found), "  ")
    print_rows(token_rows(found), "  ")
    print("\n".join(notes(found)))
    print(f"tables: {files[1]}\nnumbers: {files[0]}")
