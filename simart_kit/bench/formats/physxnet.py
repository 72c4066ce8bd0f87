"""PhysXNet: a JSON file with parts, materials and joints, and an OBJ file a part.

Source: github.com/ziangcao0312/PhysX-3D (the data set's layout, and the converter urdf_gen.py). Of an object:

    finaljson/<id>.json           object_name, category, dimension ("L*W*H" in cm), parts, group_info
    partseg/<id>/objs/<label>.obj

`group_info` says what moves: "0" is the list of labels of the base; any other key is a group, as
[labels, key of the parent group, numbers, type]. The numbers are direction (3), a point of the axis (3) and
range (2), flat or nested; type CB has a second block, of the slide, with or without its point; A and E need
none. Ranges of turns are stored divided by pi; slides are in units of the frame, which is normalised to
[-0.5, 0.5].

Assumed, for nothing says so: +Y is up, as in PartNet and ShapeNet, which the shapes are from.
"""

from __future__ import annotations

import json
import math
import re
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from ...arrays import frozen_ints
from ...errors import BadInputError
from ..articulation import FULL_TURN, Articulation, Link, LinkJoint, LinkJointKind
from ..cases import Truth
from . import DEFAULT_VARIANT, TruthFormat
from .files import reading
from .mesh_files import Triangles, joined, read_triangles

_BASE = "0"
_BLOCK = 8  # direction, point, range
_SLIDE_WITHOUT_POINT = 5
_KINDS: dict[str, LinkJointKind] = {
    "A": "free",
    "B": "prismatic",
    "C": "revolute",
    "D": "ball",
    "CB": "revolute",
    "E": "fixed",
}


class PhysXNet(TruthFormat):
    """Objects of PhysXNet. Links are groups, called by the name of their first part."""

    name = "physxnet"
    layout = "finaljson/ID.json with partseg/ID/objs/*.obj"

    def find(self, root: Path) -> dict[str, Path]:
        """The JSON files below `finaljson`, by id."""
        files = [root] if root.is_file() else sorted((root / "finaljson").glob("*.json"))
        return {path.stem: path for path in files if path.match("finaljson/*.json")}

    def read(self, path: Path, variant: str = DEFAULT_VARIANT) -> Truth:
        """Read an object; type CB is revolute, and right as prismatic, too; a full turn is continuous."""
        if variant != DEFAULT_VARIANT:
            raise BadInputError(f"{path}: no variant '{variant}': PhysXNet has '{DEFAULT_VARIANT}' only")
        table = _table(path)
        with reading(path, "PhysXNet's JSON"):
            groups, names = _groups(table), _names(table)
        folder = path.parent.parent / "partseg" / path.stem / "objs"
        pieces, notes = _pieces(folder, groups, names)
        with reading(path, "an object with parts"):
            articulation = _articulation(path.stem, groups, names, pieces)
        longest = float((articulation.bounds[1] - articulation.bounds[0]).max())
        size = _longest_side(table.get("dimension"))
        if size is None:
            notes += (f"no size: dimension {table.get('dimension')!r} is not 'L*W*H' in cm",)
        return Truth(
            path.stem,
            articulation,
            category=str(table.get("category", "")),
            up="+y",
            metres_per_unit=size / longest if size and longest > 0 else None,
            notes=notes,
        )


@dataclass(frozen=True)
class _Group:
    """What moves as one: labels of its parts, how, and key of the group that carries it, if any."""

    labels: tuple[int, ...]
    joint: LinkJoint
    parent: str | None = None
    also: tuple[LinkJoint, ...] = ()


def _table(path: Path) -> dict[str, Any]:
    with reading(path, "JSON"):
        table = json.loads(path.read_text(encoding="utf-8"))
        if not isinstance(table, dict):
            raise BadInputError(f"it holds a {type(table).__name__}, expected an object with 'group_info'")
    return table


def _names(table: dict[str, Any]) -> dict[int, str]:
    """Names of the parts by label."""
    parts = table.get("parts")
    if not isinstance(parts, list) or not all(isinstance(part, dict) for part in parts):
        raise BadInputError("'parts' is missing or no list of objects")
    return {_label(part.get("label")): str(part.get("name", "")) for part in parts}


def _groups(table: dict[str, Any]) -> dict[str, _Group]:
    """The groups by key, base first."""
    info = table.get("group_info")
    if not isinstance(info, dict) or not isinstance(info.get(_BASE), list):
        raise BadInputError(f"'group_info' is missing or has no list '{_BASE}' of the parts of the base")
    moving = [key for key in info if key != _BASE]
    if not all(key.isdecimal() for key in moving):
        raise BadInputError(f"'group_info' has keys that are no numbers: {', '.join(moving)}")
    groups = {_BASE: _Group(_labels(info[_BASE]), LinkJoint())}
    groups |= {key: _group(key, info[key]) for key in sorted(moving, key=int)}
    for key, group in groups.items():
        if group.parent is not None and group.parent not in groups:
            raise BadInputError(f"group {key} has parent '{group.parent}': groups are {', '.join(groups)}")
    labels = [label for group in groups.values() for label in group.labels]
    twice = sorted({label for label in labels if labels.count(label) > 1})
    if twice:
        raise BadInputError(f"part {twice[0]} is in two groups, or twice in one")
    return groups


