"""The ladder of each object of a data set."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

from simart_kit.bench.formats import DEFAULT_VARIANT, find_truths
from simart_kit.bench.preflight import check_variant
from simart_kit.errors import SimartKitError
from simart_kit.plugins import Plugins

from ..stored_model import reads_skins
from .case import Case, read_case
from .judging import Judged
from .rungs import candidates_step, pieces_step

PIECES, CANDIDATES, GROUPING, WHOLE = "pieces", "candidates", "grouping", "whole"
_Steps = dict[str, Callable[[Case], Judged]]


@dataclass(frozen=True)
class Ladder:
    """An object.

    Attributes:
        name: of the object.
        category: of it, or "".
        steps: what became of it, by the name of the step, in their order.
    """

    name: str
    category: str
    steps: Mapping[str, Judged]


def ladders(
    data: Path, plugins: Plugins, variant: str = DEFAULT_VARIANT, model: Path | None = None
) -> Iterator[Ladder | tuple[str, str]]:
    """Climb with every object below a folder, one after another.

    Args:
        data: folder of objects with ground truth, in any format that the bench reads.
        plugins: who reads meshes.
        variant: which mesh of each object.
        model: folder of the weights; None for the steps without a network.

    Yields:
        The ladder of an object; or its name and why there is none, in one line.

    Raises:
        BadInputError: there are no objects, none has this variant, or the weights cannot be read.
    """
    truths = find_truths(data)
    check_variant(truths, variant)
    steps: _Steps = {PIECES: pieces_step, CANDIDATES: candidates_step}
    if model is not None:
        steps |= _steps_of(model)
    relief = model is None or reads_skins(model)
    for name, (reader, path) in truths.items():
        try:
            case = read_case(reader, path, variant, plugins, relief)
            yield Ladder(name, case.category, {step: climb(case) for step, climb in steps.items()})
        except SimartKitError as error:
            yield name, " ".join(str(error).split())


def _steps_of(model: Path) -> _Steps:
    from .network import grouping_step, load_model, whole_step

    loaded = load_model(model)
    return {
        GROUPING: lambda case: grouping_step(case, loaded),
        WHOLE: lambda case: whole_step(case, loaded),
    }
