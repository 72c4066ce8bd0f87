"""How far a build has come: what is needed to go on after it was killed, at a shard's end."""

from __future__ import annotations

import shutil
from collections.abc import Sequence
from pathlib import Path

from pydantic import BaseModel, ConfigDict, ValidationError

from simart_kit.errors import BadInputError

from .manifest import MANIFEST, BuildOptions, Shard, first_line, read_manifest, write_whole
from .statistics import Statistics

FOLDER = ".unfinished"
"""Inside a data set until it is finished."""
_FILE = "progress.json"


class Progress(BaseModel):
    """The state of a build when its last shard was closed."""

    model_config = ConfigDict(extra="forbid", frozen=True)

    options: BuildOptions
    jobs: int = 0
    hashes: int = 0
    shards: tuple[Shard, ...] = ()
    statistics: Statistics = Statistics()
    skipped: tuple[tuple[str, str], ...] = ()


def begun(out: Path, options: BuildOptions) -> Progress:
    """Where to begin in a folder, which is prepared for it: at the start, or where a killed run stopped.

    Raises:
        BadInputError: the folder holds something else, or records of other options, or a shard is gone.
    """
    path = out / FOLDER / _FILE
    if not path.exists():
        strangers = sorted(p.name for p in out.iterdir() if p.name != FOLDER)
        if strangers:
            raise BadInputError(f"{out} holds other things, such as {strangers[0]}: choose another folder")
        (out / FOLDER).mkdir(exist_ok=True)
        write_whole(path, Progress(options=options))
    try:
        progress = Progress.model_validate_json(path.read_bytes())
    except (OSError, ValidationError) as error:
        raise BadInputError(
            f"{path} is damaged: {first_line(error)}; remove {out} and start again"
        ) from error
    check_same(out, progress.options, options)
    _check_files(out, progress.shards)
    return progress


def saved(out: Path, progress: Progress) -> None:
    """Note how far the build has come."""
    write_whole(out / FOLDER / _FILE, progress)


def finished(out: Path, options: BuildOptions) -> bool:
    """Whether a folder holds these records already.

    Raises:
        BadInputError: it holds others, or a shard is missing or was changed.
    """
    if not (out / MANIFEST).exists():
        return False
    manifest = read_manifest(out)
    check_same(out, manifest.options, options)
    _check_files(out, manifest.shards)
    shutil.rmtree(out / FOLDER, ignore_errors=True)  # of a run that was killed as it tidied up
    return True


def check_same(out: Path, there: BuildOptions, asked: BuildOptions) -> None:
    """Refuse to mix; raises BadInputError naming the first option that differs."""
    for name, field in BuildOptions.model_fields.items():
        old, new = getattr(there, name), getattr(asked, name)
        if old != new:
            raise BadInputError(
                f"{out} holds records made with {field.description} {_told(old)}, not {_told(new)}: "
                "give the same options to go on, or choose another folder"
            )


def _check_files(out: Path, shards: Sequence[Shard]) -> None:
    for shard in shards:
        file = out / shard.file
        if not file.is_file() or file.stat().st_size != shard.bytes:
            raise BadInputError(f"{file} is missing or was changed: remove {out} and start again")


def _told(value: object) -> str:
    if isinstance(value, tuple):
        return ", ".join(map(_told, value)) or "none"
    return value.name if hasattr(value, "name") else "none" if value is None else str(value)
