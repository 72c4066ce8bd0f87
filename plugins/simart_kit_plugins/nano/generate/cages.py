"""Things whose leaves are bars, wires or slats: cribs, cages, roll containers, turnstiles, shutters."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import ArrayLike

from simart_kit.arrays import FloatArray

from ...shapes.dice import Dice
from ...shapes.fronts import frame
from ...shapes.placing import around, at, corners, moved, rotation, turned
from ...shapes.primitives import Pieces, box, boxes, cylinder, open_box, rod, tube
from . import fitted_leaves, fitted_mechanisms, fittings, looks
from .assembling import Assembly, disc, holder, pull, shell
from .category import Category
from .fittings import sleeve_of
from .objects import Body, Look, hinge, slide, spin

Rect = tuple[float, float, float, float]  # from and to along x, from and to along z [m]
_GAP, _UP = 0.003, np.array([0.0, 0, 1])
_AXES = {"left": (0, 0, -1), "right": (0, 0, 1), "low": (1, 0, 0), "high": (-1, 0, 0)}
_ROOF = rotation((1, 0, 0), -np.pi / 2)  # what faces the front faces up, its upper edge at the back
_TURNS = [rotation(_UP, k * np.pi / 2) for k in range(4)]


@dataclass(frozen=True)
class _Grille:
    """How leaves are made up; `cross` bars run across the others, `whole` ones are of one piece."""

    fill: str
    pitch: float
    bar: float
    rim: float
    cross: int
    round: bool
    whole: bool
    deep: float


def _grille(dice: Dice, fills: str, pitch: tuple[float, float], bar: float, rim: float) -> _Grille:
    step = dice.spread(*pitch)
    thick, cross = min(bar * dice.spread(0.5, 2), 0.6 * step), dice.pick((0, 0, 1, 2))
    fill, edge, bent = dice.pick(fills.split()), max(rim * dice.spread(0.6, 1.7), thick), dice.chance(0.5)
    return _Grille(fill, step, thick, edge, cross, bent, dice.chance(0.3), edge * (1.0 if bent else 0.7))


def _panel(make: _Grille, rect: Rect) -> Pieces:
    """A leaf about the plane y = 0."""
    x0, x1, z0, z1 = rect
    wide, high, half = x1 - x0, z1 - z0, make.deep / 2
    rim, middle = min(make.rim, 0.25 * wide, 0.25 * high), np.array([x0 + x1, 0, z0 + z1]) / 2
    if make.fill == "boards":
        count = max(2, round(wide / make.pitch))
        spots = middle + np.outer((np.arange(count) + 0.5) / count - 0.5, [wide, 0, 0]) - [0, half / 2, 0]
        rails = boxes((0.97 * wide, half, 1.5 * rim), [middle + [0, half / 2, s * high / 3] for s in (-1, 1)])
        return [*at(box((0.95 * wide / count, half, high)), spots), rails]
    if make.fill == "sheet" and make.whole:
        return [box((wide, make.deep, high), middle)]
    across, up = (max(0, round(long / make.pitch) - 1) for long in (wide, high))
    across = across if make.fill in ("bars", "grid") else make.cross * (make.fill == "rails")
    up = up if make.fill in ("rails", "grid") else make.cross * (make.fill == "bars")
    xs, zs = np.linspace(x0 + rim, x1 - rim, across + 2), np.linspace(z0 + rim, z1 - rim, up + 2)
    if make.whole and make.fill != "empty" and across * up < 150:
        return [_cut(make, (x0, *xs, x1), (z0, *zs, z1))]
    pieces: Pieces = [box((wide - rim, 0.4 * make.deep, high - rim), middle)] if make.fill == "sheet" else []
    for axis, long, ends, lines in ((2, high, (x0, x1), xs[1:-1]), (0, wide, (z0, z1), zs[1:-1])):
        for k, line in enumerate([ends[0] + rim / 2, ends[1] - rim / 2, *lines]):
            thick, off = (rim, 0.0) if k < 2 else (make.bar, 0.9 * make.bar * make.round * (axis == 0))
            spot = np.array([line, off, middle[2]] if axis else [middle[0], off, line])
            step = np.eye(3)[axis] * (long - rim * (1 if make.round or k > 1 else 2 - axis)) / 2
            flat = make.deep / min(k // 2 + 1, 2) if not make.round else thick
            if make.round and (k < 2 or len(lines) < 15):
                pieces.append(rod(spot - step, spot + step, thick / 2, 8))
            else:
                pieces.append(box(np.where(step > 0, 2 * step, (thick, flat, thick)), spot))
    return pieces


def _cut(make: _Grille, *lines: tuple[float, ...]) -> FloatArray:
    """A sheet with holes, all of one piece, from edge, inner edge and bars along x and along z."""
    half = make.bar / 2 * np.array([-1, 1])
    xs, zs = (np.array([*one[:2], *np.add.outer(one[2:-2], half).ravel(), *one[-2:]]) for one in lines)
    solid = (np.arange(len(xs) - 1) % 2 == 0)[:, None] | (np.arange(len(zs) - 1) % 2 == 0)
    pad, keep = np.pad(solid, 1), np.ones((*solid.shape, 3, 2), dtype=bool)
    keep[..., 0, 0], keep[..., 0, 1] = ~pad[:-2, 1:-1], ~pad[2:, 1:-1]
    keep[..., 2, 0], keep[..., 2, 1] = ~pad[1:-1, :-2], ~pad[1:-1, 2:]
    i, j = np.nonzero(solid)
    low, high = (np.column_stack([xs[i + n], 0 * i + (n - 0.5) * make.deep, zs[j + n]]) for n in (0, 1))
    faces = boxes(high - low, (low + high) / 2).reshape(-1, 3, 2, 2, 3, 3)
    return np.asarray(np.round(faces[keep[i, j]].reshape(-1, 3, 3), 9))


@dataclass
class _Work:
    """Walls and leaves alike, put on an assembly: looks of leaves, of hinges and latches, of grips."""

    dice: Dice
    make: _Grille
    coats: tuple[Look, Look, Look]
    kit: Assembly = field(default_factory=Assembly)

    def hang(self, rect: Rect, edge: str, upper: float, label: str, parent: int = 0) -> int:
        """A leaf with knuckles before an edge, about which it opens to -y; gives its number."""
        x0, x1, z0, z1 = rect
        radius = float(np.clip(0.4 * self.make.deep, 0.0035, 0.014))
        y, along = -self.make.deep / 2 - 0.6 * radius, np.abs(_AXES[edge])
        start = np.array([x1 if edge == "right" else x0, y, z1 if edge == "high" else z0])
        long = float(along @ [x1 - x0, 0, z1 - z0])
        mine, others, own = [], [], along * min(4 * radius, 0.06 * long)
        for share in (0.15, 0.85) if long < 0.8 else (0.1, 0.5, 0.9):
            spot = start + along * long * share
            mine.append(rod(spot - own, spot + own, radius, 8))
            others += [rod(spot + s * 1.1 * own, spot + s * 2.2 * own, radius, 8) for s in (-1, 1)]
        self.kit.fix(others, self.coats[1], parent)
        parts = [(_panel(self.make, rect), self.coats[0]), (mine, self.coats[1])]
        return self.kit.add(label, hinge(start, _AXES[edge], upper), parts, parent)

    def latch(self, leaf: int, spot: FloatArray, way: FloatArray, reach: float, turns: bool) -> None:
        """On a leaf's front: a bar that turns, or a bolt in guides, pointing along x or z."""
        turn, look = rotation((0, 1, 0), float(np.arctan2(-way[2], way[0]))), self.coats[1]
        if not turns:
            bolt = fitted_leaves.bolt(self.dice, fittings.Room(1.4 * reach, 1.1 * reach, look, look, look))
            self.kit.graft(bolt, spot, turn, leaf)
            return
        thick = reach * self.dice.between(0.05, 0.08)
        self.kit.fix(moved([disc(2.2 * thick, 1.4 * thick, 10)], spot), look, leaf)
        bar = [rod((0, -1.5 * thick, 0), (0, -3.2 * thick, 0), 1.4 * thick, 10)]
        bar.append(box((0.85 * reach, thick, 2 * thick), (0.25 * reach, -2.3 * thick, 0)))
        self.kit.add("latch", hinge(spot, (0, -1, 0), 1.5), [(moved(turned(bar, turn), spot), look)], leaf)

    def fill(self, rect: Rect, kind: str, label: str) -> list[tuple[int, Rect]]:
        """What fills an opening, hinged at an edge or as named here; numbers and rooms of its leaves."""
        x0, x1, z0, z1 = rect
        if kind == "fixed":
            self.kit.fix(_panel(self.make, rect), self.coats[0])
            return []
        if kind.startswith("in "):  # a smaller opening in a wall
            a, b = (s * x1 * self.dice.between(0.2, 0.9) for s in (-1, 1))
            c, d = z1 * self.dice.between(0.08, 0.25), z1 * self.dice.between(0.5, 0.9)
            for side in ((x0, a, z0, z1), (b, x1, z0, z1), (a, b, z0, c), (a, b, d, z1)):
                self.fill(side, "fixed", "")
            return self.fill((a + _GAP, b - _GAP, c + _GAP, d - _GAP), kind[3:], label)
        if kind in ("up", "down"):
            return [(self.slider(rect, kind, label), rect)]
        x, z = (x0 + x1) / 2, z0 + (z1 - z0) * self.dice.between(0.35, 0.6)
        edge, split = self.dice.pick(("left", "right")), x0 + (x1 - x0) * self.dice.between(0.4, 0.65)
        left, right = (x0, x - _GAP, z0, z1), (x + _GAP, x1, z0, z1)
        leaves: list[tuple[Rect, str]] = {
            "pair": [(left, "left"), (right, "right")],
            "bifold": [(left, "left"), (right, "left")],
            "halves": [((x0, x1, z0, z - _GAP), edge), ((x0, x1, z + _GAP, z1), edge)],
            "fold": [((x0, x1, z, z1), "low")],
            "part": [((x0, split - _GAP, z0, z1), "left")],
        }.get(kind, [(rect, kind)])
        if kind in ("fold", "part"):
            rest = (x0, x1, z0, z - _GAP) if kind == "fold" else (split + _GAP, x1, z0, z1)
            self.fill(rest, "fixed", "")
        upper, reach, state = self.dice.between(1.4, 2.9), self.dice.between(0.05, 0.16), self.dice.unit()
        numbers: list[tuple[int, Rect]] = []
        for k, ((a, b, c, d), edge) in enumerate(leaves):
            parent = numbers[0][0] if kind == "bifold" and k else 0
            number = self.hang((a, b, c, d), edge, upper, label, parent)
            numbers.append((number, (a, b, c, d)))
            if len(leaves) > 1 and k == 0 and kind != "halves":
                continue
            size, way = np.array([b - a, 0, d - c]), np.cross((0, -1.0, 0), _AXES[edge])
            spot = np.array([a + b, -self.make.deep, c + d]) / 2 + way * (size - self.make.rim) / 2
            long = min(reach, 0.35 * size[0], 0.35 * size[2])
            for off in (-0.38, 0.38) if abs(way[2]) and size[0] > 0.7 else (0.4 * state - 0.2,):
                self.latch(number, spot + off * size * (1 - np.abs(way)), way, long, state < 0.5)
        return numbers

    def put(self, to: ArrayLike, turn: FloatArray, make: _Grille, rect: Rect, kind: str, label: str) -> None:
        part = replace(self, make=make, kit=Assembly())
        part.fill(rect, kind, label)
        self.kit.graft(part.kit, to, turn)

    def slider(self, rect: Rect, kind: str, label: str) -> int:
        """A leaf with eyes about two rods, on which it goes up before the wall or down between posts."""
        (x0, x1, z0, z1), rim, rises = rect, self.make.rim, kind == "up"
        y, share = -1.3 * self.make.deep * rises, self.dice.unit()
        travel = (z1 - z0) * (0.6 + 0.25 * share) if rises else 0.14 + 0.08 * share
        low, high = (z0, z1 + travel) if rises else (z0 - travel, z1)
        edges = [(x0 + 0.4 * rim, x0), (x1 - 0.4 * rim, x1)]
        lugs = [((x + end) / 2, y / 2, z) for x, end in edges for z in (low - 0.006, high + 0.006)]
        rods = [rod((x, y, low - 0.01), (x, y, high + 0.01), 0.2 * rim, 8) for x, _ in edges]
        self.kit.fix([*rods, boxes((0.9 * rim, 0.6 * rim - y, 0.5 * rim), lugs)], self.coats[1])
        eye = sleeve_of(0.25 * rim, 0.68 * rim, (0.8 + share) * rim, 12)
        eyes = at(eye, [(x, y, z) for x, _ in edges for z in (z0 + 0.6 * rim, z1 - 2.8 * rim)])
        leaf = moved(_panel(self.make, (x0 + rim, x1 - rim, z0, z1)), (0, y, 0))
        parts = [(leaf, self.coats[0]), (eyes, self.coats[1])]
        return self.kit.add(label, slide(_UP if rises else -_UP, travel), parts)


