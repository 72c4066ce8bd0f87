"""The vision-language model that options name."""

from __future__ import annotations

from simart_kit.errors import BadInputError

from .asking import Asking
from .cache import Asker, Cache, cache_folder
from .endpoint import KEY_VARIABLE, Endpoint, EndpointError, key_of
from .options import VlmOptions
from .served import Served
from .values import Speaker, Vlm


def open_vlm(options: VlmOptions) -> Vlm:
    """The model that options name. A local one is read when it is first asked.

    Raises:
        BadInputError: no model or server is named, or the key cannot be one.
    """
    if not options.model:
        raise BadInputError(
            "no vision-language model is named: set the option model to the name that the server lists under "
            "/v1/models, and url to the server; or with backend transformers, model to a folder or hub id"
        )
    return vlm_of(None if options.replay else _speaker(options), options)


def vlm_of(speaker: Speaker | None, options: VlmOptions) -> Vlm:
    """A model whose answers are read and kept as options say; without a speaker, they are all kept ones."""
    asker = Asker(options.backend, options.model, options.seed, options.temperature)
    cache = None if options.cache == "off" else Cache(cache_folder(options.cache), asker)
    return Asking(options.model, speaker, cache, options.max_tokens)


def endpoint_of(options: VlmOptions) -> Endpoint:
    """The server that options name, with the key of the environment.

    Raises:
        EndpointError: none is named, or the key cannot be one.
    """
    if not options.url:
        raise EndpointError(
            "no server is named: set the option url, such as http://localhost:8000/v1; "
            "or use backend transformers, or replay"
        )
    key = key_of(KEY_VARIABLE)
    return Endpoint(options.url, options.model, options.timeout, retries=options.retries, key=key)


def _speaker(options: VlmOptions) -> Speaker:
    if options.backend == "transformers":
        from ..simart.mllm.weights import Choices
        from .local import Local

        choices = Choices(options.device, options.dtype, options.quantisation, options.allow_slow)
        return Local(options.model, choices, options.max_tokens, options.temperature, options.seed)
    return Served(endpoint_of(options), options)
