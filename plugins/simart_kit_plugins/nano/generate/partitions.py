"""Screens, shower cabins and stalls: leaves of bars, slats and glass between posts."""

from __future__ import annotations

import numpy as np

from ...shapes.dice import Dice
from ...shapes.placing import X, Z, at, moved, pointed
from ...shapes.primitives import Pieces, between, box, cylinder, rod, torus
from . import looks
from .assembling import Assembly, disc, holder, lever, swing
from .category import Category
from .objects import Body, Look, hinge, slide, spin
from .rigging import lying


def _frame(wide: float, low: float, high: float, bar: float) -> Pieces:
    """Two stiles and two rails from x = 0, about y = 0."""
    stiles = [between((x, -bar / 2, low), (x + bar, bar / 2, high)) for x in (0.0, wide - bar)]
    rails = [between((bar, -bar / 2, z), (wide - bar, bar / 2, z + bar)) for z in (low, high - bar)]
    return [*stiles, *rails]


def _filling(dice: Dice, style: str, wide: float, low: float, high: float, bar: float) -> Pieces:
    """What is between the bars of a frame: bars, slats, boards, a lattice or one pane."""
    inner, tall = wide - 2 * bar, high - low - 2 * bar
    middle = np.array([wide / 2, 0, (low + high) / 2])
    if style == "bars":
        xs = np.linspace(bar, wide - bar, dice.whole(4, 10) + 2)[1:-1]
        return at(cylinder(0.2 * bar, tall + 0.2 * bar, 8), [(x, 0, middle[2]) for x in xs])
    if style == "slats":
        zs = np.linspace(low + bar, high - bar, dice.whole(5, 14) + 2)[1:-1]
        return at(box((inner + 0.2 * bar, 0.3 * bar, 0.4 * tall / len(zs))), [(wide / 2, 0, z) for z in zs])
    if style == "boards":
        count = dice.whole(3, 7)
        xs = bar + (np.arange(count) + 0.5) * inner / count
        return at(box((inner / count - 0.003, 0.5 * bar, tall)), [(x, 0, middle[2]) for x in xs])
    if style == "lattice":
        across = at(
            box((inner, 0.25 * bar, 0.3 * bar)), [(wide / 2, 0, z) for z in np.linspace(low, high, 8)[1:-1]]
        )
        count = max(3, int(8 * wide / (high - low)))
        xs = np.linspace(bar, wide - bar, count + 2)[1:-1]
        return [*across, *at(box((0.3 * bar, 0.25 * bar, tall)), [(x, 0.1 * bar, middle[2]) for x in xs])]
    return [box((inner, 0.25 * bar, tall), middle)]


_FILLINGS = ("bars", "slats", "boards", "lattice", "pane")


def _screen(dice: Dice) -> list[Body]:
    """A folding screen: leaves that hang one on the other, bent to and fro; the first stands on feet."""
    kit, coat = Assembly("leaf"), looks.wood(dice) if dice.chance(0.6) else looks.painted_metal(dice)
    count, wide, high = dice.whole(2, 5), dice.between(0.35, 0.6), dice.between(1.2, 2.0)
    bar, low, style = dice.between(0.02, 0.045), dice.between(0.0, 0.15), dice.pick(_FILLINGS)
    fill = looks.fabric(dice) if style == "pane" else coat
    pieces = _frame(wide, low, high, bar)
    if low > 0.04:
        pieces += [between((x, -bar / 2, 0), (x + bar, bar / 2, low)) for x in (0.0, wide - bar)]
    inside = _filling(dice, style, wide, low, high, bar)
    # Which end of a chain stays is anybody's guess else.
    feet = [between((s * wide - bar, -0.15, -0.03), (s * wide + bar, 0.15, 0)) for s in (0.2, 0.8)]
    kit.fix([*pieces, *feet], coat)
    kit.fix(inside, fill)
    metal, parent, x = looks.metal(dice), 0, wide
    shown, levels = dice.chance(0.7), np.array([0.15, 0.5, 0.85]) * high
    for k in range(1, count):
        sense = 1 if k % 2 else -1
        pin = np.array([x + 0.002, sense * (bar / 2 + 0.004), 0])
        parts = [(moved(pieces, (x + 0.004, 0, 0)), coat), (moved(inside, (x + 0.004, 0, 0)), fill)]
        if shown:
            parts.append((at(cylinder(0.005, 0.07, 8), [pin + [0, 0, z] for z in levels]), metal))
        upper = dice.between(1.6, 3.0)
        parent = kit.add("leaf", hinge(pin, (0, 0, sense), upper), parts, parent)
        x += wide + 0.004
    return kit.done()


