"""USD colliders, and the physics materials that they slide on."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from .findings import Finding
from .numbers import restitution_findings, sign_findings
from .usd_scene import UsdScene, body_of, stated

if TYPE_CHECKING:
    from pxr import Usd

_CONCAVE = ("none", "meshSimplification")
_SIZES = ("size", "radius", "height", "width", "length")


def collider_findings(scene: UsdScene) -> Iterator[Finding]:
    """Breaches by what collides, by what does not, and by physics materials."""
    yield from _presence_findings(scene)
    for prim in scene.prims:
        yield from _schema_findings(prim)
        yield from _material_findings(prim)
    for prim in scene.colliders:
        yield from _approximation_findings(prim)
        yield from _size_findings(prim)
        if _is_drawn_bare(prim):
            text = "it is drawn and has no look: set purpose to guide, or bind a material"
            yield Finding("collider-visible", str(prim.GetPath()), text)


def _presence_findings(scene: UsdScene) -> Iterator[Finding]:
    if scene.bodies and not scene.colliders:
        yield Finding("collider-missing", "", "no prim has CollisionAPI: apply it to shapes of the bodies")
        return
    owners = {owner.GetPath() for owner in map(body_of, scene.colliders) if owner}
    for body in scene.bodies:
        if body.GetPath() not in owners and scene.shapes(body):
            text = "nothing of it collides: apply CollisionAPI to a shape"
            yield Finding("body-collider-missing", str(body.GetPath()), text)


def _schema_findings(prim: Usd.Prim) -> Iterator[Finding]:
    from pxr import UsdGeom, UsdPhysics

    where = str(prim.GetPath())
    if prim.HasAPI(UsdPhysics.CollisionAPI) and not prim.IsA(UsdGeom.Gprim):
        text = f"CollisionAPI is for shapes, not for {prim.GetTypeName() or 'a prim without type'}: move it"
        yield Finding("collider-api", where, text)
    if prim.HasAPI(UsdPhysics.MeshCollisionAPI):
        if not prim.IsA(UsdGeom.Mesh):
            yield Finding("collider-api", where, "MeshCollisionAPI is for meshes: remove it")
        elif not prim.HasAPI(UsdPhysics.CollisionAPI):
            yield Finding("collider-api", where, "MeshCollisionAPI needs CollisionAPI too: apply it")


def _approximation_findings(prim: Usd.Prim) -> Iterator[Finding]:
    from pxr import UsdGeom, UsdPhysics

    if not prim.IsA(UsdGeom.Mesh):
        return
    where, known = str(prim.GetPath()), prim.HasAPI(UsdPhysics.MeshCollisionAPI)
    found = stated(prim, "physics:approximation") if known else None
    schema = UsdPhysics.MeshCollisionAPI(prim).GetApproximationAttr().GetMetadata("allowedTokens")
    if found is not None and found not in schema and not _is_sdf(prim, found):
        text = f"approximation '{found}' is not one of {', '.join(schema)}"
        yield Finding("collider-approximation", where, text)
    body = body_of(prim)
    if (found or "none") in _CONCAVE and body and not stated(body, "physics:kinematicEnabled"):
        text = "a moving body needs a convex shape: set approximation to convexHull, or decompose it"
        yield Finding("collider-concave", where, text)


def _is_sdf(prim: Usd.Prim, approximation: str) -> bool:
    """Whether PhysX' own schema explains PhysX' own token."""
    return approximation == "sdf" and any(name.startswith("PhysxSDF") for name in prim.GetAppliedSchemas())


def _size_findings(prim: Usd.Prim) -> Iterator[Finding]:
    sizes = {name: stated(prim, name) for name in _SIZES}
    for name, size in sizes.items():
        if isinstance(size, float) and size <= 0:
            yield Finding("size-not-positive", str(prim.GetPath()), f"{name} {size:g} should be above 0")


def _is_drawn_bare(prim: Usd.Prim) -> bool:
    from pxr import UsdGeom, UsdShade

    shown = UsdGeom.Gprim(prim)
    if not shown or shown.ComputePurpose() in (UsdGeom.Tokens.guide, UsdGeom.Tokens.proxy):
        return False
    if shown.ComputeVisibility() == UsdGeom.Tokens.invisible:
        return False
    look, _ = UsdShade.MaterialBindingAPI(prim).ComputeBoundMaterial()
    return not look and stated(prim, "primvars:displayColor") is None


def _material_findings(prim: Usd.Prim) -> Iterator[Finding]:
    from pxr import UsdPhysics

    if not prim.HasAPI(UsdPhysics.MaterialAPI):
        return
    where, names = str(prim.GetPath()), ("staticFriction", "dynamicFriction", "density")
    signs = {name: stated(prim, f"physics:{name}") for name in names}
    yield from sign_findings("friction-negative", where, {k: v for k, v in signs.items() if v is not None})
    restitution = stated(prim, "physics:restitution")
    if restitution is not None:
        yield from restitution_findings(where, restitution)