def _casters(dice: Dice, kit: Assembly, spots: FloatArray, radius: float) -> None:
    grey, seed = looks.metal(dice), dice.whole(0, 2**31)
    for spot in spots:
        yaw = rotation(_UP, dice.between(-1.2, 1.2)) @ rotation((1, 0, 0), np.pi / 2)
        room = fittings.Room(5 * radius, 5 * radius, grey, looks.darker(grey, 0.3), grey)
        kit.graft(fitted_mechanisms.caster(Dice(seed), room), spot, yaw)


def _tray(dice: Dice, work: _Work, size: tuple[float, float, float], label: str, z: float) -> None:
    """A case below a height, and a tray or drawer that slides out of it."""
    (wide, deep, high), wall = size, min(dice.between(0.004, 0.015), 0.15 * size[2])
    work.kit.fix([shell(wide, deep, high, wall) + [0, 0, z - high]], work.coats[0])
    room = (wide - 2 * wall - 0.008, deep - wall - 0.012, (high - 2 * wall) * dice.between(0.5, 0.85))
    lift = z + wall + 0.003 - high
    pieces = [open_box(room, min(0.01, 0.1 * high)) + [0, room[1] / 2 - deep / 2 + 0.001, lift]]
    if dice.chance(0.6):
        pieces.append(box((room[0], 0.008, high - 2 * wall - 0.006), (0, -deep / 2 - 0.004, z - high / 2)))
    grip = moved(holder(dice, wide * dice.between(0.15, 0.5)), (0, -deep / 2 - 0.004, z - high / 2))
    parts = [(pieces, looks.plastic(dice)), (grip, work.coats[2])]
    work.kit.add(label, pull(deep * dice.between(0.6, 0.9)), parts)


