"""Cases of furniture: boards, what they stand on, how they are divided, and what fills their rooms."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from simart_kit.arrays import FloatArray

from ...shapes.dice import Dice
from ...shapes.fronts import frame, front
from ...shapes.legs import feet
from ...shapes.placing import moved
from ...shapes.primitives import Pieces, between, box, boxes, sheet
from . import leaves, looks
from .assembly import Assembly, Leaf
from .objects import Look
from .styles import Opening, Style

Size = tuple[float, float, float]


def any_size(dice: Dice, low: Size, high: Size) -> Size:
    """Width, depth and height between two sizes [m]."""
    width, depth, height = (dice.spread(a, b) for a, b in zip(low, high, strict=True))
    return width, depth, height


def carcass(made: Assembly, dice: Dice, size: Size, board: float, look: Look) -> Opening:
    """Sides, bottom, top and back above z = 0, the front at y = -depth / 2; its room."""
    width, depth, height = size
    x, y = width / 2, depth / 2
    pieces = [boxes((board, depth, height), [(s * (x - board / 2), 0, height / 2) for s in (-1, 1)])]
    levels = [board / 2, height - board / 2]
    pieces.append(boxes((width - 2 * board, depth, board), [(0, 0, z) for z in levels]))
    back = board * dice.between(0.2, 1.0)
    behind = dice.pick((0.0, 0.0, 0.02, 0.04))
    if dice.chance(0.93):
        low, high = (-x + board, y - behind - back, board), (x - board, y - behind, height - board)
        made.fix([between(low, high)], dice.pick((look, looks.darker(look))))
    rim = board
    if dice.chance(0.2):
        rim = board * dice.between(1.2, 2.5)
        pieces += moved([frame(width, height, board, rim)], (0, -y + board, height / 2))
    made.fix(pieces, look)
    deep = depth - behind - back
    return Opening(-x + rim, x - rim, rim, height - rim, -y, deep, (rim - 0.001,) * 4)


def stand(made: Assembly, dice: Dice, size: Size, look: Look, most: float = 0.2) -> None:
    """Legs, runners or a plinth below z = 0, or nothing."""
    width, depth, _ = size
    style = dice.unit()
    if style < 0.4:
        made.fix(feet(dice, width, depth, dice.spread(0.03, most)), dice.pick((look, looks.metal(dice))))
    elif style < 0.75:
        recess, tall = dice.between(-0.03, 0.15) * depth, min(most, dice.between(0.04, 0.14))
        low, high = (-width / 2 * 0.99, -depth / 2 + recess, -tall), (width / 2 * 0.99, depth / 2, 0)
        made.fix([between(low, high)], dice.pick((look, looks.darker(look))))


def crown(made: Assembly, dice: Dice, size: Size, look: Look, share: float = 0.45) -> None:
    """A plate on top, a cornice or a gallery, or nothing."""
    width, depth, height = size
    x, y = width / 2, depth / 2
    if not dice.chance(share):
        return
    over, thick = dice.between(0.0, 0.03), dice.between(0.012, 0.05)
    other = dice.pick((look, looks.darker(look), looks.wood(dice)))
    made.fix([between((-x - over, -y - over, height), (x + over, y, height + thick))], other)
    if dice.chance(0.2):
        rail = dice.between(0.03, 0.12) * height
        made.fix(moved(front(dice, width, rail, 0.015), (0, y, height + thick + rail / 2)), look)


def side_panels(made: Assembly, dice: Dice, size: Size, look: Look) -> None:
    """Fields on the sides that look like doors and are none; on few cases."""
    width, depth, height = size
    if not dice.chance(0.15):
        return
    rim = frame(depth * 0.98, height * 0.98, 0.006, min(0.08, 0.15 * depth))
    for side in (-1, 1):
        upright = rim[..., [1, 0, 2]] * [-side, 1, 1]
        made.fix(moved([upright], (side * width / 2, 0, height / 2)), look)


def even_or_random(dice: Dice, count: int) -> list[float]:
    """Shares of parts of a room."""
    return [1.0] * count if dice.chance(0.6) else (0.4 + dice.units(count)).tolist()


def columns(
    made: Assembly, opening: Opening, shares: Sequence[float], board: float, look: Look
) -> list[Opening]:
    """Rooms side by side with boards between."""
    cells = opening.columns(shares, board)
    for cell in cells[1:]:
        low = (cell.left - board, opening.front, opening.low)
        made.fix([between(low, (cell.left, opening.front + opening.depth, opening.high))], look)
    return cells


def rows(
    made: Assembly, opening: Opening, shares: Sequence[float], board: float, look: Look
) -> list[Opening]:
    """Rooms on top of each other with boards between, the lowest first."""
    cells = opening.rows(shares, board)
    for cell in cells[1:]:
        low = (opening.left, opening.front, cell.low - board)
        made.fix([between(low, (opening.right, opening.front + opening.depth, cell.low))], look)
    return cells


def shelves(made: Assembly, dice: Dice, opening: Opening, look: Look, recess: float, most: int = 4) -> None:
    """Boards inside a room, or a rail for clothes in a tall one; `recess` keeps free of what closes it."""
    deep = (opening.depth - recess) * dice.between(0.75, 0.98)
    if deep < 0.03:
        return
    x, back = opening.center[0], opening.front + opening.depth
    if opening.height > 0.9 and dice.chance(0.4):
        height = opening.high - dice.between(0.06, 0.15)
        rail = box((opening.width, 0.02, 0.02), (x, opening.front + opening.depth / 2, height))
        made.fix([rail], looks.metal(dice))
        most = 1
    count = dice.whole(0, min(most, int(opening.height / 0.12)))
    if count:
        levels = np.linspace(opening.low, opening.high, count + 2)[1:-1]
        thick = dice.between(0.006, 0.02)
        plates = boxes((opening.width, deep, thick), [(x, back - deep / 2, z) for z in levels])
        made.fix([plates], dice.weighted([(5, look), (1, looks.glass(dice))]))


def decoy(made: Assembly, dice: Dice, style: Style, opening: Opening, look: Look) -> None:
    """A front that looks as if it opened, on a board that closes the room behind it."""
    low = opening.height < 0.6 * opening.width
    shown = leaves.drawer_front(style, opening) if low else _any_door(dice, style, opening).surfaces
    made.dress(*shown)
    y = opening.front + style.reach
    made.fix([between((opening.left, y, opening.low), (opening.right, y + 0.012, opening.high))], look)


def fill(made: Assembly, dice: Dice, style: Style, opening: Opening, kind: str, look: Look) -> None:
    """Put what closes a room in it, and what stands behind.

    Args:
        made: the object.
        dice: for this room.
        style: of the fronts.
        opening: the room.
        kind: "door", "pair", "drawer", "drawers", "flap_down", "flap_up", "sliding", "decoy" or "open".
        look: of shelves.
    """
    if kind == "drawer":
        made.add(leaves.drawer(dice, style, opening))
        return
    if kind == "drawers":
        count = max(1, min(5, round(opening.height / dice.between(0.12, 0.3))))
        for cell in opening.rows(even_or_random(dice, count), 0.0):
            made.add(leaves.drawer(dice, style, cell))
        return
    if kind == "decoy":
        decoy(made, dice, style, opening, look)
        return
    for leaf in _closing(dice, style, opening, kind):
        made.add(leaf)
    recess = 0.0 if kind == "open" else style.reach + min(0.12, 0.35 * opening.depth)
    shelves(made, dice, opening, look, recess if kind != "sliding" else 3.5 * style.thick)


def _closing(dice: Dice, style: Style, opening: Opening, kind: str) -> list[Leaf]:
    if kind == "door":
        return [_any_door(dice, style, opening)]
    if kind == "pair":
        return leaves.pair(dice, style, opening)
    if kind in ("flap_down", "flap_up"):
        return [leaves.flap(dice, style, opening, -1 if kind == "flap_down" else 1)]
    if kind == "sliding":
        count = 3 if opening.width > 1.3 and dice.chance(0.4) else 2
        return leaves.sliding(dice, style, opening, count)
    return []


def _any_door(dice: Dice, style: Style, opening: Opening) -> Leaf:
    """A door on either side; some carry a handle that turns."""
    side = dice.sign()
    if style.seed % 9 == 1 and opening.width > 0.2:
        bare = leaves.door(dice, style.bare(), opening, side)
        return bare.with_children(leaves.turning_grip(dice, style, opening, side))
    return leaves.door(dice, style, opening, side)


def board(loop: FloatArray, thick: float) -> FloatArray:
    """A board with a convex (K, 2) outline in x and y, about z = 0."""
    middle = np.broadcast_to(loop.mean(axis=0), loop.shape)
    levels = (-thick / 2, -thick / 2, thick / 2, thick / 2)
    rings = [
        np.insert(ring, 2, z, axis=1) for ring, z in zip((middle, loop, loop, middle), levels, strict=True)
    ]
    stack = np.stack(rings)
    return sheet(np.concatenate([stack, stack[:, :1]], axis=1))


def posts(width: float, depth: float, height: float, thick: float) -> Pieces:
    """Four square posts from z = 0 up, inside a rectangle."""
    x, y = (width - thick) / 2, (depth - thick) / 2
    spots = [(sx * x, sy * y, height / 2) for sx in (-1, 1) for sy in (-1, 1)]
    return [boxes((thick, thick, height), spots)]
