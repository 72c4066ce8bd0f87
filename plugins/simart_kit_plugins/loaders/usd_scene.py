"""Which meshes a USD stage shows, and where."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

import numpy as np

from simart_kit.arrays import FloatArray

Place = Callable[[Any], Any]  # prim -> Gf.Matrix4d that takes row vectors from the prim to the world


def shown_meshes(stage: Any, skipped: set[str]) -> Iterator[tuple[Any, FloatArray]]:
    """Each mesh prim that is drawn, as often as it is, with world_from_prim (4, 4).

    Args:
        stage: a Usd.Stage.
        skipped: gets the types of shapes that are drawn but are not meshes.
    """
    from pxr import Usd, UsdGeom

    cache = UsdGeom.XformCache(Usd.TimeCode.EarliestTime())
    for prim, matrix in _below(stage.GetPseudoRoot(), cache.GetLocalToWorldTransform, cache, skipped):
        yield prim, np.array(matrix).T


def _below(root: Any, place: Place, cache: Any, skipped: set[str]) -> Iterator[tuple[Any, Any]]:
    from pxr import Usd, UsdGeom

    walk = iter(Usd.PrimRange(root, Usd.TraverseInstanceProxies()))
    for prim in walk:
        imageable = UsdGeom.Imageable(prim)
        if not imageable:
            continue
        if imageable.GetVisibilityAttr().Get(cache.GetTime()) == UsdGeom.Tokens.invisible:
            walk.PruneChildren()
        elif prim.IsA(UsdGeom.PointInstancer):
            walk.PruneChildren()  # prototypes that stand below it are drawn only as instances
            yield from _instances(UsdGeom.PointInstancer(prim), place, cache, skipped)
        elif imageable.ComputePurpose() in (UsdGeom.Tokens.guide, UsdGeom.Tokens.proxy):
            continue
        elif prim.IsA(UsdGeom.Mesh):
            yield prim, place(prim)
        elif prim.IsA(UsdGeom.Gprim):
            skipped.add(prim.GetTypeName())


def _instances(instancer: Any, place: Place, cache: Any, skipped: set[str]) -> Iterator[tuple[Any, Any]]:
    stage, time = instancer.GetPrim().GetStage(), cache.GetTime()
    prototypes = [stage.GetPrimAtPath(p) for p in instancer.GetPrototypesRel().GetForwardedTargets()]
    chosen = instancer.GetProtoIndicesAttr().Get(time) or []
    keep = instancer.ComputeMaskAtTime(time) or [True] * len(chosen)
    matrices = instancer.ComputeInstanceTransformsAtTime(
        time, time, instancer.IncludeProtoXform, instancer.IgnoreMask
    )
    base = place(instancer.GetPrim())
    for index, shown, matrix in zip(chosen, keep, matrices, strict=True):
        prototype = prototypes[index]

        def from_prototype(prim: Any, top: Any = prototype, matrix: Any = matrix * base) -> Any:
            return cache.ComputeRelativeTransform(prim, top)[0] * matrix

        if shown:
            yield from _below(prototype, from_prototype, cache, skipped)