def _crib(dice: Dice) -> list[Body]:
    """A bed on posts; a side of it, or two, slides down, falls, folds or has gates."""
    look, make = looks.wood(dice), _grille(dice, "bars bars bars rails boards", (0.055, 0.13), 0.018, 0.035)
    own = look if dice.chance(0.6) else looks.wood(dice)
    work = _Work(dice, make, (own, looks.metal(dice), looks.plastic(dice)), Assembly("bed"))
    kit, long, wide = work.kit, dice.between(0.85, 1.5), dice.between(0.5, 0.8)
    kind = dice.pick(("down", "down", "low", "fold", "part", "pair"))
    drawer, high, post = dice.chance(0.4), dice.between(0.8, 1.1), dice.between(0.03, 0.065)
    low = dice.between(0.25, 0.4) + 0.2 * (drawer and kind == "down")
    kit.fix(at(rod(0 * _UP, _UP * high, 0.6 * post, dice.pick((4, 10))), corners(long, wide)), look)
    ends, foot = replace(make, fill="sheet") if dice.chance(0.4) else make, low * dice.between(0.5, 1.0)
    for turn in _TURNS[1::2]:
        end = (-wide / 2, wide / 2, foot, high * dice.between(0.85, 1.1))
        work.put(turn @ [0, -long / 2, 0], turn, ends, end, "fixed", "")
    kit.fix([box((long, wide - make.deep - 0.03, 0.02), (0, 0, low + 0.03))], look)
    if dice.chance(0.6):
        kit.fix([box((long - post, wide - make.deep - 0.04, 0.08), (0, 0, low + 0.082))], looks.fabric(dice))
    rect, both = (post / 2 + _GAP - long / 2, long / 2 - post / 2 - _GAP, low, high - 0.02), dice.chance(0.25)
    for k, way in ((0, kind), (2, kind if both else "fixed")):
        work.put(_TURNS[k] @ [0, -wide / 2, 0], _TURNS[k], make, rect, way, "side gate")
    if drawer:
        size, z = (long - post, wide - 0.1, 0.4 * low), low + 0.015 - 0.24 * (kind == "down")
        _tray(dice, work, size, "drawer", z)
    if dice.chance(0.4) or not (drawer or both):
        _casters(dice, kit, corners(long, wide), dice.between(0.02, 0.035))
    return kit.done()


