"""Which fronts move: chosen by evidence, one side of the object first."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from .contact import Contacts
from .drawer_fronts import STRIP, held_aside, like_drawer, stacked
from .fronts import OPEN, Front, find_fronts, thin
from .sashes import passing, slides_over
from .scene import FACINGS, Scene
from .siblings import rows, twins
from .skin_fronts import boards, gripped, leaves, parted_side, portholes

ENCLOSED = 0.85  # share of rays behind a panel that must meet something for a cavity
SHALLOWEST = 0.05  # a cavity is at least this deep
FLAT = 0.4  # share of a panel's surface that faces out or back
FRAMED = 0.75  # share of its sides with something close beside, of what stands in a frame
WHOLE = 0.9  # share of its side from which on a front is that side
LEAST_SHARE = 0.06  # of its side that a front without a handle takes
SLAT = 8.0  # times as long as wide, a panel without a handle is a slat
TALL = 0.8  # share of the object's height above which a leaf is for passing through
MOST = 0.4  # share of its side that the leaf in a doorway takes
_LEAF = 0.3  # share of its side that a leaf takes which passes before the body, and not within a frame
_ALL = 0.99  # share of its side from which on a front leaves nothing else of it
_REST = 0.98  # share of the whole surface from which on pieces leave nothing that could hold them
_SHEET = 1e-4  # what is thinner has no back of its own
_MOST_OPEN = 0.5  # share of its side that a drawer which stands open takes: larger boxes hold the rest
_SMALL = 0.15  # share of its side that a drawer takes which has neither a back behind it nor walls all around
_DOORWAY = 0.7  # share of rays to the sides that meet the frame behind a leaf: there is no sill
_BETWEEN = 0.9  # share of the width of its side that such a drawer takes: the apron of a table takes more
_ROW = 3  # so many alike are a row
_CONTROLS = 4  # so many things on a strip are controls
_ACROSS = 0.85  # share of the width of its side that a strip takes which bears controls
_EDGE = 0.15  # share of a whole side by which what opens it is off its middle, on a skin
_TWIN = 0.5  # how sure a front is of which only its twin opens by itself
_BARE = 0.6  # how sure a front is that only the parting of a skin tells
_PORTHOLE = 0.7  # how sure a round front is, rather than the panel around it
_DOUBTFUL = 0.3  # how sure a front is that takes its whole side, and for which nothing else speaks


@dataclass(frozen=True)
class Mover:
    """Pieces that move as one.

    Attributes:
        pieces: their ids.
        label: such as "door", "sliding_door", "drawer", "lid", "rack", "lever", "wheel" or "button".
        score: 0..1.
        evidence: why it moves, a phrase each.
        facing: side that it opens to, key of `FACINGS`; "" where that does not tell how the object stands.
    """

    pieces: tuple[int, ...]
    label: str
    score: float
    evidence: tuple[str, ...]
    facing: str = ""


def front_movers(scene: Scene, contacts: Contacts, fused: bool) -> list[Mover]:
    """Doors, drawers and lids. A front with a handle counts on any side; one without, on the main side only.

    On a fused skin every patch closes the cavity within. There those with handles count, unless they take a
    whole side of the body and have them in the middle, boards with a handle and their twins, the panels of a
    parted side, round ones, and several alike of one piece with their handles.
    """
    fronts = {facing: find_fronts(scene, contacts, facing, fused) for facing in FACINGS}
    in_rows = {facing: [] if fused else _rows(scene, fronts[facing]) for facing in FACINGS}
    main = _main_side(fronts, in_rows)
    if main != "top" and any(map(_opens_by_handle, fronts[main])):
        fronts["top"] = []  # it lies on what these open: a worktop, with taps on it
    every = [front for facing in FACINGS for front in fronts[facing]]
    able = [] if fused else [front for front in every if _is_panel(front)]
    tracks = passing(scene, [front for front in able if front.framed >= 0.5 or _hides_much(front)])
    scored: list[tuple[float, Front]] = []
    for front in every:
        score = max(_score(front, front.facing == main, fused), 0.8 * (front.piece in tracks))
        if score > 0:
            scored.append((score, front))
    if fused:
        told = {front.piece for _, front in scored}
        able = boards(scene, fronts)
        bare = [*leaves(scene, able), *parted_side(scene, fronts), *gripped(scene, every)]
        scored += [(_BARE, front) for front in bare if front.piece not in told]
        scored += [(_PORTHOLE, front) for front in portholes(scene, every) if front.piece not in told]
    scored = _without_skins(_layered(_within_frames(scene, scored)))
    known = {piece for _, front in scored for piece in front.pieces}
    scored += [(_TWIN, front) for front in in_rows[main] if front.piece not in known]
    scored += [(_TWIN, front) for front in twins(scene, [front for _, front in scored], able)]
    tracks |= {front.piece for _, front in scored if _is_panel(front) and slides_over(scene, front)}
    # On a skin, what seems a grip may be a patch of the panel, and tells nothing of drawers in a column.
    drawers = stacked(scene, [front for _, front in scored if fused or not held_aside(front)])
    labels = dict.fromkeys(drawers, "drawer") | dict.fromkeys(tracks, "sliding_door")
    return _apart(scored, set(), labels)


def doubtful_movers(scene: Scene, contacts: Contacts, taken: set[int]) -> list[Mover]:
    """Panels and boxes of the main side and on top, for which too little speaks; none of `taken` pieces."""
    fronts = {facing: find_fronts(scene, contacts, facing) for facing in FACINGS}
    sides = {_main_side(fronts, {}), "top"}
    found = [front for facing in FACINGS if facing in sides for front in fronts[facing]]
    able = [front for front in found if _is_panel(front) or front.boxed]
    return _apart([(_DOUBTFUL * front.share, front) for front in able], taken, {})


def _rows(scene: Scene, fronts: Sequence[Front]) -> list[Front]:
    """Panels of a side that are each too small to tell, and in rows of alike ones close cavities."""
    bare = [
        front
        for front in fronts
        if front.share < LEAST_SHARE
        and front.facing != "top"
        and front.loose
        and not front.handles
        and not _like_slat(front)
        and _is_panel(front)
        and _closes_cavity(front)
    ]
    return [
        front
        for row in rows(scene, bare, _ROW)
        for front in row
        if sum(one.share for one in row) >= LEAST_SHARE
    ]


def _layered(scored: Sequence[tuple[float, Front]]) -> list[tuple[float, Front]]:
    """Without those that are stuck on one that is held by nothing else, which is as sure as they are."""
    outer = {id(front): score for score, front in scored}
    dropped = set[int]()
    for score, front in scored:
        for _, other in scored:
            if other.loose and not front.loose and front.piece in other.inlays:
                outer[id(other)] = max(outer[id(other)], score)
                dropped.add(id(front))
    return [(outer[id(front)], front) for _, front in scored if id(front) not in dropped]


def _without_skins(scored: Sequence[tuple[float, Front]]) -> list[tuple[float, Front]]:
    """Without those that lie in another with the same outline: the face of a leaf is not a leaf."""
    skins = {
        piece
        for _, front in scored
        for _, other in scored
        for piece in front.inlays
        if piece == other.piece and other.area > 0.9 * front.area and front.piece not in other.inlays
    }
    return [(score, front) for score, front in scored if front.piece not in skins]


def _within_frames(scene: Scene, scored: Sequence[tuple[float, Front]]) -> list[tuple[float, Front]]:
    """Without those that leave nothing that could hold them, where others lie in them: these do."""
    inner = {front.piece for _, front in scored}
    whole = _REST * scene.areas.sum()
    return [
        (score, front)
        for score, front in scored
        if scene.areas[list(front.pieces)].sum() < whole or not inner.intersection(front.inlays)
    ]


def _apart(scored: Sequence[tuple[float, Front]], taken: set[int], labels: Mapping[int, str]) -> list[Mover]:
    """The surest first, without those that share pieces with surer ones or with `taken`.

    Args:
        scored: how sure each is.
        taken: pieces.
        labels: of fronts by their piece, where more than the front tells it.
    """
    used, movers = set(taken), []
    for score, front in sorted(scored, key=lambda item: (-item[0], -item[1].area)):
        if not used.intersection(front.pieces):
            used.update(front.pieces)
            label = labels.get(front.piece) or _label(front)
            movers.append(Mover(front.pieces, label, score, _evidence(front), front.facing))
    return movers


def _main_side(fronts: dict[str, list[Front]], in_rows: Mapping[str, Sequence[Front]]) -> str:
    """The side with most to open; the canonical front wins a tie."""
    prior = {"front": 0.2, "top": -0.2}

    def weight(facing: str) -> float:
        handled = sum(1.0 + f.area for f in fronts[facing] if _opens_by_handle(f))
        hollow = sum(0.8 if f.loose else 0.3 for f in fronts[facing] if _opens_by_place(f))
        return handled + hollow + 0.8 * len(in_rows.get(facing, ())) + prior.get(facing, 0.0)

    return max(fronts, key=weight)


def _score(front: Front, main: bool, fused: bool) -> float:
    """0 for a front that stays, else how sure it moves."""
    if fused and front.framed < FRAMED and front.share > WHOLE and not (main and _held_at_edge(front)):
        return 0.0
    if front.share > _ALL and front.box.size[2] < _SHEET and not front.loose:
        return 0.0  # a side of a housing, to which the others are joined
    if _is_fascia(front):
        return 0.0
    if _opens_by_handle(front):
        return 0.9 if main else 0.6
    return 0.6 if main and not fused and _opens_by_place(front) else 0.0


def _held_at_edge(front: Front) -> bool:
    """Whether what one takes hold of is off the middle, as of a fridge's door; a case is carried by it."""
    return front.facing != "top" and front.held is not None and np.abs(front.held).max() > _EDGE


