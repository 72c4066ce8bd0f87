"""The kinematic spec as values: what is stated of kinds of parts, of single parts, and of pieces."""

from __future__ import annotations

import json
import math
from typing import Annotated, Any, Literal

from pydantic import BaseModel, ConfigDict, Field

from ..asset import JointKind

AxisWord = Literal[
    "vertical",
    "horizontal",
    "front",
    "back",
    "left",
    "right",
    "up",
    "down",
    "left edge",
    "right edge",
    "top edge",
    "bottom edge",
    "front edge",
    "back edge",
    "outer edge",
    "inner edge",
]
_STRICT = ConfigDict(extra="forbid", frozen=True, strict=True)
_Number = Annotated[float, Field(allow_inf_nan=False)]
_Piece = Annotated[int, Field(ge=0)]
_Name = Annotated[str, Field(pattern=r"^[a-z][a-z0-9_]*$")]
Point = tuple[_Number, _Number, _Number]

_AXIS = (
    'Where the axis lies or points, such as "vertical", "front" or "left edge"; edges as seen from outside.'
)
_LIMITS = "Lowest and highest position [degrees | m]; 0, the pose of the mesh, lies between. Needs `joint`."


class Motion(BaseModel):
    """How something moves; what is left out is for the joint predictor to say."""

    model_config = _STRICT
    joint: JointKind | None = Field(default=None, description="Kind of joint.")
    axis: AxisWord | None = Field(default=None, description=_AXIS)
    limits: tuple[_Number, _Number] | None = Field(default=None, description=_LIMITS)


class KindSpec(Motion):
    """What holds of all parts of a kind, such as doors."""

    count: int | None = Field(default=None, ge=0, description="How many of them move.")


class PartSpec(Motion):
    """One part."""

    name: _Name = Field(description="What it is called from now on.")
    found_as: _Name | None = Field(
        default=None, description="What the run calls it, where that is another name."
    )
    label: str | None = Field(default=None, description='What kind of thing it is, such as "door".')
    pieces: tuple[_Piece, ...] | None = Field(
        default=None, description="All its pieces, by the numbers that `simart-kit spec` draws."
    )
    points: tuple[Point, ...] | None = Field(
        default=None, description="Points on it: what was found there is the part."
    )
    parent: _Name | None = Field(default=None, description="The part that carries it.")
    through: Point | None = Field(default=None, description="A point on its axis.")
    root: bool = Field(default=False, description="Whether it is the body, which no joint moves.")


class Merge(BaseModel):
    """Parts of the run that are one."""

    model_config = _STRICT
    into: _Name = Field(description="The part of the run that stays.")
    parts: tuple[_Name, ...] = Field(description="The parts of the run that become of it.")


class Split(BaseModel):
    """A part of the run that is two."""

    model_config = _STRICT
    part: _Name = Field(description="The part of the run that is divided.")
    name: _Name = Field(description="What the new part is called.")
    pieces: tuple[_Piece, ...] = Field(default=(), description="Pieces of the new part, by their numbers.")
    points: tuple[Point, ...] = Field(default=(), description="Points on pieces of the new part.")


class Spec(BaseModel):
    """What moves, as a person or a model states it."""

    model_config = _STRICT
    # `schema` would hide a pydantic method, so the field has another name than its key.
    version: Literal[1] = Field(alias="schema", description="Version of the format.")
    numbered: int | None = Field(
        default=None, ge=1, description="How many pieces there were when they were numbered."
    )
    coordinates: Literal["m", "fraction"] = Field(
        default="m",
        description="What points are in: metres as the file is loaded, or shares of the bounding box; "
        "x left to right, y front to back, z up.",
    )
    only: bool = Field(default=False, description="Whether parts that `parts` does not list are of the body.")
    kinds: dict[str, KindSpec] = Field(
        default_factory=dict, description="What holds of all parts of a kind, by its word, such as `door`."
    )
    parts: tuple[PartSpec, ...] = Field(default=(), description="Single parts.")
    merge: tuple[Merge, ...] = Field(default=(), description="Parts of the run that are one.")
    split: tuple[Split, ...] = Field(default=(), description="Parts of the run that are two.")

    def table(self) -> dict[str, Any]:
        """The spec as plain values, a valid spec itself; what is not stated is left out."""
        text = self.model_dump_json(by_alias=True, exclude_none=True, exclude_defaults=True)
        return {"schema": self.version, **json.loads(text)}

    @property
    def moves(self) -> bool:
        """Whether it states that something moves, or how."""
        stated = any(part.joint not in (None, "fixed") for part in self.parts)
        return stated or any(kind.count for kind in self.kinds.values())


def position_limits(motion: Motion) -> tuple[float, float] | None:
    """The stated limits of a turning joint [rad] or a slide [m]."""
    if motion.limits is None or motion.joint == "prismatic":
        return motion.limits
    lower, upper = motion.limits
    return math.radians(lower), math.radians(upper)
