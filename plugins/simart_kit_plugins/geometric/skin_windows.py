"""Leaves of windows on a fused skin: panes with both faces, each with the frame that its handle is on.

Such a window stands upright and is thin. Extents leave out the ends of pieces, which are ragged on skins.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence, Set
from dataclasses import dataclass, replace
from itertools import combinations

import numpy as np

from simart_kit.arrays import FloatArray

from .extents import extent_without
from .movers import Mover
from .scene import FACINGS, Scene

_SIDES = ("front", "left")  # from either of which one sees all that stands upright
_THIN = 0.4  # thickness of a window, as a share of its width and height
_ENDS = 0.01  # share of a piece's surface at either end that its extents leave out
_ALONG = 0.9  # how nearly a face looks to one side
_AJAR = np.deg2rad(3.0)  # what leans more stands ajar
_FACE = 0.3  # share of a pane's surface that each of its faces has
_LEAST = 0.15  # share of the whole's width and height that a pane takes
_ALONE = 0.4  # the same of a pane that is no pair's
_RIM = 0.4  # share of a frame's surface that looks to one side
_BAR = 0.3  # of its height by which a pane may be above another of the same leaf
_WIDER = 1.8  # so many times as wide and high as its pane a frame is at most
_SAME = 0.15  # of their size by which the panes of two leaves may differ
_LEVEL = 0.03  # diagonals by which they may be out of line
_BETWEEN = 0.5  # of its longer side by which two panes may be apart: the frames meet there
_TRACK = 0.006  # diagonals between the middles of panes that pass by each other, at least
_OUT, _GRIP = 0.01, 0.4  # how far handles stand out [diagonals], and the share of the leaf that they take
_TRACKED = ("sliding_door", "sash")  # what passes by its like across, and up
_SMALL = 0.1  # share of the whole surface below which a piece goes with the leaf in which it lies


@dataclass(frozen=True, eq=False)
class _Piece:
    """One piece, seen from a side: (u, v, w) across, up and out.

    Attributes:
        piece: its id.
        lower, upper: (3,) where it begins and ends.
        faces: (2,) share of its surface that looks towards that side, and away from it.
        levels: (2,) where these lie on the whole [w].
        ajar: by how much they lean to the side [rad].
        share: of the whole surface.
    """

    piece: int
    lower: FloatArray
    upper: FloatArray
    faces: FloatArray
    levels: FloatArray
    ajar: float
    share: float

    @property
    def size(self) -> FloatArray:
        """(3,) extents."""
        return self.upper - self.lower

    @property
    def center(self) -> FloatArray:
        """(3,) middle of its extents; along w, of its two faces."""
        middle = (self.lower + self.upper) / 2
        return np.array([*middle[:2], self.levels.mean()])

    def lies_in(self, other: _Piece, margin: float) -> bool:
        """Whether its rectangle lies in another's."""
        low, high = self.lower[:2] > other.lower[:2] - margin, self.upper[:2] < other.upper[:2] + margin
        return bool(low.all() and high.all())


@dataclass(frozen=True, eq=False)
class _Leaf:
    """A pane and the frames before and behind it."""

    pane: _Piece
    frames: tuple[_Piece, ...]

    @property
    def pieces(self) -> tuple[_Piece, ...]:
        """Both."""
        return (self.pane, *self.frames)


def window_leaves(scene: Scene, known: Set[int]) -> list[Mover]:
    """Leaves in two tracks slide, the lower one if one is above the other; two with a handle, or ajar, turn.

    So does a single one in a frame with a handle, unless its pane is one of the `known` pieces.
    """
    for side in _SIDES:
        whole = scene.box.turned(FACINGS[side])
        if whole.size[2] < _THIN * whole.size[:2].min():
            seen = _seen(scene, FACINGS[side])
            found = list(_moving(scene, seen, _leaves(seen, whole.size), side, known))
            if found:
                return found
    return []


