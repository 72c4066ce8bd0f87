"""What the model is asked, as values."""

from __future__ import annotations

from dataclasses import dataclass

from simart_kit.arrays import ByteArray

from ..tokens import VoxelTokens


@dataclass(frozen=True, eq=False)
class Prompt:
    """One question about one object.

    Attributes:
        system: text of the system's turn; "" for none.
        question: text of the user's turn, after the picture and the voxels.
        voxels: the object's tokens.
        picture: (H, W, 3) sRGB picture of the object, or None (the paper's ablation without vision).
    """

    system: str
    question: str
    voxels: VoxelTokens
    picture: ByteArray | None = None
