"""The tokens of an object and its parts as a JSON file, written and read strictly. See docs/tokens.md."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

import numpy as np
from pydantic import Field, ValidationError

from simart_kit.errors import BadInputError, OutputError

from ..tables import Table, told
from .token_parser import parse
from .tokens import TokenGrid, VoxelTokens

Notation = Literal["text", "atoms"]


@dataclass(frozen=True, eq=False)
class PartTokens:
    """A part of the object.

    Attributes:
        name: unique within the object.
        tokens: its cells, in the object's frame.
        label: what kind of thing it is, such as "door".
        material: key of the material table.
    """

    name: str
    tokens: VoxelTokens
    label: str = ""
    material: str = "wood"


@dataclass(frozen=True, eq=False)
class TokensFile:
    """An object and its parts as tokens of one model.

    Attributes:
        model: fingerprint of the model that made the codes.
        object: tokens of the whole.
        parts: at least one; their cells are a subset of the object's.

    Raises:
        BadInputError: no part, no token, a name twice, or a cell that the object does not occupy.
    """

    model: str
    object: VoxelTokens
    parts: tuple[PartTokens, ...]

    def __post_init__(self) -> None:
        """Hold what a file is read with to what is written, too."""
        if not len(self.object.index):
            raise BadInputError("the object has no tokens")
        if not self.parts:
            raise BadInputError("there are no parts: an object without joints is one part")
        _require_names([part.name for part in self.parts])
        for part in self.parts:
            if part.tokens.grid != self.object.grid:
                raise BadInputError(f"part '{part.name}' is of another grid or codebook than the object")
            if not len(part.tokens.index):
                raise BadInputError(f"part '{part.name}' has no tokens: leave it out")
            foreign = np.setdiff1d(part.tokens.index, self.object.index)
            if len(foreign):
                raise BadInputError(f"part '{part.name}' has cell {foreign[0]}, which the object has not")


class _PartRow(Table):
    name: str = Field(min_length=1)
    label: str = ""
    material: str = "wood"
    tokens: str


class _FileTable(Table):
    version: Literal[1] = Field(alias="schema")
    grid: Literal["8x8x8", "16x8x8"]
    codebook: int
    model: str = Field(pattern=r"^[0-9a-f]{16}$")
    object: str
    parts: tuple[_PartRow, ...] = Field(min_length=1)


def write_tokens_file(file: TokensFile, path: Path, notation: Notation = "text") -> None:
    """Write the JSON file; the same tokens give the same bytes, and nothing is left of a failed write.

    Raises:
        OutputError: it cannot be written.
    """
    grid = file.object.grid
    rows = [
        {"name": p.name, "label": p.label, "material": p.material, "tokens": written(p.tokens, notation)}
        for p in file.parts
    ]
    table = {
        "schema": 1,
        "grid": "x".join(map(str, grid.shape)),
        "codebook": grid.codebook,
        "model": file.model,
        "object": written(file.object, notation),
        "parts": rows,
    }
    partial = path.with_name(f".{path.name}.partial")
    try:
        partial.write_text(json.dumps(table, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")
        partial.replace(path)
    except OSError as error:
        partial.unlink(missing_ok=True)
        raise OutputError(f"cannot write {path}: {error.strerror}: give a file in a folder") from error


def written(tokens: VoxelTokens, notation: Notation) -> str:
    """Tokens in a notation that `token_parser.parse` reads."""
    return tokens.text() if notation == "text" else tokens.atoms()


def read_tokens_file(path: Path, model: str | None = None) -> TokensFile:
    """Read the JSON file.

    Args:
        path: the file.
        model: fingerprint of the model that is to decode it; another model's codes are refused. None reads
            the tokens of any.

    Raises:
        BadInputError: the file is missing or damaged, a key is unknown, missing or wrong, a name comes twice,
            the tokens are of another model, or a token is wrong; the message points at the part and token.
    """
    table = _read(path)
    try:
        if model is not None and table.model != model:
            raise BadInputError(
                f"its codes are of model {table.model}, and this model is {model}: "
                "give the model that wrote it, or write the tokens again"
            )
        # Before the tokens are read: messages about them name the part.
        _require_names([row.name for row in table.parts])
        x, y, z = map(int, table.grid.split("x"))
        grid = TokenGrid((x, y, z), table.codebook)
    except BadInputError as error:
        raise BadInputError(f"{path}: {error}") from error
    whole = parse(table.object, grid, source=f"{path}, object")
    parts = [
        PartTokens(
            row.name,
            parse(row.tokens, grid, allowed=whole.index, source=f"{path}, part '{row.name}'"),
            row.label,
            row.material,
        )
        for row in table.parts
    ]
    try:
        return TokensFile(table.model, whole, tuple(parts))
    except BadInputError as error:
        raise BadInputError(f"{path}: {error}") from error


def _read(path: Path) -> _FileTable:
    try:
        return _FileTable.model_validate_json(path.read_bytes())
    except OSError as error:
        raise BadInputError(
            f"cannot read tokens file {path}: {error.strerror}: write one with `simart-kit tokens MESH --out`"
        ) from error
    except ValidationError as error:
        raise BadInputError(f"{path} is no tokens file: {told(error)}") from error


def _require_names(names: Sequence[str]) -> None:
    twice = [name for place, name in enumerate(names) if name in names[:place]]
    if twice:
        raise BadInputError(f"part '{twice[0]}' comes twice: part names must differ")
