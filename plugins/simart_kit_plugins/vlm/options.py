"""Options of every stage that asks a vision-language model."""

from __future__ import annotations

import re
from typing import Any, Literal

from pydantic import Field, field_validator, model_validator

import simart_kit

from ..simart.mllm.placing import Dtype, Quantisation
from .endpoint import KEY_VARIABLE, optional_url

_SECRETS = re.compile(r"key|token|secret|password|credential|auth|bearer", re.IGNORECASE)


class VlmOptions(simart_kit.Options):
    """Which model is asked, how, and where its answers are kept."""

    backend: Literal["server", "transformers"] = Field(
        default="server",
        description="Who runs the model: an OpenAI-compatible server, or this machine with transformers.",
    )
    url: str = Field(
        default="",
        description="URL of the server, such as http://localhost:8000/v1; its key is read from the "
        f"environment variable {KEY_VARIABLE} and nowhere else.",
    )
    model: str = Field(
        default="",
        description="Name of the model on the server; for transformers, a folder or hub id of a Qwen3-VL.",
    )
    timeout: float = Field(
        default=300.0, gt=0, allow_inf_nan=False, description="Longest wait for a reply of the server [s]."
    )
    retries: int = Field(
        default=4, ge=0, le=20, description="Times to ask a busy or unreachable server again."
    )
    rate_limit: float = Field(
        default=0.0, ge=0, allow_inf_nan=False, description="Most requests [per minute]; 0 for no limit."
    )
    max_tokens: int = Field(default=4096, ge=16, description="Longest answer [tokens].")
    temperature: float = Field(
        default=0.0, ge=0, le=10, description="0 takes the likeliest token each time; 1 samples."
    )
    seed: int = Field(default=0, ge=0, description="Of the model's choices, where it makes any.")
    cache: str = Field(
        default="",
        description="Folder that keeps answers; empty: simart-kit/vlm in $XDG_CACHE_HOME or ~/.cache; "
        "off: none.",
    )
    replay: bool = Field(default=False, description="Take answers from the cache only, never from a model.")
    price_in: float = Field(
        default=0.0, ge=0, allow_inf_nan=False, description="Price of a million tokens read [any currency]."
    )
    price_out: float = Field(
        default=0.0,
        ge=0,
        allow_inf_nan=False,
        description="Price of a million tokens written [same currency].",
    )
    device: str = Field(
        default="auto", description="For transformers: auto (a GPU if there is one), cpu, cuda, or cuda:N."
    )
    dtype: Dtype = Field(default="auto", description="For transformers: type of the weights.")
    quantisation: Quantisation = Field(
        default="none", description="For transformers: of the large weights, on GPUs."
    )
    allow_slow: bool = Field(
        default=False, description="For transformers: run a large model even on a CPU, which takes hours."
    )

    def needed_extras(self) -> tuple[str, ...]:
        """Those of a model on this machine, unless all its answers are kept ones."""
        return ("mllm",) if self.backend == "transformers" and not self.replay else ()

    @model_validator(mode="before")
    @classmethod
    def _refuse_keys(cls, table: Any) -> Any:
        """Refuse a key without showing it, as other unknown options are shown."""
        names = [name for name in table if name not in cls.model_fields] if isinstance(table, dict) else []
        secret = next((name for name in names if _SECRETS.search(str(name))), None)
        if secret:
            raise ValueError(
                f"there is no option {secret}: the key is read from the environment variable {KEY_VARIABLE} "
                "and nowhere else"
            )
        return table

    @field_validator("url")
    @classmethod
    def _check_url(cls, url: str) -> str:
        """Refuse a password in the URL before it stands in a report or a recording."""
        return optional_url(url)

    @model_validator(mode="after")
    def _check_replay(self) -> VlmOptions:
        if self.replay and self.cache == "off":
            raise ValueError("replay takes answers from the cache, and cache is off: give its folder")
        return self
