"""Which fronts move: chosen by evidence, one side of the object first."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .contact import Contacts
from .fronts import Front, find_fronts
from .scene import FACINGS, Scene

ENCLOSED = 0.85  # share of rays behind a panel that must meet something for a cavity
SHALLOWEST = 0.04  # a cavity is at least this deep


@dataclass(frozen=True)
class Mover:
    """Pieces that move as one.

    Attributes:
        pieces: their ids.
        label: "door", "drawer", "lid", "wheel" or "knob".
        score: 0..1.
        evidence: why it moves, a phrase each.
    """

    pieces: tuple[int, ...]
    label: str
    score: float
    evidence: tuple[str, ...]


def front_movers(scene: Scene, contacts: Contacts, fused: bool) -> list[Mover]:
    """Doors, drawers and lids. A front with a handle counts on any side; one without, on the main side only.

    On a fused skin every patch closes the cavity within, so there only framed fronts with handles count.
    """
    fronts = {facing: find_fronts(scene, contacts, facing) for facing in FACINGS}
    main = _main_side(fronts)
    chosen: list[tuple[float, Front]] = []
    for facing, found in fronts.items():
        for front in found:
            score = _fused_score(front) if fused else _score(front, facing == main)
            if score > 0:
                chosen.append((score, front))
    taken: set[int] = set()
    movers = []
    for score, front in sorted(chosen, key=lambda item: (-item[0], -item[1].area)):
        if not taken.intersection(front.pieces):
            taken.update(front.pieces)
            movers.append(Mover(front.pieces, _label(front), score, _evidence(front)))
    return movers


def _main_side(fronts: dict[str, list[Front]]) -> str:
    """The side with most to open; the canonical front wins a tie."""
    prior = {"front": 0.2, "top": -0.2}

    def weight(facing: str) -> float:
        handled = sum(1.0 + f.area for f in fronts[facing] if f.handles and _backed(f))
        hollow = sum(0.3 for f in fronts[facing] if _closes_cavity(f))
        return handled + hollow + prior.get(facing, 0.0)

    return max(fronts, key=weight)


def _score(front: Front, main: bool) -> float:
    """0 for a front that stays, else how sure it moves."""
    if front.handles and _backed(front):
        return 0.9 if main else 0.6
    if front.handles and front.framed >= 0.75:
        return 0.7
    if not main:
        return 0.0
    if front.behind and front.boxed and front.backed >= ENCLOSED:
        return 0.8
    if _closes_cavity(front):
        return 0.6
    return 0.0


def _fused_score(front: Front) -> float:
    return 0.4 if front.handles and front.framed >= 0.75 and _backed(front) else 0.0


def _backed(front: Front) -> bool:
    return front.backed >= ENCLOSED or front.boxed


def _closes_cavity(front: Front) -> bool:
    return front.walled >= ENCLOSED and front.backed >= ENCLOSED and front.depth >= SHALLOWEST


def _label(front: Front) -> str:
    if front.facing == "top":
        return "lid"
    return "drawer" if front.boxed else "door"


def _evidence(front: Front) -> tuple[str, ...]:
    told = []
    if front.handles:
        told.append(f"{len(front.handles)} piece(s) like a handle on it")
    if _closes_cavity(front):
        told.append(f"closes a cavity {front.depth:.2f} diagonals deep")
    if front.boxed:
        told.append("a box hangs behind it")
    if front.framed >= 0.75:
        told.append("stands in a frame")
    return tuple(told)
