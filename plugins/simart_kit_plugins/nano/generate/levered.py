"""Kitchen and office tools of arms, blades or rolls about a pin."""

from __future__ import annotations

import numpy as np

from simart_kit.arrays import FloatArray

from ...shapes.dice import Dice
from ...shapes.outlines import SQUARE, ngon, rounded
from ...shapes.placing import X, around, at, moved, pointed, rotation, turned
from ...shapes.primitives import between, box, cylinder, prism, torus
from . import looks
from .assembling import Assembly
from .category import Category
from .fittings import sleeve_of
from .objects import Body, Look, hinge, slide, spin
from .rigging import LEFT, RIGHT, UP, ball_knob, lying
from .shared_pins import FLAT, UPRIGHT, Pin, arm_looks, flat_bar, gripped_bar, opened, two_places


def _gear(radius: float, thick: float, teeth: int = 12) -> FloatArray:
    """A toothed wheel about x."""
    tips = around([box((0.3 * radius, 0.2 * radius, thick), (0.9 * radius, 0, 0))], teeth)
    return pointed(np.concatenate([cylinder(0.9 * radius, thick, 16), *tips]), X)


def _can_opener(dice: Dice) -> list[Body]:
    """Arms side by side about one pin, on an arm with a key or on a tower; a wheel that cuts, magnets."""
    kit, (look, grip), steel, fan = Assembly("body"), arm_looks(dice), looks.metal(dice), list[int]()
    thick, r, long = dice.between(0.003, 0.006), dice.between(0.008, 0.012), dice.between(0.12, 0.2)
    tower = dice.chance(0.45)
    y, z = (-0.045, -1.2 * r) if tower else (2.0 * r, r)
    low = -z if tower else z - 2 * r  # of the wheel that cuts
    kit.fix([lying(0.5 * r, (9 if tower else 7) * thick) + [1.5 * thick, 0, 0]], steel)
    key = [_gear(0.8 * r, thick), lying(0.3 * r, 5 * thick) - [thick, 0, 0]]
    if tower:
        high, outline = dice.between(0.15, 0.26), dice.pick((SQUARE, rounded(0.25), ngon(18)))
        block = prism(outline, (0.09, 0.13, high)) + [-0.045 - thick, -0.03, 0.04 - high / 2]
        kit.fix([block], looks.painted_metal(dice))
    else:
        shank, cover = gripped_bar(dice, (0, 0), (-long, -0.012), r, 1.4 * r)
        jaw = [flat_bar([(0, 0), (y, z)], 1.2 * r, thick), lying(1.2 * r, thick)]
        kit.fix([*turned(shank, np.diag([thick / r, 1, 1])), *jaw], look)
        kit.fix(moved(cover, (-thick, 0, 0)), grip)
        wing = dice.pick((box((0.8 * thick, 1.4 * r, 1.2 * r)), pointed(torus(0.8 * r, 0.25 * r, 14), X)))
        key += at(wing, [(-3.5 * thick, s * 0.95 * r, 0) for s in (-1, 1)])
    kit.add("gear" if tower else "key", spin((0, y, z), LEFT), [(moved(key, (0, y, z)), steel)])
    for k in range(1, dice.whole(2, 4) if tower else dice.whole(2, 3)):
        x, far, first = 1.3 * k * thick, (-long * (1 if k == 1 else 0.6), 0.012 * k), k == 1
        shank, cover = gripped_bar(dice, (0, 0), far, r, r)
        flat = [*turned(shank, np.diag([thick / (2.2 * r), 1, 1])), lying(1.2 * r, thick)]
        flat += [flat_bar([(0, 0), (y, low)], 1.1 * r, thick)] if first else []
        end = cover if first else [cylinder(r, 0.005, 14) + [0, far[0], far[1] - 0.5 * r]]
        parts = [(moved(flat, (x, 0, 0)), look), (moved(end, (x, 0, 0)), grip)]
        arm = kit.add("lever" if first else "arm", hinge((0, 0, 0), LEFT, 0.6 + 0.3 * k), parts)
        fan.append(arm)
        if first:
            hub = (2.6 * thick, y, low)
            disc = moved([lying(0.8 * r, 0.4 * thick), lying(0.3 * r, 2 * thick)], hub)
            kit.add("wheel", spin(hub, RIGHT), [(disc, steel)], arm)
    turn = FLAT if dice.chance(0.7) else UPRIGHT
    return opened(dice, kit, fan, rotation(UP, -np.pi / 2) if tower else turn)


