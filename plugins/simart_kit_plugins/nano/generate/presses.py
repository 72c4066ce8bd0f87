"""Presses for garlic, fruit and paper: arms about a pin, or a ram in a stand."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ...shapes.dice import Dice
from ...shapes.outlines import SQUARE, ngon, rounded
from ...shapes.placing import X, around, at, moved, pointed, rotation, turned
from ...shapes.primitives import between, box, cylinder, prism, revolve, rod, torus, vessel
from . import looks
from .assembling import Assembly, Parts
from .category import Category
from .fittings import sleeve_of
from .objects import Body, Look, free, hinge, slide, spin
from .rigging import DOWN, LEFT, RIGHT, UP, ball_knob, lying
from .shared_pins import Pin, arm_looks, flat_bar, gripped_bar, opened, two_places

_Size = tuple[float, float, float]  # width, depth, height


def _garlic_press(dice: Dice) -> list[Body]:
    """Two arms, the upper with a plate on its own pin; a basket and a cleaner on the same pin in some."""
    kit, (look, grip), fan = Assembly("arm"), arm_looks(dice), list[int]()
    room, high, thick = dice.between(0.026, 0.042), dice.between(0.005, 0.009), dice.between(0.0022, 0.0034)
    pin = Pin(np.zeros(3), room / 2 + 0.002 + thick / 2, thick, 0.9 * high)
    mid, top = -(room / 2 + 1.6 * pin.radius + 0.004), high / 2 + 0.0024
    join, long, level = room / 2 + 1.3 * high - mid, dice.between(0.13, 0.2), top + 0.002 + high / 2
    shank, cover = gripped_bar(dice, (-join, 0), (-long, 0), high, level)
    cross = box((2 * pin.half + thick, 1.2 * high, high), (0, -join, 0))
    kit.fix([*pin.bars(0, [(0, 0), (-join, 0)], high), cross, *shank, *pin.shaft()], look)
    kit.fix(cover, grip)
    outline, deep = dice.pick((SQUARE, rounded(0.3), ngon(18))), room * dice.between(0.3, 0.5)
    basket = [vessel(outline, (0.92 * room, 0.92 * room, deep), 0.0012) + [0, mid, top - deep]]
    lip = box((1.2 * thick + 0.1 * room, room * dice.between(0.3, 0.8), 0.0016))
    basket += at(lip, two_places(0.5 * (room + thick), mid, top - 0.0008))
    spots = [(x * room, mid + y * room, top - deep) for x in (-0.2, 0, 0.2) for y in (-0.2, 0, 0.2)]
    parts: Parts = [(basket, look), (at(cylinder(0.04 * room, 0.001, 6), spots), looks.rubber(dice))]
    if dice.chance(0.65):
        tail = pin.bars(3, [(0, 0), (mid + 0.35 * room, top - 0.001)], 0.6 * high)
        parts = [*parts, ([*tail, lying(pin.radius, 2 * pin.x(3))], look)]
        fan.append(pin.hang(kit, "basket", dice.between(1.1, 1.5), parts))
    else:
        for pieces, stuff in parts:
            kit.fix(pieces, stuff)
    far = (-long * dice.between(0.93, 1.05), level + dice.between(0.004, 0.025))
    shank, cover = gripped_bar(dice, (-join, level), far, high, level)
    shank += pin.bars(1, [(0, 0), (-1.5 * pin.radius, level), (-join, level)], high)
    shank.append(box((2 * pin.x(1) + thick, 1.2 * high, high), (0, -join, level)))
    shank.append(lying(0.25 * high, 2 * pin.x(1) + 1.6 * thick) + [0, mid, level])
    arm = pin.hang(kit, "arm", dice.between(1.6, 2.4), [(shank, look), (cover, grip)])
    fan.append(arm)
    wide, knee = 2 * pin.x(1) - 1.3 * thick, (0, mid, level)
    plate = [prism(outline, (0.8 * room, 0.8 * room, 0.004)) + [0, mid, top], lying(0.5 * high, wide) + knee]
    plate.append(box((wide, 0.9 * high, level - top), (0, mid, (level + top) / 2)))
    kit.add("press plate", hinge(knee, RIGHT, 0.3, -0.3), [(plate, looks.darker(look))], arm)
    if dice.chance(0.4):
        near = pin.radius * 1.5 + 0.004
        comb = pin.bars(2, [(0, 0), (near, 0)], 0.5 * high)
        comb.append(box((room, 0.8 * room, 0.003), (0, near + 0.4 * room, 0)))
        nubs = np.array(spots) * [1, 1, 0] + [0, near + 0.4 * room - mid, 0.004]
        comb += at(box((0.002, 0.002, 0.009)), nubs)
        pin.hang(kit, "cleaner", dice.between(1.2, 1.6), [(comb, grip)], sense=1)
    return opened(dice, kit, fan)


def _squeezer(dice: Dice) -> list[Body]:
    """Bowls within each other, two to four of them, each on an arm of its own about one pin."""
    kit = Assembly("arm")
    count, large, step = dice.pick((2, 3, 3, 4)), dice.between(0.034, 0.05), dice.between(0.005, 0.007)
    pin = Pin(np.zeros(3), large * dice.between(0.45, 0.7), 0.0035, dice.between(0.004, 0.007))
    back, flare, squash = pin.radius * 1.6 + 0.005, dice.between(0.008, 0.016), dice.between(0.85, 1.0)
    long, mid, fan = back + 2 * large + dice.between(0.09, 0.15), -back - large, list[int]()
    kit.fix(pin.shaft(), looks.metal(dice))
    for k in range(count):
        look, radius, z = looks.painted_metal(dice), large - k * (step + 0.001), k * step
        angle = np.linspace(0, np.pi / 2, 7)
        out = radius * np.column_stack([np.sin(angle), -squash * np.cos(angle)])
        inner = [(0.0, 0.0)] if k == count - 1 else (out * (1 - 0.002 / radius))[::-1].tolist()
        rim = sleeve_of(radius - 0.001, large + 0.003, 0.0025, 20) - [0, 0, 0.0025]
        bowl = moved([revolve(np.vstack([out, inner]), 20), rim], (0, mid, z))
        bowl += pin.bars(k, [(0, 0), (-pin.radius, z), (-back - 0.3 * large, z - 0.0015)], 0.0025)
        far = (-long * dice.pick((1, 1, 0.85)), z + flare * (k - 0.5))
        near, tall = (mid - large - 0.001, z - 0.001), 0.7 * (step + flare * 0.6)
        shank, cover = gripped_bar(dice, near, far, 0.004, tall)
        cap = [cylinder(0.8 * radius, 0.004, 18) + [0, mid, z + 0.0015]] if k == count - 1 else []
        parts = [([*bowl, *shank], look), (cover, looks.rubber(dice)), (cap, looks.darker(look))]
        if k:
            fan.append(pin.hang(kit, "arm", 0.7 + 0.5 * k, parts))
        else:
            for pieces, stuff in parts:
                kit.fix(pieces, stuff)
    return opened(dice, kit, fan)


def _stand(dice: Dice, kit: Assembly, size: _Size, look: Look) -> tuple[float, float, float]:
    """A foot, and a head on one post or two; gives the foot's top, the head's bottom and half its width."""
    wide, deep, high = size
    foot, low, kind = high * dice.between(0.05, 0.1), high * dice.between(0.8, 0.88), dice.whole(0, 3)
    half = wide * (0.45 if kind == 0 else dice.between(0.13, 0.22))
    back = (0.02 if kind == 0 else 0.36) * deep
    kit.fix([prism(dice.pick((SQUARE, rounded(0.2))), (wide, deep, foot)) + [0, 0, foot / 2]], look)
    if kind < 2:
        post = cylinder(0.05 * wide if kind == 0 else 0.7 * half, high + 0.01 - foot, 14)
        middle = (high + foot) / 2
        spots = two_places(0.38 * wide, back, middle) if kind == 0 else [(0, back, middle)]
        kit.fix(at(post, spots), looks.metal(dice))
    else:
        kit.fix([box((1.4 * half, 0.2 * deep, high - foot), (0, back, (high + foot) / 2))], look)
        if kind == 2:
            rib = [(0.8 * back, foot), (0.95 * back, foot + 0.3 * high)]
            kit.fix([flat_bar(rib, [0.2 * deep, 0], 0.4 * half)], look)
    kit.fix([between((-half, -0.18 * deep, low), (half, back + 0.11 * deep, high))], look)
    return foot, low, half


def _driven(dice: Dice, kit: Assembly, size: _Size, gap: tuple[float, float, float], tip: Parts) -> None:
    """A ram through the head of a stand, and its drive: a lever, one with a link, or a wheel.

    Args:
        dice: for all choices.
        kit: with the stand.
        size: of the stand.
        gap: lowest height that the ram may come down to, the head's bottom, half its width.
        tip: what is at the ram's end, about z = 0.
    """
    (_, deep, high), (bottom, low, half) = size, gap
    steel, (look, grip), thick = looks.metal(dice), arm_looks(dice), 0.3 * min(half, 0.1 * high)
    top, start = high + dice.between(0.6, 0.95) * (low - bottom), 0.98 * low
    shaft = [between((-thick, -thick, start), (thick, thick, top))]
    teeth = [(0, -1.1 * thick, z) for z in np.arange(high + 0.01, top, 0.02 * high)]
    shaft += at(box((thick, 0.4 * thick, 0.01 * high)), teeth) if dice.chance(0.5) else []
    ends = [(moved(pieces, (0, 0, start)), stuff) for pieces, stuff in tip]
    kit.add("ram", slide(DOWN, 0.8 * (low - bottom)), [(shaft, steel), *ends])
    kind, middle, reach = dice.unit(), (low + high) / 2, dice.between(0.5, 0.9) * high
    if kind < 0.35:
        long, count = 0.4 * reach, dice.whole(2, 5)
        turn = around([rod((0, 0, 0), (long, 0, 0), 0.05 * long, 8)], count)
        turn.append(cylinder(0.14 * long, 0.2 * long, 14))
        ring, balls = [torus(long, 0.06 * long, 22)], around([ball_knob(0.12 * long) + [long, 0, 0]], count)
        turn += dice.pick((ring, ring, balls, [rod((long, 0, 0), (long, 0, 0.5 * long), 0.1 * long, 10)]))
        kit.fix([lying(0.05 * long, 0.02) + [half, 0, middle]], steel)
        wheel = moved([pointed(piece, X) for piece in turn], (half + 0.1 * long + 0.01, 0, middle))
        kit.add("handwheel", spin((0, 0, middle), RIGHT), [(wheel, look)])
        return
    pin, linked = Pin(np.array([0, 0, middle]), half + 0.012, 0.012, 0.018 + 0.02 * high), kind > 0.7
    near, bend = 0.4 * reach, 0.0
    if linked:  # across the top of the ram
        pin = Pin(np.array([0, 0.3 * deep, top + 0.03]), thick + 0.03, 0.008, 0.012)
        near, bend = 0.4 * deep, 0.4 * reach
        kit.fix(pin.bars(0, [(0, 0), (0.001, high - top - 0.03)], 0.02), steel)
    kit.fix(pin.shaft(), steel)
    number = 1 if linked else 0
    shank, cover = gripped_bar(dice, (-near, 0), (-near - reach, bend), 0.014, 0.03)
    bars = pin.bars(number, [(0, 0), (-near, 0)], 0.016)
    bars += moved([*shank, box((2 * pin.x(number) + pin.thick, 0.014, 0.016), (0, -near, 0))], pin.spot)
    tilt = 0.0 if linked else dice.between(0.5, 1.1)
    lean = rotation(LEFT, tilt)
    cover = turned(moved(cover, pin.spot), lean, pin.spot)
    parts = [(turned(bars, lean, pin.spot), look), (cover, grip)]
    lever = kit.add("lever", hinge(pin.spot, RIGHT, tilt + 0.2 + 0.3 * linked), parts)
    if linked:
        knee = replace(pin, spot=np.array([0, 0, top + 0.03]))
        link = [(knee.bars(2, [(0, 0), (0, -0.06)], 0.012), steel)]
        kit.add("link", hinge(knee.spot, RIGHT, 0.25, -0.25), link, lever)


def _plates(dice: Dice) -> list[Body]:
    """Plates above a bed, each on arms of its own about the pin at the back."""
    kit = Assembly("base")
    wide, deep, bed = dice.between(0.16, 0.5), dice.between(0.16, 0.45), dice.between(0.02, 0.1)
    (look, grip), gap, count, fan = arm_looks(dice), dice.between(0.002, 0.006), dice.whole(1, 3), list[int]()
    spot, half = np.array([0, deep / 2 + 0.02, bed + 0.02]), wide * dice.between(0.25, 0.46)
    pin = Pin(spot, half, dice.between(0.006, 0.012), 0.014)
    kit.fix([between((-wide / 2, -deep / 2, 0), (wide / 2, deep / 2 + 0.03, bed))], look)
    kit.fix([*pin.bars(0, [(0, 0), (0.001, -0.022)], 0.02), *pin.shaft()], looks.metal(dice))
    kit.fix([box((0.8 * wide, 0.75 * deep, 0.004), (0, 0, bed + 0.001))], looks.darker(look))
    z = bed + 0.004 + gap
    for k in range(1, count + 1):
        high, pad, own = dice.between(0.008, 0.02), dice.between(0.003, 0.006), dice.between(0.85, 1.0)
        across, along, z = own * wide, own * deep - 0.02, z + pad
        plate = [prism(dice.pick((SQUARE, rounded(0.15))), (across, along, high)) + [0, -0.01, z + high / 2]]
        level, front = z + high / 2 - pin.spot[2], -0.01 - along / 2
        plate += pin.bars(k, [(0, 0), (-0.012, level), (-0.03 - 0.1 * deep, level)], 0.8 * high)
        far = (front - dice.between(0.05, 0.14), z + high / 2)
        shank, cover = gripped_bar(dice, (front, z + high / 2), far, 0.8 * high, high)
        aside = moved([*shank, *cover], ((k - (count + 1) / 2) * 0.3 * wide, 0, 0))
        under = box((0.75 * across, 0.75 * along, pad), (0, -0.01, z - pad / 2 + 0.0005))
        cap = [box((0.6 * across, 0.5 * along, gap), (0, -0.01, z + high))] if dice.chance(0.6) else []
        parts = [(plate, look), (aside, grip), ([under], looks.rubber(dice)), (cap, looks.metal(dice))]
        fan.append(pin.hang(kit, "plate", 0.8 + 0.4 * k, parts))
        z, look = z + high + gap + 0.004, look if dice.chance(0.5) else looks.painted_metal(dice)
    return opened(dice, kit, fan)


def _lever_arm_press(dice: Dice) -> list[Body]:
    """An arbor or a book press: a ram in a stand above a table; or plates above a bed."""
    kit, look, steel, kind = Assembly("base"), looks.painted_metal(dice), looks.metal(dice), dice.unit()
    if dice.chance(0.3):
        return _plates(dice)
    wide, deep, high = size = (dice.between(0.16, 0.4), dice.between(0.2, 0.4), dice.between(0.3, 0.7))
    foot, low, half = _stand(dice, kit, size, look)
    tall = 0.05 * high + 0.012
    middle, thick = (0, -0.02 * deep, foot + tall / 2 + 0.004), tall - 0.016
    if kind < 0.4:
        kit.fix([box((0.9 * wide, 0.02, 0.012), (0, s * 0.15 * deep, foot + 0.0045)) for s in (-1, 1)], steel)
        along, across = slide((0, -1, 0), 0.3 * deep), slide(RIGHT, 0.35 * wide, -0.35 * wide)
        motion, inset = dice.pick((along, across)), (0.5 * wide, 0.3 * deep, thick + 0.004)
        table = [box((0.7 * wide, 0.5 * deep, thick), middle), box(inset, middle)]
        kit.add("table", motion, [(table, steel)])
    elif kind < 0.7:
        kit.fix([cylinder(0.1 * wide, 0.012, 14) + [0, 0, foot]], steel)
        arms = around([box((0.3 * wide, 0.18 * wide, thick), (0.15 * wide, 0, 0))], dice.whole(3, 5))
        disc = [*arms, cylinder(0.22 * wide, 0.8 * thick, 18)]
        kit.add("turntable", spin((0, 0, foot), UP), [(moved(disc, (0, 0, middle[2])), steel)])
    else:
        kit.fix([box((0.7 * wide, 0.5 * deep, tall), (0, 0, foot + tall / 2))], steel)
    flat = dice.between(0.03, 0.07) * high
    tip = box((dice.between(0.3, 0.64) * wide, 0.3 * deep, flat))
    tip = tip if dice.chance(0.5) else cylinder(0.1 * wide, flat, 16)
    ends = [([tip], steel), ([tip * [0.9, 0.9, 0.3] - [0, 0, 0.6 * flat]], looks.rubber(dice))]
    _driven(dice, kit, size, (foot + tall + 1.5 * flat, low, half), ends)
    return opened(dice, kit)


def _citrus_press(dice: Dice) -> list[Body]:
    """Bowls on arms about a pin; or a bell on a ram in a stand, above a cup that lifts off or swings out."""
    if dice.chance(0.4):
        return _squeezer(dice)
    size = (dice.between(0.15, 0.22), dice.between(0.18, 0.26), dice.between(0.34, 0.5))
    kit, look, steel, r = Assembly("base"), looks.painted_metal(dice), looks.metal(dice), 0.25 * size[0]
    foot, low, half = _stand(dice, kit, size, look)
    tall = dice.between(0.12, 0.3) * size[2]
    bell = revolve(np.array([(0, -0.2), (0.45, 0), (0.8, -0.9), (0.75, -0.9), (0, -0.3)]) * r, 18)
    ring, level = sleeve_of(0.8 * r, 0.97 * r, 0.012, 18), foot + tall
    cup = [vessel(ngon(18), (1.5 * r, 1.5 * r, 0.9 * r), 0.003, 1.3)]
    cup.append(revolve([(0.6 * r, 0.002), (0, 0.8 * r)], 10))
    cups: Parts = [(moved(cup, (0, 0, level + 0.013)), steel)]
    if dice.chance(0.5):
        stem = cylinder(dice.between(0.9, 1.1) * r, tall, 18) + [0, 0, foot + tall / 2]
        kit.fix([stem, ring + [0, 0, level]], look)
        kit.add("cup", free(), cups)
    else:
        post = np.array([dice.sign() * 0.42 * size[0], -0.1 * size[1], level])
        kit.fix([rod(post * [1, 1, 0], post + [0, 0, 0.035], 0.008, 12)], steel)
        aim = -post / np.linalg.norm(post[:2]) * [1, 1, 0]
        arm = [rod(aim * -0.9 * r + [0, 0, level + 0.005], post + 0.012 * aim + [0, 0, 0.005], 0.005, 8)]
        arm += [ring + [0, 0, level], sleeve_of(0.0085, 0.016, 0.02, 14) + post]
        swings = kit.add("arm", hinge(post, (0, 0, np.sign(post[0])), 1.5), [(arm, look)])
        kit.add("cup", free(), cups, swings)
        glass = vessel(ngon(16), (1.2 * r, 1.2 * r, 0.7 * tall), 0.003, 1.15) + [0, 0, foot + 0.001]
        kit.add("glass", free(), [([glass], looks.glass(dice))])
    _driven(dice, kit, size, (level + 1.8 * r + 0.01, low, half), [([bell], steel)])
    return opened(dice, kit)


CATEGORIES: tuple[Category, ...] = (
    Category("garlic_press", _garlic_press),
    Category("citrus_press", _citrus_press),
    Category("lever_arm_press", _lever_arm_press),
)
