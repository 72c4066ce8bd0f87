"""What defines a simart-nano network: a strict JSON table, from which every size follows."""

from __future__ import annotations

from typing import Self

from pydantic import Field, model_validator

from ..tables import Table


class NanoConfig(Table):
    """Sizes of a `NanoNetwork`."""

    channels: int = Field(default=128, gt=0, description="Channels of a piece's token.")
    layers: int = Field(default=5, ge=1, description="Transformer layers.")
    heads: int = Field(default=8, ge=1, description="Attention heads; they divide the channels.")
    hidden: int = Field(default=320, gt=0, description="Channels inside the perceptrons.")
    point_channels: int = Field(default=64, gt=0, description="Channels of a point.")
    pair_channels: int = Field(default=16, gt=0, description="Channels of a pair of pieces.")
    labels: tuple[str, ...] = Field(default=(), description="What a part may be called; none of these is ''.")
    categories: tuple[str, ...] = Field(default=(), description="What an object may be.")

    @model_validator(mode="after")
    def _check_heads(self) -> Self:
        if self.channels % self.heads:
            raise ValueError(f"heads {self.heads} does not divide channels {self.channels}")
        return self
