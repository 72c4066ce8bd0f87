"""Tables to practise on, for robots and children: drawers, sliding doors, buttons, slides."""

from __future__ import annotations

import numpy as np

from simart_kit.arrays import FloatArray

from ...shapes.dice import Dice
from ...shapes.placing import X, moved, pointed, rotation
from ...shapes.primitives import Pieces, between, box, boxes, cylinder, open_box, rod, superquadric
from . import looks
from .assembling import Assembly, disc, fall, holder, press, pull, shell
from .carcass import posts
from .category import Category
from .fittings import sleeve_of, standing
from .objects import Body, Look, hinge, slide


def _play_table(dice: Dice) -> list[Body]:
    """A top on legs, a part above its back that is upright or leans back, and things to work."""
    kit, look, other = Assembly("table"), looks.wood(dice), looks.wood(dice)
    wide, deep, high = dice.between(0.5, 1.6), dice.between(0.35, 0.8), dice.between(0.25, 0.8)
    top = dice.between(0.02, 0.08)
    kit.fix([box((wide, deep, top), (0, 0, high - top / 2))], look)
    _stand(dice, kit, (wide, deep, high - top), look)
    accent = looks.plastic(dice)
    _drawers(dice, kit, (wide, deep, high - top), (other, accent))
    back = deep * dice.between(0.25, 0.5)
    tall = dice.between(0.2, 0.45)
    upper = Assembly()
    _upper(dice, upper, (wide, back, tall), look, other, accent)
    lean = dice.between(0.25, 0.7) if dice.chance(0.5) else 0.0
    kit.graft(upper, (0, deep / 2 - back, high), rotation((1, 0, 0), -lean))
    if lean:
        kit.fix([box((wide, 0.02, tall), (0, deep / 2 - 0.01, high + tall / 2))], look)
    room = deep - back
    for k in range(dice.whole(0, 3)):
        spot = np.array([(k - 1) * 0.3 * wide, -deep / 2 + room / 2, high])
        _on_top(dice, kit, spot, min(0.12, 0.6 * room), accent)
    return kit.done()


def _stand(dice: Dice, kit: Assembly, size: tuple[float, float, float], look: Look) -> None:
    wide, deep, high = size
    post = dice.between(0.03, 0.08)
    x, y = wide / 2 - 0.6 * post, deep / 2 - 0.6 * post
    kit.fix(posts(wide - 0.2 * post, deep - 0.2 * post, high, post), look)
    apron = high * dice.between(0.15, 0.3)
    kit.fix([box((wide - 2 * post, 0.02, apron), (0, y, high - apron / 2))], look)
    kit.fix([box((0.02, deep - 2 * post, apron), (s * x, 0, high - apron / 2)) for s in (-1, 1)], look)


def _drawers(dice: Dice, kit: Assembly, size: tuple[float, float, float], coats: tuple[Look, Look]) -> None:
    """One to three below the top; solid or a tub, with a bow or a bar to pull."""
    wide, deep, high = size
    count = dice.weighted([(4, 1), (2, 2), (1, 3)])
    each, tall = wide * 0.8 / count, high * dice.between(0.14, 0.28)
    for k in range(count):
        x, own = (k - (count - 1) / 2) * each, each * dice.between(0.5, 0.95)
        long = deep * dice.between(0.4, 0.8)
        front = box((own, 0.02, tall), (x, -deep / 2, high - tall / 2 - 0.004))
        room = (own * 0.94, long, tall * 0.8)
        place = (x, -deep / 2 + long / 2 + 0.01, high - 0.85 * tall)
        tub = box(room, (0, 0, room[2] / 2)) if dice.chance(0.4) else open_box(room, 0.008)
        grip = holder(dice, own * dice.between(0.2, 0.6))
        pull_at = (x, -deep / 2 - 0.01, high - tall / 2)
        parts = [([front, tub + place], coats[0]), (moved(grip, pull_at), coats[1])]
        kit.add("drawer", pull(long * dice.between(0.6, 0.9)), parts)


def _upper(
    dice: Dice, kit: Assembly, size: tuple[float, float, float], look: Look, other: Look, accent: Look
) -> None:
    """A niche behind a panel that slides, falls or swings, and beside it a face with a slide or a lever."""
    wide, deep, high = size
    share = dice.between(0.5, 0.85) if dice.chance(0.7) else 1.0
    side, wall = dice.sign(), dice.between(0.012, 0.03)
    long = share * wide
    middle = side * (wide - long) / 2
    kit.fix([shell(long, deep, high, wall) + [middle, deep / 2, 0]], look)
    _panel(dice, kit, (middle, long, high), other, accent)
    if share < 1:
        rest = wide - long
        x = -side * (wide - rest) / 2
        kit.fix([between((x - rest / 2, 0, 0), (x + rest / 2, deep, high))], look)
        _on_face(dice, kit, np.array([x, 0, high / 2]), 0.8 * min(rest, high), accent)
    for _ in range(dice.whole(0, 2)):
        spot = ((dice.unit() - 0.5) * 0.9 * wide, deep / 2, high)
        lamp: Pieces = [superquadric((0.04, 0.04, 0.05), 1.0, 1.0, 8) + [0, 0, 0.03]]
        kit.fix(moved([*lamp, cylinder(0.012, 0.01, 10)], spot), Look("plastic", (245, 245, 235)))


