"""Chains of arms: robots, excavators, cranes, tractors."""

from __future__ import annotations

import numpy as np

from simart_kit.arrays import FloatArray

from ...shapes.dice import Dice
from ...shapes.outlines import ngon, rounded
from ...shapes.placing import X, Y, around, moved, rotation, turned
from ...shapes.primitives import Pieces, between, box, boxes, cylinder, loft, prism, rod, superquadric, torus
from . import looks
from .category import Category
from .objects import Body, Look, hinge, slide, spin, surface
from .rigging import BACK, LEFT, QUARTER, RIGHT, UP, Rig, axle_wheel, lying, profile


def _robot_arm(dice: Dice) -> list[Body]:
    """Three to six joints in a row, with a gripper, a cup or nothing."""
    scale, paint, dark = dice.spread(0.3, 1.6), looks.painted_metal(dice), looks.plastic(dice)
    thick, count = dice.between(0.05, 0.09), dice.whole(2, 5)
    foot = prism(ngon(dice.pick((4, 8, 20))), (0.3, 0.3, 0.05)) + [0, 0, 0.025]
    whole = Rig(surface([foot], dark), label="base")
    at = np.array([0, 0, 0.05])
    column = surface(
        [cylinder(0.1, 0.12, 18) + at + [0, 0, 0.062], box((0.5 * thick, 0.12, 0.12), at + [0, 0, 0.16])],
        paint,
    )
    parent = whole.add("turntable", hinge(at, UP, 2.9, -2.9), column)
    at, angle, side = at + [0, 0, 0.18], dice.between(-0.3, 0.4), 1
    for _ in range(count):
        long = dice.between(0.18, 0.45)
        along = np.array([0, -np.sin(angle), np.cos(angle)])
        shift = np.array([side * thick * 0.8, 0, 0])
        end = at + long * along
        form = (
            prism(rounded(0.2), (0.6 * thick, 0.9 * thick, long))
            if dice.chance(0.5)
            else cylinder(0.35 * thick, long, 12)
        )
        lean = rotation(RIGHT, angle)
        link = [*moved(turned([form], lean), shift + (at + end) / 2)]
        link += [lying(0.6 * thick, 0.62 * thick, X, 14) + p + shift for p in (at, end)]
        caps = surface([lying(0.35 * thick, 1.9 * thick, X, 12) + at + shift / 2], dark)
        parent = whole.add(
            "arm",
            hinge(at, RIGHT, dice.between(0.8, 1.8), -dice.between(0.5, 1.8)),
            surface(link, paint),
            caps,
            parent=parent,
        )
        if dice.chance(0.25):
            disc = moved(turned([cylinder(0.4 * thick, 0.04, 14)], lean), end + shift + 0.03 * along)
            turn = hinge(end + shift, along, 2.8, -2.8)
            parent = whole.add("wrist", turn, surface(disc, dark), parent=parent)
            end = end + 0.05 * along
        at, angle, side = end, angle + dice.between(-0.2, 1.1), -side
    along, lean = np.array([0, -np.sin(angle), np.cos(angle)]), rotation(RIGHT, angle)
    palm = moved(turned([box((0.1, 0.05, 0.03), (0, 0, 0.04)), cylinder(0.02, 0.05, 10)], lean), at)
    hand = whole.add("flange", hinge(at, along, 2.9, -2.9), surface(palm, dark), parent=parent)
    if dice.chance(0.7):
        for name, s in (("left_finger", -1), ("right_finger", 1)):
            tip = surface(
                moved(turned([box((0.012, 0.03, 0.08), (s * 0.012, 0, 0.097))], lean), at), looks.metal(dice)
            )
            whole.add("finger", slide((s, 0, 0), 0.03), tip, parent=hand, name=name)
    return whole.bodies(scale=scale)


