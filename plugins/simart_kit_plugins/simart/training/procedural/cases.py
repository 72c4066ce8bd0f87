"""Case goods: cabinets, wardrobes, chests of drawers, shelves, sideboards."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from simart_kit.arrays import FloatArray

from ....shapes.dice import Dice
from ....shapes.fronts import front
from ....shapes.legs import feet
from ....shapes.placing import moved
from ....shapes.primitives import Pieces, between, boxes
from .leaves import Opening, Style, door, drawer, flap, sliding

MOST_PARTS = 12
# Width, depth and height: base cabinet, wall cabinet, wardrobe, chest, sideboard, bookcase, night stand.
_SIZES = (
    ((0.3, 0.5, 0.7), (1.2, 0.65, 0.95)),
    ((0.3, 0.25, 0.4), (1.2, 0.4, 0.9)),
    ((0.5, 0.45, 1.5), (2.2, 0.7, 2.3)),
    ((0.4, 0.35, 0.5), (1.2, 0.55, 1.3)),
    ((1.0, 0.35, 0.4), (2.0, 0.55, 0.9)),
    ((0.4, 0.2, 0.8), (1.4, 0.45, 2.2)),
    ((0.35, 0.3, 0.35), (0.6, 0.5, 0.7)),
)


@dataclass(frozen=True)
class Cell:
    """A room of a case, in the plane of its front.

    Attributes:
        left, right: along x.
        low, high: along z.
    """

    left: float
    right: float
    low: float
    high: float

    @property
    def width(self) -> float:
        return self.right - self.left

    @property
    def height(self) -> float:
        return self.high - self.low

    @property
    def middle(self) -> FloatArray:
        """(3,) in the plane y = 0."""
        return np.array([(self.left + self.right) / 2, 0.0, (self.low + self.high) / 2])


def case(dice: Dice) -> list[Pieces]:
    """The body first, then its leaves; front at y = -depth / 2."""
    low, high = dice.pick(_SIZES)
    width, depth, height = (dice.between(a, b) for a, b in zip(low, high, strict=True))
    board = max(width, height) * dice.spread(0.01, 0.04)
    body = carcass(dice, width, depth, height, board)
    room = Cell(-width / 2 + board, width / 2 - board, board, height - board)
    style = Style.random(dice, board, inset=True)
    cells = _divided(dice, room, board)
    body += _dividers(room, cells, depth, board)
    leaves: list[Pieces] = []
    kinds: dict[float, str] = {}
    for cell in cells:
        kind = kinds.setdefault(cell.left, _kind(dice))
        if dice.chance(0.1):
            kind = _kind(dice)
        filled, fixed = _fill(dice, cell, kind, depth, board, style)
        body += fixed
        leaves += filled
    body += [piece for leaf in leaves[MOST_PARTS - 1 :] for piece in leaf]
    return [body, *leaves[: MOST_PARTS - 1]]


def carcass(dice: Dice, width: float, depth: float, height: float, board: float) -> Pieces:
    """Sides, bottom, top, back, and what it stands on; the room inside starts one board from each side."""
    x, y = width / 2, depth / 2
    pieces = [boxes((board, depth, height), [(s * (x - board / 2), 0, height / 2) for s in (-1, 1)])]
    levels = [board / 2, height - board / 2]
    pieces.append(boxes((width - 2 * board, depth, board), [(0, 0, z) for z in levels]))
    if dice.chance(0.85):
        back = board * dice.between(0.15, 1.0)
        pieces.append(between((-x, y - back, 0), (x, y, height)))
    if dice.chance(0.35):
        over = board * dice.between(0.0, 2.0)
        thick = board * dice.between(0.8, 2.5)
        pieces.append(between((-x - over, -y - over, height), (x + over, y, height + thick)))
    if dice.chance(0.12):
        cornice = front(dice, width, height * 0.12, board)
        pieces += moved(cornice, (0, y, height * 1.06))
    style = dice.unit()
    if style < 0.4:
        pieces += moved(feet(dice, width, depth, dice.spread(0.03, 0.3) * height), (0, 0, 0))
    elif style < 0.7:
        recess = dice.between(0.0, 0.15) * depth
        tall = dice.between(0.03, 0.15) * height
        pieces.append(between((-x * 0.98, -y + recess, -tall), (x * 0.98, y, 0)))
    return pieces


def _divided(dice: Dice, room: Cell, board: float) -> list[Cell]:
    """Columns, each with its own rows; some rooms are whole."""
    most = max(1, min(4, int(2 * room.width / room.height) + 1))
    columns = dice.whole(1, most)
    xs = _cuts(dice, room.left, room.right, columns)
    shared = dice.chance(0.5)
    rows = dice.whole(1, max(1, min(5, int(2 * room.height / room.width * columns) + 1)))
    zs = _cuts(dice, room.low, room.high, rows)
    cells = []
    for left, right in pairwise(xs):
        levels = zs if shared else _cuts(dice, room.low, room.high, dice.whole(1, rows))
        cells += [Cell(left, right, a, b) for a, b in pairwise(levels)]
    return [cell for cell in cells if min(cell.width, cell.height) > 2 * board] or [room]


def _cuts(dice: Dice, low: float, high: float, count: int) -> list[float]:
    """Ends and cuts of a range: even, or of random shares."""
    shares = np.ones(count) if dice.chance(0.6) else 0.35 + dice.units(count)
    return [low, *(low + (high - low) * np.cumsum(shares) / shares.sum()).tolist()]


def _dividers(room: Cell, cells: list[Cell], depth: float, board: float) -> Pieces:
    """A board on the left and below each cell that does not lie at the edge of the room."""
    pieces: Pieces = []
    deep, thick = depth - board, 0.8 * board
    for cell in cells:
        x, _, z = cell.middle
        if cell.left > room.left + 1e-9:
            pieces.append(boxes((thick, deep, cell.height), [(cell.left, 0, z)]))
        if cell.low > room.low + 1e-9:
            pieces.append(boxes((cell.width, deep, thick), [(x, 0, cell.low)]))
    return pieces


def _kind(dice: Dice) -> str:
    weights = [(4, "door"), (4, "drawer"), (1, "flap"), (1.5, "open"), (0.6, "sliding"), (0.8, "pair")]
    return dice.weighted(weights)


def _fill(
    dice: Dice, cell: Cell, kind: str, depth: float, board: float, style: Style
) -> tuple[list[Pieces], Pieces]:
    """The leaves of a cell, and what is fixed in it."""
    # Leaves set into the case need room at its boards; those before it nearly touch each other.
    gap = board * (0.65 if style.lift < 0 else 0.1)
    opening = Opening(cell.width - 2 * gap, cell.height - 2 * gap, depth - 2 * board)
    place = cell.middle - [0, depth / 2, 0]
    if kind == "drawer" and cell.height < 2.2 * cell.width:
        return [moved(drawer(dice, opening, style), place)], []
    shelves = _shelves(dice, cell, depth, board)
    if kind == "open":
        return [], shelves
    if kind == "flap" and cell.height < 1.5 * cell.width:
        return [moved(flap(dice, opening, style, dice.sign()), place)], shelves
    if kind == "sliding" and cell.width > 0.5 * cell.height:
        count = dice.whole(2, 3)
        return [moved(sliding(dice, opening, style, k, count), place) for k in range(count)], shelves
    if kind == "pair" or cell.width > 1.1 * cell.height:
        half = Opening(opening.width / 2 - gap / 2, opening.height, opening.depth)
        sides = [(side, place + [side * opening.width / 4, 0, 0]) for side in (-1, 1)]
        return [moved(door(dice, half, style, side), spot) for side, spot in sides], shelves
    return [moved(door(dice, opening, style, dice.sign()), place)], shelves


def _shelves(dice: Dice, cell: Cell, depth: float, board: float) -> Pieces:
    """Up to four boards, or a rail for clothes."""
    count = dice.whole(0, min(4, int(cell.height / (6 * board))))
    if not count:
        return []
    deep = (depth - 2 * board) * dice.between(0.7, 1.0)
    levels = np.linspace(cell.low, cell.high, count + 2)[1:-1]
    x = cell.middle[0]
    places = [(x, (depth - deep) / 2 - board, z) for z in levels]
    return [boxes((cell.width, deep, board * dice.between(0.4, 0.9)), places)]
