"""simart.json: what binds a language model to its tokenizer and its codebook, and how it is asked."""

from __future__ import annotations

import hashlib
from pathlib import Path
from typing import Literal

from pydantic import Field, ValidationError

from simart_kit.errors import BadInputError

from ...tables import Table, told
from ..default_model import LoadedModel
from ..tokens import TokenGrid
from ..vocabulary import Vocabulary

SETTINGS_FILE = "simart.json"


class Settings(Table):
    """The file; whoever asks the model asks as it was trained."""

    schema_version: Literal[1] = Field(default=1, alias="schema")
    prompt: Literal["paper", "short", "none"] = Field(
        default="paper", description="System prompt that the model was trained with."
    )
    picture: bool = Field(default=True, description="The model is shown a picture of the object.")
    picture_size: int = Field(default=252, gt=0, description="Edge of the picture [pixels].")
    candidates: Literal[1, 8] = Field(
        default=1, description="Codes that encoding tries for a cell of the input; 1 is the nearest."
    )
    seeds: Literal["codes", "cells"] = Field(
        default="codes", description="What parts are found by: their codes, or their cells alone."
    )
    codec: str = Field(description="Fingerprint of the voxel model whose codes the tokens are.")
    grid: tuple[int, int, int] = Field(description="Cells that tokens may name.")
    codebook: int = Field(description="Codes that they may carry.")
    first_id: int = Field(ge=0, description="Id of <voxel>; cells and codes follow.")
    tokens: str = Field(description="SHA-256 of the voxel tokens' names, a line each.")
    tokenizer: str = Field(default="", description="SHA-256 of tokenizer.json; empty until it is saved.")
    base: str = Field(default="", description="Hub id or folder that the model or its adapter started from.")
    seed: int = Field(default=0, description="Of the first values of new weights.")
    training: dict[str, str | int | float | bool] = Field(
        default_factory=dict, description="Remarks on how the weights were made."
    )

    @property
    def vocabulary(self) -> Vocabulary:
        """The voxel tokens' ids; raises BadInputError for a grid that there is not."""
        return Vocabulary(TokenGrid(self.grid, self.codebook), self.first_id)

    @property
    def identity(self) -> str:
        """What every weights file carries, so that files of different models cannot be mixed."""
        bound = f"{self.codec} {self.grid} {self.codebook} {self.first_id} {self.tokens} {self.tokenizer}"
        return hashlib.sha256(bound.encode()).hexdigest()[:16]


def settings_of(vocabulary: Vocabulary, codec: LoadedModel, *, base: str = "", seed: int = 0) -> Settings:
    """Settings of a new model; the prompt and what else training decides have their defaults."""
    return Settings(
        codec=codec.fingerprint,
        grid=vocabulary.grid.shape,
        codebook=vocabulary.grid.codebook,
        first_id=vocabulary.first_id,
        tokens=names_hash(vocabulary),
        base=base,
        seed=seed,
    )


def names_hash(vocabulary: Vocabulary) -> str:
    """SHA-256 of the tokens' names, a line each."""
    return hashlib.sha256("\n".join(vocabulary.names).encode()).hexdigest()


def read_settings(folder: Path) -> Settings:
    """Read the file of a folder.

    Raises:
        BadInputError: there is none, or it is damaged or contradicts itself.
    """
    path = folder / SETTINGS_FILE
    try:
        settings = Settings.model_validate_json(path.read_bytes())
    except FileNotFoundError:
        raise BadInputError(
            f"{folder} is not a SIMART model: it has no {SETTINGS_FILE}; "
            "make one with `simart-kit train mllm`, which extends a plain Qwen3-VL"
        ) from None
    except OSError as error:
        raise BadInputError(f"cannot read {path}: {error.strerror}") from error
    except ValidationError as error:
        raise BadInputError(f"{path} is damaged: {told(error)}") from error
    if settings.tokens != names_hash(settings.vocabulary):
        raise BadInputError(f"{path} is damaged: the hash of its token names is not that of its grid")
    return settings


def write_settings(settings: Settings, folder: Path) -> None:
    """Write the file that `read_settings` reads."""
    text = settings.model_dump_json(indent=1, by_alias=True) + "\n"
    (folder / SETTINGS_FILE).write_text(text, encoding="utf-8")