def _pet_cage(dice: Dice) -> list[Body]:
    """Walls of wires, bars, boards or sheets with doors and a roof that opens or a vault, over a tray."""
    kind = dice.weighted([(4, "crate"), (3, "hutch"), (2, "carrier"), (3, "bird")])
    own = looks.wood(dice) if kind == "hutch" else looks.painted_metal(dice)
    make = _grille(dice, "bars rails grid", (0.022, 0.06), 0.0035, 0.03 if kind == "hutch" else 0.009)
    work = _Work(dice, make, (own, looks.metal(dice), looks.plastic(dice)), Assembly("cage"))
    scale, kit, tall = 0.6 if kind in ("carrier", "bird") else 1.0, work.kit, dice.between(0.04, 0.1)
    wide, deep = scale * dice.between(0.4, 1.2), scale * dice.between(0.4, 0.75)
    high = dice.between(0.3, 0.6) * (1.5 if kind == "bird" or dice.chance(0.2) else 1.0)
    plank = replace(make, fill="boards", pitch=dice.between(0.06, 0.14))
    solid = {"hutch": plank, "carrier": replace(make, fill="sheet", whole=True)}.get(kind, make)
    _tray(dice, work, (wide + 0.02, deep + 0.02, tall), "tray", 0.0)
    kinds = ("left", "right", "left", "right", "low", "high", "up", "pair")[: 2 if kind == "carrier" else 8]
    for k, turn in enumerate(_TURNS):
        across, away = (wide, deep) if k % 2 == 0 else (deep, wide)
        x, opens = (across - make.deep) / 2, k == 0 or (k != 2 and dice.chance(0.3))
        way, own_make = ("in " + dice.pick(kinds), make) if opens else ("fixed", solid)
        work.put(turn @ [0, -away / 2, 0], turn, own_make, (-x, x, 0, high), way, "door")
    x, whole, top = wide / 2, kind == "hutch" or dice.chance(0.3), high + solid.deep / 2 + _GAP
    if kind == "bird":
        up = np.linspace(0, np.pi, 13)
        rib = np.column_stack([x * np.cos(up), 0 * up, high + wide * dice.between(0.25, 0.7) * np.sin(up)])
        kit.fix([tube(rib + [0, y, 0], make.bar / 2, 5) for y in deep * np.linspace(-0.5, 0.5, 12)], own)
    elif whole:
        work.put((0, -deep / 2, top), _ROOF, solid, (-x - 0.01, x + 0.01, -0.02, deep), "high", "lid")
    else:
        work.put((0, -deep / 2, top), _ROOF, solid, (-x, x, 0, deep), "in high", "flap")
        if dice.chance(0.6):
            bow = fittings.bail(dice, fittings.Room(0.2, 0.15, *work.coats))
            kit.graft(bow, (0, 0.47 * deep, top + solid.deep / 2), _ROOF)
    if dice.chance(0.3):
        _casters(dice, kit, corners(0.85 * wide, 0.8 * deep, -tall), dice.between(0.018, 0.03))
    return kit.done()


