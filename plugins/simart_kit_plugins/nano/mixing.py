"""Stored examples made different each time: from another side, in other colours, lessened, in pairs."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from simart_kit.arrays import FloatArray

from .evidence import EXTENTS
from .lessening import few_asked, lessened
from .scene import AREA, COLOR, HALF, MIDDLE, REACH, SPREAD, area_number, area_share
from .store import Stored
from .truth import KINDS
from .turning import turned

_PRISMATIC = KINDS.index("prismatic")
# How often a batch is of pairs of objects, of how many pieces these have at most, and how often one is grey.
_PAIRED, _MOST, _GREY = 0.25, 80, 0.2
_LESSENED = 0.3  # of the objects


def varied(examples: Sequence[Stored], generator: np.random.Generator) -> list[Stored]:
    """The examples of a step; some have less on them, and small ones sometimes another one beside them."""
    some = [filling(lessened(e, generator)) if generator.random() < _LESSENED else e for e in examples]
    some = [few_asked(e, generator) for e in some]
    seen = [
        recolored(turned(e, int(generator.integers(4)), bool(generator.integers(2))), generator) for e in some
    ]
    most = max(len(e.own) for e in examples)
    if len(seen) < 2 or most > _MOST or generator.random() >= _PAIRED:
        return seen
    return [beside(one, other, generator) for one, other in zip(seen, [*seen[1:], seen[0]], strict=True)]


def recolored(e: Stored, generator: np.random.Generator) -> Stored:
    """Colours swapped, stretched and shifted, or all alike."""
    if generator.random() < _GREY:
        mix, shift = np.zeros((3, 3)), np.zeros(3)
    else:
        mix = np.eye(3)[generator.permutation(3)] * generator.uniform(0.4, 1.2)
        shift = generator.normal(0, 0.1, 3)
    own = e.own.copy()
    own[:, COLOR] = own[:, COLOR] @ mix.T + shift
    colors = (e.colors.astype(np.float32) - 0.5) @ mix.T + shift + 0.5
    return replace(e, own=own, colors=colors)


def beside(one: Stored, other: Stored, generator: np.random.Generator) -> Stored:
    """Two objects as one, next to each other or one on top of the other; nothing tells what that is.

    Both bodies stand still. The second is smaller or as large. Pieces of the two count as far apart.
    """
    size = float(np.exp(generator.uniform(np.log(0.3), 0)))
    along = int(generator.integers(3))
    side = 1.0 if along == 2 else float(generator.choice([-1, 1]))
    low, high = _bounds(one)
    its_low, its_high = _bounds(other)
    shift = generator.uniform(-0.2, 0.2, 3)
    shift[2] = low[2] - its_low[2] * size  # both stand on the floor
    shift[along] = (
        high[along] - its_low[along] * size if side > 0 else low[along] - its_high[along] * size
    ) + side * abs(generator.normal(0, 0.03))
    whole_low = np.minimum(low, its_low * size + shift)
    whole_high = np.maximum(high, its_high * size + shift)
    scale, middle = 1 / float((whole_high - whole_low).max()), (whole_low + whole_high) / 2
    total = 1 + size**2
    first = _moved(one, scale, -middle * scale, 1 / total)
    second = _moved(other, size * scale, (shift - middle) * scale, size**2 / total)
    return _joined(first, second)


def filling(e: Stored) -> Stored:
    """The example in the middle of a space whose longest side it fills, as a whole surface."""
    low, high = _bounds(e)
    scale = 1 / float((high - low).max())
    whole = float(area_share(e.own[:, AREA].astype(np.float64)).sum())
    return _moved(e, scale, -(low + high) / 2 * scale, 1 / whole)


def _bounds(e: Stored) -> tuple[FloatArray, FloatArray]:
    middle, half = e.own[:, MIDDLE].astype(np.float64), e.own[:, HALF].astype(np.float64)
    return (middle - half).min(axis=0), (middle + half).max(axis=0)


def _moved(e: Stored, scale: float, shift: FloatArray, share: float) -> Stored:
    """Scaled, then shifted; its surface is this share of the whole."""
    own, numbers, travel = e.own.copy(), e.numbers.copy(), e.travel.copy()
    own[:, MIDDLE] = own[:, MIDDLE] * scale + shift
    for lengths in (HALF, SPREAD):
        own[:, lengths] *= scale
    own[:, AREA] = area_number(area_share(own[:, AREA].astype(np.float64)) * share)
    numbers[:, EXTENTS] *= scale
    travel[e.kind == _PRISMATIC] *= scale
    gap = np.where(e.gap < REACH * 0.99, e.gap * scale, e.gap)
    points = e.points.astype(np.float32) * scale + shift
    return replace(e, points=points, own=own, gap=gap, numbers=numbers, travel=travel)


def _joined(one: Stored, other: Stored) -> Stored:
    pieces, parts = len(one.own), int(max(one.part.max(), one.number.max(initial=0)))
    gap = np.full((pieces + len(other.own),) * 2, REACH, dtype=np.float32)
    gap[:pieces, :pieces], gap[pieces:, pieces:] = one.gap, other.gap
    other = replace(
        other,
        piece=other.piece + pieces,
        part=np.where(other.part > 0, other.part + parts, 0),
        number=other.number + parts,
        parent=np.where(other.parent > 0, other.parent + parts, 0),
    )
    fields = [name for name in vars(one) if name not in ("gap", "category", "size")]
    both = {name: np.concatenate([getattr(one, name), getattr(other, name)]) for name in fields}
    return Stored(**both, gap=gap, category="", size=1.0)
