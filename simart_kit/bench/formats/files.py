"""Reading files of others: whatever is wrong with one is told as one line that names it."""

from __future__ import annotations

import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import numpy as np

from ...errors import BadInputError

LARGEST = 1e30  # squares of lengths and areas still are finite numbers


@contextmanager
def reading(path: Path, kind: str) -> Iterator[None]:
    """Turn whatever is raised about a file into a BadInputError that names it, and let nothing be printed.

    Args:
        path: of the file.
        kind: what it should be, such as "mesh".
    """
    try:
        with warnings.catch_warnings(), np.errstate(all="ignore"):
            warnings.simplefilter("ignore")
            yield
    except BadInputError as error:
        raise BadInputError(f"{path}: {error}") from error
    except FileNotFoundError as error:
        raise BadInputError(f"no such file: {error.filename or path}") from error
    except Exception as error:  # libraries raise anything about a damaged file
        raise BadInputError(f"{path} cannot be read as {kind}: {_one_line(error)}") from error


def _one_line(error: Exception) -> str:
    """What an error says, on one line that means something without its traceback."""
    lines = str(error).strip().splitlines()
    if lines and "pickle" in lines[0]:
        return "it is damaged, or holds Python objects and no numbers"  # numpy advises to load it unsafely
    if lines and not isinstance(error, LookupError):
        return lines[0]
    return ": ".join([type(error).__name__, *lines[:1]])