def _group(key: str, entry: object) -> _Group:
    if not isinstance(entry, list) or len(entry) not in (3, 4):
        raise BadInputError(f"group {key} is not [labels, parent, numbers, type]")
    labels, parent, *numbers, letters = entry
    if not isinstance(letters, str) or letters not in _KINDS:
        raise BadInputError(f"group {key} has type {letters!r}: types are {', '.join(_KINDS)}")
    found = _labels(labels)
    if not found:
        raise BadInputError(f"group {key} has no parts")
    joints = _joints(f"group {key}", letters, numbers)
    return _Group(found, joints[0], str(parent), joints[1:])


def _joints(name: str, letters: str, numbers: object) -> tuple[LinkJoint, ...]:
    """The joint of a group, and the slide after it for type CB."""
    kind = _KINDS[letters]
    if kind in ("free", "fixed"):
        return (LinkJoint(kind, name=name),)
    values = _flat(name, numbers)
    if len(values) not in ((_BLOCK + _SLIDE_WITHOUT_POINT, 2 * _BLOCK) if letters == "CB" else (_BLOCK,)):
        raise BadInputError(f"{name} of type {letters} has {len(values)} numbers: direction, point and range")
    if kind == "ball":
        return (LinkJoint("ball", origin=(values[3], values[4], values[5]), name=name),)
    first = _joint(name, kind, values[:_BLOCK])
    if letters != "CB":
        return (first,)
    slide = values[_BLOCK:]
    block = slide if len(slide) == _BLOCK else [*slide[:3], *values[3:6], *slide[3:]]
    return first, _joint(name, "prismatic", block)


def _joint(name: str, kind: LinkJointKind, block: list[float]) -> LinkJoint:
    x, y, z, u, v, w, lower, upper = block
    if lower > upper:
        raise BadInputError(f"{name}: range runs from {lower} to {upper}")
    unit = math.pi if kind == "revolute" else 1.0
    if kind == "revolute" and (upper - lower) * unit >= FULL_TURN:
        kind = "continuous"
    return LinkJoint(kind, (x, y, z), (u, v, w), lower * unit, upper * unit, name)


def _flat(name: str, value: object) -> list[float]:
    """The numbers in lists of lists."""
    if isinstance(value, list):
        return [number for item in value for number in _flat(name, item)]
    if isinstance(value, bool) or not isinstance(value, int | float) or not math.isfinite(value):
        raise BadInputError(f"{name}: {value!r} is no finite number")
    return [float(value)]


def _labels(values: object) -> tuple[int, ...]:
    if not isinstance(values, list):
        raise BadInputError(f"{values!r} is no list of part labels")
    return tuple(_label(value) for value in values)


def _label(value: object) -> int:
    """A label; a number in quotes is one, too."""
    if not re.fullmatch(r"[0-9]{1,9}", str(value)):
        raise BadInputError(f"{value!r} is no label of a part")
    return int(str(value))


def _pieces(
    folder: Path, groups: dict[str, _Group], names: dict[int, str]
) -> tuple[dict[int, Triangles], tuple[str, ...]]:
    """Vertices and faces by label, and a note about parts that are in no group."""
    grouped = {label for group in groups.values() for label in group.labels}
    there = {int(path.stem) for path in folder.glob("*.obj") if re.fullmatch(r"[0-9]{1,9}", path.stem)}
    loose = sorted((there | set(names)) - grouped)
    pieces = {label: read_triangles(folder / f"{label}.obj") for label in sorted(grouped | set(loose))}
    if not loose:
        return pieces, ()
    which = ", ".join(map(str, loose))
    return pieces, (f"parts in no group, taken for part of the base: {which}",)


def _articulation(
    name: str,
    groups: dict[str, _Group],
    names: dict[int, str],
    pieces: dict[int, Triangles],
) -> Articulation:
    keys = list(groups)
    if not pieces:
        raise BadInputError("no part: 'group_info' and 'parts' are empty, and there are no OBJ files")
    link_of = {label: index for index, key in enumerate(keys) for label in groups[key].labels}
    vertices, faces = joined(list(pieces.values()))
    owners = [link_of.get(label, 0) for label in pieces]
    sizes = [len(triangles) for _, triangles in pieces.values()]
    links = tuple(_link(group, keys, names) for group in groups.values())
    return Articulation(name, vertices, faces, frozen_ints(np.repeat(owners, sizes)), links)


def _link(group: _Group, keys: list[str], names: dict[int, str]) -> Link:
    first = group.labels[0] if group.labels else None
    name = "base" if first is None else names.get(first, "") or f"part_{first}"
    parent = -1 if group.parent is None else keys.index(group.parent)
    return Link(name, parent, group.joint, group.also, label=name)


def _longest_side(dimension: object) -> float | None:
    """Longest of "L*W*H" in cm [m]; None where it is something else."""
    text = str(dimension).strip().lower().removesuffix("cm")
    try:
        sides = [float(side) for side in text.split("*")]
    except ValueError:
        return None
    whole = len(sides) == 3 and all(math.isfinite(side) and side > 0 for side in sides)
    return max(sides) / 100 if whole else None
