"""The folder that a command writes a model to: checked first, then put in place in one move."""

from __future__ import annotations

import shutil
from pathlib import Path
from tempfile import mkdtemp
from typing import TYPE_CHECKING

from simart_kit.errors import BadInputError, OutputError

if TYPE_CHECKING:
    from ..models import VoxelModel


def check_folder(out: Path) -> None:
    """Refuse a folder with anything but a model of ours, and a file; raises BadInputError."""
    from ..vqvae.checkpoint import CONFIG_FILE, WEIGHTS_FILE
    from ..vqvae.config_file import read_config

    if out.exists() and not out.is_dir():
        raise BadInputError(f"{out} is a file: choose a folder")
    names = {path.name for path in out.iterdir()} if out.is_dir() else set()
    other = sorted(names - {CONFIG_FILE, WEIGHTS_FILE})
    if other:
        raise BadInputError(
            f"{out} holds other things than a model, such as {other[0]}: choose another folder"
        )
    if names:
        read_config(out / CONFIG_FILE)


def put_model(model: VoxelModel, out: Path, compact: bool = False) -> None:
    """Write a model beside its place and move it in, so that nothing half-written is ever there.

    Args:
        model: to write.
        out: its folder.
        compact: store the compact form.

    Raises:
        OutputError: the folder cannot be written.
    """
    from ..vqvae.checkpoint import save_checkpoint

    place = out.resolve()
    try:
        place.parent.mkdir(parents=True, exist_ok=True)
        aside = Path(mkdtemp(prefix=f".{place.name}-", dir=place.parent))
    except OSError as error:
        raise OutputError(f"cannot write the model to {out}: {error.strerror}") from error
    try:
        _swap(save_checkpoint(model, aside / "new", compact), place, aside / "old")
    except OSError as error:
        raise OutputError(f"cannot write the model to {out}: {error.strerror}") from error
    finally:
        shutil.rmtree(aside, ignore_errors=True)


def _swap(new: Path, place: Path, old: Path) -> None:
    """Move a folder into a place; what was there goes to `old`, or stays if the move fails."""
    if place.exists():
        place.rename(old)
    try:
        new.rename(place)
    except OSError:
        if old.exists():
            old.rename(place)
        raise
