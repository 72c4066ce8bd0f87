"""Furniture with fronts that tilt, fall, roll or lift."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from simart_kit.arrays import FloatArray

from ...shapes import fronts
from ...shapes.dice import Dice
from ...shapes.legs import feet
from ...shapes.outlines import rounded
from ...shapes.placing import X, moved, pointed, rotation, turned
from ...shapes.primitives import Pieces, between, box, boxes, open_box, prism, rod, vessel
from . import assembling, leaves, looks
from .assembling import holder
from .assembly import Assembly, Leaf, until_moving
from .carcass import Size, carcass, columns, crown, even_or_random, fill, rows, shelves, stand
from .category import Category
from .objects import Body, Look, Surface, free, hinge, slide, surface
from .rigging import profile, ribbon
from .styles import Face, Opening, Style, grip, panel, random_style

_Coats = tuple[Look, Look, Look]
_Grid = tuple[int, int]
# How a front is held, always at the edge that moves farthest.
_MODES = ((5.0, "handle"), (2.5, "slot"), (1.5, "gap"))


def _style(dice: Dice, look: Look) -> Style:
    """Fronts that stay flat, as those that tip lie close to their neighbours."""
    makes = (fronts.slab, fronts.slab, fronts.framed, fronts.planked, fronts.louvred, fronts.raised)
    make, gap, long = dice.pick(makes), dice.between(0.004, 0.007), dice.spread(0.08, 0.3)
    return replace(random_style(dice, look), make=make, gap=gap, grips="handle", long=long)


def _pair(piece: FloatArray, x: float) -> Pieces:
    return [piece + [s * x, 0, 0] for s in (-1, 1)]


def _barrels(pin: FloatArray, x: float, long: float = 0.06, radius: float = 0.005) -> Pieces:
    return _pair(rod(pin - [long / 2, 0, 0], pin + [long / 2, 0, 0], radius, 10), x)


def _chest(corners: FloatArray, wide: float, wall: float) -> Pieces:
    """Cheeks of these corners in y and z with a floor, a back and a top between them, open before."""
    back, low, high, x = corners[:, 0].max(), corners[:, 1].min(), corners[:, 1].max(), wide / 2
    a, b = (corners[np.abs(corners[:, 1] - z) < 1e-6, 0].min() for z in (low, high))
    spans = [(a, low, back, low + wall), (back - wall, low, back, high), (b, high - wall, back, high)]
    plates = [between((-x, *span[:2]), (x, *span[2:])) for span in spans]
    return [*plates, *_pair(profile(corners, wall), x - wall / 2)]


def _cells(made: Assembly, dice: Dice, room: Opening, grid: _Grid, wall: float, look: Look) -> list[Opening]:
    """Rooms in columns and rows with boards between."""
    across = columns(made, room, even_or_random(dice, grid[0]), wall, look)
    return [one for column in across for one in rows(made, column, [1.0] * grid[1], wall, look)]


def _front(style: Style, face: Face, mode: str, rise: float) -> list[Surface]:
    """A front with a handle, a slot or a gap beside it; `rise` tells where, as a share of its height."""
    wide, high, z = min(0.14, 0.4 * face.width), min(0.03, 0.12 * face.height), rise * face.height
    if mode == "gap":
        return panel(style, replace(face, height=face.height - high, z=face.z - np.sign(rise) * high / 2))
    if mode == "slot":
        x, top = face.width / 2, face.height / 2
        ends = [(-x, -top, x, z - high / 2), (-x, z + high / 2, x, top)]
        ends += [(-x, z - high / 2, -wide / 2, z + high / 2), (wide / 2, z - high / 2, x, z + high / 2)]
        bits = [between((a, -style.thick, b), (c, 0, d)) for a, b, c, d in ends]
        return [surface(moved(bits, (face.x, face.back, face.z)), style.look)]
    return panel(style, face) + (grip(style, face, 0, z, False, 0.6 * face.width) if mode == "handle" else [])


def _section(dice: Dice, start: float, low: float, most: float, deep: float) -> FloatArray:
    """(N, 2) of y and z about the pin: the floor and back of a bin, none of it farther off than `most`."""
    kind, radius = dice.pick(("curved", "curved", "slanted", "straight")), most * dice.between(0.75, 0.98)
    if kind == "curved":
        turn = np.linspace(np.arcsin(max(low, 0) / radius), dice.between(0.8, 1.3), 9)
        arc = np.column_stack([np.minimum(radius * np.cos(turn), deep), radius * np.sin(turn)])
        return np.concatenate([[(start, low)], arc])
    high = radius * dice.between(0.5, 0.8)
    far = min(deep, 0.97 * float(np.sqrt(radius**2 - high**2)))
    near = far * dice.between(0.35, 0.7) if kind == "slanted" else far
    return np.array([(start, low), (near, low), (far, high)])


def _tub(dice: Dice, path: FloatArray, wide: float, look: Look) -> Surface:
    """What is behind a front that tips: a tub or a rack of bars between cheeks, along x about 0."""
    loop, wall = np.concatenate([path, [(path[0, 0], path[-1, 1])]]), min(0.006, 0.02 * wide)
    steps = np.linspace(0, len(path) - 1, dice.whole(6, 12))
    spots = [(0, *(np.interp(s, range(len(path)), path[:, k]) for k in (0, 1))) for s in steps]
    solid = dice.chance(0.7)
    skin = pointed(ribbon(path, wall, wide, -wide / 2), X) if solid else boxes((wide, wall, wall), spots)
    return surface([skin, *_pair(profile(loop, wall), (wide - wall) / 2)], look)


def _tip(dice: Dice, style: Style, room: Opening, mode: str, kind: str) -> Leaf:
    """A front that tips out about its lower edge or pins above it; behind it a "tub", a "pail" or lugs."""
    face, raised = Face.of(style, room), 0.0
    pin_y = face.back - style.thick
    if style.inset and room.height > 0.3 and dice.chance(0.6):
        raised, pin_y = dice.between(0.05, 0.08), face.back + 0.012
        # The lower edge dips as it swings in.
        drop = float(np.hypot(style.thick + 0.012, raised)) - raised + 0.001
        face = replace(face, z=face.z + drop / 2, height=face.height - drop)
    pin = np.array([face.x, pin_y, face.z - face.height / 2 + raised])
    parts = _front(style, face, mode, dice.between(0.32, 0.42))
    most, pad = room.high - pin[2] - 0.006, min(0.008, 0.06 * room.height)
    deep = min(0.98 * most, room.front + room.depth - pin_y - 0.012)
    start, low = face.back + 0.001 - pin_y, room.low + pad - pin[2]
    wide, children = room.width - 2 * min(0.012, 0.05 * room.width), tuple[Leaf, ...]()
    if kind != "bare":
        path = _section(dice, start, low, most, deep)
        parts.append(_tub(dice, path, wide, style.inner).placed(np.eye(3), pin))
    if kind == "pail":
        size = (0.8 * wide, 0.6 * (path[1, 0] - start), 0.6 * most)
        pail = vessel(rounded(0.15), size, 0.003, 1.08) + pin + [0, start + 0.62 * size[1], low + 0.008]
        children = (Leaf("bucket", "bucket", (surface([pail], looks.plastic(dice)),), free()),)
    if kind == "bare":
        lug = box((0.005, 0.04, 0.04), (0, start + 0.02, low + 0.03)) + pin
        parts.append(surface(_pair(lug, wide / 2 - 0.0025), style.grip))
    if raised:
        parts.append(surface(_barrels(pin, (wide + room.width) / 4 - 0.002, 0.01, 0.006), style.grip))
    upper = np.radians(dice.between(28, 55) if kind != "bare" else dice.between(40, 65))
    return Leaf("flap", "flap", tuple(parts), hinge(pin, (1, 0, 0), upper), children)


def _drawer(made: Assembly, dice: Dice, style: Style, room: Opening) -> Leaf:
    """A deep one, on runners at the sides of the case."""
    leaf = leaves.drawer(dice, style, room)
    while np.ptp(np.concatenate([one.triangles[..., 1].ravel() for one in leaf.surfaces])) < 0.7 * room.depth:
        leaf = leaves.drawer(dice, style, room)
    slim, long = 0.7 * min(0.015, 0.04 * room.width), 0.8 * (room.depth - style.reach)
    y, z = room.front + style.reach + 0.005 + long / 2, room.low + 0.3 * room.height
    rail = box((slim, long, min(0.012, 0.1 * room.height)), (room.center[0], y, z))
    made.fix(_pair(rail, (room.width - slim) / 2), style.grip)
    return leaf


def _flap(dice: Dice, style: Style, room: Opening, mode: str, side: int) -> Leaf:
    """A front that falls about its lower edge (side -1) or lifts about its upper one (1)."""
    face = Face.of(style, room)
    parts = _front(style, face, mode, -side * dice.between(0.34, 0.42))
    pin = np.array([face.x, face.back - style.thick, face.z + side * face.height / 2])
    if mode == "bare":
        parts.append(surface(_barrels(pin, 0.3 * face.width), style.grip))
    upper = np.radians(dice.between(75, 100) if side < 0 else dice.between(70, 110))
    return Leaf("flap", "flap", tuple(parts), hinge(pin, (-side, 0, 0), upper))


def _fold(dice: Dice, style: Style, room: Opening) -> Leaf:
    """A front in two that lifts: its lower half folds up before its upper one, about barrels that show."""
    low, high = room.rows((1, 1), 0.0)
    lower = _flap(dice, style, low, "handle", 1)
    pin = np.asarray(lower.motion.origin) + [0, -0.003, style.gap / 2]
    barrels = surface(_barrels(pin, 0.35 * room.width), style.grip)
    turn = hinge(pin, (-1, 0, 0), np.radians(dice.between(100, 140)))
    second = Leaf("folding_flap", "flap", (*lower.surfaces, barrels), turn)
    return _flap(dice, style, high, "bare", 1).with_children(second)


def _tilt_bin_cabinet(dice: Dice) -> Sequence[Body]:
    """Laundry, rubbish or grain: bins that tip out side by side or over each other, and drawers."""
    grids = ((1, 1), (2, 1), (2, 1), (3, 1), (3, 1), (1, 2), (1, 2), (1, 3), (2, 2), (2, 3))
    (across, up), above = dice.pick(grids), dice.pick((None, None, True, False))
    wide, high = across * dice.between(0.28, 0.55), dice.between(0.4, 0.75) * (1.0, 1.5, 2.1)[up - 1]
    size = (wide + 0.4 * (above is False), dice.between(0.2, 0.55), high + 0.18 * (above is True))
    look = looks.wood(dice) if dice.chance(0.8) else looks.painted_metal(dice)
    made, style, board = Assembly("body"), _style(dice, look), dice.between(0.014, 0.026)
    mode, kind = dice.weighted(_MODES), dice.weighted([(6, "tub"), (2, "pail"), (1.5, "bare")])
    if up == 1 and above is None and dice.chance(0.5):
        return _hopper(dice, made, style, (across, size[1], high), mode)
    room = carcass(made, dice, size, board, look)
    stand(made, dice, size, look, 0.15)
    crown(made, dice, size, look)
    if above is not None:
        shares = (room.height - 0.17, 0.15) if above else (room.width - 0.4, 0.38)
        room, rest = (rows if above else columns)(made, room, shares, board, look)
        grid = (dice.whole(1, across), 1) if above else (1, dice.whole(2, 4))
        for one in _cells(made, dice, rest, grid, board, look):
            made.add(_drawer(made, dice, style, one))
    for one in _cells(made, dice, room, (across, up), board, look):
        made.add(_tip(dice, style, one, mode, kind))
    return made.bodies()


def _hopper(dice: Dice, made: Assembly, style: Style, size: Size, mode: str) -> Sequence[Body]:
    """Bins with fronts that lean out, between boards below a counter."""
    (count, depth, high), look, style = size, style.inner, replace(style, lift=-style.thick)
    each, board, lean = dice.between(0.25, 0.5), dice.between(0.015, 0.025), dice.between(0.08, 0.3)
    y, x, out = depth / 2, (count * each + board) / 2, depth / 2 + high * float(np.tan(lean))
    corners = np.array([(-y, -board), (y, -board), (y, high + board), (-out, high + board)])
    dividers = [profile(corners, board) + [k * each - x + board / 2, 0, 0] for k in range(1, int(count))]
    made.fix([*dividers, *_chest(corners, 2 * x, board)], look)
    stand(made, dice, (2 * x, depth, high), look)
    tall = float((high - style.thick * np.sin(lean) - 0.008) / np.cos(lean))
    for k in range(int(count)):
        room = Opening(k * each - x + board, (k + 1) * each - x, 0.003, tall, -y, depth - 0.01)
        leaf = _tip(dice, style, room, mode, dice.pick(("tub", "tub", "bare")))
        made.add(leaf.turned(rotation((1, 0, 0), lean), leaf.motion.origin))
    return made.bodies()


def _bread_bin(dice: Dice) -> list[Body]:
    """One or two chambers over each other."""
    wide, deep, kit, base = dice.between(0.3, 0.5), dice.between(0.24, 0.36), assembling.Assembly("body"), 0.0
    look = dice.pick((looks.wood(dice), looks.painted_metal(dice), looks.metal(dice)))
    other = dice.pick((look, looks.wood(dice), looks.plastic(dice), looks.glass(dice)))
    coats = (look, other, dice.pick((looks.metal(dice), looks.wood(dice), looks.plastic(dice))))
    tiers = 2 if dice.chance(0.35) else 1
    for k in range(tiers):
        last, chamber = k == tiers - 1, assembling.Assembly()
        # Below another one, what leans back and falls would catch on it.
        make = dice.weighted([(5.0, _rolled), (4.0 * last, _flapped), (2.5 * last, _lidded)])
        high = min(0.93 * deep, dice.between(0.15, 0.25))
        make(dice, chamber, (wide, deep, high), coats)
        kit.graft(chamber, (0, 0, base))
        base += high
    return kit.done()


def _rolled(dice: Dice, kit: assembling.Assembly, size: Size, coats: _Coats) -> None:
    """A part of a drum that turns up and back into the chamber, about hubs on its cheeks."""
    (wide, deep, high), wall, whole = size, dice.between(0.006, 0.014), dice.chance(0.45)
    rim = min(0.47 * deep, high * (0.5 if whole else dice.between(0.7, 0.85)))
    pin, x, back = np.array([0, rim - deep / 2, high - rim]), wide / 2, deep / 2
    first = dice.between(-0.7, -0.4) if whole else 0.02
    turns = [np.linspace(a, b, 12) for a, b in ((first, np.pi / 2), (-np.pi / 2, first - 0.04))]
    bend, under = (np.column_stack([-np.cos(turn), np.sin(turn)]) for turn in turns)
    low = under * rim if whole else np.array([(-rim, rim - high), (-rim, 0)])
    loop = np.concatenate([low, bend * rim]) + pin[1:]
    skirt = pointed(ribbon(low * (1 - wall / 2 / rim) + pin[1:], wall, wide, -x), X)
    kit.fix([skirt, *_chest(np.concatenate([loop, [(back, high), (back, 0)]]), wide, wall)], coats[0])
    kit.fix(_barrels(pin, x + 0.003, 0.006, 0.014), coats[2])
    room, radius, bars = wide - 2 * wall - 0.005, rim - wall - 0.005, dice.chance(0.45)
    slat = box((room, 0.006, 0.1 * radius), (0, 0.003 - radius, 0))
    skin = [p for a in np.linspace(first, 1.5, 13) for p in turned([slat], rotation((1, 0, 0), -a))]
    smooth = pointed(ribbon(bend * (radius - 0.003), 0.006, room, -room / 2), X)
    fan = profile(np.concatenate([[(0.012, -0.004)], bend * (radius - 0.006)]), 0.004)
    pull = moved(holder(dice, wide * dice.between(0.1, 0.5)), (0, -radius, 0))
    hold = moved(turned(pull, rotation((1, 0, 0), -first - 0.14)), pin)
    lid = moved([*(skin if bars else [smooth]), *_pair(fan, room / 2 - 0.002)], pin)
    motion = hinge(pin, (-1, 0, 0), dice.between(0.8, 1.0) * (1.2 - first))
    kit.add("lid", motion, [(lid, coats[1]), (hold, coats[2])])


def _flapped(dice: Dice, kit: assembling.Assembly, size: Size, coats: _Coats) -> None:
    """A front between cheeks, upright or leaning back, that falls or lifts; its grip is at the far edge."""
    (wide, deep, high), wall, thick = size, dice.between(0.006, 0.014), dice.between(0.006, 0.012)
    y, lean = deep / 2, dice.pick((0.0, dice.between(0.1, 0.5)))
    run, falls, room = high * float(np.tan(lean)), dice.chance(0.55), wide - 2 * wall - 0.005
    kit.fix(_chest(np.array([(-y, 0), (y, 0), (y, high), (run - y, high)]), wide, wall), coats[0])
    low = wall + thick * float(np.sin(lean)) + 0.003
    long = (high - wall - 0.003 - low) / float(np.cos(lean))
    slope, pin = rotation((1, 0, 0), -lean), np.array([0, -y + low * np.tan(lean), low])
    front = (fronts.framed if dice.chance(0.4) else fronts.slab)(dice, room, long, thick)
    hold = moved(holder(dice, wide * dice.between(0.1, 0.5)), (0, 0, long * (0.85 if falls else 0.15)))
    parts = [(moved(turned(moved(front, (0, thick, long / 2)), slope), pin), coats[1])]
    parts.append((moved(turned(hold, slope), pin), coats[2]))
    end = pin if falls else pin + slope @ np.array([0, 0, long])
    upper = dice.between(1.3, 1.6) + (lean if falls else 0.0)
    kit.add("flap", hinge(end, (1 if falls else -1, 0, 0), upper), parts)


def _lidded(dice: Dice, kit: assembling.Assembly, size: Size, coats: _Coats) -> None:
    """A tub with a lid that only lies on it, or is hinged behind on barrels."""
    wide, deep, high = size
    thick, outline = dice.between(0.012, 0.025), rounded(dice.pick((0.05, 0.15, 0.3)))
    kit.fix([vessel(outline, size, 0.006)], coats[0])
    lid = prism(outline, (wide * 1.02, deep * 1.02, thick)) + [0, 0, high + 0.001 + thick / 2]
    hold = turned(holder(dice, wide * dice.between(0.2, 0.4)), rotation((1, 0, 0), -np.pi / 2))
    parts = [([lid], coats[1]), (moved(hold, (0, 0, high + thick)), coats[2])]
    loose, pin = dice.chance(0.6), np.array([0, 0.51 * deep + 0.006, high])
    kit.fix([] if loose else _barrels(pin, 0.3 * wide, 0.2 * wide, 0.006), coats[2])
    kit.add("lid", free() if loose else hinge(pin, (-1, 0, 0), dice.between(1.2, 1.7)), parts)


def _storage_bench(dice: Dice) -> Sequence[Body]:
    """Lids over boxes, or a fixed seat, above rooms with fronts; some with a back."""
    wide, deep, leans = dice.between(0.5, 1.7), dice.between(0.34, 0.55), dice.chance(0.5)
    lids, look, board, base = dice.chance(0.75), looks.wood(dice), dice.between(0.012, 0.022), 0.0
    made, style, y, box_high = Assembly("body"), _style(dice, look), deep / 2, dice.between(0.3, 0.42)
    if not lids or dice.chance(0.4):
        base, box_high = dice.between(0.22, 0.28) if lids else box_high, 0.14 if lids else 0.0
        room = carcass(made, dice, (wide, deep, base), board, look)
        for one in columns(made, room, [1.0] * dice.whole(1, max(1, int(wide / 0.38))), board, look):
            fill(made, dice, style, one, dice.pick(("flap_down", "door", "drawer", "open")), look)
    stand(made, dice, (wide, deep, base), look, 0.1)
    top, plate = base + box_high, dice.between(0.014, 0.026)
    made.fix([open_box((wide, deep, box_high), board) + [0, 0, base]] if lids else [], look)
    rear = dice.between(0.11, 0.14) if leans else dice.pick((0.0, 0.04))
    made.fix([box((wide, rear, plate), (0, y - rear / 2 + 0.003, top + plate / 2))] if rear else [], look)
    tall, make, soft = dice.between(0.3, 0.6), style.make or fronts.slab, looks.fabric(dice)
    made.fix(moved(make(dice, wide, tall, 0.025) if leans else [], (0, y, top + plate + tall / 2)), look)
    count = dice.whole(1, max(1, min(3, int(wide / 0.4)))) if lids else 1
    pad, each, straps = dice.pick((0.0, dice.between(0.03, 0.075))), wide / count, dice.chance(0.4)
    size = (each - 0.008, deep - rear + 0.01, plate)
    for k in range(count):
        board_of = turned(make(Dice(style.seed), *size), rotation((1, 0, 0), -np.pi / 2))
        parts = [surface(moved(board_of, (0, -size[1] / 2, 0.0005 - plate)), style.look)]
        if pad:
            cushion = prism(rounded(0.08), (size[0] * 0.98, size[1] - 0.4 * pad - 0.01, pad))
            parts.append(surface([cushion + [0, -size[1] / 2 - 0.1 * pad, pad / 2]], soft))
        tab = [box((0.05, 0.025, 0.004), (0, -0.0125, 0))] if straps else holder(Dice(style.seed), 0.1)
        parts += [surface(moved(tab, (0, -size[1], -plate / 2)), style.grip)] if lids else []
        leaf = Leaf("lid", "lid", tuple(parts), hinge((0, 0, 0), (-1, 0, 0), dice.between(1.1, 1.45)))
        spot = ((k - (count - 1) / 2) * each, y - rear, top + plate)
        (made.add if lids else made.fix_leaf)(leaf.moved(spot))
    return made.bodies()


def _flap_cabinet(dice: Dice) -> Sequence[Body]:
    """A case for a wall with fronts that lift, fall or fold up."""
    across, up = dice.pick(((1, 1), (2, 1), (2, 1), (3, 1), (1, 2), (1, 2), (2, 2), (1, 3), (4, 1), (2, 3)))
    size = (across * dice.between(0.35, 0.6), dice.between(0.18, 0.4), up * dice.between(0.25, 0.45))
    look = looks.wood(dice) if dice.chance(0.8) else looks.painted_metal(dice)
    made, style, board = Assembly("body"), _style(dice, look), dice.between(0.014, 0.024)
    room = carcass(made, dice, size, board, look)
    crown(made, dice, size, look, 0.2)
    mode = dice.weighted((*_MODES, (1.5, "bare")))
    style = style.clear() if mode != "slot" and dice.chance(0.25) else style
    shared = dice.weighted([(4, "lift"), (2, "fall"), (2, "fold"), (2, "mixed")])
    for one in _cells(made, dice, room, (across, up), board, look):
        kind = dice.pick(("lift", "fall", "fold", "open")) if shared == "mixed" else shared
        if kind != "open":
            fold, side = kind == "fold", -1 if kind == "fall" else 1
            made.add(_fold(dice, style, one) if fold else _flap(dice, style, one, mode, side))
        shelves(made, dice, one, look, style.reach + 0.03, 1)
    return made.bodies()


def _bureau(dice: Dice) -> Sequence[Body]:
    """A writing flap, leaning or upright, before small drawers; drawers or doors below, lopers beside."""
    look, board, made = looks.wood(dice), dice.between(0.014, 0.022), Assembly("body")
    wide, deep, tall = dice.between(0.55, 1.1), dice.between(0.36, 0.5), dice.between(0.26, 0.42)
    style, legs = replace(_style(dice, look), long=dice.between(0.06, 0.14)), dice.chance(0.4)
    floor = dice.between(0.18, 0.3) if legs else dice.between(0.6, 0.72)
    lean = dice.between(0.3, min(0.75, float(np.arctan(0.5 * deep / tall)))) if dice.chance(0.7) else 0.0
    x, y, run, roof = wide / 2, deep / 2, tall * float(np.tan(lean)), floor + tall
    room = carcass(made, dice, (wide, deep, floor - 0.05 - board), board, look)
    made.fix(feet(dice, wide, deep, dice.between(0.4, 0.5)) if legs else [], look)
    for one in _cells(made, dice, room, (dice.whole(1, 2), 1 if legs else dice.whole(1, 4)), board, look):
        made.add(leaves.door(dice, style, one, 1) if one.height > 0.3 else _drawer(made, dice, style, one))
    # Between the case and the flap is a strip with the lopers at its ends, which carry the open flap.
    pull = moved(holder(dice, 0.03), (0, -y - 0.001, floor - 0.026))
    bar = between((-0.013, -y - 0.001, floor - 0.046), (0.013, y - 0.02, floor - 0.006))
    far, out, thick = dice.between(0.55, 0.75) * deep, x - board - 0.018, style.thick
    for side in (-1, 1):
        parts = (surface([bar], style.look), surface(pull, style.grip))
        made.add(Leaf("loper", "rail", parts, slide((0, -1, 0), far)).moved((side * out, 0, 0)))
    low = floor - 0.05 - board
    strip = between((0.018 - out, -y, floor - 0.05), (out - 0.018, y, floor - 0.002))
    desk = between((0.01 - x, thick + 0.006 - y, floor - 0.002), (x - 0.01, y, floor + thick))
    corners = np.array([(-y, low), (y, low), (y, roof), (run - y, roof), (-y, floor)])
    made.fix([strip, desk, *_chest(corners, wide, board)], look)
    solid = replace(style, make=dice.pick((fronts.slab, fronts.framed, fronts.raised)))
    dip = thick * np.sin(lean)
    start, face = floor + dip + 0.002, (tall - board) / np.cos(lean) - 0.012 - 2 * dip
    front = Face(0, face / 2, wide - 2 * board - 0.006, face, thick)
    shown = _front(solid, front, dice.pick(("handle", "handle", "slot")), dice.between(0.36, 0.42))
    flap = Leaf("flap", "flap", tuple(shown), hinge((0, 0, 0), (1, 0, 0), np.pi / 2 + lean))
    made.add(flap.turned(rotation((1, 0, 0), -lean)).moved((0, -y, start)))
    near = run - y + 0.03 + thick
    nest = Opening(board - x, x - board, floor + thick, roof - board, near, y - near - board - 0.004)
    for one in _cells(made, dice, nest, (dice.whole(2, 4), dice.whole(1, 3)), 0.008, look):
        if dice.chance(0.6):
            made.add(leaves.drawer(dice, style.inside(), one, "inner_drawer"))
    return made.bodies()


def _parts_rack(dice: Dice) -> Sequence[Body]:
    """Small bins in rows on a wall: drawers that slide, bins that tip, or both; mostly clear."""
    up, across, board = dice.whole(2, 8), dice.pick((dice.whole(2, 4), dice.whole(4, 8))), 0.004
    size = (across * dice.between(0.06, 0.16), dice.between(0.08, 0.22), up * dice.between(0.05, 0.13))
    look = dice.pick((looks.plastic(dice), looks.painted_metal(dice), looks.wood(dice)))
    clear, made = Look("plastic", (200, 215, 220)), Assembly("body")
    front = dice.pick((clear, clear, looks.plastic(dice), looks.darker(look)))
    small = replace(_style(dice, look), make=fronts.slab, thick=0.003, gap=0.002, look=front, inner=front)
    style = replace(small, long=0.03, lift=dice.pick((0.0, -0.003)), grip=dice.pick((front, small.grip)))
    room = carcass(made, dice, size, board, look)
    tips, mode = dice.pick(((1, 1), (0, 0), (1, 0))), dice.pick(("handle", "handle", "slot"))
    for k, row in enumerate(rows(made, room, even_or_random(dice, up), board, look)):
        for one in columns(made, row, [1.0] * dice.whole(max(2, across - 1), across), board, look):
            made.add(_tip(dice, style, one, mode, "tub") if tips[k % 2] else _drawer(made, dice, style, one))
    return made.bodies()


CATEGORIES: tuple[Category, ...] = (
    Category("tilt_bin_cabinet", _tilt_bin_cabinet),
    Category("bread_bin", _bread_bin),
    Category("bureau", _bureau),
    Category("storage_bench", until_moving(_storage_bench)),
    Category("flap_cabinet", until_moving(_flap_cabinet)),
    Category("parts_rack", _parts_rack),
)