def _shower_cabin(dice: Dice) -> list[Body]:
    """A tray with panes, of which one slides or two turn; a tap, a lever and a head on an arm."""
    kit, white = Assembly("cabin"), looks.ceramic(dice)
    wide, deep, high = dice.between(0.8, 1.4), dice.between(0.7, 1.0), dice.between(1.85, 2.1)
    tray, metal, pane = dice.between(0.03, 0.15), looks.metal(dice), looks.glass(dice)
    kit.fix([box((wide, deep, tray), (0, 0, tray / 2))], white)
    walls = [box((wide, 0.02, high), (0, deep / 2 + 0.011, high / 2))]
    kit.fix(walls, white)
    for side in (-1, 1):
        if dice.chance(0.6):
            kit.fix([box((0.02, deep, high), (side * (wide / 2 + 0.011), 0, high / 2))], white)
        else:
            size = (0.008, deep - 0.02, high - tray)
            kit.fix([box(size, (side * (wide / 2 - 0.006), 0, (high + tray) / 2))], pane)
    post = at(
        box((0.03, 0.03, high - tray)),
        [(s * (wide / 2 - 0.02), -deep / 2 + 0.02, (high + tray) / 2) for s in (-1, 1)],
    )
    kit.fix(post, metal)
    front = -deep / 2 + 0.02
    kit.fix([box((wide - 0.08, 0.03, 0.03), (0, front, high - 0.016))], metal)
    _cabin_doors(dice, kit, (wide - 0.08, tray + 0.008, high - 0.036), front, metal, pane)
    _shower(dice, kit, deep / 2, high, metal)
    return kit.done()


def _cabin_doors(
    dice: Dice, kit: Assembly, size: tuple[float, float, float], y: float, metal: Look, pane: Look
) -> None:
    """Adds one leaf that slides before a fixed one, or one or two that turn, or a pair that fold."""
    wide, low, high = size
    tall, middle, style = high - low, (low + high) / 2, dice.unit()
    if style < 0.4:
        kit.fix([box((wide / 2, 0.006, tall), (wide / 4, y + 0.006, middle))], pane)
        leaf = box((wide / 2 - 0.004, 0.006, tall), (-wide / 4, y - 0.008, middle))
        grip = moved(holder(dice, 0.3, True), (-0.06, y - 0.011, middle))
        rollers = at(
            pointed(cylinder(0.018, 0.008, 12), 1), [(x * wide, y - 0.017, high - 0.03) for x in (-0.4, -0.1)]
        )
        kit.add("sliding door", slide((1, 0, 0), 0.46 * wide), [([leaf], pane), ([*grip, *rollers], metal)])
        return
    count = 1 if style < 0.7 else 2
    one = wide / count
    for side in (-1, 1)[:count]:
        edge = side * wide / 2
        leaf = box((one - 0.006, 0.007, tall), (edge - side * one / 2, y, middle))
        grip = moved(holder(dice, 0.25, True), (edge - side * (one - 0.06), y - 0.004, middle))
        clamps = at(
            box((0.05, 0.016, 0.06)), [(edge - side * 0.028, y, middle + s * 0.38 * tall) for s in (-1, 1)]
        )
        moves = swing(side, edge, y, dice.between(1.4, 1.8))
        kit.add("door", moves, [([leaf], pane), ([*grip, *clamps], metal)])


