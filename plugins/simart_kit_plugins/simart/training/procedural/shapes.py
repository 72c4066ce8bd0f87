"""Which family an object is of, and how it lies in space."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from simart_kit.arrays import FloatArray

from ....shapes.dice import Dice
from ....shapes.placing import rotation
from ....shapes.primitives import Pieces
from .abstract import composition
from .appliances import appliance
from .cases import MOST_PARTS, case
from .containers import container
from .devices import device
from .fixtures import fixture
from .furniture import cart, seat, table
from .openings import opening
from .turned import turned_object

Family = Callable[[Dice], list[Pieces]]

FAMILIES: dict[str, tuple[float, Family]] = {
    "case": (0.30, case),
    "appliance": (0.16, appliance),
    "table": (0.09, table),
    "seat": (0.08, seat),
    "cart": (0.03, cart),
    "opening": (0.06, opening),
    "container": (0.10, container),
    "device": (0.07, device),
    "turned": (0.05, turned_object),
    "fixture": (0.06, fixture),
}
"""Share of the objects, and what makes one."""

ABSTRACT = "composition"
"""What is no object: heaps of solids, among augmented objects only."""

_STRETCHED = 0.4
# Of augmented objects: turned freely, turned freely about z, and those that are heaps instead.
_TILTED, _YAWED, _HEAPED = 0.04, 0.10, 0.06


def procedural_object(seed: int | Sequence[int], augmented: bool = False) -> tuple[FloatArray, ...]:
    """The parts of an object that depends on its arguments only.

    Args:
        seed: of all choices.
        augmented: for training: some objects are turned freely, and some are heaps of abstract solids.

    Returns:
        1 to 12 parts, each (F, 3, 3) triangles; no unit, up is +Z, turned by quarters about it.
    """
    dice = Dice(seed)
    name = _family(dice, augmented)
    make = composition if name == ABSTRACT else FAMILIES[name][1]
    pose = _pose(dice, augmented)
    parts = [np.concatenate(pieces) for pieces in make(dice) if pieces]
    kept = parts[: MOST_PARTS - 1] + [np.concatenate(rest) for rest in [parts[MOST_PARTS - 1 :]] if rest]
    return tuple(part @ pose.T for part in kept)


def family(seed: int | Sequence[int], augmented: bool = False) -> str:
    """The name of the family that an object is of."""
    return _family(Dice(seed), augmented)


def _family(dice: Dice, augmented: bool) -> str:
    name = dice.weighted([(share, name) for name, (share, _) in FAMILIES.items()])
    return ABSTRACT if augmented and dice.chance(_HEAPED) else name


def _pose(dice: Dice, augmented: bool) -> FloatArray:
    """(3, 3) scales along the axes and a turn: by quarters about z, or free."""
    scale = np.diag(0.7 + 0.7 * dice.units(3) if dice.chance(_STRETCHED) else np.ones(3))
    style = dice.unit() if augmented else 1.0
    if style < _TILTED:
        return rotation(dice.normals(3), dice.between(0, 2 * np.pi)) @ scale
    if style < _TILTED + _YAWED:
        return rotation((0, 0, 1), dice.between(0, 2 * np.pi)) @ scale
    quarters = np.round(rotation((0, 0, 1), dice.whole(0, 3) * np.pi / 2))
    mirror = np.diag([dice.sign(), 1.0, 1.0])
    return quarters @ mirror @ scale
