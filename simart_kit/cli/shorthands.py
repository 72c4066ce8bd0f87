"""Options of `convert` that are short for an option of the recipe's segmenter."""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from ..errors import BadInputError

if TYPE_CHECKING:
    from ..plugins import Plugins


@dataclass(frozen=True)
class Shorthand:
    """`--NAME VALUE`, short for `--set segmenter.options.NAME=VALUE`.

    Attributes:
        lacks: what a segmenter does not do that has no such option.
        recipe: one whose segmenter does it.
        file: the value names a file, which must exist.
    """

    lacks: str
    recipe: str
    file: bool = False


SHORTHANDS: Mapping[str, Shorthand] = {
    "transfer": Shorthand("decodes no voxels", "tokens"),
    "image": Shorthand("looks at no picture", "simart", file=True),
    "text": Shorthand("reads no text", "simart"),
}


def shorthand_sets(
    values: Mapping[str, str | Path | None], recipe: str, sets: Iterable[str], plugins: Plugins
) -> list[str]:
    """The `--set` texts that shorthands stand for.

    Args:
        values: of the options named in `SHORTHANDS`, None for those that are not given. A file's path stays
            as it is: absolute, or relative to the working folder.
        recipe: name or file.
        sets: other changes to it, which may choose the segmenter.
        plugins: where the segmenter is looked up.

    Raises:
        BadInputError: the segmenter has no such option, the file does not exist, or a value is not UTF-8.
    """
    given = {name: value for name, value in values.items() if value is not None}
    if not given:
        return []
    from ..recipe import load_recipe
    from ..stages import Segmenter

    use = load_recipe(recipe, plugins, sets).segmenter.use
    known = plugins.find(Segmenter.kind, use).value.Options.model_fields
    for name, value in given.items():
        _check(name, value, use, known)
    return [f"segmenter.options.{name}={_toml(str(value))}" for name, value in given.items()]


def _check(name: str, value: str | Path, use: str, known: Iterable[str]) -> None:
    short = SHORTHANDS[name]
    if name not in known:
        raise BadInputError(
            f"--{name} {value}: segmenter '{use}' {short.lacks}; "
            f"use it with one that does, such as --recipe {short.recipe}"
        )
    if not _is_text(str(value)):
        raise BadInputError(f"--{name} {str(value)!a}: this is not UTF-8 text")
    if short.file and not _is_file(Path(value)):
        raise BadInputError(f"--{name} {value}: there is no such file")


def _is_text(value: str) -> bool:
    try:
        value.encode()
    except UnicodeEncodeError:  # bytes of the command line that are no text
        return False
    return True


def _is_file(path: Path) -> bool:
    try:
        return path.is_file()
    except OSError:  # a name that no file can have, or a folder that may not be looked into
        return False


def _toml(text: str) -> str:
    """A string as TOML writes it; JSON's strings are TOML's, but for DEL."""
    return json.dumps(text, ensure_ascii=False).replace("\x7f", "\\u007f")
