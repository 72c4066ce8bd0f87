"""USD stages: axes, units, and what stands for the file."""

from __future__ import annotations

from collections.abc import Iterator

from .findings import Finding
from .usd_scene import UsdScene, stated


def stage_findings(scene: UsdScene, physical: bool) -> Iterator[Finding]:
    """Breaches by metadata of the stage; a stage that is not `physical` is one for AR."""
    if not scene.stage.HasDefaultPrim():
        yield Finding("default-prim-missing", "", "set defaultPrim to the root prim")
    yield from _axis_findings(scene, "Z" if physical else "Y")
    yield from _unit_findings(scene, physical)
    if physical:
        yield from _kilogram_findings(scene)
        yield from _gravity_findings(scene)


def _axis_findings(scene: UsdScene, wanted: str) -> Iterator[Finding]:
    from pxr import UsdGeom

    found = UsdGeom.GetStageUpAxis(scene.stage)
    if not scene.stage.HasAuthoredMetadata(UsdGeom.Tokens.upAxis):
        yield Finding("up-axis-missing", "", f"upAxis is not set: set it to {wanted}")
    elif found != wanted:
        yield Finding("up-axis", "", f"upAxis is {found}: turn the asset and set {wanted}")


def _unit_findings(scene: UsdScene, physical: bool) -> Iterator[Finding]:
    from pxr import UsdGeom

    if not scene.stage.HasAuthoredMetadata(UsdGeom.Tokens.metersPerUnit):
        yield Finding("units-missing", "", "metersPerUnit is not set: set it to 1 and write metres")
    elif physical and not UsdGeom.LinearUnitsAre(scene.metres, 1.0):
        yield Finding("units", "", f"metersPerUnit is {scene.metres:g}: write metres and set 1")


def _kilogram_findings(scene: UsdScene) -> Iterator[Finding]:
    from pxr import UsdPhysics

    kilograms = UsdPhysics.GetStageKilogramsPerUnit(scene.stage)
    if not scene.stage.HasAuthoredMetadata(UsdPhysics.Tokens.kilogramsPerUnit):
        yield Finding("kilograms-missing", "", "kilogramsPerUnit is not set: set it to 1")
    elif not UsdPhysics.MassUnitsAre(kilograms, 1.0):
        yield Finding("kilograms", "", f"kilogramsPerUnit is {kilograms:g}: write kilograms and set 1")


def _gravity_findings(scene: UsdScene) -> Iterator[Finding]:
    for prim in scene.prims:
        if prim.GetTypeName() != "PhysicsScene":
            continue
        names = ("gravityDirection", "gravityMagnitude")
        lacking = [name for name in names if stated(prim, f"physics:{name}") is None]
        if lacking:
            text = f"it has no {' and no '.join(lacking)}: set them, or leave the scene to the user"
            yield Finding("scene-gravity", str(prim.GetPath()), text)