def _tracks(whole: Rig, dice: Dice, wide: float, long: float) -> float:
    """Crawler tracks or wheels below a frame; gives its height."""
    high = dice.between(0.45, 0.6)
    if dice.chance(0.6):
        band = prism(rounded(0.5 * high / long, long / high), (long, high, 0.4))
        sides = turned([band], QUARTER @ rotation(RIGHT, np.pi / 2))
        for s in (-1, 1):
            whole.dress(0, surface(moved(sides, (s * wide / 2, 0, high / 2)), looks.rubber(dice)))
        return high
    form, rubber = axle_wheel(dice, high * 0.7), looks.rubber(dice)
    axles = [lying(0.06, wide, X, 10) + [0, y * long, high * 0.7] for y in (-0.35, 0.35)]
    spine = box((0.2, 0.8 * long, 0.12), (0, 0, high * 0.7))
    whole.dress(0, surface([*axles, spine], looks.metal(dice)))
    for s in (-1, 1):
        for y in (-0.35, 0.35):
            hub = np.array([s * wide / 2, y * long, high * 0.7])
            whole.add("wheel", spin(hub, RIGHT), surface(moved(form, hub), rubber))
    return high


def _excavator(dice: Dice) -> list[Body]:
    wide, long = dice.between(1.2, 1.8), dice.between(1.6, 2.4)
    paint, dark = looks.painted_metal(dice), looks.metal(dice)
    whole = Rig(surface([box((0.7 * wide, 0.6 * long, 0.2), (0, 0, 0.4))], dark), label="undercarriage")
    level = _tracks(whole, dice, wide, long)
    at = np.array([0, 0, level + 0.05])
    whole.dress(0, surface([cylinder(0.4, 0.24, 18) + at - [0, 0, 0.1]], dark))
    house = [between((-wide / 2, -0.4 * long, level + 0.06), (wide / 2, 0.55 * long, level + 0.2))]
    house.append(between((-wide / 2, 0.15 * long, level + 0.2), (wide / 2, 0.55 * long, level + 0.75)))
    cab_x = -0.28 * wide
    house += [box((0.4 * wide, 0.5 * long, 0.04), (cab_x, -0.12 * long, level + 1.25))]
    house += [
        box((0.04, 0.04, 1.1), (cab_x + s * 0.19 * wide, -0.12 * long + t * 0.23 * long, level + 0.7))
        for s in (-1, 1)
        for t in (-1, 1)
    ]
    turret = whole.add("turret", spin(at, UP), surface(house, paint))
    door = surface(
        [box((0.03, 0.44 * long, 0.95), (cab_x - 0.22 * wide, -0.12 * long, level + 0.7))], looks.glass(dice)
    )
    whole.add(
        "door", hinge((cab_x - 0.22 * wide, 0.1 * long, level + 0.7), (0, 0, -1), 1.4), door, parent=turret
    )
    x, pin = 0.18 * wide, np.array([0.18 * wide, -0.38 * long, level + 0.25])
    knee, tip = pin + [0, -0.35 * long, 0.6 * long], pin + [0, -0.75 * long, 0.55 * long]
    middle = np.array([[p[1], p[2]] for p in (pin, knee, tip)])
    boom = profile(np.vstack([middle + [0.0, -0.06], middle[::-1] + [0.05, 0.1]]), 0.16) + [x, 0, 0]
    first = whole.add(
        "boom",
        hinge(pin, LEFT, 0.6, -0.5),
        surface([boom, lying(0.08, 0.26, X, 10) + pin], paint),
        parent=turret,
    )
    end = tip + [0, -0.15 * long, -dice.between(0.4, 0.55) * long]
    stick = rod(tip + [0, 0.06 * long, 0.1 * long], end, 0.075, 4)
    second = whole.add(
        "stick",
        hinge(tip, LEFT, 1.0, -0.6),
        surface([stick, lying(0.06, 0.24, X, 10) + tip], paint),
        parent=first,
    )
    cup = np.array([[0.1, 0.05], [-0.15, 0.02], [-0.3, -0.25], [-0.1, -0.42], [0.12, -0.35]]) * 0.3 * long
    sides = [profile(cup, 0.03) + end + [s * 0.2, 0, 0] for s in (-1, 1)]
    back = [rod(end + [0, *a], end + [0, *b], 0.02) for a, b in ((cup[1], cup[2]), (cup[2], cup[3]))]
    floor = [
        loft(
            np.array([[-0.2, -0.015], [0.2, -0.015], [0.2, 0.015], [-0.2, 0.015]]),
            [(1, 1, 0), (1, 1, 0.3 * long * 0.4)],
        )
        + end
        + [0, 0.1 * 0.3 * long, -0.4 * 0.3 * long]
    ]
    whole.add("bucket", hinge(end, LEFT, 1.2, -1.0), surface([*sides, *back, *floor], dark), parent=second)
    return whole.bodies(scale=1.0 if dice.chance(0.4) else dice.spread(0.04, 0.2))