def _roll_container(dice: Dice) -> list[Body]:
    """A deck on casters between walls; leaves before them, and shelves that fold."""
    make, coat = _grille(dice, "bars rails grid grid", (0.07, 0.25), 0.01, 0.028), looks.painted_metal(dice)
    work = _Work(dice, make, (coat, looks.metal(dice), looks.plastic(dice)))
    wide, deep, high = dice.between(0.55, 0.95), dice.between(0.55, 1.2), dice.between(0.8, 1.8)
    post, low, back = max(make.rim, dice.between(0.025, 0.045)), dice.between(0.01, 0.08), dice.chance(0.8)
    deck = replace(make, fill=dice.pick(("sheet", "grid", "boards")), rim=max(make.rim, 0.03))
    x, level = wide / 2 - post - _GAP, -0.02 - deck.deep / 2
    work.put((0, -deep / 2, -0.02), _ROOF, deck, (-wide / 2, wide / 2, 0, deep), "fixed", "")
    work.kit.fix(at(rod((0, 0, -0.02), (0, 0, high), post / 2, 10), corners(wide - post, deep - post)), coat)
    _casters(dice, work.kit, corners(wide - 0.15, deep - 0.15, level), dice.between(0.045, 0.08))
    for k, long, away in ((1, deep, wide), (3, deep, wide), (2, wide, deep))[: 2 + back]:
        rect = (0.9 * post - long / 2, long / 2 - 0.9 * post, low, high)
        work.put(_TURNS[k] @ [0, (post - away) / 2, 0], _TURNS[k], make, rect, "fixed", "")
    kind = dice.pick(("left", "right", "pair", "pair", "halves", "fold", "bifold"))
    rect = (-x, x, low, high * dice.pick((1, 1, 0.6)))
    work.put((0, (post - deep) / 2, 0), np.eye(3), make, rect, kind, "gate")
    long, y, lies = min(deep - 4 * post, 0.3 * high), deep / 2 - post - 1.5 * make.deep, dice.chance(0.5)
    for share in dice.pick(((), (0.5,), (0.4,), (0.33, 0.66))) if back else ():
        shelf = replace(work, make=replace(make, fill=dice.pick(("sheet", "grid", "rails"))), kit=Assembly())
        shelf.hang((-x, x, 0, long), "high" if lies else "low", 1.5, "shelf")
        work.kit.graft(shelf.kit, (0, y - long * lies, share * high), _ROOF if lies else None)
    return work.kit.done()