def _shower(dice: Dice, kit: Assembly, back: float, high: float, metal: Look) -> None:
    """Adds a mixer with a lever or knobs, and a head on an arm that tips or slides on a bar."""
    y = back - 0.002
    kit.fix([box((0.2, 0.04, 0.04), (0, y - 0.02, 1.05))], metal)
    if dice.chance(0.5):
        for s in (-1, 1):
            knob = pointed(cylinder(0.022, 0.04, 12), X) + [s * 0.124, y - 0.02, 1.05]
            kit.add("knob", spin((s * 0.1, y - 0.02, 1.05), (1, 0, 0)), [([knob], metal)])
    else:
        spot = (0, y - 0.042, 1.05)
        kit.add("lever", hinge(spot, (0, 1, 0), 0.8, -0.8), [(moved(lever(dice, 0.09, 0.008), spot), metal)])
    kit.fix([rod((0, y - 0.05, 1.1), (0, y - 0.05, high - 0.1), 0.01, 8)], metal)
    kit.fix(at(box((0.02, 0.05, 0.02)), [(0, y - 0.025, z) for z in (1.12, high - 0.12)]), metal)
    level = dice.between(1.4, high - 0.3)
    carriage = [box((0.04, 0.03, 0.05), (0, y - 0.078, level))]
    moves = slide((0, 0, 1), 0.15, -0.15)
    number = kit.add("holder", moves, [(carriage, metal)])
    pin = np.array([0, y - 0.1, level])
    head = [lying(0.01, 0.05), rod((0, 0, 0), (0, -0.12, 0.06), 0.011, 8)]
    head.append(cylinder(0.05, 0.015, 16) + [0, -0.15, 0.06])
    kit.add("shower head", hinge(pin, (1, 0, 0), 0.5, -0.5), [(moved(head, pin), metal)], number)


def _stall(dice: Dice) -> list[Body]:
    """The front of a stall: boards below, bars above, and a door that slides on a rail or turns; a hatch."""
    kit, wood = Assembly("stall"), looks.wood(dice)
    metal, wide, high = looks.painted_metal(dice), dice.between(2.2, 3.2), dice.between(1.9, 2.4)
    bar, door, side = dice.between(0.05, 0.08), dice.between(0.9, 1.25), dice.sign()
    low, split = 0.05, high * dice.between(0.5, 0.65)
    edge = wide / 2 - door  # the opening is from here to the post
    posts = [-wide / 2, edge - bar, wide / 2]
    kit.fix([between((x, -bar / 2, 0), (x + bar, bar / 2, high)) for x in posts], metal)
    kit.fix([between((-wide / 2, -bar / 2, high), (wide / 2 + bar, bar / 2, high + bar))], metal)
    panel = edge - bar + wide / 2 - bar
    styles = dice.pick(("boards", "slats", "pane")), dice.pick(("bars", "lattice"))
    heights = (low, split, high - 0.06)
    for pieces, look in _panel(styles, heights, (-wide / 2 + bar, panel), 0.6 * bar, (metal, wood), dice):
        kit.fix(pieces, look)
    leaf = _panel(styles, heights, (edge + 0.01, door - 0.02), 0.6 * bar, (metal, wood), dice)
    grip = [rod((edge + 0.12, -0.09, split - 0.1), (edge + 0.12, -0.09, split + 0.2), 0.012, 8)]
    grip += at(box((0.02, 0.08, 0.02)), [(edge + 0.12, -0.05, z) for z in (split - 0.08, split + 0.18)])
    if dice.chance(0.5):
        out = bar + 0.02
        leaf = [(moved(pieces, (0, -out, 0)), look) for pieces, look in leaf]
        kit.fix(
            [between((-wide / 2, -out - 0.02, high + 0.02), (wide / 2 + bar, -bar / 2, high + 0.05))], metal
        )
        hangers = at(
            box((0.04, 0.012, 0.12)), [(edge + s * door, -out - 0.03, high - 0.01) for s in (0.2, 0.8)]
        )
        rollers = at(
            pointed(cylinder(0.03, 0.012, 12), 1),
            [(edge + s * door, -out - 0.03, high + 0.035) for s in (0.2, 0.8)],
        )
        leaf.append(([*moved(grip, (0, -out, 0)), *hangers, *rollers], metal))
        kit.add("sliding door", slide((-1, 0, 0), 0.92 * door), leaf)
    else:
        hinges = at(
            cylinder(0.014, 0.12, 10), [(wide / 2 - 0.004, -bar / 2 - 0.012, z * high) for z in (0.15, 0.8)]
        )
        leaf.append(([*grip, *hinges], metal))
        number = kit.add("door", swing(1, wide / 2 - 0.004, -bar / 2 - 0.012, 1.7), leaf)
        spot = (edge + 0.05, -0.4 * bar, split)
        bolt = [disc(0.025, 0.02, 12), box((0.16, 0.012, 0.03), (-0.05, -0.026, 0))]
        kit.add("latch", hinge(spot, (0, 1, 0), 1.5), [(moved(bolt, spot), metal)], number)
    if dice.chance(0.5):
        _manger(dice, kit, -wide / 2 + bar + panel / 2, split, bar, metal)
    return kit.done(np.diag([side, 1, 1]).astype(np.float64))