def _crane(dice: Dice) -> list[Body]:
    """A tower crane: jib that slews, trolley that runs along, hook that drops."""
    tall, reach, wide = dice.between(2.0, 3.6), dice.between(1.2, 2.2), dice.between(0.12, 0.2)
    paint, dark = looks.painted_metal(dice), looks.metal(dice)
    posts = boxes(
        (0.025, 0.025, tall), [(s * wide / 2, t * wide / 2, tall / 2) for s in (-1, 1) for t in (-1, 1)]
    )
    levels = np.linspace(0, tall, dice.whole(6, 12))
    braces = [
        rod((-s * wide / 2, t * wide / 2, a), (s * wide / 2, t * wide / 2, b), 0.008, 4)
        for a, b, s in zip(levels[:-1], levels[1:], np.resize([1, -1], len(levels) - 1), strict=True)
        for t in (-1, 1)
    ]
    whole = Rig(surface([posts, *braces, box((0.6, 0.6, 0.08), (0, 0, 0.04))], paint), label="tower")
    at = np.array([0, 0, tall + 0.01])
    jib = [cylinder(0.12, 0.06, 14) + at + [0, 0, 0.03], box((0.16, 0.2, 0.22), at + [0.15, -0.1, 0.17])]
    jib += [box((0.02, reach + 0.6, 0.02), at + [s * 0.05, 0.3 - reach / 2, 0.12]) for s in (-1, 1)]
    jib += [
        rod(at + [0, 0, 0.1], at + [0, 0, 0.5], 0.02),
        rod(at + [0, 0, 0.5], at + [0, -0.8 * reach, 0.13], 0.006),
        rod(at + [0, 0, 0.5], at + [0, 0.55, 0.13], 0.006),
    ]
    counter = surface([box((0.14, 0.16, 0.24), at + [0, 0.5, 0.06])], dark)
    slew = whole.add("jib", spin(at, UP), surface(jib, paint), counter)
    run = at + [0, -0.3, 0.09]
    trolley = whole.add(
        "trolley", slide((0, -1, 0), 0.65 * reach), surface([box((0.1, 0.1, 0.035), run)], dark), parent=slew
    )
    drop = dice.between(0.3, 0.6) * tall
    hook = [
        rod(run, run - [0, 0, drop], 0.005),
        box((0.05, 0.03, 0.07), run - [0, 0, drop]),
        *turned([torus(0.025, 0.007, 12)], rotation(RIGHT, np.pi / 2)),
    ]
    hook[-1] = hook[-1] + run - [0, 0, drop + 0.055]
    whole.add(
        "hook",
        slide((0, 0, -1), 0.9 * (tall - drop) - 0.1, -0.5 * drop),
        surface(hook, looks.metal(dice)),
        parent=trolley,
    )
    return whole.bodies(scale=dice.spread(0.15, 1.0))


