"""What a spec names that a run has not: told by name, all at once, before any part is changed."""

from __future__ import annotations

from collections.abc import Iterator

from ..stages import Segmentation
from .values import Spec


def unknowns(spec: Spec, segmentation: Segmentation, pieces: int, body: int) -> list[str]:
    """Every mistake that shows with the parts of a run.

    Args:
        spec: without contradictions in itself.
        segmentation: what was found.
        pieces: how many there are.
        body: place of the part that stands still.
    """
    found = [guess.name for guess in segmentation.parts]
    told = [*_of_numbers(spec, pieces), *_of_parts(spec, found), *_of_parents(spec, found)]
    return [*told, *_of_changes(spec, found), *_of_root(spec, found[body])]


def _of_numbers(spec: Spec, pieces: int) -> Iterator[str]:
    used = [(part.name, number) for part in spec.parts for number in part.pieces or ()]
    used += [(split.name, number) for split in spec.split for number in split.pieces]
    if used and spec.numbered not in (None, pieces):
        yield (
            f"pieces are numbered among {spec.numbered}, this run has {pieces}: it is another mesh or "
            "segmenter; write the spec anew with `simart-kit spec`, or give points"
        )
        return
    for name, number in used:
        if number >= pieces:
            yield f"'{name}' has piece {number}, the object has pieces 0..{pieces - 1}"


def _of_parts(spec: Spec, found: list[str]) -> Iterator[str]:
    made = {split.name for split in spec.split}
    for part in spec.parts:
        name = part.found_as or part.name
        if part.pieces is None and part.points is None and name not in {*found, *made}:
            yield (
                f"unknown part '{name}': the run found {', '.join(found)}; "
                "give pieces, points or found_as to say which it is"
            )


def _of_parents(spec: Spec, found: list[str]) -> Iterator[str]:
    renamed = {part.found_as for part in spec.parts if part.found_as}
    merged = {name for merge in spec.merge for name in merge.parts}
    known = [part.name for part in spec.parts] + [split.name for split in spec.split]
    if not spec.only:
        known += [name for name in found if name not in renamed | merged]
    for part in spec.parts:
        if part.parent is not None and part.parent not in known:
            names = ", ".join(dict.fromkeys(known))
            yield f"part '{part.name}': unknown parent '{part.parent}', parts are {names}"


def _of_changes(spec: Spec, found: list[str]) -> Iterator[str]:
    told = ", ".join(found)
    for number, split in enumerate(spec.split):
        if split.part not in found:
            yield f"split.{number}: unknown part '{split.part}', the run found {told}"
        if split.name in found:
            yield f"split.{number}: the run has a part '{split.name}' already"
    known = {*found, *(split.name for split in spec.split)}
    for number, merge in enumerate(spec.merge):
        for name in (merge.into, *merge.parts):
            if name not in known:
                yield f"merge.{number}: unknown part '{name}', the run found {told}"


def _of_root(spec: Spec, body: str) -> Iterator[str]:
    """The part that stands still cannot have a joint, unless another is made the root."""
    if any(part.root for part in spec.parts):
        return
    for part in spec.parts:
        if (part.found_as or part.name) == body and (part.joint not in (None, "fixed") or part.parent):
            yield (
                f"joint on the root: '{part.name}' is the body, on which the others move; "
                "state root = true for another part first"
            )