def _paper_guillotine(dice: Dice) -> list[Body]:
    """A board, and beside each other about one pin a blade's arm or a rail with a head, a clamp, a guard."""
    wide, deep, t = dice.between(0.2, 0.45), dice.between(0.25, 0.5), dice.between(0.01, 0.03)
    kit, (look, grip), steel, fan = Assembly("board"), arm_looks(dice), looks.metal(dice), list[int]()
    edge, thin, rail = wide / 2, dice.between(0.004, 0.008), dice.chance(0.25)
    spot = np.array([0, deep / 2 - 0.02, t + 0.016])
    board = [box((wide, deep, t), (0, 0, t / 2))]
    board.append(between((-edge, deep / 2, 0), (edge - 0.07, deep / 2 + 0.012, t + 0.012)))
    kit.fix(board, dice.pick((looks.wood, looks.plastic, looks.painted_metal))(dice))
    lugs = [flat_bar([(0, 0), (0.001, -0.018)], 0.022, 0.006, x) for x in (edge - 0.008, edge - 0.058)]
    kit.fix(moved([*lugs, lying(0.004, 0.075) + [edge - 0.025, 0, 0]], spot), steel)
    reach, x = 0.045 - deep, edge - 0.02
    if not rail:
        way = (edge + 0.003 + thin / 2, reach, -0.012)
        fan.append(_beside(dice, kit, "arm", spot, way, (thin, 0.02), (look, grip)))
    if rail or dice.chance(0.65):
        label, way = "rail" if rail else "clamp", (x, reach, -0.008)
        arm = _beside(dice, kit, label, spot, way, (0.012, 0.006), (look, grip))
        pad = flat_bar([(-0.04, -0.0125), (reach + 0.02, -0.0125)], 0.002, 0.009, x) + spot
        kit.fix([pad], looks.rubber(dice), arm)
        if rail:
            place = np.array([x, reach + deep / 2 + 0.03, t + 0.026])
            hub = place + [0.018, 0, -0.006]
            block = [box((0.03, 0.05, 0.024)), ball_knob(0.012) + [0, 0, 0.018]]
            head = kit.add("slider", slide((0, 1, 0), -reach - 0.12), [(moved(block, place), grip)], arm)
            disc = moved([lying(0.011, 0.002), lying(0.003, 0.006)], hub)
            kit.add("wheel", spin(hub, RIGHT), [(disc, steel)], head)
    if dice.chance(0.4):
        way = (edge - 0.04, reach, 0.012)
        _beside(dice, kit, "guard", spot, way, (0.018, 0.005), (looks.glass(dice), grip))
    for k in range(dice.whole(1, 2)):
        x, long, off = -edge + (0.1 + 0.35 * k) * wide, deep * dice.between(0.4, 0.8), 0.16 * deep
        slots = at(box((0.26 * wide, 0.005, 0.001)), [(x + 0.1 * wide, s * off, t) for s in (-1, 1)])
        kit.fix(slots, looks.rubber(dice))
        knobs = at(cylinder(0.008, 0.01, 12), [(x, s * off, t + 0.018) for s in (-1, 1)])
        bar = box((0.012, long, 0.012), (x, 0, t + 0.0075))
        kit.add("back stop", slide(RIGHT, 0.2 * wide), [([bar], looks.metal(dice)), (knobs, grip)])
    return opened(dice, kit, fan)


def _beside(
    dice: Dice,
    kit: Assembly,
    label: str,
    spot: FloatArray,
    way: tuple[float, float, float],
    size: tuple[float, float],
    coats: tuple[Look, Look],
) -> int:
    """Adds an arm about the pin through `spot`, beside others; gives its number.

    Args:
        dice: for all choices.
        kit: that it is added to.
        label: of the arm; a guard has no grip.
        spot: (3,) of the pin, at x = 0.
        way: x of the arm, y of its end and its level, both from the pin.
        size: width and height of the arm.
        coats: looks of the arm and of its grip.
    """
    (x, reach, low), (broad, high), (look, grip) = way, size, coats
    bar = [flat_bar([(0, 0), (-0.03, low), (reach, low)], high, broad, x), lying(0.009, broad) + [x, 0, 0]]
    far = (reach - (0.13 if label == "arm" else 0.06), low + 0.03)
    shank, cover = gripped_bar(dice, (reach, low), far, 0.01, 0.026)
    ends = [] if label == "guard" else moved([*shank, *cover], (x, 0, 0))
    parts = [(moved(bar, spot), look), (moved(ends, spot), grip)]
    return kit.add(label, hinge(spot, LEFT, dice.between(0.8, 1.4)), parts)


