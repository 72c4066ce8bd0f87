"""What all rows share: records to train on, held-out objects, and the voxels that their tokens decode to."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import islice
from pathlib import Path

import numpy as np

from simart_kit.errors import BadInputError

from ..answer.writing import answer_text
from ..codec import decode_tokens
from ..dataset.record import Record
from ..default_model import LoadedModel, load_model
from ..finetune.plan import FinetunePlan
from ..finetune.records import Records, find_records
from ..prompt.texts import URDF_QUESTION, system_prompt
from ..training.grids import Grids, pack
from .scoring import Truth

# Records whose text the tokenizer is made for, and objects whose voxels train a voxel model.
_TEXTS, _OBJECTS = 1000, 400


@dataclass(frozen=True, eq=False)
class SharedData:
    """Data of a comparison.

    Attributes:
        codec: the voxel model of the records' codes.
        records: to train on.
        counted: some of these, whose tokens are counted.
        judged: held-out records, each of another object.
        truths: what these show.
    """

    codec: LoadedModel
    records: Records
    counted: tuple[Record, ...]
    judged: tuple[Record, ...]
    truths: tuple[Truth, ...]


def shared_data(
    folders: Sequence[Path], codec: Path | None, plan: FinetunePlan, counted: int, pictures: bool
) -> SharedData:
    """Read what all rows need.

    Args:
        folders: of instruction data.
        codec: voxel model of their codes; None for the shipped one.
        plan: says how many are held out.
        counted: records to count the tokens of.
        pictures: whether a row is shown pictures.

    Raises:
        BadInputError: the data are not there, of other codes, too few, or have no pictures where these are
            needed.
    """
    loaded = load_model(codec)
    records = find_records(folders, plan.held_out, loaded.fingerprint)
    some = tuple(islice(records.training(plan.seed, 0, 0, 1), counted))
    if not some:
        raise BadInputError("the data have no record to train on: give more of them")
    if pictures and any(record.picture is None for record in some):
        raise BadInputError(
            "row vision needs pictures, which some records have not: "
            "build the data with --pictures, or leave the row out with --rows"
        )
    held, truths = [], []
    for record in records.judged(plan.evaluated):
        voxels = decode_tokens(loaded.model, [part.voxels for part in record.answer.parts])
        if voxels.any(axis=(1, 2, 3)).all():
            held.append(record)
            truths.append(Truth(record.answer, voxels))
    if plan.evaluated and not held:
        raise BadInputError("no object is held out to be judged on: give more data")
    return SharedData(loaded, records, some, tuple(held), tuple(truths))


def texts(data: SharedData, plan: FinetunePlan) -> Iterator[str]:
    """Text that the tokenizer of a small model is made for."""
    yield system_prompt(data.codec.grid, plan.prompt)
    yield URDF_QUESTION
    for record in islice(data.records.training(plan.seed, 0, 0, 1), _TEXTS):
        yield answer_text(record.answer)


def voxel_grids(data: SharedData, plan: FinetunePlan) -> Grids:
    """Voxels of objects and of their parts, to train another voxel model on; one state of each object."""
    objects: dict[str, Record] = {}
    for record in data.records.training(plan.seed, 0, 0, 1):
        objects.setdefault(record.object, record)
        if len(objects) == _OBJECTS:
            break
    packed, names = [], []
    for record in objects.values():
        every = [record.voxels, *[part.voxels for part in record.answer.parts]]
        voxels = decode_tokens(data.codec.model, every)
        filled = np.flatnonzero(voxels.any(axis=(1, 2, 3)))
        packed.append(pack(voxels[filled]))
        names += [f"{record.key}, grid {number}" for number in filled]
    return Grids(data.codec.model.config.resolution, np.concatenate(packed), tuple(names))
