"""How large a model is: every number of its architecture, in presets that are JSON files."""

from __future__ import annotations

from importlib.resources import files
from pathlib import Path
from typing import Self

from pydantic import Field, ValidationError, model_validator

from simart_kit.errors import BadInputError

from ...tables import Table, told

PRESETS = ("tiny", "2b", "8b")


class TextSize(Table):
    """The language model."""

    hidden: int = Field(gt=0, description="Length of a token's vector.")
    layers: int = Field(gt=0, description="Transformer layers.")
    heads: int = Field(gt=0, description="Heads of the queries.")
    key_heads: int = Field(gt=0, description="Heads of keys and values; they divide `heads`.")
    head_dim: int = Field(gt=0, description="Length of a head's vector.")
    feed_forward: int = Field(gt=0, description="Length between the layers of the perceptrons.")
    rotary: tuple[int, int, int] = Field(description="Rotary frequencies of time, height and width.")
    positions: int = Field(gt=0, description="Longest sequence [tokens].")

    @model_validator(mode="after")
    def _check(self) -> Self:
        if self.heads % self.key_heads:
            raise ValueError(f"key_heads {self.key_heads} does not divide heads {self.heads}")
        if 2 * sum(self.rotary) != self.head_dim:
            raise ValueError(f"rotary {self.rotary} must sum to half of head_dim {self.head_dim}")
        if 3 * max(self.rotary[1:]) > sum(self.rotary):
            raise ValueError(f"rotary {self.rotary}: height and width may have a third at most, interleaved")
        return self


class VisionSize(Table):
    """The picture encoder."""

    hidden: int = Field(gt=0, description="Length of a patch's vector.")
    depth: int = Field(gt=0, description="Transformer layers.")
    heads: int = Field(gt=0, description="Heads; they divide `hidden`.")
    feed_forward: int = Field(gt=0, description="Length between the layers of the perceptrons.")
    patch: int = Field(gt=0, description="Edge of a patch [pixels].")
    merge: int = Field(gt=0, description="Patches along the edge of what becomes one token.")
    deepstack: tuple[int, ...] = Field(description="Layers whose output joins the first text layers.")
    positions: int = Field(gt=0, description="Learned positions, a square grid.")

    @model_validator(mode="after")
    def _check(self) -> Self:
        if self.hidden % (4 * self.heads):
            raise ValueError(f"hidden {self.hidden} must be a multiple of 4 times heads {self.heads}")
        if round(self.positions**0.5) ** 2 != self.positions:
            raise ValueError(f"positions {self.positions} must be a square")
        if any(not 0 <= layer < self.depth for layer in self.deepstack):
            raise ValueError(f"deepstack {self.deepstack} must name layers 0..{self.depth - 1}")
        return self


class MllmSize(Table):
    """A Qwen3-VL: random weights of these sizes, or a pretrained base that has them."""

    base: str = Field(description="Hub id or folder of the pretrained weights; empty for random ones.")
    tie_embeddings: bool = Field(description="Tokens are read and written with the same matrix.")
    tokenizer_size: int = Field(ge=263, description="Tokens before the voxel tokens are added.")
    text: TextSize
    vision: VisionSize


def preset_path(name: str) -> Path:
    """The file of a preset; raises BadInputError, with the names that there are."""
    if name not in PRESETS:
        raise BadInputError(f"model size '{name}' is not known: use {', '.join(PRESETS)} or a .json file")
    return Path(str(files(__package__))) / "sizes" / f"{name}.json"


def load_size(name: str) -> MllmSize:
    """Read a preset (`PRESETS`), or a JSON file of the same form.

    Raises:
        BadInputError: there is no such preset or file, or a number in it is missing, unknown or impossible.
    """
    path = Path(name) if name.endswith(".json") else preset_path(name)
    try:
        return MllmSize.model_validate_json(path.read_bytes())
    except OSError as error:
        raise BadInputError(f"cannot read {path}: {error.strerror}; give {' or '.join(PRESETS)}") from error
    except ValidationError as error:
        raise BadInputError(f"{path} is no model size: {told(error)}") from error
