"""Which model is asked: the one that options name, read once a process."""

from __future__ import annotations

from importlib.resources import files
from pathlib import Path
from typing import TYPE_CHECKING

from pydantic import Field, field_validator

import simart_kit
from simart_kit.errors import BadInputError

from ..vlm.endpoint import optional_url
from .endpoint.values import KEY_VARIABLE, endpoint_at
from .mllm.placing import Dtype, Quantisation

if TYPE_CHECKING:
    from .partner import Partner


class ModelOptions(simart_kit.Options):
    """Which model, and where it runs."""

    model: str = Field(
        default="", description="Folder or hub id of the model; empty: the shipped one, if there is one."
    )
    device: str = Field(
        default="auto", description="auto (a GPU where there is one), cpu, cuda, or such as cuda:1."
    )
    dtype: Dtype = Field(default="auto", description="Of the weights; auto: what the device does best.")
    quantisation: Quantisation = Field(default="none", description="Of the large weights, on GPUs.")
    allow_slow: bool = Field(default=False, description="Run a large model even on a CPU, which takes hours.")
    endpoint: str = Field(
        default="",
        description="URL of an OpenAI-compatible server that runs the model, such as "
        "http://localhost:8000/v1; its key is read from the environment variable SIMART_API_KEY.",
    )
    endpoint_model: str = Field(default="", description="Name of the model on that server.")
    endpoint_timeout: float = Field(
        default=300.0, gt=0, allow_inf_nan=False, description="Longest wait for a reply of the server [s]."
    )

    def needed_extras(self) -> tuple[str, ...]:
        """Of the model; with a server's, only the voxel model runs here."""
        return ("torch",) if self.endpoint else ("mllm",)

    @field_validator("endpoint")
    @classmethod
    def _check_endpoint(cls, url: str) -> str:
        """Refuse a password in the URL before it stands in a report or a recording."""
        return optional_url(url, KEY_VARIABLE)


def shipped_folder() -> Path:
    """The folder of the model that comes with the package; it need not be there."""
    return Path(str(files(__package__))) / "weights" / "mllm-tiny"


def open_partner(options: ModelOptions) -> Partner:
    """The model that options name.

    Raises:
        BadInputError: no model is named and none is shipped, it cannot be had or read, memory or device do
            not suffice, or the endpoint is none.
    """
    if options.endpoint:
        return _served(options)
    name = options.model
    if not name:
        folder = shipped_folder()
        if not folder.is_dir():
            raise BadInputError(
                "no language model is named and none is shipped: add --set segmenter.options.model=FOLDER, "
                "as `simart-kit train mllm` writes it, or a hub id, or segmenter.options.endpoint=URL"
            )
        name = str(folder)
    from .mllm.bundle import load_bundle
    from .partner import partner_here

    bundle = load_bundle(
        name,
        device=options.device,
        dtype=options.dtype,
        quantisation=options.quantisation,
        allow_slow=options.allow_slow,
    )
    return partner_here(bundle)


def _served(options: ModelOptions) -> Partner:
    """A server's model: its settings and codec are those of the folder `model`, else the shipped codec."""
    from .default_model import load_model
    from .mllm.bundle import read_codec
    from .mllm.hub import located
    from .mllm.settings import read_settings, settings_of
    from .partner import partner_at
    from .vocabulary import Vocabulary

    endpoint = endpoint_at(options.endpoint, options.endpoint_model, options.endpoint_timeout)
    if not options.model:
        codec = load_model()
        return partner_at(endpoint, settings_of(Vocabulary(codec.grid, 0), codec), codec)
    folder = located(options.model, weights=False)
    settings = read_settings(folder)
    return partner_at(endpoint, settings, read_codec(folder, settings))
