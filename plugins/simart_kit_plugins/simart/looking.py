"""An object as a model is shown it: voxel tokens in its own cube, and a picture."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Literal

from simart_kit import Mesh, Note
from simart_kit.arrays import BoolArray, ByteArray
from simart_kit.errors import BadInputError
from simart_kit.voxels import GridFrame

from .codec import encode_grids, object_frame, occupancy
from .prompt.values import Prompt
from .tokens import VoxelTokens

if TYPE_CHECKING:
    from .codec import TokenModel
    from .mllm.settings import Settings

Vision = Literal["auto", "on", "off"]


@dataclass(frozen=True, eq=False)
class Seen:
    """What a model is shown of an object.

    Attributes:
        frame: the cube about the object.
        occupancy: (64, 64, 64) bool, its voxels.
        tokens: its voxels as tokens.
    """

    frame: GridFrame
    occupancy: BoolArray
    tokens: VoxelTokens


@dataclass(frozen=True, eq=False)
class Asked:
    """A question about an object.

    Attributes:
        prompt: with its voxels and picture.
        seen: the object.
        notes: for the report.
    """

    prompt: Prompt
    seen: Seen
    notes: tuple[Note, ...]


def look(mesh: Mesh, encoder: TokenModel) -> Seen:
    """An object's voxels and tokens; raises BadInputError for a mesh without size or faces."""
    frame = object_frame(mesh)
    grid = occupancy(mesh.triangles, frame)
    (tokens,) = encode_grids(encoder, grid[None])
    return Seen(frame, grid, tokens)


def chosen_picture(
    mesh: Mesh, settings: Settings, vision: Vision, image: str
) -> tuple[ByteArray | None, str]:
    """The picture that a model is shown, if any, and a sentence about it.

    Args:
        mesh: of the object.
        settings: of the model.
        vision: "on" or "off"; "auto" as the model was trained.
        image: file of a user's own picture; "" for one of the mesh.

    Raises:
        BadInputError: an image is given and pictures are off, or it cannot be read.
    """
    from .prompt.picture import object_picture, read_picture

    if vision == "off":
        if image:
            raise BadInputError(f"image {image} is given and vision is off: leave one of the two out")
        return None, "no picture is shown: vision is off"
    if vision == "auto" and not settings.picture:
        ignored = f"the model was trained without pictures: {image or 'a picture'} is not shown"
        return None, f"{ignored}; vision=on shows it all the same" if image else ignored
    if image:
        return read_picture(Path(image), settings.picture_size), f"the picture shown is {Path(image).name}"
    return object_picture(mesh, settings.picture_size), "the picture shown is of the mesh itself"
