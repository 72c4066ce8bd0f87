"""A record of instruction data: an object in one state, and the questions that are asked about it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from ..answer.values import ObjectAnswer
from ..tokens import VoxelTokens

Task = Literal["urdf", "grounding"]


@dataclass(frozen=True, slots=True)
class Pair:
    """A question and what answers it.

    Attributes:
        task: "urdf" is answered by the record's whole answer, "grounding" by the voxels of one part.
        question: as it is put to the model.
        part: number of the part that a grounding question means; None for "urdf".
    """

    task: Task
    question: str
    part: int | None = None


@dataclass(frozen=True, eq=False)
class Record:
    """An object in one kinematic state.

    Attributes:
        key: unique in its data set, such as "partnet-7201-03"; letters, digits, - and _.
        object: key without the state: states of one object share it.
        source: of the data, such as "generated".
        category: such as "cabinet", or "".
        state: 0 is the pose of the source.
        voxels: tokens of the whole object in this state.
        answer: its parts and joints in this state.
        pairs: both instruction sets.
        picture: PNG file, 252 x 252 pixels, or None.
    """

    key: str
    object: str
    source: str
    category: str
    state: int
    voxels: VoxelTokens
    answer: ObjectAnswer
    pairs: tuple[Pair, ...]
    picture: bytes | None = None