def _tractor(dice: Dice) -> list[Body]:
    long, wide, big = dice.between(2.4, 3.4), dice.between(0.7, 0.9), dice.between(0.6, 0.8)
    small, paint, dark = big * dice.between(0.45, 0.7), looks.painted_metal(dice), looks.metal(dice)
    nose, tail = -long / 2, long / 2
    level = big * 0.8
    body = [
        between((-wide / 2, nose, level), (wide / 2, 0.1 * long, level + 0.2)),
        between((-wide / 2 + 0.05, 0.05 * long, level - 0.1), (wide / 2 - 0.05, tail - 0.2, level + 0.2)),
    ]
    body += [
        box((0.3, big * 1.6, 0.05), (s * (wide / 2 + 0.18), 0.28 * long, 2 * big + 0.05)) for s in (-1, 1)
    ]
    whole = Rig(
        surface(body, paint),
        surface(
            [
                box((0.5, 0.5, 0.12), (0, 0.25 * long, level + 0.35)),
                box((0.5, 0.1, 0.5), (0, 0.25 * long + 0.28, level + 0.6)),
                rod((0.2, -0.2 * long, level + 0.5), (0.2, -0.2 * long, level + 1.2), 0.04),
            ],
            dark,
        ),
    )
    hood = prism(rounded(0.15), (wide, 0.55 * long, 0.45)) + [0, nose + 0.29 * long, level + 0.435]
    whole.add("bonnet", hinge((0, nose + 0.01, level + 0.22), RIGHT, 0.9), surface([hood], paint))
    for spot, radius, label in ((nose + small, small, "front"), (0.28 * long, big, "rear")):
        form = axle_wheel(dice, radius)
        half = max(float(np.abs(p[..., 0]).max()) for p in form)
        shrink = min(1.0, 0.18 / half)
        whole.dress(0, surface([lying(0.05, wide + 0.1, X, 8) + [0, spot, radius]], dark))
        for name, s in (("left", -1), ("right", 1)):
            hub = np.array([s * (wide / 2 + 0.2), spot, radius])
            whole.add(
                "wheel",
                spin(hub, RIGHT),
                surface(moved([p * [shrink, 1, 1] for p in form], hub), looks.rubber(dice)),
                name=f"{label}_{name}_wheel",
            )
    column = np.array([0, 0.05 * long, level + 0.85])
    lean = rotation(RIGHT, -0.7)
    ring = [torus(0.2, 0.02, 16), rod((0, 0, 0), (0, 0, -0.35), 0.02), rod((-0.2, 0, 0), (0.2, 0, 0), 0.015)]
    whole.add(
        "steering wheel",
        spin(column, lean @ np.array(UP)),
        surface(moved(turned(ring, lean), column), looks.rubber(dice)),
    )
    if dice.chance(0.6):
        _loader(whole, np.array([0, -0.05 * long, level + 0.3]), nose, wide, (paint, dark))
    return whole.bodies(scale=1.0 if dice.chance(0.4) else dice.spread(0.04, 0.2))


def _loader(whole: Rig, pin: FloatArray, nose: float, wide: float, of: tuple[Look, Look]) -> None:
    """Arms with a shovel in front of a tractor."""
    paint, dark = of
    arms = [
        rod(pin + [s * (wide / 2 + 0.06), 0, 0], (s * (wide / 2 + 0.06), nose - 0.3, 0.35), 0.05, 6)
        for s in (-1, 1)
    ]
    arms.append(lying(0.05, wide + 0.2, X, 8) + [0, nose - 0.28, 0.35])
    lift = whole.add("loader arm", hinge(pin, LEFT, 1.0), surface(arms, paint))
    tip = np.array([0, nose - 0.3, 0.35])
    scoop = [
        box((1.5 * wide, 0.03, 0.5), tip + [0, -0.07, 0]),
        box((1.5 * wide, 0.5, 0.03), tip + [0, -0.33, -0.25]),
    ]
    scoop += [
        profile([[0, 0.25], [0, -0.25], [-0.5, -0.25]], 0.02) + tip + [s * 0.74 * wide, -0.07, 0]
        for s in (-1, 1)
    ]
    whole.add("shovel", hinge(tip, LEFT, 0.6, -0.9), surface(scoop, dark), parent=lift)