def _tape_dispenser(dice: Dice) -> list[Body]:
    """Rolls on an axle in a heavy foot or on a grip; some have arms about the axle too."""
    kit, (look, grip), steel = Assembly("base"), arm_looks(dice), looks.metal(dice)
    count = dice.pick((1, 1, 2, 3))
    r, wide, gun = dice.between(0.022, 0.06), dice.between(0.012, 0.05), dice.chance(0.35)
    pin = Pin(np.array([0, 0, 1.6 * r]), count * (wide + 0.003) / 2 + 0.016, 0.004, 0.3 * r)
    half, nose, core = pin.half, -dice.between(1.8, 2.3) * r, r * dice.between(0.4, 0.65)
    kit.fix(pin.shaft(), steel)
    if gun:
        shank, cover = gripped_bar(dice, (0.2 * r, 0.4 * r), (1.2 * r, -2.2 * r), 0.02, 0.035)
        kit.fix(pin.bars(0, [(0, 0), (0.2 * r, -1.2 * r), (nose, -r)], 0.3 * r), look)
        kit.fix([*shank, box((2 * half, 0.02, 0.01), (0, 0.2 * r, 0.4 * r))], look)
        kit.fix(cover, grip)
    else:
        foot = prism(dice.pick((SQUARE, rounded(0.2))), (2 * half + 0.01, 1.2 * r - nose, 0.45 * r))
        kit.fix([foot + [0, (1.2 * r + nose) / 2, 0.22 * r]], look)
        kit.fix(pin.bars(0, [(0, 0), (0.001, -1.3 * r)], dice.between(0.5, 1.2) * r), look)
    lip = 0.75 * r if gun else 0.9 * r
    kit.fix([between((-half, nose, 0.4 * r), (half, nose + 0.25 * r, lip))], look)
    row = np.linspace(0.006 - half, half - 0.006, 8)
    kit.fix(at(box((0.003, 0.004, 0.006)), [(x, nose - 0.001, lip) for x in row]), steel)
    spokes = around([box((0.9 * core, 0.2 * core, 0.5 * wide), (0.45 * core, 0, 0))], dice.whole(2, 5))
    spool = [*spokes, sleeve_of(0.85 * core, core, 0.98 * wide, 18) - [0, 0, 0.49 * wide]]
    for k in range(count):
        hub, full = ((k - (count - 1) / 2) * (wide + 0.003), 0, 1.6 * r), r * dice.between(0.75, 1)
        ring = [sleeve_of(core, full, wide, 24) - [0, 0, wide / 2]]
        parts = ((ring, looks.plastic(dice)), (spool, grip))
        turning = [(moved([pointed(one, X) for one in pieces], hub), stuff) for pieces, stuff in parts]
        kit.add("roll", spin(hub, RIGHT), turning)
    _about_axle(dice, kit, pin, r, look)
    if dice.chance(0.4):
        knee = np.array([0, nose - 0.006, lip + 0.007])
        flap = flat_bar([(-0.002, -0.003), (-0.002, 0.5 * r - knee[2])], 0.002, 1.8 * half)
        flap_parts = [(moved([flap, lying(0.003, 1.9 * half)], knee), grip)]
        kit.add("flap", hinge(knee, LEFT, 1.5), flap_parts)
    return opened(dice, kit)


def _about_axle(dice: Dice, kit: Assembly, pin: Pin, r: float, look: Look) -> None:
    """What turns about the axle of rolls of a radius, beside them: an arm with a roller, a cover."""
    if dice.chance(0.6):
        path, wide = [(0, 0), (-1.2 * r, 0.1 * r)], 2 * pin.x(1) + pin.thick
        hub = pin.spot + [0, -1.2 * r, 0.1 * r]
        arms = [*pin.bars(1, path, 0.2 * r), lying(0.06 * r, wide) + hub]
        arm = pin.hang(kit, "arm", dice.between(0.7, 1.0), [(arms, look)])
        roller = moved([lying(0.12 * r, wide - 0.012), lying(0.15 * r, 0.3 * wide)], hub)
        kit.add("roller", spin(hub, RIGHT), [(roller, looks.rubber(dice))], arm)
    if dice.chance(0.5):
        angle = np.linspace(1.2, 2.5, 8)
        arch = 1.08 * r * np.column_stack([np.cos(angle), np.sin(angle)])
        hood = [flat_bar(arch, 0.002, 2 * pin.x(2) + pin.thick) + pin.spot]
        for end in (arch[2], arch[6]):
            hood += pin.bars(2, [(0, 0), end], 0.25 * r)
        pin.hang(kit, "cover", dice.between(0.6, 0.9), [(hood, looks.plastic(dice))])


