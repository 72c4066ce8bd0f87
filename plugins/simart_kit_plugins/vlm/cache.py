"""Answers kept as JSON files, one a question, so that a run can be repeated with no model at all."""

from __future__ import annotations

import hashlib
import json
import os
import tempfile
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from pydantic import BaseModel, ConfigDict, ValidationError

from simart_kit.arrays import ByteArray
from simart_kit.errors import BadInputError

from .json_reply import read_answer
from .values import Question, Reply, Usage

_FORMAT = 1


@dataclass(frozen=True, slots=True)
class Asker:
    """Whose answers are kept: others, asked the same, say something else.

    Attributes:
        backend: "server" or "transformers".
        model: its name.
        seed: of its choices.
        temperature: of its choices.
    """

    backend: str
    model: str
    seed: int
    temperature: float


class _File(BaseModel):
    """What a file holds; see docs/vlm.md."""

    model_config = ConfigDict(extra="forbid", strict=True)

    format: int
    key: str
    question: dict[str, Any]
    raw: str
    calls: int
    input_tokens: int
    output_tokens: int
    remarks: list[str]


@dataclass(frozen=True, slots=True)
class Cache:
    """A folder of answers; several runs may read and write it at once.

    Attributes:
        folder: it need not be there yet.
        asker: whose answers are meant.
    """

    folder: Path
    asker: Asker

    def path(self, question: Question) -> Path:
        """Where the answer to a question is, or would be."""
        key = _key(self._identity(question))
        return self.folder / key[:2] / f"{key}.json"

    def read(self, question: Question) -> Reply | None:
        """The answer that is kept, or None.

        Raises:
            BadInputError: its file cannot be read, or is damaged.
        """
        path = self.path(question)
        try:
            file = _File.model_validate_json(path.read_bytes())
            value = read_answer(file.raw, question.answer)
        except (FileNotFoundError, NotADirectoryError):
            return None
        except TimeoutError:  # of the run's time limit
            raise
        except OSError as error:
            raise BadInputError(f"{path}: the kept answer cannot be read: {error.strerror}") from error
        except (ValidationError, BadInputError) as error:
            raise BadInputError(f"{path}: the kept answer is damaged: delete the file") from error
        if file.format != _FORMAT or file.key != path.stem:
            raise BadInputError(f"{path}: the file is no answer to its question: delete it")
        usage = Usage(file.calls, file.input_tokens, file.output_tokens, cached=True)
        return Reply(value, usage, self.asker.model, file.raw, tuple(file.remarks))

    def write(self, question: Question, reply: Reply) -> None:
        """Keep an answer: a whole file at once, or none. Raises OSError where it cannot be written."""
        path = self.path(question)
        file = _File(
            format=_FORMAT,
            key=path.stem,
            question=self._identity(question),
            raw=reply.raw,
            calls=reply.usage.calls,
            input_tokens=reply.usage.input_tokens,
            output_tokens=reply.usage.output_tokens,
            remarks=list(reply.remarks),
        )
        path.parent.mkdir(parents=True, exist_ok=True)
        _write_whole(path, json.dumps(file.model_dump(), indent=1, ensure_ascii=False) + "\n")

    def _identity(self, question: Question) -> dict[str, Any]:
        """All that an answer depends on; pictures by their pixels."""
        return {
            "backend": self.asker.backend,
            "model": self.asker.model,
            "seed": self.asker.seed,
            "temperature": self.asker.temperature,
            "system": question.system,
            "text": question.text,
            "pictures": [_picture_hash(picture) for picture in question.pictures],
            "schema": question.schema(),
        }


def cache_folder(cache: str) -> Path:
    """The folder that the option `cache` means: its own, or one for the user."""
    if cache:
        return Path(cache).expanduser()
    base = os.environ.get("XDG_CACHE_HOME")
    return (Path(base) if base else Path.home() / ".cache") / "simart-kit" / "vlm"


def _key(identity: dict[str, Any]) -> str:
    text = json.dumps({"format": _FORMAT} | identity, sort_keys=True, separators=(",", ":"))
    return hashlib.sha256(text.encode()).hexdigest()


def _picture_hash(picture: ByteArray) -> str:
    return hashlib.sha256(repr(picture.shape).encode() + picture.tobytes()).hexdigest()


def _write_whole(path: Path, text: str) -> None:
    """Write beside and rename, so that a reader meets the old file or the new one."""
    handle, name = tempfile.mkstemp(prefix=".", suffix=".part", dir=path.parent)
    try:
        with os.fdopen(handle, "w", encoding="utf-8") as file:
            file.write(text)
        Path(name).replace(path)
    except BaseException:
        with suppress(OSError):
            Path(name).unlink()
        raise
