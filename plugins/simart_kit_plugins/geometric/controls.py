"""Controls of hand-held things: what is pressed and tilted on top, triggers below, squeezes at the sides.

Fingers set their sizes, so these are in metres.
"""

from __future__ import annotations

from collections.abc import Set

import numpy as np

from .caps import Cap, measure_cap, stacked_on
from .contact import Contacts
from .movers import Mover
from .scene import Scene

_HELD = 0.35  # [m] larger things are not held in one hand or two
_WIDE = (0.006, 0.05)  # [m] of a button or a touchpad: from a fingertip's edge to two thumbs
_PROUD = 0.0008  # [m] less is not felt: discs so flush are lights, screws and signs
_PAD = 0.025  # [m] wider than this, it is a dish for a thumb: round, and never high
_STICK = (0.012, 0.028)  # [m] width of a thumbstick's cap
_MOST_STICKS = 2  # one a thumb: more studs alike are screws or feet
_FIELD, _PITCH = 12, 1.35  # more caps alike than this, so close in widths, are a keyboard's keys: left
_LEVEL = 40  # so are those among more caps than this that face the same way at one height, of any width
_STANDS = 0.3  # of its width, how far a thumbstick stands above its well: buttons stand less
_CURVED = (0.015, 0.055)  # [m] length of a trigger or of a squeeze: about one finger's, or two
_COMPACT = 2.2  # length over width at most: longer is a seam, a strap or a stripe
_ROUND = 1.25  # length over width at most, of what is round
_ON_TOP = ("button", "touchpad", "thumbstick")
_UP, _DOWN, _SIDEWAYS = 0.35, -0.3, 0.85  # of the outward direction

_Said = tuple[str, str]
"""A label, and why."""


def hand_controls(scene: Scene, contacts: Contacts, taken: Set[int]) -> list[Mover]:
    """What fingers move; without anything on top one trigger alone: two are the feet of a thing."""
    if scene.box.size.max() * scene.size > _HELD or scene.count < 2:
        return []
    caps = _caps(scene, taken)
    found = _alone(caps, _told({piece: _on_top(cap, scene.size) for piece, cap in caps.items()}))
    around = _told({p: _around(cap, scene.size) for p, cap in caps.items() if p not in found})
    if not found and [label for label, _ in around.values()] != ["trigger"]:
        return []
    found |= around
    if len(found) == 1 and not _sure_alone(caps, *found.items()):
        return []
    movers, used = [], set(taken) | set(found)
    for piece, (label, reason) in found.items():
        stacked = stacked_on(scene, piece, caps[piece], used) if label in _ON_TOP else ()
        used.update(stacked)
        movers.append(Mover((piece, *stacked), label, 0.6, (reason,)))
    return movers


def _told(said: dict[int, _Said | None]) -> dict[int, _Said]:
    return {piece: one for piece, one in said.items() if one is not None}


def _alone(caps: dict[int, Cap], told: dict[int, _Said]) -> dict[int, _Said]:
    """Without thumbsticks where they are too many, and without the keys of a keyboard."""
    sticks = [piece for piece, (label, _) in told.items() if label == "thumbstick"]
    dropped = set(sticks) if len(sticks) > _MOST_STICKS else set()
    dropped.update(piece for piece, (label, _) in told.items() if label == "button" and _is_key(caps, piece))
    return {piece: one for piece, one in told.items() if piece not in dropped}


def _is_key(caps: dict[int, Cap], piece: int) -> bool:
    """Whether it is one of many alike, side by side, or of very many at one height."""
    own, wide = caps[piece], caps[piece].wide
    heights = [(cap.top - own.top) @ own.outward for cap in caps.values() if cap.outward @ own.outward > 0.95]
    if (np.abs(heights) < 0.2 * wide).sum() > _LEVEL:
        return True
    alike = [cap.top for cap in caps.values() if abs(cap.wide - wide) < 0.1 * wide]
    if len(alike) <= _FIELD:
        return False
    apart = np.linalg.norm(np.array(alike) - own.top, axis=1)
    return bool(np.sort(apart)[1] < _PITCH * wide)


def _sure_alone(caps: dict[int, Cap], one: tuple[int, _Said]) -> bool:
    """Whether one control needs no company: alone, a stick is a lid's knob, and what is not round a plate."""
    piece, (label, _) = one
    round_cap = caps[piece].wide < _ROUND * caps[piece].narrow
    return label == "trigger" or (label != "thumbstick" and round_cap)


def _caps(scene: Scene, taken: Set[int]) -> dict[int, Cap]:
    """Every piece of a size for fingers, but the largest, as a finger meets it."""
    widest = max(_WIDE[1], _CURVED[1]) / scene.size
    able = [
        piece
        for piece, box in enumerate(scene.boxes)
        if piece not in taken and _WIDE[0] / scene.size < np.linalg.norm(box.size) < 1.8 * widest
    ]
    measured = {piece: measure_cap(scene, (piece,)) for piece in able if piece != scene.areas.argmax()}
    return {piece: cap for piece, cap in measured.items() if cap is not None and cap.closed}


def _on_top(cap: Cap, metre: float) -> _Said | None:
    """Label and reason of what is pressed or tilted from above; `metre` is the size of the object [m]."""
    wide, proud = cap.wide * metre, cap.proud * metre
    if cap.outward[2] < _UP or cap.wide > _COMPACT * cap.narrow or cap.facing < 0.4 or cap.rimmed < 0.7:
        return None
    round_cap = cap.wide < _ROUND * cap.narrow
    if round_cap and cap.proud > _STANDS * cap.wide and _STICK[0] < wide < _STICK[1]:
        return "thumbstick", "a round cap stands high above what is around it"
    if not _WIDE[0] < wide < _WIDE[1] or proud < _PROUD:
        return None
    if wide > _PAD:
        dish = round_cap and cap.proud < 0.2 * cap.wide
        return ("touchpad", "a round dish for a thumb, with the body all around") if dish else None
    low = cap.proud < 0.5 * cap.wide
    return ("button", "a small cap of its own, with the body all around") if low else None


def _around(cap: Cap, metre: float) -> _Said | None:
    """Label and reason of what fingers pull from below, or press from a side."""
    if not _CURVED[0] < cap.wide * metre < _CURVED[1] or cap.wide > _COMPACT * cap.narrow:
        return None
    if cap.outward[2] < _DOWN and cap.rimmed > 0.5 and cap.proud > 0.3 * cap.wide:
        return "trigger", "a thick piece hangs out below, under a finger"
    beside = abs(cap.outward[0]) > _SIDEWAYS and cap.rimmed > 0.85
    if beside and cap.proud * metre > 2 * _PROUD and cap.proud < 0.4 * cap.wide:
        return "squeeze", "a small cap in the side, under a finger"
    return None