def _moving(
    scene: Scene, seen: Sequence[_Piece], leaves: Sequence[_Leaf], side: str, known: Set[int]
) -> Iterator[Mover]:
    told: dict[int, tuple[_Leaf, str, str]] = {}
    for one, other in combinations(leaves, 2):
        lower, upper = sorted((one, other), key=lambda leaf: float(leaf.pane.center[1]))
        label, reason = _pair(scene, lower, upper, side)
        if label in _TRACKED:
            along = _TRACKED.index(label)
            lower, upper = (_with_stiles(seen, *two, along) for two in ((lower, upper), (upper, lower)))
        for leaf in {"": (), "sash": (lower,)}.get(label, (lower, upper)):
            told[leaf.pane.piece] = (leaf, label, reason)
    whole = scene.box.turned(FACINGS[side]).size
    for leaf in leaves:
        new = leaf.pane.piece not in known and leaf.pane.piece not in told
        large = (leaf.pane.size[:2] > _ALONE * whole[:2]).all()
        if new and large and leaf.frames and _has_handle(scene, leaf, side):
            told[leaf.pane.piece] = (leaf, "door", "a pane in a frame with a handle")
    used = set(told)
    for leaf, label, reason in told.values():
        pieces = (leaf.pane.piece, *(piece for piece in _all_of(seen, leaf) if piece not in used))
        used.update(pieces)
        yield Mover(pieces, label, 0.7, (reason,), side)


def _pair(scene: Scene, lower: _Leaf, upper: _Leaf, side: str) -> tuple[str, str]:
    """What two leaves are, and why; nothing where they are not alike, or nothing tells that they move."""
    one, other = lower.pane, upper.pane
    along = _follows(one, other)
    if along is None:
        return "", ""
    if max(one.ajar, other.ajar) > _AJAR:
        return ("door", "stands ajar, or beside its like that does") if along == 0 else ("", "")
    if abs(one.center[2] - other.center[2]) > _TRACK:
        return ("sash" if along else "sliding_door"), "a pane in a track of its own"
    if along == 0 and any(_has_handle(scene, leaf, side) for leaf in (lower, upper)):
        return "door", "one of two panes in frames with a handle"
    return "", ""


def _seen(scene: Scene, axes: FloatArray) -> list[_Piece]:
    """All pieces that have a surface, from one side."""
    order = np.argsort(scene.labels, kind="stable")
    ends = np.searchsorted(scene.labels[order], np.arange(scene.count + 1))
    middles, normals = scene.triangles.mean(axis=1) @ axes.T, scene.normals @ axes.T
    found = []
    for piece in np.flatnonzero(scene.areas > 0).tolist():
        faces = order[ends[piece] : ends[piece + 1]]
        found.append(
            _piece(piece, middles[faces], normals[faces], scene.face_areas[faces] / scene.areas.sum())
        )
    return found


def _piece(piece: int, middles: FloatArray, normals: FloatArray, shares: FloatArray) -> _Piece:
    """A piece by its faces: their middles, normals and shares of the whole surface, as seen from the side."""
    low, high = np.transpose([extent_without(_ENDS, column, shares) for column in middles.T])
    looks = [normals[:, 2] > _ALONG, normals[:, 2] < -_ALONG]
    faces = np.array([shares[look].sum() for look in looks])
    levels = [
        np.average(middles[look, 2], weights=shares[look]) if share > 0 else middles[:, 2].mean()
        for look, share in zip(looks, faces, strict=True)
    ]
    way = shares[looks[0]] @ normals[looks[0]] - shares[looks[1]] @ normals[looks[1]]
    ajar = float(np.arctan2(abs(way[0]), way[2]))
    return _Piece(piece, low, high, faces / shares.sum(), np.array(levels), ajar, float(shares.sum()))


def _leaves(seen: Sequence[_Piece], whole: FloatArray) -> list[_Leaf]:
    panes = [one for one in seen if one.faces.min() > _FACE and (one.size[:2] > _LEAST * whole[:2]).all()]
    panes = _columns(panes)
    return [_Leaf(pane, tuple(one for one in seen if _frames(one, pane, panes))) for pane in panes]


