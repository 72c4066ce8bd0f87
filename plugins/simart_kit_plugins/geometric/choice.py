"""Choosing among candidates by evidence: each piece of it adds to a score and is told in words."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from .candidates import Candidate
from .scene import FACINGS, Box
from .views import View

SLIDING = ("drawer", "tray", "rack", "slide", "sliding", "button", "basket")
HINGED = ("door", "lid", "flap", "cover", "hatch", "gate", "window", "hinge")
STANDING_OPEN = (*HINGED, "screen", "display", "tailgate")
RACKS = ("rack", "tray", "basket")
SPINNING = ("wheel", "knob", "caster", "dial", "fan", "rotor")
_TALL = 2.0  # times as high as wide, a leaf never hangs by its lower or upper edge, nor so wide by its sides
AJAR = np.deg2rad(1.0)


@dataclass(frozen=True, eq=False)
class Surroundings:
    """What lies around a part, in the (u, v, w) of its view.

    Attributes:
        hardware: small pieces of the body, some of which may be hinges.
        neighbours: boxes of other moving parts.
        posts: round, upright pieces of the body.
        unheld: edges of the part behind which nothing could hold a hinge.
    """

    hardware: tuple[Box, ...]
    neighbours: tuple[Box, ...]
    posts: tuple[Box, ...] = ()
    unheld: frozenset[str] = frozenset()


@dataclass(frozen=True)
class Score:
    """A number and the reasons for it."""

    value: float
    reasons: tuple[str, ...]


def says(label: str, words: Sequence[str]) -> bool:
    """Whether a label names one of these things."""
    spoken = re.findall(r"[a-z]+", label.lower())
    return any(word in (one, one.removesuffix("s")) for one in spoken for word in words)


def sides(label: str) -> tuple[str, ...]:
    """Facings that a part called so may have, whatever shows most of it."""
    if says(label, ("drawer",)):  # an open one shows more of its inside than of its front
        return tuple(name for name in FACINGS if name != "top")
    return ("top",) if says(label, ("seat",)) else tuple(FACINGS)  # a seat may lie under its lid


def slide_score(view: View, label: str) -> Score:
    """Evidence for a slide."""
    across, _ = view.handle_place
    width, height, _ = view.box.size
    return _sum(
        (2.0, view.is_box, "a box hangs behind the front"),
        (0.8, view.handle is not None and abs(across) < 0.2, "handle in the middle of the width"),
        (0.5, width > 1.6 * height, "wider than high"),
        (3.0, says(label, SLIDING), f"labelled '{label}'"),
    )


def hinge_score(view: View, label: str) -> Score:
    """Evidence for a hinge, wherever it is."""
    across, _ = view.handle_place
    width, height, _ = view.box.size
    return _sum(
        (1.2, not view.is_box, "a plain panel"),
        (1.0, view.handle is not None and abs(across) > 0.35, "handle near an edge"),
        (0.5, height > width, "higher than wide"),
        (1.0, abs(view.ajar) > AJAR, f"stands ajar by {np.degrees(abs(view.ajar)):.0f} degrees"),
        (3.0, says(label, HINGED), f"labelled '{label}'"),
    )


def edge_score(view: View, hinge: Candidate, around: Surroundings) -> Score:
    """Evidence for a hinge on one edge."""
    across, up = view.handle_place
    opposite = {"left": across, "right": -across, "bottom": up, "top": -up}[hinge.edge]
    meets = _neighbour_beyond(view, hinge, around)
    upright = hinge.edge in ("left", "right")
    lid = view.facing == "top"
    width, height = view.box.size[:2]
    tall = not upright and not lid and bool(height > _TALL * width)
    wide = upright and bool(width > _TALL * height)
    # What is of neither of two leaves, where they meet, is a lock or a handle; below a tall one are feet.
    hardware = [] if meets or tall else hardware_on(view, hinge, around)
    bar = view.handle is not None and view.handle.size[0] > view.handle.size[1]
    centred = abs(across) < 0.3 and abs(up) > 0.5
    return _sum(
        (1.5, upright and opposite > 0.3, "handle on the opposite side"),
        (1.6, not upright and opposite > 0.5 and (bar or lid) and centred, "handle along the opposite side"),
        (1.5, bool(hardware), "hinge-like pieces on this edge"),
        (0.5, bool(hardware) and hardware[-1] - hardware[0] > 0.3, "several of them, as a lock is not"),
        (
            2.0,
            abs(view.ajar) > AJAR and upright and (view.ajar < 0) == (hinge.edge == "left"),
            "ajar from this edge",
        ),
        (-0.7, meets, ""),
        (0.3, _at_body_edge(view, hinge), "at the outer edge of the body"),
        (-0.6, not upright and not lid, ""),
        (-0.8, tall or wide, ""),
        (-0.5, meets and hinge.edge in around.unheld, ""),
        (0.5, lid and hinge.edge == "top", "lids open from the back"),
        (-0.4, lid and hinge.edge == "bottom", ""),
    )


def _sum(*evidence: tuple[float, bool | np.bool_, str]) -> Score:
    held = [(value, text) for value, holds, text in evidence if holds]
    return Score(sum(value for value, _ in held), tuple(text for _, text in held if text))


def _edge_line(view: View, hinge: Candidate) -> tuple[int, float, float]:
    """Axis across the edge (0 for u, 1 for v), its place, and the sign that leads off the panel."""
    axis = 0 if hinge.edge in ("left", "right") else 1
    sign = -1.0 if hinge.edge in ("left", "bottom") else 1.0
    return axis, float(hinge.origin[axis]), sign


def hardware_on(view: View, hinge: Candidate, around: Surroundings) -> list[float]:
    """Where along an edge small pieces of the body are, in order, as shares of its length."""
    axis, place, _ = _edge_line(view, hinge)
    panel, along = view.box, 1 - axis
    return sorted(
        float((piece.center[along] - panel.lower[along]) / panel.size[along])
        for piece in around.hardware
        if piece.lower[axis] - 0.012 <= place <= piece.upper[axis] + 0.012
        and panel.lower[along] <= piece.center[along] <= panel.upper[along]
        and piece.lower[2] <= panel.upper[2] + 0.02
        and piece.upper[2] >= panel.lower[2] - 0.02
    )


def _neighbour_beyond(view: View, hinge: Candidate, around: Surroundings) -> bool:
    """Whether another moving part begins where this edge ends."""
    axis, place, sign = _edge_line(view, hinge)
    panel = view.box
    for other in around.neighbours:
        start = other.lower[axis] if sign > 0 else other.upper[axis]
        beside = min(other.upper[1 - axis], panel.upper[1 - axis]) - max(
            other.lower[1 - axis], panel.lower[1 - axis]
        )
        level = other.upper[2] > panel.lower[2] and other.lower[2] < panel.upper[2]
        if abs(start - place) < 0.04 and beside > 0.3 * panel.size[1 - axis] and level:
            return True
    return False


def _at_body_edge(view: View, hinge: Candidate) -> bool:
    axis, place, sign = _edge_line(view, hinge)
    edge = view.body.upper[axis] if sign > 0 else view.body.lower[axis]
    return bool(abs(edge - place) < 0.12 * view.body.size[axis])
