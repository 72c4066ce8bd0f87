"""What stands between a file nobody checked and the libraries that read it."""

from __future__ import annotations

import logging
import warnings
import zipfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import numpy as np

from simart_kit import BadInputError

# A 3MF or USDZ beyond these is a bomb or not one object. Ratios are held only against archives that unpack to
# something large: a small file of equal numbers may well shrink a hundredfold.
MAX_ENTRIES, MAX_UNPACKED, MAX_RATIO, SMALL = 1000, 512 * 2**20, 100, 16 * 2**20
# Errors that libraries raise without a word.
WORDLESS: dict[type[BaseException], str] = {
    AssertionError: "its parts do not fit together",
    StopIteration: "a part that must be there is missing",
}
ARCHIVES = (".zip", ".3mf", ".gz", ".bz2", ".xz", ".7z", ".rar")


@contextmanager
def reading(path: Path, kind: str) -> Iterator[None]:
    """Turn what is raised about a broken file into one BadInputError that names it; let nothing be printed.

    Args:
        path: the file.
        kind: what it should be, such as "GLB".
    """
    try:
        with warnings.catch_warnings(), np.errstate(all="ignore"):
            warnings.simplefilter("ignore")
            # numpy stops at the first word that is no number, and only warns that it lost the rest.
            warnings.filterwarnings("error", "string or file could not be read", DeprecationWarning)
            yield
    except BadInputError as error:
        raise BadInputError(f"{path}: {error}") from error
    except OSError as error:
        raise BadInputError(f"{path} cannot be read: {error.strerror or one_line(error)}") from error
    except Exception as error:
        raise BadInputError(
            f"{path} cannot be read as {kind}: {one_line(error)}; check it, or export it again"
        ) from error


@contextmanager
def survived(logger: str) -> Iterator[list[str]]:
    """Collect what a library logs about problems that it carries on after, instead of printing it."""
    log, lines = logging.getLogger(logger), _Lines()
    level, propagate = log.level, log.propagate
    log.addHandler(lines)
    log.setLevel(logging.DEBUG)
    log.propagate = False
    try:
        yield lines.texts
    finally:
        log.removeHandler(lines)
        log.setLevel(level)
        log.propagate = propagate


class _Lines(logging.Handler):
    """Keeps warnings, and errors that were caught; those of ours are told by whoever raised them."""

    def __init__(self) -> None:
        super().__init__()
        self.texts: list[str] = []

    def emit(self, record: logging.LogRecord) -> None:
        error = record.exc_info[1] if record.exc_info else None
        if isinstance(error, BadInputError) or (error is None and record.levelno < logging.WARNING):
            return
        text = record.getMessage() + (f" ({one_line(error)})" if error else "")
        if text not in self.texts:
            self.texts.append(text)


def one_line(error: BaseException) -> str:
    """The first line of an error's message, with its type where that says more."""
    lines = str(error).strip().splitlines() or [WORDLESS.get(type(error), "")]
    named = isinstance(error, (KeyError, IndexError, AttributeError)) or not lines[0]
    text = f"{type(error).__name__}: {lines[0]}".rstrip(": ") if named else lines[0]
    return f"it refers to what it does not have ({text})" if isinstance(error, IndexError) else text


def check_zip(path: Path) -> None:
    """Refuse an archive that would unpack to too much; raises BadInputError."""
    try:
        with zipfile.ZipFile(path) as archive:
            entries = archive.infolist()
    except zipfile.BadZipFile as error:
        raise BadInputError("not a zip archive, as this format must be; export it again") from error
    unpacked = sum(entry.file_size for entry in entries)
    packed = max(1, sum(entry.compress_size for entry in entries))
    if len(entries) > MAX_ENTRIES or unpacked > MAX_UNPACKED:
        raise BadInputError(
            f"it holds {len(entries)} files of {unpacked / 2**20:.0f} MiB: more than {MAX_ENTRIES} files or "
            f"{MAX_UNPACKED // 2**20} MiB are refused"
        )
    if unpacked > SMALL and unpacked / packed > MAX_RATIO:
        raise BadInputError(f"it unpacks to {unpacked / packed:.0f} times its size: refused as a zip bomb")
    nested = [e.filename for e in entries if e.filename.lower().endswith(ARCHIVES)]
    if nested:
        raise BadInputError(f"it holds another archive, '{nested[0]}': refused")
