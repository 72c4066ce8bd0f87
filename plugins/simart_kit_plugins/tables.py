"""Strict tables in JSON files: configs, presets and tokens."""

from __future__ import annotations

from pydantic import BaseModel, ConfigDict, ValidationError


class Table(BaseModel):
    """A table without unknown keys, numbers for text, or values that are not finite."""

    model_config = ConfigDict(extra="forbid", frozen=True, strict=True, allow_inf_nan=False)


def told(error: ValidationError) -> str:
    """Every wrong field and what is wrong with it, on one line."""
    return "; ".join(f"{'.'.join(map(str, e['loc'])) or 'file'}: {e['msg']}" for e in error.errors())