def _panel(dice: Dice, kit: Assembly, place: tuple[float, float, float], look: Look, accent: Look) -> None:
    """What closes a part of the niche; `place` is its middle, length and height."""
    middle, long, high = place
    thick, gap = dice.between(0.01, 0.03), 0.002
    kind = dice.weighted([(5, "slide"), (1, "flap"), (1.5, "door"), (0.5, "none")])
    if kind == "none":
        return
    share = dice.between(0.35, 0.6) if kind == "slide" else 1.0
    own, side = long * share, dice.sign()
    x = middle + side * (long - own) / 2
    panel = between((x - own / 2, -thick - gap, 0.003), (x + own / 2, -gap, high - 0.003))
    grip = holder(dice, high * dice.between(0.25, 0.6), upright=kind != "flap")
    far = {"slide": dice.between(-0.35, 0.35), "door": -0.4 * side, "flap": 0.0}[kind]
    up = 0.85 if kind == "flap" else 0.5
    parts = [([panel], look), (moved(grip, (x + far * own, -thick - gap, up * high)), accent)]
    if kind == "slide":
        rails = [box((long, 2 * thick, 0.008), (middle, -thick, z)) for z in (-0.004, high + 0.004)]
        kit.fix(rails if dice.chance(0.4) else [], look)
        kit.add("sliding door", slide((-side, 0, 0), long - own), parts)
    elif kind == "door":
        kit.add("door", hinge((x + side * own / 2, -gap, 0), (0, 0, side), dice.between(1.2, 1.57)), parts)
    else:
        kit.add("flap", fall(-gap - thick, 0.003, dice.between(0.8, 1.1)), parts)


def _on_face(dice: Dice, kit: Assembly, spot: FloatArray, room: float, look: Look) -> None:
    """A cap that slides along a slot, a lever in a slot, or a button."""
    kind = dice.weighted([(4, "slider"), (2, "lever"), (2, "button")])
    dark = Look("plastic", (25, 25, 25))
    if kind == "button":
        radius = room * dice.between(0.1, 0.25)
        collar = sleeve_of(1.05 * radius, 1.3 * radius, 0.6 * radius, 18)
        kit.fix(moved(standing([collar]), spot), dark)
        cap = moved([disc(radius, 0.5 * radius, 18) - [0, 0.42 * radius, 0]], spot)
        kit.add("button", press(0.4 * radius), [(cap, look)])
        return
    long = room * dice.between(0.4, 0.9)
    frame = boxes((0.006, 0.006, long), [(s * 0.04 * room, -0.003, 0) for s in (-1, 1)])
    kit.fix(moved([frame] if kind == "slider" else [], spot), dark)
    kit.fix(moved([box((0.07 * room, 0.002, long))], spot), dark)
    if kind == "slider":
        low = dice.between(-0.4, 0.0) * long
        stem = box((0.05 * room, 0.03, 0.05 * room), (0, -0.015, low))
        bar = box((room * dice.between(0.15, 0.5), 0.02, 0.1 * room), (0, -0.035, low))
        kit.add("slider", slide((0, 0, 1), 0.42 * long - low), [(moved([stem, bar], spot), look)])
        return
    reach, tilt = room * dice.between(0.25, 0.5), dice.between(0.3, 0.6)
    arm: Pieces = [rod((0, 0, 0), (0, -reach * np.cos(tilt), -reach * np.sin(tilt)), 0.03 * room, 8)]
    arm.append(pointed(cylinder(0.05 * room, 0.07 * room, 12), X))
    pin = spot - [0, 0.07 * room, 0]
    cheeks = boxes((0.01, 0.12 * room, 0.08 * room), [(s * 0.06 * room, -0.06 * room, 0) for s in (-1, 1)])
    kit.fix(moved([cheeks], spot), dark)
    kit.add("lever", hinge(pin, (-1, 0, 0), 2 * tilt), [(moved(arm, pin), look)])


def _on_top(dice: Dice, kit: Assembly, spot: FloatArray, room: float, look: Look) -> None:
    """A button in a collar, or a block that only stands there."""
    if dice.chance(0.3):
        return
    radius = room * dice.between(0.2, 0.45)
    if dice.chance(0.25):
        block = box((radius, radius, radius), spot + [0, 0, radius / 2 + 0.0005])
        kit.fix([block], looks.plastic(dice))
        return
    rim = dice.between(0.2, 0.6) * radius
    kit.fix([sleeve_of(1.05 * radius, 1.3 * radius, rim, 18) + spot], looks.metal(dice))
    cap = cylinder(radius, rim, 18) + spot + [0, 0, 1.2 * rim]
    kit.add("button", slide((0, 0, -1), 0.6 * rim), [([cap], look)])


CATEGORIES: tuple[Category, ...] = (Category("play_table", _play_table),)