def _turnstile(dice: Dice) -> list[Body]:
    """Arms on a housing, wings about a shaft between curved rails, or leaves on posts; a key or a dial."""
    make = _grille(dice, "bars rails sheet rails", (0.08, 0.2), 0.03, 0.035)
    work = _Work(dice, make, (looks.metal(dice), looks.painted_metal(dice), looks.plastic(dice)))
    kind, high, kit = dice.pick(("arms", "wings", "leaves")), dice.between(0.85, 1.1), work.kit
    lane, wide, deep = dice.between(0.55, 0.95), dice.between(0.08, 0.25), dice.between(0.1, 1.2)
    if kind == "wings":
        return _wings(dice, work, lane * 0.9, high * dice.pick((1, 2.1)))
    count, tilt, both = dice.whole(1 + (kind == "leaves"), 3), dice.between(0.75, 0.96), dice.chance(0.5)
    room, radius, pair = fittings.Room(wide / 2, 0.1, *work.coats), dice.between(0.02, 0.04), dice.chance(0.5)
    for k in range(count + (kind == "leaves")):
        x, back = k * (lane + wide), (deep / 2 + 2 * radius + 0.06) * (kind == "leaves")
        if kind == "arms" or not both:
            kit.fix([box((wide, deep, high), (x, back, high / 2))], work.coats[1])
            kit.graft(fittings.knob(dice, room), (x, back - deep / 2, 0.9 * high))
        if kind == "arms":
            pin, turn = np.array([x + wide / 2 + 0.05, 0, high - 0.14]), rotation((0, 1, 0), np.pi / 2 + tilt)
            arm = rod((0, 0, 0), lane * 0.85 * np.array([-np.sin(tilt), 0, np.cos(tilt)]), 0.018, 10)
            rotor = turned([cylinder(0.055, 0.07, 16) + 0.04 * _UP, *around([arm], 3)], turn)
            kit.fix(moved(turned([cylinder(0.075, 0.12, 16) - 0.058 * _UP], turn), pin), work.coats[1])
            kit.add("arm", spin(pin, turn @ _UP), [(moved(rotor, pin), work.coats[0])])
            continue
        post = [rod((x, 0, 0), (x, 0, 1.02 * high), radius, 14), cylinder(3 * radius, 0.03) + [x, 0, 0]]
        kit.fix(post, work.coats[0])
        for side in [one for one in ((1, -1) if pair else (1,)) if 0 <= k + one <= count]:
            reach = (lane + wide) / (2 if pair else 1) - 0.02 - 2 * radius * (not pair)
            leaf = _panel(make, (1.4 * radius, reach, 0.2 * high, 0.95 * high))
            eyes = at(sleeve_of(1.06 * radius, 1.6 * radius, 0.05, 14), np.outer((0.3, 0.8), high * _UP))
            parts = moved(turned([*leaf, *eyes], _TURNS[1 - side]), (x, 0, 0))
            motion = hinge((x, 0, 0), (0, 0, -side), 1.5, -1.5 if both else 0.0)
            kit.add("gate", motion, [(parts, work.coats[0])])
    return kit.done()


