"""Seats that swivel, recline, fold and swing."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from simart_kit.arrays import FloatArray

from ...shapes.dice import Dice
from ...shapes.outlines import rounded
from ...shapes.placing import X, around, moved, rotation, turned
from ...shapes.primitives import (
    Pieces,
    between,
    box,
    boxes,
    cylinder,
    prism,
    revolve,
    rod,
    sheet,
    superquadric,
    torus,
    tube,
)
from . import looks
from .category import Category
from .objects import Body, Look, hinge, slide, spin, surface
from .rigging import LEFT, RIGHT, UP, Rig, caster_hub, caster_wheel, fork, lying


def _cushion(dice: Dice, width: float, depth: float, thick: float) -> FloatArray:
    """A soft or hard pad about 0."""
    if dice.chance(0.6):
        return superquadric((width, depth, thick), dice.between(0.25, 0.6), dice.between(0.2, 0.6), 7)
    return prism(rounded(dice.between(0.03, 0.2), width / depth), (width, depth, thick))


def _shell(width: float, height: float, bend: float, thick: float) -> Pieces:
    """A bent panel with two skins, from z = 0 up, its front at y = 0 in the middle."""
    x, z = np.meshgrid(np.linspace(-1, 1, 8), np.linspace(0, 1, 6), indexing="ij")
    narrow = 1 - 0.15 * z**2
    skin = np.stack([x * narrow * width / 2, -bend * x**2 + 0.12 * height * z, z * height], axis=-1)
    ends = [np.stack([skin[k], skin[k] + [0, thick, 0]]) for k in (0, -1)]
    return [sheet(skin), sheet(skin[::-1] + [0, thick, 0]), *(sheet(end) for end in ends)]


def _rollers(dice: Dice, whole: Rig, spots: Sequence[tuple[float, float, float]], look: Look) -> None:
    """Casters or gliders below these spots."""
    radius = dice.between(0.022, 0.035)
    wide, style = radius * dice.between(0.6, 1.3), dice.unit()
    for number, (x, y, z) in enumerate(spots, 1):
        yaw = rotation(UP, 2 * np.pi * dice.unit())
        holder = surface(moved(turned(fork(radius, wide), yaw), (x, y, z)), look)
        hub = yaw @ caster_hub(radius) + [x, y, z]
        tyre = surface(moved(turned(caster_wheel(radius, wide), yaw), hub), looks.darker(look))
        if style < 0.2:
            whole.dress(0, surface([cylinder(radius, radius, 10) + [x, y, z - radius / 2]], look))
            continue
        parent = whole.add("caster", spin((x, y, z), UP), holder, name=f"caster_{number}")
        whole.add("wheel", spin(hub, yaw @ RIGHT), tyre, parent=parent, name=f"wheel_{number}")


def _office_chair(dice: Dice) -> list[Body]:
    reach, low, height = dice.between(0.25, 0.36), dice.between(0.08, 0.14), dice.between(0.42, 0.55)
    frame, cover = looks.metal(dice) if dice.chance(0.6) else looks.plastic(dice), looks.fabric(dice)
    count, thick = dice.whole(4, 6), dice.between(0.02, 0.035)
    start = dice.between(0, 1)
    arm = tube(
        [(0, 0, low + 0.05), (0.5 * reach, 0, low + 0.03), (reach, 0, low)], thick * np.array([1, 0.8, 0.6])
    )
    sleeve, top = dice.between(0.025, 0.035), low + dice.between(0.1, 0.2)
    hub = [cylinder(2 * sleeve, 0.07, 14) + [0, 0, low + 0.04], rod((0, 0, low), (0, 0, top), sleeve, 12)]
    whole = Rig(surface([*around([arm], count, start), *hub], frame), label="base")
    angles = start + 2 * np.pi * np.arange(count) / count
    _rollers(dice, whole, [(reach * np.cos(a), reach * np.sin(a), low - 0.4 * thick) for a in angles], frame)
    piston = surface([rod((0, 0, low + 0.02), (0, 0, height - 0.03), sleeve * 0.65, 10)], looks.metal(dice))
    column = whole.add("column", slide(UP, dice.between(0.06, 0.12)), piston)
    width, depth = dice.between(0.42, 0.54), dice.between(0.42, 0.52)
    under = surface([box((0.2, 0.25, 0.035), (0, 0, height - 0.02))], frame)
    pad = surface([_cushion(dice, width, depth, 0.09) + [0, 0, height + 0.04]], cover)
    seat = whole.add("seat", spin((0, 0, height), UP), pad, under, parent=column)
    _office_back(dice, whole, seat, (width, depth, height), (frame, cover))
    return whole.bodies()


def _office_back(
    dice: Dice, whole: Rig, seat: int, size: tuple[float, float, float], of: tuple[Look, Look]
) -> None:
    """Backrest and arms of an office chair."""
    (width, depth, height), (frame, cover) = size, of
    tall, edge = dice.between(0.35, 0.75), depth / 2 + 0.015
    shell = moved(
        _shell(width * 0.9, tall, dice.between(0, 0.1), 0.035), (0, edge, height + dice.between(0.1, 0.2))
    )
    stem = tube(
        [(0, 0.1, height - 0.02), (0, edge + 0.03, height), (0, edge + 0.09, height + 0.35)], 0.018, 8
    )
    panels = (surface(shell, cover), surface([stem], frame))
    leans = hinge((0, edge, height), LEFT, dice.between(0.2, 0.6))
    whole.add("backrest", leans, *panels, parent=seat)
    if dice.chance(0.3):
        return
    rise = dice.between(0.18, 0.24)
    for name, side in (("left", -1), ("right", 1)):
        x = side * (width / 2 + 0.03)
        post = [
            box((0.03, 0.06, rise - 0.02), (x, 0, height + rise / 2)),
            between((min(x, 0.1 * side), -0.03, height - 0.01), (max(x, 0.1 * side), 0.03, height + 0.01)),
        ]
        whole.dress(seat, surface(post, frame))
        pad = surface([box((0.08, 0.26, 0.03), (x, 0, height + rise + 0.02))], looks.darker(cover))
        whole.add("armrest", slide(UP, 0.09), pad, parent=seat, name=f"{name}_armrest")


def _swivel_stool(dice: Dice) -> list[Body]:
    """A seat that turns, on a column that lifts out of its post, or on a post that reaches up to it."""
    height, radius = dice.between(0.4, 0.8), dice.between(0.15, 0.21)
    frame, cover = looks.metal(dice), looks.fabric(dice) if dice.chance(0.6) else looks.wood(dice)
    stem, lifts = dice.between(0.015, 0.03), dice.chance(0.5)
    if dice.chance(0.4):
        base: Pieces = [revolve(np.array([[0, 0.03], [0.2, 0.03], [1, 0.012], [1, 0], [0, 0]]) * [radius, 1])]
    else:
        leg = tube([(0, 0, height * 0.55), (0.6 * radius, 0, 0.4 * height), (1.2 * radius, 0, 0.01)], 0.014)
        base = around([leg], dice.whole(3, 5), dice.between(0, 1))
    base.append(rod((0, 0, 0.01), (0, 0, height * 0.6 if lifts else height - 0.01), stem * 1.4, 12))
    if dice.chance(0.5):
        ring = 0.25 * height
        base += [
            torus(radius * 0.85, 0.01, 20) + [0, 0, ring],
            *around([rod((0, 0, ring), (radius * 0.85, 0, ring), 0.008)], 3),
        ]
    whole = Rig(surface(base, frame), label="base")
    parent = 0
    if lifts:
        column = surface([rod((0, 0, 0.1), (0, 0, height - 0.01), stem, 10)], looks.darker(frame))
        parent = whole.add("column", slide(UP, 0.25 * height), column)
    top = superquadric((2 * radius, 2 * radius, dice.between(0.03, 0.09)), dice.between(0.2, 0.7), 1.0, 8)
    pad = [surface([top + [0, 0, height + 0.02]], cover)]
    if dice.chance(0.3):
        back = moved(_shell(1.6 * radius, 0.25, 0.08, 0.02), (0, 0.9 * radius, height + 0.08))
        brace = box((0.04, 0.012, 0.2), (0, 0.98 * radius, height + 0.08))
        pad.append(surface([*back, brace], cover))
    whole.add("seat", spin((0, 0, height), UP), *pad, parent=parent)
    return whole.bodies()


def _folding_chair(dice: Dice) -> list[Body]:
    """The long legs, which carry the back, are the root; the short ones and the seat fold."""
    width, seat, tall = dice.between(0.38, 0.46), dice.between(0.4, 0.46), dice.between(0.75, 0.9)
    metal = dice.chance(0.6)
    frame = looks.metal(dice) if metal else looks.wood(dice)
    thick, x = dice.between(0.01, 0.016), width / 2
    foot, lean = np.array([-0.22, 0.0]), dice.between(0.3, 0.5)
    head = foot + [lean * tall, tall]
    pin = foot + 0.5 * seat * np.array([lean, 1.0])
    other = pin + 0.5 * seat * np.array([0.75, -1.0])
    upper = pin - 0.45 * seat * np.array([0.75, -1.0])
    long = [rod((s * x, *foot), (s * x, *head), thick, 8) for s in (-1, 1)]
    rail = rod((-x, *(0.15 * head + 0.85 * foot)), (x, *(0.15 * head + 0.85 * foot)), thick * 0.8)
    tilt = np.arctan(lean)
    back = turned([_cushion(dice, width, 0.02, dice.between(0.12, 0.3))], rotation(RIGHT, -tilt))
    at_back = foot + 0.85 * (head - foot)
    whole = Rig(
        surface([*long, rail], frame), surface(moved(back, (0, *at_back)), looks.plastic(dice)), label="frame"
    )
    inner = x - 2.4 * thick
    short = [rod((s * inner, *upper), (s * inner, *other), thick, 8) for s in (-1, 1)]
    low = 0.8 * other + 0.2 * upper
    short.append(rod((-inner, *low), (inner, *low), thick * 0.8))
    whole.add("legs", hinge((0, *pin), LEFT, dice.between(0.7, 1.0)), surface(short, frame))
    hold = foot + seat / tall * (head - foot)
    deep = dice.between(0.34, 0.42)
    wide = 2 * (x - thick) - 0.006
    pad = box((wide, deep, 0.025), (0, hold[0] + 0.02 - deep / 2, seat + 0.02))
    if dice.chance(0.4):
        ys = np.linspace(hold[0] - deep + 0.05, hold[0], dice.whole(4, 7))
        pad = boxes((wide, 0.8 * deep / len(ys), 0.018), [(0, y, seat + 0.02) for y in ys])
    whole.add("seat", hinge((0, hold[0], seat + 0.02), LEFT, 1.2), surface([pad], looks.darker(frame, 0.85)))
    return whole.bodies()


def _recliner(dice: Dice) -> list[Body]:
    width, depth, seat = dice.between(0.5, 0.65), dice.between(0.55, 0.7), dice.between(0.38, 0.46)
    arm, high = dice.between(0.1, 0.2), dice.between(0.55, 0.68)
    cover = looks.fabric(dice)
    x, y = width / 2, depth / 2
    low = dice.between(0.04, 0.12)
    body = [box((width, depth * 0.98, seat - 0.14 - low), (0, 0, (seat - 0.14 + low) / 2))]
    for side in (-1, 1):
        size = (arm, depth + 0.12, high)
        body.append(prism(rounded(0.2), size) + [side * (x + 0.003 + arm / 2), 0, high / 2])
    whole = Rig(surface(body, cover))
    pad = _cushion(dice, width - 0.01, depth - 0.04, 0.13) + [0, -0.01, seat - 0.07]
    whole.dress(0, surface([pad], looks.darker(cover, 0.9)))
    rest = _cushion(dice, width - 0.01, 0.16, dice.between(0.65, 0.8))
    tilted = moved(turned([rest + [0, 0, 0.36]], rotation(RIGHT, -0.12)), (0, y - 0.0, seat - 0.08))
    whole.add("backrest", hinge((0, y, seat - 0.08), LEFT, dice.between(0.5, 1.0)), surface(tilted, cover))
    tall = seat - 0.16
    foot = box((width - 0.02, 0.06, tall), (0, -y - 0.03, seat - 0.03 - tall / 2))
    whole.add(
        "footrest", hinge((0, -y - 0.003, seat - 0.03), LEFT, dice.between(1.1, 1.6)), surface([foot], cover)
    )
    if dice.chance(0.5):
        side = dice.sign()
        at_x = side * (x + arm + 0.006)
        lever = [
            box((0.02, 0.14, 0.025), (at_x + side * 0.012, -0.05, 0.32)),
            lying(0.02, 0.012) + [at_x, 0, 0.32],
        ]
        whole.add("lever", hinge((at_x, 0, 0.32), LEFT, 1.2), surface(lever, looks.plastic(dice)))
    return whole.bodies()


def _deck_chair(dice: Dice) -> list[Body]:
    """A lounger: head at the back, sections that tilt."""
    width, long, level = dice.between(0.55, 0.7), dice.between(1.7, 2.0), dice.between(0.25, 0.4)
    frame, thick = looks.wood(dice) if dice.chance(0.6) else looks.plastic(dice), dice.between(0.03, 0.05)
    x, y = width / 2, long / 2
    pieces = [box((thick, long, 0.06), (s * (x + thick / 2 + 0.004), 0, level)) for s in (-1, 1)]
    pieces += [box((width + 0.008, thick, 0.05), (0, s * (y - 0.2), level - 0.03)) for s in (-1, 1)]
    ends = (-y + 0.2, y - 0.2)
    rolling = dice.chance(0.45)
    pieces += [
        box((thick, thick, level), (s * (x + thick / 2 + 0.004), e, level / 2))
        for s in (-1, 1)
        for e in (ends[:1] if rolling else ends)
    ]
    whole = Rig(surface(pieces, frame), label="frame")
    if rolling:
        for name, s in (("left_wheel", -1), ("right_wheel", 1)):
            spot = np.array([s * (x + thick + 0.035), ends[1], 0.5 * level])
            whole.add(
                "wheel",
                spin(spot, RIGHT),
                surface([lying(0.5 * level, 0.04) + spot], looks.rubber(dice)),
                name=name,
            )
        posts = [
            box((thick, thick, 0.6 * level), (s * (x + thick / 2 + 0.004), ends[1], 0.7 * level))
            for s in (-1, 1)
        ]
        whole.dress(
            0,
            surface([*posts, lying(0.01, width + 2 * thick + 0.05, X, 8) + [0, ends[1], 0.5 * level]], frame),
        )
    fold, knee = dice.between(0.0, 0.2) * long, -dice.between(0.15, 0.3) * long
    cover = looks.fabric(dice) if dice.chance(0.5) else frame
    for low, high, part in ((-y, knee, "leg"), (knee, fold, "seat"), (fold, y, "back")):
        sect = surface(_slats(dice, width, low + 0.004, high - 0.004, level + 0.035, cover is frame), cover)
        if part == "back":
            whole.add("backrest", hinge((0, fold, level + 0.02), RIGHT, dice.between(0.8, 1.3)), sect)
        elif part == "leg":
            whole.add("leg rest", hinge((0, knee, level + 0.02), LEFT, 0.5), sect)
        else:
            whole.dress(0, sect)
    return whole.bodies()


def _slats(dice: Dice, width: float, low: float, high: float, z: float, bare: bool) -> Pieces:
    if not bare:
        return [box((width, high - low, 0.03), (0, (low + high) / 2, z))]
    count = max(2, round((high - low) / 0.09))
    pitch = (high - low) / count
    rails = boxes(
        (0.03, high - low, 0.015), [(s * 0.3 * width, (low + high) / 2, z - 0.015) for s in (-1, 1)]
    )
    return [
        rails,
        boxes((width, 0.8 * pitch, 0.015), [(0, low + (k + 0.5) * pitch, z) for k in range(count)]),
    ]


def _swing_bench(dice: Dice) -> list[Body]:
    """A bench that hangs from a frame."""
    width, tall, spread = dice.between(1.0, 1.6), dice.between(1.6, 2.0), dice.between(0.5, 0.7)
    look, thick = looks.wood(dice) if dice.chance(0.5) else looks.metal(dice), dice.between(0.025, 0.04)
    x = width / 2 + 0.25
    pieces = [rod((s * x, t * spread, 0), (s * x, 0, tall), thick, 8) for s in (-1, 1) for t in (-1, 1)]
    pieces += [rod((-x - 0.05, 0, tall), (x + 0.05, 0, tall), thick, 8)]
    pieces += [
        rod((s * x, -0.7 * spread, 0.3 * tall), (s * x, 0.7 * spread, 0.3 * tall), thick * 0.7)
        for s in (-1, 1)
    ]
    whole = Rig(surface(pieces, look), label="frame")
    if dice.chance(0.5):
        roof = [box((width + 0.5, 1.1, 0.02), (0, 0, tall + 0.06))]
        whole.dress(0, surface(roof, looks.fabric(dice)))
    level, deep, tail = dice.between(0.4, 0.55), dice.between(0.4, 0.5), dice.between(0.4, 0.6)
    bench = _slats(dice, width, -deep / 2, deep / 2, level, True)
    back = turned(moved(_slats(dice, width, 0, tail, 0, dice.chance(0.7)), (0, 0, 0)), rotation(RIGHT, 1.4))
    bench += moved(back, (0, deep / 2, level))
    ropes = [
        rod((s * width / 2, t * deep / 2, level), (s * width / 2, 0, tall - thick), 0.008, 5)
        for s in (-1, 1)
        for t in (-1, 1)
    ]
    whole.add(
        "bench",
        hinge((0, 0, tall), RIGHT, 0.5, -0.5),
        surface(bench, looks.wood(dice)),
        surface(ropes, looks.metal(dice)),
    )
    return whole.bodies()


def _cinema_seats(dice: Dice) -> list[Body]:
    """A row of seats that tip up."""
    count, width, level = dice.whole(1, 4), dice.between(0.46, 0.54), dice.between(0.4, 0.46)
    frame, cover = looks.painted_metal(dice), looks.fabric(dice)
    arm, start = dice.between(0.04, 0.08), -count * width / 2
    posts = [box((arm, 0.42, 0.62), (start + k * width, 0, 0.31)) for k in range(count + 1)]
    whole = Rig(surface(posts, frame), label="frame")
    deep, tipped, inner = dice.between(0.42, 0.48), dice.chance(0.3), width - arm - 0.008
    rest, soft = _cushion(dice, inner, 0.09, 0.55), _cushion(dice, inner, deep, 0.1)
    for number in range(count):
        x = start + (number + 0.5) * width
        back = turned([rest + [0, 0, 0.28]], rotation(RIGHT, -0.15))
        whole.dress(0, surface(moved(back, (x, 0.2, level + 0.04)), cover))
        pin = np.array([x, 0.12, level])
        pad = soft + [0, 0.02 - deep / 2, 0]
        up = rotation(LEFT, 1.3) if tipped else np.eye(3)
        seat = surface(
            [*moved(turned([pad], up), pin), lying(0.02, inner, X, 10) + pin], looks.darker(cover, 0.85)
        )
        whole.add("seat", hinge(pin, RIGHT if tipped else LEFT, 1.3), seat)
    return whole.bodies()


def _high_chair(dice: Dice) -> list[Body]:
    """A child's chair with a tray that slides or swings up."""
    width, level, spread = dice.between(0.3, 0.38), dice.between(0.5, 0.62), dice.between(0.05, 0.12)
    frame, thick, x = looks.wood(dice) if dice.chance(0.5) else looks.plastic(dice), 0.015, width / 2
    legs = [
        rod((s * (x + spread), t * (0.16 + spread), 0), (s * x, t * 0.14, level), thick, 8)
        for s in (-1, 1)
        for t in (-1, 1)
    ]
    shell = [
        box((width, 0.34, 0.02), (0, 0, level)),
        *moved(_shell(width, 0.42, 0.05, 0.02), (0, 0.17, level)),
    ]
    arms = [box((0.025, 0.34, 0.025), (s * (x + 0.013), 0, level + 0.2)) for s in (-1, 1)]
    arms += [
        box((0.025, 0.025, 0.2), (s * (x + 0.013), t, level + 0.1)) for s in (-1, 1) for t in (-0.12, 0.12)
    ]
    whole = Rig(surface(legs + arms, frame), surface(shell, looks.plastic(dice)))
    tray = prism(rounded(0.15), (width + 0.08, dice.between(0.2, 0.28), 0.015)) + [0, -0.2, level + 0.224]
    rim = box((width + 0.02, 0.01, 0.02), (0, -0.27, level + 0.24))
    top = surface([tray, rim], looks.plastic(dice))
    if dice.chance(0.5):
        whole.add("tray", slide((0, -1, 0), dice.between(0.06, 0.15)), top)
    else:
        pin = rod((-0.03, -0.09, level + 0.22), (0.03, -0.09, level + 0.22), 0.008)
        pins = [pin + [s * x, 0, 0] for s in (-1, 1)]
        whole.dress(0, surface(pins, frame))
        whole.add("tray", hinge((0, -0.09, level + 0.22), LEFT, dice.between(1.3, 1.9)), top)
    if dice.chance(0.5):
        low = 0.4 * level
        step = box((width * 0.9, 0.12, 0.015), (0, -0.17 - 0.5 * spread - 0.05, low))
        bar = rod(
            (-x - 0.6 * spread, -0.14 - 0.6 * spread, low),
            (x + 0.6 * spread, -0.14 - 0.6 * spread, low),
            0.01,
        )
        whole.dress(0, surface([bar], frame))
        whole.add("footrest", hinge((0, -0.14 - 0.5 * spread, low), LEFT, 1.4), surface([step], frame))
    return whole.bodies()


CATEGORIES: tuple[Category, ...] = (
    Category("office_chair", _office_chair),
    Category("swivel_stool", _swivel_stool),
    Category("folding_chair", _folding_chair),
    Category("recliner", _recliner),
    Category("deck_chair", _deck_chair),
    Category("swing_bench", _swing_bench),
    Category("cinema_seats", _cinema_seats),
    Category("high_chair", _high_chair),
)