def _turning_wheel(dice: Dice) -> list[Body]:
    """A windmill, a water wheel or a fairground wheel."""
    radius, count, look = dice.between(0.3, 1.2), dice.whole(4, 10), looks.wood(dice)
    style = dice.unit()
    metal = looks.metal(dice)
    if style < 0.5:
        return _windmill(dice, radius, count, look)
    wide, axle = radius * dice.between(0.25, 0.6), radius * 1.15
    frame = [
        rod(
            (s * 0.6 * wide + s * 0.06 * radius, t * 0.6 * radius, 0),
            (s * 0.66 * wide, 0, axle),
            0.05 * radius,
            6,
        )
        for s in (-1, 1)
        for t in (-1, 1)
    ]
    whole = Rig(
        surface(frame, look),
        surface([box((1.6 * wide, 1.4 * radius, 0.03), (0, 0, 0.0))], metal),
        label="frame",
    )
    hub = np.array([0, 0, axle])
    level = rotation(BACK, np.pi / 2)
    rims = [
        p + [s * 0.45 * wide, 0, 0]
        for s in (-1, 1)
        for p in turned([torus(0.9 * radius, 0.03 * radius, 20)], level)
    ]
    spokes = turned(around([rod((0, 0, 0), (0.9 * radius, 0, 0), 0.02 * radius, 4)], count), level)
    whole_wheel: Pieces = [
        *rims,
        *[p + [s * 0.45 * wide, 0, 0] for p in spokes for s in (-1, 1)],
        lying(0.05 * radius, 1.5 * wide, X, 10),
    ]
    if style < 0.75:
        paddle = box((0.9 * wide, 0.02 * radius, 0.28 * radius), (0, 0, 0.95 * radius))
        whole_wheel += [
            p for k in range(2 * count) for p in turned([paddle], rotation(RIGHT, np.pi * k / count))
        ]
        whole.add("wheel", spin(hub, RIGHT), surface(moved(whole_wheel, hub), looks.wood(dice)))
        return whole.bodies()
    wheel = whole.add("wheel", spin(hub, RIGHT), surface(moved(whole_wheel, hub), metal))
    _gondolas(dice, whole, wheel, (hub, radius, wide), count)
    return whole.bodies()


def _windmill(dice: Dice, radius: float, count: int, look: Look) -> list[Body]:
    """Sails on a cap that turns on a tower."""
    tall = radius * dice.between(1.3, 2.2)
    tower = loft(
        ngon(dice.pick((4, 8, 14))),
        [(0, 0, 0), (0.9 * radius, 0.9 * radius, 0), (0.5 * radius, 0.5 * radius, tall), (0, 0, tall)],
    )
    whole = Rig(surface([tower], look), label="tower")
    at = np.array([0, 0, tall + 0.004])
    cap = superquadric((0.55 * radius, 0.6 * radius, 0.35 * radius), 0.8, 0.8, 8) + at + [0, 0, 0.17 * radius]
    yaw = whole.add("cap", spin(at, UP), surface([cap], looks.wood(dice)))
    hub = at + [0, -0.4 * radius, 0.17 * radius]
    blade = [
        box((0.06 * radius, 0.04 * radius, 0.95 * radius), (0, 0, 0.5 * radius)),
        box((0.22 * radius, 0.015 * radius, 0.7 * radius), (0.12 * radius, 0, 0.6 * radius)),
    ]
    sails = [
        p for k in range(min(count, 6)) for p in turned(blade, rotation(BACK, 2 * np.pi * k / min(count, 6)))
    ]
    sails.append(lying(0.05 * radius, 0.35 * radius, Y, 10) + [0, 0.12 * radius, 0])
    whole.add("sails", spin(hub, BACK), surface(moved(sails, hub), looks.wood(dice)), parent=yaw)
    return whole.bodies()


def _gondolas(dice: Dice, whole: Rig, wheel: int, size: tuple[FloatArray, float, float], count: int) -> None:
    """Cabins on a fairground wheel: its hub, radius and width."""
    hub, radius, wide = size
    for k in range(count):
        angle = 2 * np.pi * k / count
        pin = hub + 0.9 * radius * np.array([0, np.cos(angle), np.sin(angle)])
        gondola = [
            box((0.7 * wide, 0.18 * radius, 0.12 * radius), pin - [0, 0, 0.2 * radius]),
            box((0.03 * radius, 0.03 * radius, 0.18 * radius), pin - [0, 0, 0.09 * radius]),
            lying(0.02 * radius, 0.9 * wide, X, 8) + pin,
        ]
        whole.add("gondola", spin(pin, RIGHT), surface(gondola, looks.plastic(dice)), parent=wheel)


CATEGORIES: tuple[Category, ...] = (
    Category("robot_arm", _robot_arm),
    Category("excavator", _excavator),
    Category("crane", _crane),
    Category("tractor", _tractor),
    Category("turning_wheel", _turning_wheel),
)
