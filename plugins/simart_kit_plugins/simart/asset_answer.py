"""An asset as the answer that says it: names, materials, joints and voxel tokens of its parts."""

from __future__ import annotations

from collections.abc import Sequence

from simart_kit import PartGuess
from simart_kit.asset import Asset
from simart_kit.voxels import GridFrame

from .answer.scales import edge
from .answer.units import answer_of
from .answer.values import ObjectAnswer
from .codec import TokenModel, encode_grids, object_grids
from .tokens import VoxelTokens


def asset_answer(asset: Asset, model: TokenModel) -> ObjectAnswer:
    """The answer for an asset at rest, in the cube about it.

    Args:
        asset: its parts may be inside each other.
        model: turns voxels into tokens.

    Raises:
        BadInputError: the asset is a point, or the model has no tokens (see `codec.token_grid`).
    """
    grids = object_grids(asset.mesh, asset.face_part, [part.name for part in asset.parts])
    return answer_with(asset, encode_grids(model, grids.parts), grids.frame)


def answer_with(asset: Asset, tokens: Sequence[VoxelTokens], frame: GridFrame) -> ObjectAnswer:
    """The answer for an asset whose (P,) parts have these tokens in its cube."""
    materials = [part.material for part in asset.parts]
    name = asset.name.replace("_", " ")
    return answer_of(name, edge(frame), part_guesses(asset), asset.joints, tokens, frame, materials)


def part_guesses(asset: Asset) -> tuple[PartGuess, ...]:
    """The asset's parts as a segmenter gives them."""
    return tuple(PartGuess(part.name, part.label, part.material.name) for part in asset.parts)