def _wings(dice: Dice, work: _Work, radius: float, high: float) -> list[Body]:
    low, kit, (coat, dark, grip) = high * dice.between(0.1, 0.3), work.kit, work.coats
    wing = _panel(work.make, (0.045, radius, low, high * dice.between(0.85, 0.97)))
    rotor = [rod((0, 0, 0.032), (0, 0, high), 0.05, 16), *around(wing, dice.pick((3, 4, 4)), dice.unit())]
    kit.add("rotor", spin((0, 0, 0), _UP), [(rotor, coat)])
    lid = [cylinder(radius + 0.06, 0.05, 24) + _UP * (high + 0.04)] if high > 1.3 else []
    turn, out = np.linspace(-0.8, 0.8, 9) * dice.between(0.8, 1.2), radius + 0.04
    kit.fix([cylinder(0.1, 0.03, 16) + 0.015 * _UP, *lid, box((0.16, 0.2, 1.0), (out + 0.1, 0, 0.5))], dark)
    kit.graft(fittings.knob(dice, fittings.Room(0.1, 0.1, coat, coat, grip)), (out + 0.1, -0.1, 0.9))
    levels = np.linspace(low, high, dice.whole(2, 8))
    for arc in (turn, turn + np.pi):
        ring = out * np.column_stack([np.cos(arc), np.sin(arc), 0 * arc])
        bars = [tube(ring + z * _UP, 0.012) for z in levels]
        kit.fix(bars + [rod(p, p + high * _UP, 0.018, 8) for p in ring[:: dice.pick((1, 2, 4))]], dark)
    return kit.done()


