"""Things that are nothing in particular: bodies of any make with fittings anywhere on them.

What moves, and how, shows in the fitting alone, not in what the thing is: who learns from these learns to
look at hinges, axles, gaps, grips and guides.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ...shapes.dice import Dice
from ...shapes.placing import rotation
from . import fitted_arms, fitted_covers, fitted_leaves, fitted_mechanisms, fittings, looks
from .assembling import Assembly
from .assembly import until_moving
from .category import Category
from .chassis import FRAMES, Site
from .fittings import Fitting, Room
from .objects import Body, Look

NAME = "contraption"
# Bodies at most, the root included.
_MOST = 72

_FITTINGS: Sequence[tuple[float, Fitting]] = (
    (2, fittings.knob),
    (2, fittings.buttons),
    (1, fittings.toggle),
    (1, fittings.crank),
    (1, fittings.rotor),
    (3, fittings.wheel),
    (2, fittings.roller),
    (1, fittings.handwheel),
    (0.7, fittings.turntable),
    (1, fittings.bail),
    (1.5, fitted_arms.flat_lever),
    (3, fitted_arms.lifted_arm),
    (2.5, fitted_arms.standing_arm),
    (1, fitted_arms.jaws),
    (4, fitted_leaves.leaf),
    (1.5, fitted_leaves.pair),
    (2, fitted_leaves.drawer),
    (1.5, fitted_leaves.panel_slide),
    (1.5, fitted_leaves.slider),
    (1.5, fitted_leaves.plunger),
    (1, fitted_leaves.bolt),
    (1.5, fitted_leaves.telescope),
    (1.5, fitted_covers.case_half),
    (1.5, fitted_covers.trailing_flap),
    (2, fitted_covers.pad),
    (1, fitted_covers.screw_cap),
    (1, fitted_covers.clasp),
    (3, fitted_covers.busy_leaf),
    (1.5, fitted_covers.hung_panel),
    (1.5, fitted_mechanisms.caster),
    (1.5, fitted_mechanisms.forked_wheel),
    (1, fitted_mechanisms.key_row),
    (1.5, fitted_mechanisms.pedals),
    (1, fitted_mechanisms.mast),
    (1, fitted_mechanisms.push_pad),
)
# What can hang in an opening, with nothing behind.
_HANGING: Sequence[tuple[float, Fitting]] = (
    (4, fitted_leaves.leaf),
    (2, fitted_leaves.pair),
    (2, fitted_covers.busy_leaf),
    (1, fitted_covers.hung_panel),
    (1, fitted_leaves.panel_slide),
)
# What is as thick as the edge that it is on.
_ON_EDGES: Sequence[tuple[float, Fitting]] = ((1, fitted_covers.trailing_flap),)
# An edge is so many times as wide as high.
_EDGE = 5.0

_Colors = tuple[Look, Look, Look]


def _contraption(dice: Dice) -> Sequence[Body]:
    kit, sites, colors = _begun(dice)
    left = dice.whole(1, 6)
    for group in _cells(dice, sites):
        made = dice.weighted(_fittings(dice, group[0]))
        moves = left > 0 and dice.chance(0.75)
        if not moves and (group[0].open or dice.chance(0.5)):
            continue
        _fit(dice, kit, group, made if moves else fitted_leaves.decoy, colors)
        left -= moves
    return _placed(dice, kit)


def _fittings(dice: Dice, site: Site) -> Sequence[tuple[float, Fitting]]:
    if site.open:
        return _HANGING
    return _ON_EDGES if site.wide > _EDGE * site.high and dice.chance(0.5) else _FITTINGS


def decorated(dice: Dice) -> Sequence[Body]:
    """What a contraption is without all that moves: a body with plates, ribs, handles and blocks on it."""
    kit, sites, colors = _begun(dice)
    for group in _cells(dice, sites):
        if not group[0].open and dice.chance(0.6):
            _fit(dice, kit, group, fitted_leaves.decoy, colors)
    return _placed(dice, kit)[:1]


def _begun(dice: Dice) -> tuple[Assembly, list[Site], _Colors]:
    """The body, where fittings may go, and the looks."""
    kit, size = Assembly(), dice.spread(0.08, 1.8)
    pieces, sites = dice.weighted(FRAMES)(dice)
    colors = _looks(dice)
    kit.fix([size * piece for piece in pieces], colors[0])
    return kit, [site.scaled(size) for site in sites], colors


def _fit(dice: Dice, kit: Assembly, group: Sequence[Site], made: Fitting, colors: _Colors) -> None:
    """The same fitting at each of a few sites, as long as there may be more bodies."""
    quarters, seed = dice.whole(0, 3), dice.whole(0, 2**31)
    for site in group:
        there = site.turned(quarters)
        fitted = made(Dice(seed), Room(there.wide, there.high, *colors))
        if kit.count + fitted.count - 1 > _MOST:
            return
        kit.graft(fitted, there.origin, there.turn)


def _placed(dice: Dice, kit: Assembly) -> Sequence[Body]:
    """The bodies, seen from any side; some lie on their fronts or backs."""
    turn = rotation((0, 0, 1), dice.whole(0, 3) * np.pi / 2)
    if dice.chance(0.15):
        turn = turn @ rotation((1, 0, 0), dice.pick((-1, 1)) * np.pi / 2)
    return kit.done(turn)


def _cells(dice: Dice, sites: list[Site]) -> list[list[Site]]:
    """Groups of sites for one fitting each, in a random order: whole sides, or cells of them."""
    groups = []
    for number in sorted(range(len(sites)), key=lambda _: dice.unit()):
        site = sites[number]
        if site.open:
            groups.append([site])
            continue
        many, most = (dice.whole(2, 6), 12) if dice.chance(0.08) else (1, 4)
        columns, rows = (
            min(most, max(1, round(many * ratio * dice.between(0.5, 1.5))))
            for ratio in (site.wide / site.high, site.high / site.wide)
        )
        cells = site.cells(columns, rows)
        if dice.chance(0.5):
            groups.append(cells)
        else:
            groups += [[cell] for cell in cells]
    return groups


def _looks(dice: Dice) -> _Colors:
    """Of the body, of what moves and of grips; many things are of one colour."""
    make = dice.pick((looks.wood, looks.painted_metal, looks.plastic, looks.metal))
    base = make(dice)
    if dice.chance(0.3):
        return base, base, base
    own = dice.pick((base, looks.darker(base, 0.8), make(dice), looks.plastic(dice)))
    return base, own, dice.pick((own, looks.metal(dice), looks.plastic(dice)))


CATEGORIES = (Category(NAME, until_moving(_contraption)),)
