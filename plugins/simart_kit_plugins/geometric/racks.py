"""Racks and baskets of wire within a cavity, which slide out of its front."""

from __future__ import annotations

from collections.abc import Set

import numpy as np

from simart_kit.arrays import BoolArray, FloatArray, IntArray

from .candidates import Candidate, Choice
from .casting import first_met
from .contact import Contacts
from .movers import Mover
from .scene import FACINGS, Box, Scene
from .views import View

# All lengths are shares of the object's diagonal.
_NARROWEST = 0.4  # share of the object's width and depth: walls are thinner than cavities
_TOUCHES = 0.003  # wires nearer than this are welded
_THIN = 0.02  # second largest extent of a straight wire
_LEANS = 0.01  # no farther out of a rack reach those of its wires that touch a wall
_STICKS_OUT = 0.03  # of its cavity a rack may, up to the door before it
_WIRES = 8  # a rack is of at least so many
_BESIDE = 1.3  # from its middle to a wall, in halves of its width: it fills the cavity between them
_BEHIND = 1.8  # the same to the back, which pipes keep it from
_SEEN_THROUGH = 0.4  # share of rays from above that pass between its wires
_HIGHEST = 0.5  # share of the object's height: a cage that fills the cavity is its lining
_LEVEL = ("front", "back", "left", "right")


def racks(scene: Scene, contacts: Contacts, taken: Set[int]) -> list[Mover]:
    """Wire that hangs together within the body's cavity, nearly as wide as it, and held by no wall."""
    shell = int(scene.areas.argmax())
    inside = [i for i in range(scene.count) if i not in taken and _may_be_wire(scene, i, shell)]
    passing = np.array([*inside, *taken])
    movers = []
    for pieces in _clusters(scene, contacts, inside, shell):
        box = Box.around([scene.boxes[i] for i in pieces])
        low = box.size[2] < _HIGHEST * scene.box.size[2]
        if low and _seen_through(scene, box) and _in_cavity(scene, box, passing):
            told = f"{len(pieces)} wires that fill the width of a cavity"
            movers.append(Mover(tuple(pieces), "rack", 0.6, (told,)))
    return movers


def sliding_out(scene: Scene, view: View) -> Choice | None:
    """Level, to where the object's body does not stand in the way; None without walls on three sides."""
    box = scene.boxes[view.part]
    body = int(scene.areas.argmax())
    others = np.delete(np.arange(scene.count), body)
    ways = {name: _way_to_wall(scene, box, FACINGS[name][2], others) for name in _LEVEL}
    free = [name for name in _LEVEL if ways[name] > _BEHIND]
    if len(free) != 1 or view.part == body:
        return None
    outward = FACINGS[free[0]][2]
    travel = float(box.size @ np.abs(outward))
    candidate = Candidate("prismatic", view.axes @ outward, view.axes @ box.center, travel)
    return candidate, 0.7, ("walls stand on its other sides",)


def _may_be_wire(scene: Scene, piece: int, shell: int) -> bool:
    """Whether a piece is small, and within the box of the largest one."""
    box, outer = scene.boxes[piece], scene.boxes[shell]
    within = (box.center > outer.lower).all() and (box.center < outer.upper).all()
    within &= (box.lower > outer.lower - _STICKS_OUT).all() and (box.upper < outer.upper + _STICKS_OUT).all()
    return bool(within and piece != shell and scene.areas[piece] < 0.2 * scene.areas[shell])


