"""A record as the JSON document of a shard, without its picture, which is a file beside it."""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import Any

import numpy as np

from simart_kit.errors import BadInputError

from ..answer.values import Motion, ObjectAnswer, PartAnswer
from ..tokens import TokenGrid, VoxelTokens
from .record import Pair, Record

SCHEMA = 1


def to_json(record: Record) -> bytes:
    """One line of UTF-8, the same bytes for the same record."""
    grid = record.voxels.grid
    table = {
        "schema": SCHEMA,
        "key": record.key,
        "object": record.object,
        "source": record.source,
        "category": record.category,
        "state": record.state,
        "grid": {"shape": grid.shape, "codebook": grid.codebook},
        "voxels": _tokens(record.voxels),
        "answer": {
            "name": record.answer.name,
            "scale": record.answer.scale,
            "parts": [_part(part) for part in record.answer.parts],
        },
        "pairs": [{"task": p.task, "question": p.question, "part": p.part} for p in record.pairs],
    }
    return json.dumps(table, separators=(",", ":"), ensure_ascii=False, allow_nan=False).encode()


def from_json(data: bytes, picture: bytes | None, where: str) -> Record:
    """The record of a document.

    Args:
        data: what `to_json` gave.
        picture: the PNG file beside it, or None.
        where: for messages.

    Raises:
        BadInputError: the document is damaged or of another schema.
    """
    try:
        table = json.loads(data)
        if table["schema"] != SCHEMA:
            raise BadInputError(f"{where}: schema {table['schema']}, this version reads {SCHEMA}")
        return _record(table, picture)
    except (ValueError, KeyError, TypeError, AttributeError) as error:
        raise BadInputError(f"{where} is damaged: {type(error).__name__} {error}") from error
    except BadInputError as error:
        raise BadInputError(str(error) if str(error).startswith(where) else f"{where}: {error}") from error


def _record(table: Mapping[str, Any], picture: bytes | None) -> Record:
    grid = TokenGrid(tuple(table["grid"]["shape"]), table["grid"]["codebook"])
    answer = table["answer"]
    parts = tuple(_part_of(row, grid) for row in answer["parts"])
    record = Record(
        table["key"],
        table["object"],
        table["source"],
        table["category"],
        table["state"],
        _tokens_of(table["voxels"], grid),
        ObjectAnswer(answer["name"], answer["scale"], parts),
        tuple(Pair(row["task"], row["question"], row["part"]) for row in table["pairs"]),
        picture,
    )
    wrong = [pair for pair in record.pairs if not _possible(pair, len(parts))]
    if wrong:
        raise BadInputError(f"a {wrong[0].task!r} question about part {wrong[0].part} of {len(parts)}")
    return record


def _possible(pair: Pair, parts: int) -> bool:
    if pair.task == "urdf":
        return pair.part is None
    return pair.task == "grounding" and pair.part is not None and 0 <= pair.part < parts


def _tokens(tokens: VoxelTokens) -> dict[str, list[int]]:
    return {"index": tokens.index.tolist(), "code": tokens.code.tolist()}


def _tokens_of(table: Mapping[str, Any], grid: TokenGrid) -> VoxelTokens:
    index, code = (np.array(table[name], dtype=np.int64) for name in ("index", "code"))
    return VoxelTokens(grid, index, code)


def _part(part: PartAnswer) -> dict[str, Any]:
    motion = part.motion
    told = None if motion is None else {"center": motion.center, "axis": motion.axis, "limits": motion.limits}
    return {
        "name": part.name,
        "type": part.type,
        "parent": part.parent,
        "motion": told,
        "material": part.material,
        "density": part.density,
        "youngs_modulus": part.youngs_modulus,
        "voxels": _tokens(part.voxels),
    }


def _part_of(row: Mapping[str, Any], grid: TokenGrid) -> PartAnswer:
    motion = row["motion"]
    if motion is not None:
        axis, limits = motion["axis"], motion["limits"]
        motion = Motion(
            tuple(motion["center"]),
            None if axis is None else tuple(axis),
            None if limits is None else tuple(limits),
        )
    return PartAnswer(
        row["type"],
        _tokens_of(row["voxels"], grid),
        row["name"],
        row["parent"],
        motion,
        row["material"],
        row["density"],
        row["youngs_modulus"],
    )