def _is_fascia(front: Front) -> bool:
    """A strip that bears controls, as above a washer's door, or hides the knees of who sits at a desk.

    It has more on it than one takes hold of, or has it where nobody would to draw it out, or there is nothing
    behind it.
    """
    width, height = front.box.size[:2]
    if width <= STRIP * height:
        return False
    if front.grips >= _CONTROLS:
        return True
    if front.boxed or front.held is None:
        return False
    hides = front.backed < OPEN and front.grips > 1
    return hides or (front.share > _ACROSS * front.tall and not like_drawer(front))


def _opens_by_handle(front: Front) -> bool:
    """Something sticks out of a panel that has something behind it, or of a drawer, or stands in a frame."""
    if not front.handles:
        return False
    if front.facing == "top":
        return _is_panel(front) and _closes_cavity(front)
    if front.boxed:
        standing_open = front.share < _MOST_OPEN and (front.hollow or bool(front.behind))
        return _in_a_body(front) and (front.walled >= 0.5 or standing_open)
    return _is_panel(front) and (front.backed >= ENCLOSED or front.framed >= FRAMED or _in_doorway(front))


def _in_a_body(front: Front) -> bool:
    """Whether something is behind a box, or all around it, as around none that carries the rest."""
    small = front.share < min(_SMALL, _BETWEEN * front.tall)
    return front.backed >= OPEN or front.walled >= ENCLOSED or small


