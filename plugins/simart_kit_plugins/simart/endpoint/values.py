"""The server that options name."""

from __future__ import annotations

from ...vlm.endpoint import Endpoint, EndpointError, key_of
from ...vlm.endpoint import require_url as require_any_url

__all__ = ["KEY_VARIABLE", "Endpoint", "EndpointError", "endpoint_at", "require_url"]

KEY_VARIABLE = "SIMART_API_KEY"


def require_url(url: str) -> None:
    """Raise EndpointError unless this is the URL of a server, and nothing but that; shows no password."""
    require_any_url(url, KEY_VARIABLE)


def endpoint_at(url: str, model: str, timeout: float) -> Endpoint:
    """The server at a URL, with the key of the environment.

    Raises:
        EndpointError: no http(s) URL, more than that in it (see `require_url`), or no name of a model.
    """
    require_url(url)
    if not model:
        raise EndpointError(
            f"endpoint {url}: its model is not named: add --set segmenter.options.endpoint_model=NAME, "
            "the name that the server lists under /v1/models"
        )
    return Endpoint(
        url,
        model,
        timeout,
        key=key_of(KEY_VARIABLE),
        key_variable=KEY_VARIABLE,
        timeout_option="endpoint_timeout",
    )
