"""Extras: the libraries that simart-kit does without, and the one line for who needs them and has not."""

from __future__ import annotations

from importlib.util import find_spec

from .errors import BadInputError

# Modules of each extra of pyproject.toml that people use.
EXTRAS = {
    "coacd": ("coacd",),
    "mllm": ("torch", "transformers", "tokenizers", "accelerate", "peft"),
    "torch": ("torch",),
}


def install_command(extra: str) -> str:
    """What to type to have an extra."""
    return f"pip install 'simart-kit[{extra}]'"


def require_extra(extra: str, what: str) -> None:
    """Nothing where the libraries of an extra are there; none is imported.

    Args:
        extra: a key of `EXTRAS`.
        what: needs it, for people, such as "segmenter 'tokens'".

    Raises:
        BadInputError: says which are missing, and what to install.
    """
    missing = [module for module in EXTRAS[extra] if find_spec(module) is None]
    if missing:
        raise BadInputError(f"{what} needs {', '.join(missing)}: {install_command(extra)}")
