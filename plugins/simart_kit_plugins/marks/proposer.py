"""Option that names another segmenter."""

from __future__ import annotations

from pydantic import BaseModel, ConfigDict, Field

from simart_kit.recipe_files import Table


class Proposer(BaseModel):
    """A segmenter by its name, as a recipe names one."""

    model_config = ConfigDict(extra="forbid", frozen=True, strict=True)
    use: str = Field(description="Registered name of a segmenter.")
    options: Table = Field(default_factory=dict, description="Options of that segmenter.")
