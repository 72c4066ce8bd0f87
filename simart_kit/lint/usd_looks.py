"""USD looks: bindings of materials, and normal maps."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from .findings import Finding
from .usd_scene import UsdScene, stated

if TYPE_CHECKING:
    from pxr import Usd

_BINDING = "material:binding"
_EIGHT_BIT = (".png", ".jpg", ".jpeg", ".tga", ".bmp")
_SCALE, _BIAS = (2.0, 2.0, 2.0), (-1.0, -1.0, -1.0)


def look_findings(scene: UsdScene) -> Iterator[Finding]:
    """Breaches by bindings and by shaders."""
    for prim in scene.prims:
        yield from _binding_findings(scene, prim)
        if prim.GetTypeName() == "Shader" and stated(prim, "info:id") == "UsdPreviewSurface":
            yield from _normal_findings(prim)


def _binding_findings(scene: UsdScene, prim: Usd.Prim) -> Iterator[Finding]:
    from pxr import UsdShade

    where = str(prim.GetPath())
    bindings = [r for r in prim.GetAuthoredRelationships() if _is_direct(r.GetName())]
    if bindings and not prim.HasAPI(UsdShade.MaterialBindingAPI):
        text = "it binds a material and has no MaterialBindingAPI: apply it"
        yield Finding("binding-api-missing", where, text)
    for path in [path for relationship in bindings for path in relationship.GetTargets()]:
        if not scene.stage.GetPrimAtPath(path):
            yield Finding(
                "binding-target-missing", where, f"material {path} does not exist: name one that does"
            )


def _is_direct(name: str) -> bool:
    """Whether a relationship binds a material, not a collection."""
    return name == _BINDING or (
        name.startswith(f"{_BINDING}:") and not name.startswith(f"{_BINDING}:collection")
    )


def _normal_findings(shader: Usd.Prim) -> Iterator[Finding]:
    from pxr import UsdShade

    port = UsdShade.Shader(shader).GetInput("normal")
    sources = port.GetConnectedSources()[0] if port else []
    for source in sources:
        texture = source.source.GetPrim()
        if stated(texture, "info:id") != "UsdUVTexture":
            continue
        where, space = str(texture.GetPath()), stated(texture, "inputs:sourceColorSpace") or "auto"
        if space != "raw":
            text = f"a normal map is read as '{space}': set sourceColorSpace to raw"
            yield Finding("normal-map", where, text)
        elif not _is_spread(texture):
            text = "a normal map of 8 bits needs scale (2, 2, 2, 1) and bias (-1, -1, -1, 0): set them"
            yield Finding("normal-map", where, text)


def _is_spread(texture: Usd.Prim) -> bool:
    """Whether 0..1 of an 8-bit image becomes -1..1; the sign of y differs between conventions."""
    file = stated(texture, "inputs:file")
    if file is None or not file.path.lower().endswith(_EIGHT_BIT):
        return True
    scale, bias = (stated(texture, f"inputs:{name}") for name in ("scale", "bias"))
    if scale is None or bias is None:
        return False
    return bool(np.allclose(np.abs(scale[:3]), _SCALE) and np.allclose(np.abs(bias[:3]), np.abs(_BIAS)))
