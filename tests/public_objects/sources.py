"""What there is to make: the packages and objects of sources.toml."""

from __future__ import annotations

import tomllib
from pathlib import Path
from typing import Annotated, Literal

from pydantic import BaseModel, ConfigDict, Field

_TABLE = Path(__file__).with_name("sources.toml")


class _Row(BaseModel):
    model_config = ConfigDict(extra="forbid", frozen=True)


class Entry(_Row):
    """An object of a package."""

    set: Literal["develop", "verify"] = Field(description="What it is for.")
    file: str = Field(description="Below the root of its source.")
    category: str = Field(default="", description="Such as cabinet; '' where its reader knows.")
    licence: str = Field(default="", description="Where it is not that of its source.")
    body: int | str = Field(
        default="", description="MJCF: the body that it is, with all below, by name or id."
    )
    fixed: tuple[str, ...] = Field(
        default=(), description="MJCF: bodies whose joints are no movement of a part."
    )
    radians: bool = Field(default=False, description="MJCF: limits are radians, whatever the file says.")


class Source(_Row):
    """A package of a pinned version, and the objects in it."""

    kind: Literal["wheel", "npm", "deb"] = Field(description="Where it comes from: PyPI, npm or Debian.")
    package: str = Field(description="Its name there.")
    version: str = Field(description="Exactly this one.")
    hash: Annotated[str, Field(pattern=r"^sha256:[0-9a-f]{64}$|^sha512-[\w+/]{86}==$")]
    megabytes: int = Field(description="To download.")
    reader: Literal["mjcf", "urdf", "controller", "sweet-home"]
    licence: str
    root: str = Field(description="Folder in it, as unpacked, below which everything lies that is needed.")
    objects: dict[str, Entry]

    def licence_of(self, name: str) -> str:
        """The licence of an object."""
        return self.objects[name].licence or self.licence


def known_sources() -> dict[str, Source]:
    """All sources by name, in the order of the file."""
    table = tomllib.loads(_TABLE.read_text(encoding="utf-8"))
    return {name: Source.model_validate({"package": name} | row) for name, row in table.items()}
