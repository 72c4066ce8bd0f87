"""gt.json as pydantic models: the parts and joints of the SIMART-Bench format, for reader and writer."""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Sequence
from pathlib import Path
from typing import Annotated, Any

import numpy as np
from pydantic import BaseModel, ConfigDict, Field, ValidationError, field_validator

from ...arrays import IntArray
from ...errors import BadInputError
from ...mesh import UpAxis
from ..articulation import Link, LinkJoint, LinkJointKind
from .files import LARGEST, reading

Number = Annotated[float, Field(gt=-LARGEST, lt=LARGEST)]
Point = tuple[Number, Number, Number]
_NONE = -1  # id of no part: parent of a root, label of a face that belongs to none


class _Table(BaseModel):
    # Other keys are let pass: data sets keep their own remarks, such as licences, in the same file.
    model_config = ConfigDict(extra="ignore", frozen=True, allow_inf_nan=False)


class JointRow(_Table):
    """How a part moves against its parent; position 0 is the pose of the mesh."""

    type: LinkJointKind = Field(description="Kind of joint.")
    name: str = Field(default="", description="As its source has it.")
    axis: Point | None = Field(default=None, description="Direction in the mesh's frame, of any length.")
    origin: Point | None = Field(default=None, description="Point on the axis in the mesh's frame.")
    lower: Number | None = Field(default=None, description="Lowest position [rad or units].")
    upper: Number | None = Field(default=None, description="Highest position [rad or units].")

    def value(self) -> LinkJoint:
        """The joint; raises BadInputError when it misses something that its kind needs."""
        return LinkJoint(self.type, self.axis, self.origin, self.lower, self.upper, self.name)

    @classmethod
    def of(cls, joint: LinkJoint) -> JointRow:
        """The row of a joint."""
        return cls(
            type=joint.kind,
            name=joint.name,
            axis=joint.axis,
            origin=joint.origin,
            lower=joint.lower,
            upper=joint.upper,
        )


class PartRow(_Table):
    """A rigid part."""

    id: int = Field(ge=0, lt=2**31, description="Number of its faces in `face_part`; unique.")
    name: str = Field(description="As its source has it.")
    parent: int = Field(default=_NONE, ge=_NONE, description="Id of the part that carries it; -1 for a root.")
    label: str = Field(default="", description="What kind of thing it is.")
    joint: JointRow = Field(description="How it moves against the parent.")
    also: tuple[JointRow, ...] = Field(default=(), description="Further joints, any of which is right.")


class FrameRow(_Table):
    """Frame of the meshes and joints."""

    up: UpAxis = Field(default="+y", description="Axis that points up.")
    metres_per_unit: Number | None = Field(default=1.0, gt=0, description="Length of a unit [m], if known.")

    @field_validator("up", mode="before")
    @classmethod
    def _lowered(cls, value: Any) -> Any:
        return value.lower() if isinstance(value, str) else value


class ObjectTable(_Table):
    """The top level of gt.json."""

    category: str = Field(default="", description="Such as cabinet.")
    frame: FrameRow = Field(default=FrameRow(), description="Frame of the meshes and joints.")
    parts: tuple[PartRow, ...] = Field(min_length=1, description="The parts; links keep their order.")

    def links(self) -> tuple[Link, ...]:
        """The parts as links, parents by index.

        Raises:
            BadInputError: an id is used twice, a parent does not exist, or a joint is not whole; names it.
        """
        twice = [str(i) for i, count in Counter(part.id for part in self.parts).items() if count > 1]
        if twice:
            raise BadInputError(f"part id {', '.join(twice)} is used twice")
        index = {_NONE: -1} | {part.id: i for i, part in enumerate(self.parts)}
        return tuple(_link(part, index) for part in self.parts)

    def labels(self, face_part: IntArray) -> IntArray:
        """(F,) index into `links` of (F,) part ids; -1 stays -1.

        Raises:
            BadInputError: an id that no part has.
        """
        ids = np.array([_NONE] + [part.id for part in self.parts])
        order = np.argsort(ids)
        place = np.minimum(np.searchsorted(ids[order], face_part), len(ids) - 1)
        found = order[place]
        unknown = np.unique(face_part[ids[found] != face_part])
        if len(unknown):
            told = ", ".join(map(str, unknown[:5].tolist())) + (" ..." if len(unknown) > 5 else "")
            raise BadInputError(f"labels {told} are no part's id: ids are {sorted(ids[1:].tolist())}")
        return np.asarray(found - 1, dtype=np.int32)


def read_table(path: Path) -> ObjectTable:
    """Read a gt.json.

    Raises:
        BadInputError: the file is missing or damaged, or a field is wrong; names the file, part and field.
    """
    with reading(path, "JSON"):
        table = json.loads(path.read_text(encoding="utf-8"))
        try:
            return ObjectTable.model_validate(table)
        except ValidationError as error:
            told = "; ".join(f"{_place(e['loc'], table)}: {e['msg']}" for e in error.errors()[:3])
            raise BadInputError(told) from error


def check_truth(links: Sequence[Link]) -> None:
    """Refuse what a prediction may get wrong and a truth may not.

    Raises:
        BadInputError: a part moves in an unknown way, or its limits are reversed; names the part.
    """
    for link in links:
        for joint in (link.joint, *link.also):
            if joint.kind == "unknown":
                raise BadInputError(f"part '{link.name}': a truth has to say how it moves, not 'unknown'")
            if joint.lower is not None and joint.upper is not None and joint.lower > joint.upper:
                raise BadInputError(
                    f"part '{link.name}': its lower limit {joint.lower} is above the upper, {joint.upper}"
                )


def part_rows(links: Sequence[Link]) -> list[dict[str, Any]]:
    """Links as `parts` of a gt.json: ids by place, and of the rest what is not as by default."""
    return [_row(index, link) for index, link in enumerate(links)]


def _row(index: int, link: Link) -> dict[str, Any]:
    row = PartRow(
        id=index,
        name=link.name,
        parent=link.parent,
        label=link.label,
        joint=JointRow.of(link.joint),
        also=tuple(JointRow.of(joint) for joint in link.also),
    )
    first = {"id": index, "name": link.name, "parent": link.parent}
    return first | row.model_dump(mode="json", exclude_defaults=True)


def _link(part: PartRow, index: dict[int, int]) -> Link:
    where = f"part '{part.name}' (id {part.id})"
    if part.parent not in index:
        raise BadInputError(f"{where}: there is no parent with id {part.parent}")
    try:
        also = tuple(joint.value() for joint in part.also)
        return Link(part.name, index[part.parent], part.joint.value(), also, part.label)
    except BadInputError as error:
        raise BadInputError(f"{where}: {error}") from error


def _place(location: Sequence[int | str], table: Any) -> str:
    """Where a field stands, a part by its name if it has one."""
    if len(location) < 2 or location[0] != "parts":
        return ".".join(map(str, location)) or "top level"
    part = table["parts"][location[1]]
    name = part.get("name") if isinstance(part, dict) else None
    known = f"part '{name}'" if isinstance(name, str) else f"part {location[1]}"
    return ".".join([known, *map(str, location[2:])])