def _columns(panes: Sequence[_Piece]) -> list[_Piece]:
    """Panes, those above one another with but a bar between as one: in one plane, as sashes are not."""
    columns: list[_Piece] = []
    for pane in sorted(panes, key=lambda one: float(one.lower[1])):
        below = next((one for one in columns if _barred(one, pane)), None)
        if below is None:
            columns.append(pane)
        else:
            upper, share = np.maximum(below.upper, pane.upper), below.share + pane.share
            columns[columns.index(below)] = replace(below, upper=upper, share=share)
    return columns


def _barred(below: _Piece, pane: _Piece) -> bool:
    """Whether a pane is right above another, as wide and in its plane."""
    ends = np.abs([pane.lower[0] - below.lower[0], pane.upper[0] - below.upper[0]]).max()
    between = float(pane.lower[1] - below.upper[1])
    level = abs(pane.center[2] - below.center[2]) < _TRACK
    return bool(level and ends < _SAME * pane.size[0] and 0 < between < _BAR * pane.size[1])


def _frames(one: _Piece, pane: _Piece, panes: Sequence[_Piece]) -> bool:
    """Whether a piece is the frame of this pane, and of no other."""
    around = pane.lies_in(one, _LEVEL) and (one.size[:2] < _WIDER * pane.size[:2]).all()
    rim = one.faces.max() > _RIM and one.faces.min() < _FACE
    within = [other for other in panes if other.lies_in(one, 0.0)]
    return bool(rim and around and len(within) <= 1)


def _follows(one: _Piece, other: _Piece) -> int | None:
    """The axis along which two panes alike follow each other: 0 across, 1 up; None where they do not."""
    size = np.maximum(one.size[:2], other.size[:2])
    if (np.abs(one.size[:2] - other.size[:2]) > _SAME * size).any():
        return None
    apart = np.abs(one.center[:2] - other.center[:2])
    for along in (0, 1):
        near = -_BETWEEN * size[along] < apart[along] - size[along] < _BETWEEN * size.max()
        if near and apart[1 - along] < _LEVEL:
            return along
    return None


def _with_stiles(seen: Sequence[_Piece], leaf: _Leaf, other: _Leaf, along: int) -> _Leaf:
    """A leaf with the small pieces in its track where two panes meet, across or up, such as their stiles."""
    pieces = (*leaf.pieces, *other.pieces)
    low = np.min([one.lower for one in pieces], axis=0) - _LEVEL
    high = np.max([one.upper for one in pieces], axis=0) + _LEVEL
    low[along], high[along] = sorted((leaf.pane.center[along], other.pane.center[along]))
    between = replace(leaf.pane, lower=low, upper=high)
    mine = (
        one
        for one in seen
        if one.share < _SMALL
        and one.lies_in(between, 0.0)
        and abs(one.center[2] - leaf.pane.center[2]) < abs(one.center[2] - other.pane.center[2])
    )
    return replace(leaf, frames=tuple(dict.fromkeys((*leaf.frames, *mine))))


def _has_handle(scene: Scene, leaf: _Leaf, side: str) -> bool:
    """Whether something small stands out of the frame or the pane, on either side."""
    size = leaf.pane.size[:2]
    for one in leaf.pieces:
        places = scene.points_of(one.piece) @ FACINGS[side].T
        for sign, level in ((1.0, one.levels[0]), (-1.0, one.levels[1])):
            out = places[sign * (places[:, 2] - level) > _OUT]
            if len(out) and (np.ptp(out[:, :2], axis=0) < _GRIP * size.max()).all():
                return True
    return False


def _all_of(seen: Sequence[_Piece], leaf: _Leaf) -> tuple[int, ...]:
    """A leaf's pieces and the small ones within it, such as bars and handles."""
    around = max(leaf.pieces, key=lambda one: float(one.size[:2].prod()))
    low = min(one.lower[2] for one in leaf.pieces) - _LEVEL
    high = max(one.upper[2] for one in leaf.pieces) + _LEVEL
    known = [one.piece for one in leaf.pieces]
    small = [
        one.piece
        for one in seen
        if one.piece not in known
        and one.share < _SMALL
        and one.lies_in(around, 0.0)
        and low < one.lower[2]
        and one.upper[2] < high
    ]
    return (*known, *small)
