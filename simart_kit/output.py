"""The output folder: written aside, moved into place when all is done, nothing of the user's lost."""

from __future__ import annotations

import hashlib
import json
import os
import shutil
import sys
import tempfile
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path

from .errors import OutputError

PROVENANCE = "provenance.json"
_STAGING = ".simart-kit-"


@contextmanager
def staging(out: Path) -> Iterator[Path]:
    """A fresh folder inside `out`, removed at the end whatever happens; makes `out` and removes it if unused.

    Raises:
        OutputError: `out` is a file, cannot be written, or another run is writing to it.
    """
    created: list[Path] = []
    with ExitStack() as held:
        try:
            created = [p for p in (out, *out.parents) if not p.exists()]
            out.mkdir(parents=True, exist_ok=True)
            held.enter_context(claimed(out))
            for stale in out.glob(f"{_STAGING}*"):
                shutil.rmtree(stale)  # of a run that was killed
            folder = Path(tempfile.mkdtemp(prefix=_STAGING, dir=out))
        except OSError as error:
            _remove_empty(created)
            reason = "it is a file" if isinstance(error, FileExistsError) else error.strerror or str(error)
            raise OutputError(
                f"cannot write to output folder {out}: {reason}; choose another with --out"
            ) from error
        folder.chmod(0o755)  # mkdtemp's 0700 would be inherited by nothing, but readers of a crash need in
        try:
            yield folder
        finally:
            shutil.rmtree(folder, ignore_errors=True)
            _remove_empty(created)


def commit(folder: Path, out: Path) -> tuple[str, ...]:
    """Move everything in `folder` into `out`, replacing what an earlier run wrote.

    A file or folder in the way that the earlier run did not write, or that was changed since, is kept beside
    under a `.bak` name.

    Returns:
        A sentence for each thing kept.

    Raises:
        OutputError: a symbolic link is in the way; nothing was moved.
    """
    earlier = _earlier_hashes(out)
    for target in (out / source.name for source in folder.iterdir()):
        if target.is_symlink():
            raise OutputError(f"{target} is a symbolic link: remove it or choose another folder with --out")
    kept = []
    # Provenance last: while it is the old one, its hashes tell which of the files are still the old run's.
    for source in sorted(folder.iterdir(), key=lambda p: (p.name == PROVENANCE, p.name)):
        target = out / source.name
        if target.exists():
            if not _is_ours(target, out, earlier):
                backup = _free_name(target)
                target.rename(backup)
                kept.append(f"{target.name} was not as the last run left it: kept as {backup.name}")
            elif target.is_dir():
                shutil.rmtree(target)
        source.replace(target)
    return tuple(kept)


def keep_failure(kept: Path, out: Path) -> None:
    """Move the folder of a failed run to `out/failed`, replacing that of an earlier failure."""
    forget_failure(out)
    target = out / "failed"
    if target.exists():
        target.rename(_free_name(target))
    kept.replace(target)


def forget_failure(out: Path) -> None:
    """Remove what an earlier failed run left, once a run succeeded."""
    target = out / "failed"
    if (target / "error.txt").is_file() and not target.is_symlink():
        shutil.rmtree(target)


def hashes(folder: Path) -> dict[str, str]:
    """SHA-256 of every file below a folder, by relative path, but for provenance and staging folders."""
    return {
        path.relative_to(folder).as_posix(): hashlib.sha256(path.read_bytes()).hexdigest()
        for path in sorted(folder.rglob("*"))
        if path.is_file()
        and path.name != PROVENANCE
        and not path.relative_to(folder).parts[0].startswith(_STAGING)
    }


def left_over(folder: Path, out: Path) -> dict[str, str]:
    """Hashes of what earlier runs left in `out` and the run in `folder` does not write again."""
    written = {path.name for path in folder.iterdir()}
    return {
        name: text
        for name, text in _earlier_hashes(out).items()
        if Path(name).parts[0] not in written and (out / name).is_file()
    }


@contextmanager
def claimed(out: Path) -> Iterator[None]:
    """Keep other runs out of a folder, by a lock that the system drops however this process ends.

    Raises:
        OutputError: another run has it.
    """
    handle = None if sys.platform == "win32" else os.open(out, os.O_RDONLY)
    try:
        if handle is not None and not _locked(handle):
            raise OutputError(
                f"another run is writing to {out}: wait for it, or choose another folder with --out"
            )
        yield
    finally:
        if handle is not None:
            os.close(handle)


def _locked(handle: int) -> bool:
    """Take the lock of an open folder; False when another process has it. Without locks there is no other."""
    import fcntl

    try:
        fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        return False
    except OSError:
        return True  # a file system without locks
    return True


def _is_ours(target: Path, out: Path, earlier: dict[str, str]) -> bool:
    if target.name == PROVENANCE:
        return bool(earlier)
    files = [target] if target.is_file() else [p for p in target.rglob("*") if p.is_file()]
    return all(
        earlier.get(path.relative_to(out).as_posix()) == hashlib.sha256(path.read_bytes()).hexdigest()
        for path in files
    )


def _earlier_hashes(out: Path) -> dict[str, str]:
    try:
        record = json.loads((out / PROVENANCE).read_text(encoding="utf-8"))
        return {**record.get("earlier_outputs", {}), **record["outputs"]}
    except (OSError, ValueError, KeyError, TypeError, AttributeError):
        return {}  # no earlier run, or its record is not readable: then nothing counts as ours


def _free_name(target: Path) -> Path:
    number = 1
    while True:
        candidate = target.with_name(f"{target.name}.bak{number}")
        if not candidate.exists():
            return candidate
        number += 1


def _remove_empty(created: list[Path]) -> None:
    for path in created:
        if path.is_dir() and not any(path.iterdir()):
            path.rmdir()