def _panel(
    styles: tuple[str, str],
    heights: tuple[float, float, float],
    span: tuple[float, float],
    bar: float,
    coats: tuple[Look, Look],
    dice: Dice,
) -> list[tuple[Pieces, Look]]:
    """Two frames one above the other, from x on so wide, and what is in each."""
    wide, (metal, wood), place = span[1], coats, (span[0], 0, 0)
    parts: list[tuple[Pieces, Look]] = []
    for style, look, low, high in zip(styles, (wood, metal), heights, heights[1:], strict=False):
        parts.append((moved(_frame(wide, low, high, bar), place), metal))
        parts.append((moved(_filling(dice, style, wide, low, high, bar), place), look))
    return parts


def _manger(dice: Dice, kit: Assembly, x: float, level: float, bar: float, metal: Look) -> None:
    """Adds a trough that turns out about its side, or a bucket's ring that tips up, before a panel."""
    y = -bar / 2 - 0.02
    if dice.chance(0.5):
        ring = [pointed(torus(0.15, 0.02, 18), Z) + [0, -0.17, 0], lying(0.012, 0.16)]
        pin = (x, y - 0.015, level)
        kit.fix(at(box((0.02, 0.05, 0.04)), [(x + s * 0.1, y, level) for s in (-1, 1)]), metal)
        kit.add("ring", hinge(pin, (-1, 0, 0), 1.4), [(moved(ring, pin), metal)])
        return
    size = np.array([0.4, 0.25, 0.2])
    low = np.array([x - 0.2, y - 0.26, level - 0.2])
    tub = [
        between(low, low + size * [1, 1, 0.06]),
        *(between(low + [0, t, 0.012], low + [0.4, t + 0.012, 0.2]) for t in (0.0, 0.238)),
        *(between(low + [t, 0.012, 0.012], low + [t + 0.012, 0.238, 0.2]) for t in (0.0, 0.388)),
    ]
    pin = (x - 0.2, y - 0.006, level - 0.1)
    pins = at(cylinder(0.01, 0.05, 8), [(pin[0] - 0.008, pin[1], level + z) for z in (-0.16, -0.04)])
    kit.add(
        "trough",
        swing(-1, pin[0] - 0.008, pin[1], dice.between(0.8, 1.4)),
        [(tub, looks.plastic(dice)), (pins, metal)],
    )


CATEGORIES: tuple[Category, ...] = (
    Category("screen", _screen),
    Category("shower_cabin", _shower_cabin),
    Category("stall", _stall),
)
