"""Which family an object is of, and how it lies in space."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from simart_kit.arrays import FloatArray

from .abstract import composition
from .appliances import appliance
from .cases import MOST_PARTS, case
from .containers import container
from .devices import device
from .dice import Dice
from .fixtures import fixture
from .furniture import cart, seat, table
from .openings import opening
from .placing import rotation
from .primitives import Pieces
from .turned import turned_object

Family = Callable[[Dice], list[Pieces]]

FAMILIES: dict[str, tuple[float, Family]] = {
    "case": (0.26, case),
    "appliance": (0.12, appliance),
    "table": (0.08, table),
    "seat": (0.08, seat),
    "cart": (0.02, cart),
    "opening": (0.05, opening),
    "container": (0.09, container),
    "device": (0.06, device),
    "turned": (0.04, turned_object),
    "fixture": (0.04, fixture),
    "composition": (0.16, composition),
}
"""Share of the objects, and what makes one."""

_TILTED, _YAWED, _STRETCHED = 0.05, 0.12, 0.4


def procedural_object(seed: int | Sequence[int]) -> tuple[FloatArray, ...]:
    """The parts of an object that depends on its seed only.

    Returns:
        1 to 12 parts, each (F, 3, 3) triangles; no unit, up is +Z, mostly along the axes.
    """
    return _placed(Dice(seed), FAMILIES[family(seed)][1])


def family(seed: int | Sequence[int]) -> str:
    """The name of the family that an object is of."""
    return Dice(seed).weighted([(share, name) for name, (share, _) in FAMILIES.items()])


def _placed(dice: Dice, make: Family) -> tuple[FloatArray, ...]:
    dice.unit()
    pose = _pose(dice)
    parts = [np.concatenate(pieces) for pieces in make(dice) if pieces]
    kept = parts[: MOST_PARTS - 1] + [np.concatenate(rest) for rest in [parts[MOST_PARTS - 1 :]] if rest]
    return tuple(part @ pose.T for part in kept)


def _pose(dice: Dice) -> FloatArray:
    """(3, 3) scales along the axes and a turn: mostly by quarters about z, sometimes free."""
    scale = np.diag(0.7 + 0.7 * dice.units(3) if dice.chance(_STRETCHED) else np.ones(3))
    style = dice.unit()
    if style < _TILTED:
        return rotation(dice.normals(3), dice.between(0, 2 * np.pi)) @ scale
    if style < _TILTED + _YAWED:
        return rotation((0, 0, 1), dice.between(0, 2 * np.pi)) @ scale
    quarters = np.round(rotation((0, 0, 1), dice.whole(0, 3) * np.pi / 2))
    mirror = np.diag([dice.sign(), 1.0, 1.0])
    return quarters @ mirror @ scale
