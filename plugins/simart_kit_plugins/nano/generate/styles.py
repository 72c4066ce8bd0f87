"""Openings of cases, and what the fronts before them have in common."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from ...shapes import fronts
from ...shapes.dice import Dice
from ...shapes.handles import handle
from ...shapes.placing import moved
from ...shapes.primitives import Pieces, box, boxes
from . import looks
from .objects import Look, Surface, surface

Make = Callable[[Dice, float, float, float], Pieces]
_MAKES: Sequence[tuple[float, Make]] = (
    (10, fronts.slab),
    (5, fronts.framed),
    (1, fronts.louvred),
    (0.7, fronts.bowed),
    (2.5, fronts.raised),
    (1.2, fronts.planked),
    (0.5, fronts.thin),
)
# Of handles: standing off their fronts, and across their length [m].
_STAND_OFF, _HAND = 0.05, 0.06
Borders = tuple[float, float, float, float]


@dataclass(frozen=True)
class Opening:
    """Where a leaf goes.

    Attributes:
        left, right: clear, along x.
        low, high: clear, along z.
        front: y of the case's front.
        depth: clear room behind it.
        borders: how far a front that lies on the case may reach beyond left, right, low and high.
    """

    left: float
    right: float
    low: float
    high: float
    front: float
    depth: float
    borders: Borders = (0.0, 0.0, 0.0, 0.0)

    @property
    def width(self) -> float:
        return self.right - self.left

    @property
    def height(self) -> float:
        return self.high - self.low

    @property
    def center(self) -> tuple[float, float]:
        """Middle along x and z."""
        return (self.left + self.right) / 2, (self.low + self.high) / 2

    def columns(self, shares: Sequence[float], board: float) -> list[Opening]:
        """Side by side, with dividers of this thickness between."""
        lefts, rights = _cuts(self.left, self.right, shares, board)
        a, b, low, high = self.borders
        return [
            replace(
                self,
                left=left,
                right=right,
                borders=(a if k == 0 else board / 2, b if k == len(shares) - 1 else board / 2, low, high),
            )
            for k, (left, right) in enumerate(zip(lefts, rights, strict=True))
        ]

    def rows(self, shares: Sequence[float], board: float) -> list[Opening]:
        """On top of each other, the lowest first."""
        lows, highs = _cuts(self.low, self.high, shares, board)
        a, b, low, high = self.borders
        return [
            replace(
                self,
                low=bottom,
                high=top,
                borders=(a, b, low if k == 0 else board / 2, high if k == len(shares) - 1 else board / 2),
            )
            for k, (bottom, top) in enumerate(zip(lows, highs, strict=True))
        ]

    def sunk(self, by: float) -> Opening:
        """The same deeper in the case, behind another leaf."""
        return replace(self, front=self.front + by, depth=self.depth - by, borders=(0.0, 0.0, 0.0, 0.0))


@dataclass(frozen=True)
class Style:
    """What the leaves of one object have in common.

    Attributes:
        seed: of the make of fronts and handles, so that they match.
        make: of the fronts; None for glass in a frame.
        thick: of a front [m].
        lift: how far a front's back lies before the case; negative for one set into it.
        gap: between a front and its neighbours [m].
        grips: "handle", "plate" or "none".
        long: length of the handles [m].
        look, grip, pane, inner: of fronts, handles, panes, and boxes of drawers.
    """

    seed: int
    make: Make | None
    thick: float
    lift: float
    gap: float
    grips: str
    long: float
    look: Look
    grip: Look
    pane: Look
    inner: Look

    @property
    def inset(self) -> bool:
        """Whether fronts lie between the boards of the case."""
        return self.lift < 0

    @property
    def reach(self) -> float:
        """How far fronts go into the case, along y."""
        return max(0.0, -self.lift)

    def clear(self) -> Style:
        """The same with panes of glass."""
        return replace(self, make=None)

    def bare(self) -> Style:
        """The same without handles."""
        return replace(self, grips="none")

    def inside(self) -> Style:
        """The same for leaves behind other leaves: set in, plain."""
        return replace(self, make=fronts.slab, lift=-self.thick, grips="plate", look=self.inner)


def random_style(dice: Dice, look: Look, thick: float | None = None) -> Style:
    """Any style for a case of this look; fronts may differ from it."""
    thickness = thick if thick is not None else dice.between(0.012, 0.03)
    other = looks.wood(dice) if look.material in ("wood", "mdf") else looks.painted_metal(dice)
    sunk = -thickness * dice.pick((1.0, 1.0, 1.2))
    return Style(
        seed=dice.whole(0, 2**31),
        make=dice.weighted(_MAKES),
        thick=thickness,
        lift=dice.weighted([(4, 0.0), (3, dice.between(0.001, 0.003)), (4, sunk)]),
        gap=dice.between(0.0015, 0.004),
        grips=dice.weighted([(16, "handle"), (2, "plate"), (2, "none")]),
        long=dice.spread(0.06, 0.4),
        look=dice.weighted([(3, look), (1, looks.darker(look, 0.85)), (2, other)]),
        grip=dice.weighted([(4, looks.metal(dice)), (1, looks.wood(dice)), (1, looks.plastic(dice))]),
        pane=looks.glass(dice),
        inner=looks.wood(dice) if look.material in ("wood", "mdf") else looks.darker(look, 0.9),
    )


@dataclass(frozen=True)
class Face:
    """Where a front lies: its middle (x, z), its size and the y of its back."""

    x: float
    z: float
    width: float
    height: float
    back: float

    @classmethod
    def of(cls, style: Style, opening: Opening) -> Face:
        """The front of an opening in a style."""
        left, right, low, high = (0.0,) * 4 if style.inset else opening.borders
        x0, x1 = opening.left - left + style.gap / 2, opening.right + right - style.gap / 2
        z0, z1 = opening.low - low + style.gap / 2, opening.high + high - style.gap / 2
        return cls((x0 + x1) / 2, (z0 + z1) / 2, x1 - x0, z1 - z0, opening.front - style.lift)


def panel(style: Style, face: Face) -> list[Surface]:
    """The front that all leaves of this style and size have."""
    place = (face.x, face.back, face.z)
    if style.make is None:
        return _glass(style, face)
    slim = min(face.width, face.height) < 6 * style.thick
    make = fronts.slab if slim else style.make
    pieces = make(Dice(style.seed), face.width, face.height, style.thick)
    # Bowed boards bulge either way; none goes into the case.
    back = max(0.0, max(float(piece[..., 1].max()) for piece in pieces))
    pieces = moved(pieces, np.array(place) - [0, back, 0])
    if make is fronts.framed and style.seed % 4 == 0:
        return [surface(pieces[:1], style.look), surface(pieces[1:], looks.darker(style.look, 0.75))]
    return [surface(pieces, style.look)]


def grip(style: Style, face: Face, x: float, z: float, upright: bool, most: float) -> list[Surface]:
    """The handle of this style on a face, at (x, z) from its middle; no longer than `most`."""
    length = min(style.long, most)
    spot = (face.x + x, face.back - style.thick, face.z + z)
    if style.grips == "none" or length < 0.01:
        return []
    if style.grips == "plate":
        long, short = 0.6 * length, min(0.02, 0.3 * length)
        size = (short, 0.002, long) if upright else (long, 0.002, short)
        return [surface([box(size, (spot[0], spot[1] - 0.001, spot[2]))], style.grip)]
    pieces = handle(Dice((style.seed, 1)), length, upright)
    return [surface(moved(_handy(pieces), spot), style.grip)]


def _handy(pieces: Pieces) -> Pieces:
    """A handle no thicker than a hand holds and no further from its front than it reaches behind."""
    points = np.concatenate(pieces).reshape(-1, 3)
    size = np.ptp(points, axis=0)
    shrunk = min(1.0, _STAND_OFF / size[1], _HAND / min(size[0], size[2]))
    if max(size[0], size[2]) < 2 * min(size[0], size[2]):
        return [piece * shrunk for piece in pieces]
    scale = np.full(3, shrunk)
    scale[0 if size[0] > size[2] else 2] = 1.0
    return [piece * scale for piece in pieces]


def _cuts(low: float, high: float, shares: Sequence[float], board: float) -> tuple[list[float], list[float]]:
    room = high - low - board * (len(shares) - 1)
    sizes = np.array(shares) / np.sum(shares) * room
    ends = low + np.cumsum(sizes) + board * np.arange(len(shares))
    return (ends - sizes).tolist(), ends.tolist()


def _glass(style: Style, face: Face) -> list[Surface]:
    """A pane, mostly in a frame, some with bars."""
    dice = Dice(style.seed)
    place = (face.x, face.back, face.z)
    middle = -style.thick / 2
    if dice.chance(0.15):
        pane = box((face.width, style.thick * 0.4, face.height), (0, middle, 0))
        return [surface(moved([pane], place), style.pane)]
    border = min(0.25 * min(face.width, face.height), dice.between(0.015, 0.08))
    wide, high = face.width - 2 * border, face.height - 2 * border
    rim = [fronts.frame(face.width, face.height, style.thick, border)]
    bar = border * dice.between(0.2, 0.5)
    if dice.chance(0.35):
        levels = np.linspace(-high / 2, high / 2, dice.whole(1, 3) + 2)[1:-1]
        rim.append(boxes((wide, style.thick * 0.8, bar), [(0, middle, z) for z in levels]))
    if dice.chance(0.25):
        rim.append(box((bar, style.thick * 0.8, high), (0, middle, 0)))
    pane = box((wide, style.thick * dice.pick((0.1, 0.25)), high), (0, middle, 0))
    return [surface(moved(rim, place), style.look), surface(moved([pane], place), style.pane)]