def _folding(dice: Dice, long: float, high: float, count: int, room: float = 0.0) -> Assembly:
    """Two scales along y about 0, pins at both ends, tools about those; only at -y if it leaves `room`."""
    kit, (look, _), thick = Assembly(), arm_looks(dice), dice.between(0.0016, 0.003)
    half, steel = max((0.6 * count + 0.6) * thick, room / 2), looks.metal(dice)
    outline = rounded(dice.between(0.1, 0.5), (long + high) / high)
    scale = pointed(prism(outline, (long + high, high, thick)), X)
    kit.fix(at(scale, two_places(half + 0.5 * thick)), look)
    pins = [(0, s * long / 2, 0) for s in (-1, 1)]
    kit.fix(at(lying(0.2 * high, 2 * half + 2.6 * thick), pins), looks.metal(dice))
    shapes = [(1, 1, 0.9, 0.1), (0.6, 0.4, 0.4, 0.5), (0.9, 0.8, 0.8, 0.8), (0.8, 0.6, 0.9, 0.3)]
    for k in range(count):
        reach = long * dice.between(0.55, 0.86)
        end, edge = (-1, 1) if room else (dice.sign(), dice.pick((-1, 1, 1)))
        pin = np.array([1.2 * thick * (k - (count - 1) / 2), end * long / 2, 0])
        path = [(-end * u * reach, edge * 0.12 * high) for u in (0, 0.3, 0.75, 1)]
        tool = [flat_bar(path, 0.7 * high * np.array(dice.pick(shapes)), thick), lying(0.45 * high, thick)]
        now, axis = dice.between(0.4, 2.6) if dice.chance(0.4) else 0.0, np.array([-end * edge, 0, 0])
        parts = [(moved(turned(tool, rotation(axis, now)), pin), steel)]
        label = dice.pick(("blade", "blade", "tool", "screwdriver"))
        kit.add(label, hinge(pin, axis, 2.9 - now, -now), parts)
    return kit


def _multi_tool(dice: Dice) -> list[Body]:
    """Blades and tools folded into a body from both ends; or pliers with two handles that hold them."""
    long, high = dice.between(0.06, 0.1), dice.between(0.012, 0.02)
    turn = FLAT if dice.chance(0.6) else UPRIGHT
    if dice.chance(0.45):
        return opened(dice, _folding(dice, long, high, dice.whole(3, 10)), turn=turn)
    kit, steel, thick = Assembly("jaw"), looks.metal(dice), dice.between(0.003, 0.005)
    neck, gap, count = dice.between(0.02, 0.03), 0.62 * high, dice.whole(1, 4)
    jaw, tip, parent = dice.between(0.025, 0.04), dice.between(0.002, 0.006), 0
    kit.fix([lying(0.25 * high, 2.6 * thick)], looks.metal(dice))
    width = np.array([0.5 * high, 0.5 * high, 0.6 * high, 0.45 * high, tip])
    for side in (-1, 1):
        path = np.array([(-neck, gap), (-0.4 * neck, 0.7 * gap), (0, 0), (0.3 * jaw, 0), (jaw, -tip / 2)])
        arm = [flat_bar(path * [1, side], width, thick), lying(0.45 * high, thick)]
        arm = moved(arm, (0.52 * side * thick, 0, 0))
        if side == 1:
            parent = kit.add("jaw", hinge((0, 0, 0), LEFT, 0.5), [(arm, steel)])
        else:
            kit.fix(arm, steel)
        spot = np.array([0, -neck, side * gap])
        motion, eye = hinge(spot, (-side, 0, 0), dice.between(2.0, 2.6)), lying(0.3 * high, 2 * thick) + spot
        handle = kit.add("handle", motion, [([eye], steel)], parent)
        holds = _folding(dice, long, 0.9 * high, count, 2.2 * thick)
        kit.graft(holds, spot - [0, long / 2, 0], np.diag([1.0, 1.0, side]), handle)
    return opened(dice, kit, turn=turn)


CATEGORIES: tuple[Category, ...] = (
    Category("can_opener", _can_opener),
    Category("paper_guillotine", _paper_guillotine),
    Category("tape_dispenser", _tape_dispenser),
    Category("multi_tool", _multi_tool),
)
