"""Where a model's files are: a folder, or a repository of the Hugging Face hub and its cache."""

from __future__ import annotations

import re
from pathlib import Path

from simart_kit.errors import BadInputError

from .extra import quiet

_SMALL_FILES = ["*.json", "*.txt", "*.jinja", "codec/*"]
_WEIGHTS = "*.safetensors"
_HUB_ID = re.compile(r"[A-Za-z0-9][\w.-]*/[\w.-]+")


def located(name: str, *, weights: bool) -> Path:
    """The folder of a model.

    Args:
        name: a folder, or a hub id such as "Qwen/Qwen3-VL-8B-Instruct".
        weights: also fetch the large files; without them one can tell first whether they would fit.

    Raises:
        BadInputError: there is no such folder, and the hub cannot be reached, is not to be, or has none.
    """
    folder = Path(name).expanduser()
    if folder.is_dir():
        return folder
    if folder.exists():
        raise BadInputError(f"{folder} is a file: give the folder that config.json and the weights are in")
    if not _HUB_ID.fullmatch(name):
        raise BadInputError(f"{folder}: there is no such folder; give one, or a hub id such as NAME/MODEL")
    return _downloaded(name, [*_SMALL_FILES, _WEIGHTS] if weights else _SMALL_FILES)


def _downloaded(name: str, patterns: list[str]) -> Path:
    """A repository's files in the hub's cache, downloaded where they are not there yet."""
    from huggingface_hub import constants, snapshot_download
    from huggingface_hub.errors import HfHubHTTPError, HFValidationError, LocalEntryNotFoundError

    offline = bool(constants.HF_HUB_OFFLINE)
    try:
        with quiet():
            return Path(snapshot_download(name, allow_patterns=patterns, local_files_only=offline))
    except LocalEntryNotFoundError as error:
        why = "HF_HUB_OFFLINE is set" if offline else "the hub cannot be reached"
        raise BadInputError(
            f"'{name}' is no folder here, and as a hub id it is not in the cache while {why}: "
            f"run `hf download {name}` where there is a connection, or give a folder"
        ) from error
    except (HfHubHTTPError, HFValidationError, OSError) as error:
        first = (str(error).strip().splitlines() or [type(error).__name__])[0]
        raise BadInputError(f"'{name}' is no folder here, and the hub says: {first}") from error
