"""Furniture of Sweet Home 3D, whose OBJ groups say by their names what opens, on which hinge or rail.

    sweethome3d_opening_on_hinge_1_door     moves about the longest side of the group sweethome3d_hinge_1
    sweethome3d_opening_on_rail_2_...       slides along sweethome3d_rail_2, or else sweethome3d_unique_rail
    ..._on_hinge_1_..._on_rail_2_...        hangs on what moves about hinge 1

`window_pane`, `window_mirror`, `mirror`, `light` and `light_source` stand for `opening`, too.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from simart_kit.arrays import FloatArray, vec3
from simart_kit.bench.articulation import Link, LinkJoint
from simart_kit.errors import BadInputError

from .furniture import catalogued
from .obj_groups import Group, ObjFile, look, read_obj
from .rigged import GREY, Piece, Rigged
from .sources import Entry

_MOVING = "opening|window_pane|window_mirror|mirror|light|light_source"
_OPENS = re.compile(rf"sweethome3d_(?:{_MOVING})_on_(hinge|rail)_(\d+)")
_GUIDE = re.compile(r"sweethome3d_(hinge|rail)_(\d+)|sweethome3d_(unique_rail)")
# A guide whose two longest sides are as like as this does not say for sure which way it lies.
_DOUBTFUL = 1.15
_NO_LIMITS = (
    "the source gives no limits of turns; an axis is the longest side of its hinge, as in Sweet Home 3D"
)
Guide = tuple[str, int]
_UNIQUE: Guide = ("rail", 0)


@dataclass(frozen=True, eq=False)
class _Openings:
    """What opens: guides, each after the one that carries it, those carriers, and the guide of each group."""

    guides: tuple[Guide, ...]
    carriers: dict[Guide, Guide]
    owners: tuple[Guide | None, ...]


def read_sweet_home(path: Path, entry: Entry) -> Rigged:
    """Read a model of a catalogue, in its unit, +y up; the catalogue's size gives the scale.

    Raises:
        BadInputError: the model is in no catalogue, nothing of it opens, or a hinge or rail is missing.
    """
    row = catalogued(path)
    file = read_obj(path)
    file = ObjFile(file.vertices @ row.turn.T, file.groups, row.colors | file.colors)
    extent = np.ptp(_places(file, range(len(file.groups))), axis=0)
    openings = _openings(file.groups)
    if not openings.guides:
        raise BadInputError(f"{path}: none of its groups opens on a hinge or a rail")
    number: dict[Guide | None, int] = {guide: 1 + index for index, guide in enumerate(openings.guides)}
    number[None] = 0
    links, notes, scale = [Link("body")], [], row.scale(extent)
    for guide in openings.guides:
        places = _guide_places(file, guide)
        if not len(places):
            raise BadInputError(f"{path}: there is no {_name(guide)}, on which something opens")
        moved = _places(file, [i for i, owner in enumerate(openings.owners) if owner == guide])
        notes += _doubts(guide, places * scale)
        joint = _joint(guide, places, moved, float(extent.max()))
        links.append(Link(_name(guide), number[openings.carriers.get(guide)], joint))
    pieces = [_piece(file, i, number[owner]) for i, owner in enumerate(openings.owners)]
    return Rigged(tuple(pieces), tuple(links), "+y", scale, row.name.lower(), (*notes, _NO_LIMITS))


def _openings(groups: tuple[Group, ...]) -> _Openings:
    """Read the names of the groups; a group belongs to the last guide that it names."""
    carriers: dict[Guide, Guide] = {}
    guides: list[Guide] = []
    owners: list[Guide | None] = []
    for group in groups:
        chain = list(dict.fromkeys((kind, int(number)) for kind, number in _OPENS.findall(group.name)))
        for index, guide in enumerate(chain):
            if guide not in guides:
                guides.append(guide)
            if index:
                carriers.setdefault(guide, chain[index - 1])
        owners.append(chain[-1] if chain else None)
    guides.sort(key=lambda guide: (guide in carriers, guide))
    return _Openings(tuple(guides), carriers, tuple(owners))


def _guide_places(file: ObjFile, guide: Guide) -> FloatArray:
    """(N, 3) corners of the groups that are a hinge or rail; none where there is no such thing."""
    found: dict[Guide, list[int]] = {}
    for index, group in enumerate(file.groups):
        for kind, number, unique in _GUIDE.findall(group.name):
            found.setdefault(_UNIQUE if unique else (kind, int(number)), []).append(index)
    return _places(file, found.get(guide) or (found.get(_UNIQUE, []) if guide[0] == "rail" else []))


def _places(file: ObjFile, groups: Iterable[int]) -> FloatArray:
    """(N, 3) corners of some groups."""
    corners = [file.vertices[np.unique(file.groups[index].faces)] for index in groups]
    return np.concatenate(corners) if corners else np.zeros((0, 3))


def _name(guide: Guide) -> str:
    return f"{guide[0]}_{guide[1]}"


def _joint(guide: Guide, places: FloatArray, moved: FloatArray, size: float) -> LinkJoint:
    """The joint that a hinge or rail with these corners is to what moves on it, in an object of a size."""
    low, high = places.min(axis=0), places.max(axis=0)
    along = int(np.argmax(high - low))
    axis, middle = vec3(np.eye(3)[along]), vec3((low + high) / 2)
    if guide[0] == "hinge":
        return LinkJoint("revolute", axis, middle, name=_name(guide))
    lower, upper = _travel(low[along], high[along], moved[:, along], size) if len(moved) else (None, None)
    return LinkJoint("prismatic", axis, middle, lower, upper, _name(guide))


def _travel(low: float, high: float, moved: FloatArray, size: float) -> tuple[float | None, float | None]:
    """How far something that slides can go on its rail; nothing where it juts out or hardly moves."""
    lower, upper = float(low - moved.min()), float(high - moved.max())
    if lower > 1e-3 * size or upper < -1e-3 * size:
        return None, None
    lower, upper = min(lower, 0.0), max(upper, 0.0)
    return (lower, upper) if upper - lower > 0.2 * np.ptp(moved) else (None, None)


def _doubts(guide: Guide, places: FloatArray) -> list[str]:
    extent = np.ptp(places, axis=0)
    _, second, longest = np.sort(extent)
    if longest >= _DOUBTFUL * second:
        return []
    return [f"{_name(guide)}: its axis is doubtful, as its hinge or rail is {np.round(extent, 4).tolist()} m"]


def _piece(file: ObjFile, index: int, link: int) -> Piece:
    group = file.groups[index]
    used, faces = np.unique(group.faces, return_inverse=True)
    color = look(file.colors, group.material, GREY)
    return Piece(file.vertices[used], faces.reshape(-1, 3), color, link)
