"""What a spec says that cannot be, each mistake by the name of its part: told before anything runs."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from .values import Motion, PartSpec, Spec, Split

AXIAL = ("revolute", "continuous", "prismatic")


def contradictions(spec: Spec) -> list[str]:
    """Every mistake that shows without an object."""
    told = [*_of_kinds(spec), *_of_names(spec.parts), *_of_roots(spec.parts), *_of_pieces(spec)]
    for number, part in enumerate(spec.parts):
        told += [f"parts.{number} '{part.name}': {text}" for text in _of_part(part)]
    return [*told, *_of_cycles(spec.parts), *_of_merges(spec), *_of_splits(spec.split)]


def _of_kinds(spec: Spec) -> Iterator[str]:
    for word, kind in spec.kinds.items():
        for text in _of_motion(kind):
            yield f"kinds.{word}: {text}"
        listed = [part for part in spec.parts if part.label == word and part.joint != "fixed"]
        if kind.count is not None and len(listed) > kind.count:
            names = ", ".join(part.name for part in listed)
            yield f"kinds.{word}.count is {kind.count}, but parts lists {len(listed)}: {names}"


def _of_motion(motion: Motion) -> Iterator[str]:
    kind = motion.joint
    if kind is not None and kind not in AXIAL and motion.axis is not None:
        yield f"joint '{kind}' has no axis, but axis is '{motion.axis}'"
    if kind == "prismatic" and motion.axis is not None and motion.axis.endswith("edge"):
        yield f"a slide goes along a direction, such as 'front', but axis is '{motion.axis}'"
    if motion.limits is None:
        return
    if kind not in ("revolute", "prismatic"):
        yield f"limits need joint 'revolute' or 'prismatic', joint is {repr(kind) if kind else 'not given'}"
    lower, upper = motion.limits
    if not lower <= 0 <= upper:
        yield f"limits {lower:g} .. {upper:g} leave out 0, the pose of the mesh"


def _of_part(part: PartSpec) -> Iterator[str]:
    yield from _of_motion(part)
    if part.joint is not None and part.joint not in AXIAL and part.through is not None:
        yield f"joint '{part.joint}' has no axis, but through is given"
    if part.parent == part.name:
        yield "is its own parent"
    if part.pieces == () or part.points == ():
        yield "has no pieces or points: leave the list out, or name some"
    given = [key for key in ("found_as", "pieces", "points") if getattr(part, key) is not None]
    if len(given) > 1:
        yield f"{' and '.join(given)} are given: one of them says which part it is"
    stated = [
        key for key in ("joint", "parent", "axis", "limits", "through") if getattr(part, key) is not None
    ]
    if part.root and stated and part.joint != "fixed":
        yield f"joint on the root: it is the root, and {', '.join(stated)} given"


def _of_names(parts: Sequence[PartSpec]) -> Iterator[str]:
    names = [part.name for part in parts]
    for name in dict.fromkeys(names):
        parents = list(dict.fromkeys(p.parent for p in parts if p.name == name and p.parent))
        if names.count(name) > 1:
            told = f", with two parents: {' and '.join(parents)}" if len(parents) > 1 else ""
            yield f"part '{name}' is listed {names.count(name)} times{told}"
    found = [part.found_as for part in parts if part.found_as]
    for name in dict.fromkeys(found):
        if found.count(name) > 1:
            yield f"found_as '{name}' is given {found.count(name)} times"


def _of_roots(parts: Sequence[PartSpec]) -> Iterator[str]:
    roots = [part.name for part in parts if part.root]
    if len(roots) > 1:
        yield f"two roots: {' and '.join(roots)}"


def _of_pieces(spec: Spec) -> Iterator[str]:
    owners: dict[int, list[str]] = {}
    claims = [(part.name, part.pieces or ()) for part in spec.parts]
    claims += [(split.name, split.pieces) for split in spec.split if split.name not in dict(claims)]
    for name, pieces in claims:
        for piece in pieces:
            owners.setdefault(piece, []).append(name)
    for piece, names in owners.items():
        if len(names) > 1:
            yield f"piece {piece} is listed {len(names)} times: of {', '.join(names)}"
        if spec.numbered is not None and piece >= spec.numbered:
            yield f"'{names[0]}' has piece {piece}, but pieces were numbered 0..{spec.numbered - 1}"


def _of_cycles(parts: Sequence[PartSpec]) -> Iterator[str]:
    parent = {part.name: part.parent for part in parts if part.parent and part.parent != part.name}
    told: set[str] = set()
    for start in parent:
        way = [start]
        while (above := parent.get(way[-1])) is not None and above not in way:
            way.append(above)
        if above == start and start not in told:
            told.update(way)
            yield f"cycle of parents: {' -> '.join([*way, start])}"


def _of_merges(spec: Spec) -> Iterator[str]:
    taken: dict[str, str] = {}
    for number, merge in enumerate(spec.merge):
        where = f"merge.{number}"
        if not merge.parts:
            yield f"{where}: nothing is merged into '{merge.into}'"
        for name in merge.parts:
            if name == merge.into:
                yield f"{where}: '{name}' is merged with itself"
            elif name in taken:
                yield f"{where}: '{name}' is merged into '{taken[name]}' and into '{merge.into}'"
            taken[name] = merge.into
    for merge in spec.merge:
        if taken.get(merge.into, merge.into) != merge.into:
            yield f"'{merge.into}' is merged away into '{taken[merge.into]}', and takes parts itself"
    for part in spec.parts:
        if (part.found_as or part.name) in taken and part.pieces is None and part.points is None:
            yield f"part '{part.name}' is listed, and merged into '{taken[part.found_as or part.name]}'"


def _of_splits(splits: Sequence[Split]) -> Iterator[str]:
    names = [split.name for split in splits]
    for number, split in enumerate(splits):
        where = f"split.{number}"
        if not split.pieces and not split.points:
            yield f"{where}: a split of nothing: name the pieces or points of '{split.name}'"
        if split.name == split.part:
            yield f"{where}: the new part is called '{split.name}' like the one that is divided"
        if names.index(split.name) != number:
            yield f"{where}: '{split.name}' is split off twice"
