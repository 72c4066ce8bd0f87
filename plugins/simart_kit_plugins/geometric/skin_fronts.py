"""Fronts of a fused skin that no handle tells: a side that is parted into panels, and boards that stand free.

Each piece of a skin closes the hollow within. What tells fronts is that one side of a plain box is parted.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from .fronts import Front, thin
from .rough_discs import rough_disc
from .scene import FACINGS, Scene
from .views import View, view_part

_OPPOSITE = {"front": "back", "back": "front", "left": "right", "right": "left"}
_BESIDE = {"front": ("left", "right"), "back": ("left", "right"), "left": ("front", "back")} | {
    "right": ("front", "back")
}
_FLAT = 0.6  # share of a panel's surface that faces out
_PLAIN = 0.7  # share of its side that what takes all of it has, but for rims and feet
_LEAST, _MOST = 0.05, 0.92  # shares of its side that a panel takes
_PARTED = 0.6  # share of a parted side that its panels take together
_LEVEL = 0.03  # diagonals between the planes, and between the edges, of panels of one front
_DEEP = 0.1  # of the diagonal, how far the other side is behind a panel
_STRIP = 0.2  # share of the height up to which what runs along the floor or the top is a plinth or a fascia
_WIDE = 0.85  # share of the width that these take
_TALL, _LEAF = 0.75, 0.3  # shares of the height and of its side that a leaf takes
_TWO_SIDED = 0.3  # share of a leaf's surface that each of its faces has
# Share of its panel that a handle covers at most, and of either side: a moulding is as long as what it is on.
_KNOB, _BAR = 0.12, 0.6
_ROUND_LEAST, _ROUND_MOST = 0.1, 0.6  # shares of its side that a round door takes
_ALIKE = 0.15  # shares of their width and height by which panels in a row may differ, and be out of line
_CORNER = 0.75  # share of the way from the middle to both edges beyond which it is none
_OUT = 0.008  # diagonals that it stands out


def parted_side(scene: Scene, fronts: Mapping[str, Sequence[Front]]) -> list[Front]:
    """The panels of the side of a box that is parted more than the opposite one, and one beside it plain."""
    pieces = {side: _pieces(fronts[side]) for side in fronts}
    found = []
    for side, opposite in _OPPOSITE.items():
        level = _level_panels(scene, fronts[side])
        if len(level) > pieces[opposite] and min(pieces[beside] for beside in _BESIDE[side]) == 1:
            found.append([front for front in level if not _is_strip(scene, front)])
    return max(found, key=len, default=[])


def leaves(scene: Scene, upright: Sequence[Front]) -> list[Front]:
    """Boards that bear a handle."""
    return [front for front in upright if has_handle(scene, front)]


def gripped(scene: Scene, upright: Sequence[Front]) -> list[Front]:
    """Panels before a body, several alike in line, each of one piece with what stands out of it."""
    able = [
        front
        for front in upright
        if front.facing != "top" and not front.handles and front.flat > _FLAT and _may_close(front)
        if thin(front.box) and not _is_strip(scene, front) and _has_grip(scene, front)
    ]
    return [front for front in able if any(_beside(front, other) for other in able)]


def _beside(one: Front, other: Front) -> bool:
    """Whether two fronts of one side have about the same size, and are level or upright with each other."""
    if one is other or one.facing != other.facing:
        return False
    size, apart = one.box.size[:2], np.abs(one.box.center - other.box.center)[:2]
    alike = (np.abs(size - other.box.size[:2]) < _ALIKE * size).all()
    return bool(alike and (apart < _ALIKE * size).any())


def portholes(scene: Scene, upright: Sequence[Front]) -> list[Front]:
    """Round rims around something round, on a larger panel before a deep body, as of a washing machine."""
    closed = [front for front in upright if front.facing != "top" and _closes(front)]
    return [
        front
        for front in closed
        if _ROUND_LEAST < front.share < _ROUND_MOST
        and front.depth > front.box.size[:2].max()
        and any(front.piece in other.inlays for other in closed if other.facing == front.facing)
        and any(_is_round(scene, front.facing, inner) for inner in front.inlays)
        and _is_round(scene, front.facing, front.piece)
    ]


def _is_round(scene: Scene, facing: str, piece: int) -> bool:
    disc = rough_disc(scene.points_of(piece))
    return disc is not None and abs(FACINGS[facing][2][disc.axis]) > 0.5


def _has_grip(scene: Scene, front: Front) -> bool:
    """Whether a panel bears a handle that is not at its corner, where skins are ragged."""
    view = view_part(scene, front.piece)
    central = min(np.abs(view.handle_place)) < _CORNER
    return bool(central and front.facing == view.facing and _bears_knob(view))


def boards(scene: Scene, fronts: Mapping[str, Sequence[Front]]) -> list[Front]:
    """Tall ones with two faces, which stand upright."""
    return [
        front
        for side in _OPPOSITE
        for front in fronts[side]
        if front.tall > _TALL and front.share > _LEAF and _is_board(scene, front)
    ]


def has_handle(scene: Scene, front: Front) -> bool:
    """Whether something small stands out of a front, of its own or of one piece with it."""
    if front.handles:
        return True
    view = view_part(scene, front.piece)
    return front.facing in (view.facing, _OPPOSITE.get(view.facing)) and _bears_knob(view)


def _bears_knob(view: View) -> bool:
    if view.handle is None or view.handle.upper[2] - view.box.upper[2] < _OUT:
        return False
    share = view.handle.size[:2] / view.box.size[:2]
    return bool(share.prod() < _KNOB and share.max() < _BAR)


def _is_board(scene: Scene, front: Front) -> bool:
    faces = scene.faces_of((front.piece,))
    along = scene.normals[faces] @ FACINGS[front.facing][2]
    areas = scene.face_areas[faces]
    return bool(min(areas[along > 0.9].sum(), areas[along < -0.9].sum()) > _TWO_SIDED * areas.sum())


def _pieces(fronts: Sequence[Front]) -> int:
    """How many panels a side is of; many where none, or too few, cover it."""
    shares = sorted((front.share for front in _outer(fronts) if front.share > _LEAST), reverse=True)
    covered = np.flatnonzero(np.cumsum(shares) > _PLAIN)
    return int(covered[0]) + 1 if len(covered) else len(fronts) + 1


def _outer(fronts: Sequence[Front]) -> list[Front]:
    inner = {piece for front in fronts for piece in front.inlays}
    return [front for front in fronts if front.piece not in inner and front.flat > _FLAT and thin(front.box)]


def _level_panels(scene: Scene, fronts: Sequence[Front]) -> list[Front]:
    """Panels in one plane that together take most of the side; or none."""
    able = [front for front in _outer(fronts) if _may_close(front)]
    if not able:
        return []
    levels = np.array([_plane(scene, front) for front in able])
    main = levels[int(np.argmax([front.share for front in able]))]
    level = [front for front, at in zip(able, levels, strict=True) if abs(at - main) < _LEVEL]
    return level if len(level) > 1 and sum(front.share for front in level) > _PARTED else []


def _plane(scene: Scene, front: Front) -> float:
    """Where most of its surface lies [w]."""
    faces = scene.faces_of((front.piece,))
    return float(np.median(scene.triangles[faces].mean(axis=1) @ FACINGS[front.facing][2]))


def _may_close(front: Front) -> bool:
    return _closes(front) and _LEAST < front.share < _MOST


def _closes(front: Front) -> bool:
    return min(front.walled, front.backed) > 0.85 and front.depth > _DEEP


def _is_strip(scene: Scene, front: Front) -> bool:
    whole = scene.box.turned(FACINGS[front.facing])
    low = front.box.lower[1] < whole.lower[1] + 0.05 * whole.size[1]
    high = front.box.upper[1] > whole.upper[1] - 0.05 * whole.size[1]
    return bool(front.tall < _STRIP and front.box.size[0] > _WIDE * whole.size[0] and (low or high))