def _clusters(scene: Scene, contacts: Contacts, pieces: list[int], shell: int) -> list[list[int]]:
    """Groups of wires that hang together other than by what sits on the shell: pipes and rails."""
    from scipy.sparse.csgraph import connected_components

    if len(pieces) < _WIRES:
        return []
    lower = np.array([scene.boxes[i].lower for i in pieces]) - _TOUCHES
    upper = np.array([scene.boxes[i].upper for i in pieces])
    near: BoolArray = np.all((lower[:, None] <= upper) & (lower <= upper[:, None]), axis=2)
    wide = _wide_enough(scene, pieces, connected_components(near, directed=False)[1])
    near &= wide
    # Where the boxes of thin bars meet, so do the bars; and their corners may be far from where they cross.
    thin = np.sort(upper - lower, axis=1)[:, 1] < _THIN
    welded = near & thin & thin[:, None]
    for i, j in np.argwhere(np.triu(near & ~welded, 1)):
        welded[i, j] = welded[j, i] = contacts.within(pieces[i], pieces[j], _TOUCHES)
    held = np.array(
        [bool(w) and contacts.within(i, shell, _TOUCHES) for i, w in zip(pieces, wide, strict=True)]
    )
    _, group = connected_components(welded & ~held & ~held[:, None], directed=False)
    clusters = [np.flatnonzero((group == one) & ~held) for one in np.unique(group)]
    clusters = [cluster for cluster in clusters if len(cluster) >= _WIRES]
    return [
        [pieces[i] for i in (*cluster, *_leaning([scene.boxes[i] for i in pieces], cluster, held))]
        for cluster in clusters
    ]


def _wide_enough(scene: Scene, pieces: list[int], group: IntArray) -> BoolArray:
    """(N,) whose group of near pieces could hold a rack; distances are worked out for no others."""
    wide = np.zeros(len(pieces), dtype=np.bool_)
    for one in np.flatnonzero(np.bincount(group) >= _WIRES):
        box = Box.around([scene.boxes[pieces[i]] for i in np.flatnonzero(group == one)])
        if (box.size[:2] > _NARROWEST * scene.box.size[:2]).all():
            ways = [_way_to_wall(scene, box, FACINGS[name][2], np.array(pieces)) for name in _LEVEL]
            wide[group == one] = np.isfinite(ways).sum() >= 3
    return wide


def _leaning(boxes: list[Box], cluster: IntArray, held: BoolArray) -> list[int]:
    """Those that touch the shell and lie within a cluster: wires that lean on a wall, not the pipe behind."""
    around = Box.around([boxes[i] for i in cluster])
    return [
        int(i)
        for i in np.flatnonzero(held)
        if (boxes[i].lower >= around.lower - _LEANS).all() and (boxes[i].upper <= around.upper + _LEANS).all()
    ]


def _in_cavity(scene: Scene, box: Box, within: IntArray) -> bool:
    """Whether walls stand close on two opposite sides and behind, and none in front."""
    front, back, left, right = (_way_to_wall(scene, box, FACINGS[name][2], within) for name in _LEVEL)
    sides, ends = sorted([sorted([left, right]), sorted([front, back])], key=max)
    return sides[1] < _BESIDE and ends[0] < _BEHIND < ends[1]


def _way_to_wall(scene: Scene, box: Box, direction: FloatArray, passing: IntArray) -> float:
    """How far the walls are, in halves of a box's extent; other than through the `passing` pieces."""
    half = 0.5 * float(box.size @ np.abs(direction))
    steps = np.linspace(-0.3, 0.3, 4)
    across = np.stack(np.meshgrid(steps, steps), axis=-1).reshape(-1, 2)
    offset = np.zeros((len(across), 3))
    offset[:, np.abs(direction) < 0.5] = across
    return float(np.median(first_met(scene, box.center + offset * box.size, direction, passing)[1])) / half


def _seen_through(scene: Scene, box: Box) -> bool:
    steps = (np.arange(20) + 0.5) / 20
    grid = np.stack(np.meshgrid(steps, steps), axis=-1).reshape(-1, 2)
    points = np.column_stack([box.lower[:2] + grid * box.size[:2], np.full(len(grid), box.upper[2] + 1e-3)])
    _, way = scene.rays.first(points, np.array([0.0, 0.0, -1.0]))
    return bool((way > box.size[2]).mean() > _SEEN_THROUGH)