def _shutters(dice: Dice) -> list[Body]:
    """Openings in a wall behind shutters of boards, slats that tilt or not, bars or sheets in frames."""
    fill = dice.pick(("boards", "boards", "sheet", "grid", "rails", "slats", "slats", "tilt", "tilt"))
    make = _grille(dice, fill, (0.06, 0.16), 0.02, 0.05)
    if slats := fill in ("slats", "tilt"):
        make = replace(make, fill="empty", round=False, deep=0.8 * make.rim, rim=min(make.rim, 0.05))
    own = looks.wood(dice) if dice.chance(0.7) else looks.painted_metal(dice)
    work = _Work(dice, make, (own, looks.metal(dice), own), Assembly("frame"))
    count, wide, border = dice.pick((1, 1, 2)), dice.between(0.5, 1.3), dice.between(0.06, 0.4)
    high, thick = dice.between(0.6, 1.1 if fill == "tilt" else 2.2), dice.between(0.08, 0.3)
    kind = dice.pick(("pair", "pair", "pair", "left", "right", "high", "halves", "bifold"))
    stone, rows = looks.ceramic(dice) if dice.chance(0.6) else looks.wood(dice), dice.whole(8, 20)
    for k in range(count):
        one, x = replace(work, kit=Assembly()), wide / 2 - _GAP
        hole = frame(wide + 2 * border, high + 2 * border, thick, border)
        one.kit.fix([hole + [0, thick - make.deep / 2, high / 2]], stone)
        one.kit.fix([box((wide, 0.01, high), (0, 0.8 * thick - make.deep / 2, high / 2))], looks.glass(dice))
        for leaf, rect in one.fill((-x, x, _GAP, high - _GAP), kind, "shutter"):
            if slats:
                _slats(one, leaf, rect, min(rows, 8 // count) if fill == "tilt" else rows, fill == "tilt")
        work.kit.graft(one.kit, (k * (wide + 2 * border), 0, 0))
    return work.kit.done()


def _slats(work: _Work, leaf: int, rect: Rect, count: int, tilts: bool) -> None:
    """Slats between the stiles of a leaf: on pins about which they tilt, or let into them."""
    (x0, x1, z0, z1), rim = rect, work.make.rim
    step, long, lean = (z1 - z0 - 2 * rim) / count, x1 - x0 - 2 * rim, rotation((1, 0, 0), 0.6)
    size = (long - 0.012 if tilts else long + 0.004, 0.2 * work.make.deep, 0.9 * step)
    pin = rod((-long / 2 - 0.006, 0, 0), (long / 2 + 0.006, 0, 0), min(0.004, 0.08 * step), 8)
    for k in range(count):
        spot = np.array([(x0 + x1) / 2, 0, z0 + rim + (k + 0.5) * step])
        slat = moved(turned([box(size), *([pin] if tilts else [])], lean), spot)
        if tilts:
            work.kit.add("slat", hinge(spot, (1, 0, 0), 0.6, -0.6), [(slat, work.coats[0])], leaf)
        else:
            work.kit.fix(slat, work.coats[0], leaf)


_MAKERS = (_crib, _pet_cage, _roll_container, _turnstile, _shutters)
CATEGORIES: tuple[Category, ...] = tuple(Category(one.__name__[1:], one) for one in _MAKERS)
