"""All categories that there are."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import partial

from ...shapes.dice import Dice
from . import (
    aircraft,
    bins,
    cages,
    capped,
    carried,
    carts,
    clocks,
    contact_grills,
    contraptions,
    cooking,
    cookware,
    desks,
    dressers,
    electronics,
    fans_lamps,
    fridges,
    gadgets,
    gates,
    hand_tools,
    heaps,
    heavy_machines,
    hospital_beds,
    instruments,
    keyed,
    kitchens,
    kitchenware,
    laundry,
    levered,
    lidded,
    light_vehicles,
    locks,
    lorries,
    machines,
    microwaves,
    motion_controllers,
    mounted,
    openings,
    pianos,
    play_tables,
    pocket_things,
    presses,
    reclining,
    safes,
    sanitary,
    seats,
    showcases,
    small_appliances,
    static_furniture,
    static_outdoor,
    static_small,
    steered,
    storage,
    strollers,
    switches,
    taps,
    tilting,
    vehicles,
    windows,
    workshop_tools,
)
from .apart import apart
from .category import Category
from .hinges import hinged
from .objects import Body

_MADE: tuple[Category, ...] = (
    *aircraft.CATEGORIES,
    *bins.CATEGORIES,
    *cages.CATEGORIES,
    *capped.CATEGORIES,
    *carried.CATEGORIES,
    *carts.CATEGORIES,
    *clocks.CATEGORIES,
    *contraptions.CATEGORIES,
    *cooking.CATEGORIES,
    *cookware.CATEGORIES,
    *desks.CATEGORIES,
    *dressers.CATEGORIES,
    *electronics.CATEGORIES,
    *fans_lamps.CATEGORIES,
    *fridges.CATEGORIES,
    *gadgets.CATEGORIES,
    *gates.CATEGORIES,
    *hand_tools.CATEGORIES,
    *heaps.CATEGORIES,
    *heavy_machines.CATEGORIES,
    *hospital_beds.CATEGORIES,
    *instruments.CATEGORIES,
    *keyed.CATEGORIES,
    *kitchens.CATEGORIES,
    *kitchenware.CATEGORIES,
    *laundry.CATEGORIES,
    *levered.CATEGORIES,
    *lidded.CATEGORIES,
    *light_vehicles.CATEGORIES,
    *locks.CATEGORIES,
    *lorries.CATEGORIES,
    *machines.CATEGORIES,
    *microwaves.CATEGORIES,
    *motion_controllers.CATEGORIES,
    *mounted.CATEGORIES,
    *contact_grills.CATEGORIES,
    *openings.CATEGORIES,
    *pianos.CATEGORIES,
    *play_tables.CATEGORIES,
    *pocket_things.CATEGORIES,
    *presses.CATEGORIES,
    *reclining.CATEGORIES,
    *safes.CATEGORIES,
    *sanitary.CATEGORIES,
    *seats.CATEGORIES,
    *showcases.CATEGORIES,
    *small_appliances.CATEGORIES,
    *static_furniture.CATEGORIES,
    *static_outdoor.CATEGORIES,
    *static_small.CATEGORIES,
    *steered.CATEGORIES,
    *storage.CATEGORIES,
    *strollers.CATEGORIES,
    *switches.CATEGORIES,
    *taps.CATEGORIES,
    *tilting.CATEGORIES,
    *vehicles.CATEGORIES,
    *windows.CATEGORIES,
    *workshop_tools.CATEGORIES,
)
# What is nothing in particular, of which nobody would say what it is.
NAMELESS = (contraptions.NAME, heaps.NAME)


def _finished(maker: Callable[[Dice], Sequence[Body]], dice: Dice) -> list[Body]:
    """What a maker makes, with hinges, and no two bodies welded together."""
    return apart(hinged(maker, dice))


CATEGORIES: tuple[Category, ...] = tuple(
    replace(made, bodies=partial(_finished, made.bodies)) for made in _MADE
)