def _in_doorway(front: Front) -> bool:
    """A tall leaf between two posts through which one passes."""
    framed = front.jambs or front.walled >= _DOORWAY  # by what stands beside it, or behind
    return framed and front.backed < OPEN and front.tall > TALL and front.share > MOST


def _opens_by_place(front: Front) -> bool:
    """Without a handle: a panel before a cavity, or an open box among walls."""
    if front.share < LEAST_SHARE or _like_slat(front):
        return False
    if front.boxed:
        return front.backed >= ENCLOSED and (
            bool(front.behind) or (front.hollow and max(front.walled, front.framed) >= 0.5)
        )
    return _is_panel(front) and _closes_cavity(front)


def _like_slat(front: Front) -> bool:
    width, height = sorted(front.box.size[:2])
    return bool(height > SLAT * width)


def _is_panel(front: Front) -> bool:
    return front.flat >= FLAT and thin(front.box)


def _hides_much(front: Front) -> bool:
    """Whether it takes so much of its side, with something behind, that it needs no frame to slide in."""
    return front.share >= _LEAF and front.backed >= ENCLOSED


def _closes_cavity(front: Front) -> bool:
    return front.walled >= ENCLOSED and front.backed >= ENCLOSED and front.depth >= SHALLOWEST


def _label(front: Front) -> str:
    if front.facing == "top":
        return "lid"
    return "drawer" if front.boxed or like_drawer(front) else "door"


def _evidence(front: Front) -> tuple[str, ...]:
    told = []
    if front.handles:
        told.append(f"{len(front.handles)} piece(s) like a handle on it")
    if _closes_cavity(front):
        told.append(f"closes a cavity {front.depth:.2f} diagonals deep")
    if front.boxed:
        told.append("a box hangs behind it")
    if front.framed >= FRAMED:
        told.append("stands in a frame")
    return tuple(told)
