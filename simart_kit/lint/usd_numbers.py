"""NaN and infinity in what a USD file says; fallbacks of schemas, many of them infinite, do not count."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from .findings import Finding
from .usd_scene import UsdScene, stated

if TYPE_CHECKING:
    from pxr import Usd

# How the scalar types of floating-point values are named.
_FLOATING = (
    "float",
    "double",
    "half",
    "color",
    "point",
    "normal",
    "vector",
    "matrix",
    "quat",
    "texCoord",
    "frame",
)
_ALWAYS_FINITE = ("physics:mass", "physics:density")


def type_findings(scene: UsdScene) -> Iterator[Finding]:
    """Attributes that are authored with another type than that of their schema."""
    for prim in scene.prims:
        for attribute in prim.GetAuthoredAttributes():
            wanted = attribute.GetTypeName()
            given = {spec.typeName for spec in attribute.GetPropertyStack()}
            # Roles may differ, such as float3 for point3f.
            others = [name for name in given if name.type != wanted.type]
            if others:
                named = ", ".join(str(name) for name in others)
                text = f"{attribute.GetName()} is {wanted}, and is authored as {named}: author it again"
                yield Finding("attribute-type", str(prim.GetPath()), text)


def number_findings(scene: UsdScene) -> Iterator[Finding]:
    """Attributes with a number that is none. Single numbers may be infinite, as limits and forces are."""
    for prim in scene.prims:
        for attribute in prim.GetAuthoredAttributes():
            name = attribute.GetName()
            if _is_broken(name, _numbers(attribute, stated(prim, name))):
                text = f"{name} holds NaN or infinity: write finite numbers"
                yield Finding("number-invalid", str(prim.GetPath()), text)


def _numbers(attribute: Usd.Attribute, value: Any) -> NDArray[Any] | None:
    """The floating-point numbers of a value in any shape; None for other values."""
    if value is None:
        return None
    if hasattr(value, "GetImaginary"):
        value = [value.GetReal(), *value.GetImaginary()]
    elif not str(attribute.GetTypeName().scalarType).startswith(_FLOATING):
        return None
    found = np.asarray(value)
    return found if found.dtype.kind == "f" else None


def _is_broken(name: str, numbers: NDArray[Any] | None) -> bool:
    if numbers is None:
        return False
    if numbers.ndim == 0 and name not in _ALWAYS_FINITE:
        return bool(np.isnan(numbers))
    return not np.isfinite(numbers).all()
