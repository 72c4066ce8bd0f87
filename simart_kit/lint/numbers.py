"""Rules on mass, inertia, limits and signs that all formats share.

NaN passes all of them: comparisons with it are false, and `number-invalid` tells of it.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping

import numpy as np

from ..arrays import FloatArray
from .findings import Finding

# Moments of a thin sheet have a + b = c, which rounding to single precision may break by a little.
_ROUNDING = 1e-4
# A solid cube has 0.22; the least of real bodies are heavy cores in wide shells.
_LEAST_SPREAD = 1e-4


def mass_findings(where: str, mass: float) -> Iterator[Finding]:
    """Breaches by a mass [kg]."""
    if mass <= 0:
        yield Finding("mass-not-positive", where, f"mass {mass:g} should be above 0: state the true one")


def inertia_findings(where: str, moments: FloatArray) -> Iterator[Finding]:
    """Breaches by (3,) principal moments [kg*m^2]."""
    low, middle, high = np.sort(moments)
    shown = f"principal moments {low:.4g} {middle:.4g} {high:.4g}"
    if low <= 0:
        yield Finding("inertia-not-positive", where, f"{shown} should all be above 0: state the true inertia")
    elif low + middle < high * (1 - _ROUNDING):
        yield Finding(
            "inertia-triangle", where, f"{shown}: the two least should add up to the largest one or more"
        )


def spread_findings(
    where: str, mass: float, moments: FloatArray, center: FloatArray, bounds: FloatArray
) -> Iterator[Finding]:
    """Breaches by mass properties within a body's bounds.

    Args:
        where: the body.
        mass: above 0 [kg].
        moments: (3,) principal moments [kg*m^2].
        center: (3,) centre of mass [m].
        bounds: (2, 3) lower and upper corner of the body, in the frame of `center` [m].
    """
    size = float(np.linalg.norm(bounds[1] - bounds[0]))
    outside = np.maximum(bounds[0] - center, center - bounds[1]).max()
    if outside > 0.05 * size:
        yield Finding(
            "com-outside",
            where,
            f"the centre of mass is {outside:.3g} outside the shape: check its frame and unit",
        )
        return
    reach = float(np.linalg.norm(np.maximum(np.abs(bounds[0] - center), np.abs(bounds[1] - center))))
    if mass <= 0 or reach <= 0 or not math.isfinite(mass):
        return
    share = float(moments.max()) / (mass * reach**2)
    if share > 1 + _ROUNDING or share < _LEAST_SPREAD:
        yield Finding(
            "inertia-implausible",
            where,
            f"inertia is {share:.3g} times that of all mass at the farthest corner: check its unit",
        )


def limit_findings(where: str, lower: float, upper: float, rest: float = 0.0) -> Iterator[Finding]:
    """Breaches by the limits of a joint that is at position `rest` in the file's pose, in one unit."""
    shown = f"limits {lower:g} to {upper:g}"
    if lower > upper:
        yield Finding("limits-reversed", where, f"{shown} are reversed: swap them")
    elif lower == upper:
        yield Finding("limits-empty", where, f"{shown} leave no way to go: make the joint fixed")
    elif rest < lower - 1e-6 or rest > upper + 1e-6:
        yield Finding("limits-rest", where, f"{shown} do not include the rest position {rest:g}: shift them")


def sign_findings(rule: str, where: str, values: Mapping[str, float]) -> Iterator[Finding]:
    """A breach of `rule` for each named value below 0."""
    for name, value in values.items():
        if value < 0:
            yield Finding(rule, where, f"{name} {value:g} should be 0 or more")


def restitution_findings(where: str, value: float) -> Iterator[Finding]:
    """Breaches by a restitution."""
    if value < 0 or value > 1:
        yield Finding("restitution-range", where, f"restitution {value:g} should be in 0..1")
