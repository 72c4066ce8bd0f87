"""What defines a simart-nano network: a strict JSON table, from which every size follows."""

from __future__ import annotations

from typing import Self

from pydantic import Field, model_validator

from ..tables import Table


class NanoConfig(Table):
    """Sizes of a `NanoNetwork`."""

    channels: int = Field(default=192, gt=0, le=4096, description="Channels of a piece's token.")
    layers: int = Field(default=6, ge=1, le=64, description="Transformer layers.")
    heads: int = Field(default=8, ge=1, description="Attention heads; they divide the channels.")
    hidden: int = Field(default=512, gt=0, le=16_384, description="Channels inside the perceptrons.")
    point_channels: int = Field(default=64, gt=0, description="Channels of a point.")
    choice_channels: int = Field(default=96, gt=0, description="Channels of a joint candidate.")
    pair_channels: int = Field(default=48, ge=2, le=1024, description="Channels of a pair of pieces.")
    pair_layers: int = Field(default=2, ge=0, le=64, description="Layers in which pairs look at each other.")
    labels: tuple[str, ...] = Field(default=(), description="What a part may be called; none of these is ''.")
    categories: tuple[str, ...] = Field(default=(), description="What an object may be.")

    @model_validator(mode="after")
    def _check_heads(self) -> Self:
        if self.channels % self.heads:
            raise ValueError(f"heads {self.heads} does not divide channels {self.channels}")
        return self
