"""The files that USD layers name: other layers, and textures."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING

from .findings import Finding
from .paths import is_absolute
from .usd_scene import UsdScene, stated

if TYPE_CHECKING:
    from pxr import Sdf, Usd

_BY_SEARCH = ".mdl"  # found by the renderer, in its own library


def layer_findings(path: Path) -> Iterator[Finding]:
    """Breaches by sublayers, references and payloads, and by those of the layers that these name.

    Opens no layer outside the folder of `path`.
    """
    from pxr import Sdf

    waiting, seen = [str(path)], {str(path)}
    while waiting:
        identifier = waiting.pop()
        layer = Sdf.Layer.FindOrOpen(identifier)
        if layer is None:
            yield Finding("unreadable", Path(identifier).name, "it is no USD layer: export it again")
            continue
        for name in layer.GetCompositionAssetDependencies():
            found = _name_finding(name, layer, path.parent, Path(identifier).name)
            target = Sdf.ComputeAssetPathRelativeToLayer(layer, name)
            if found:
                yield found
            elif target not in seen:
                seen.add(target)
                waiting.append(target)


def asset_findings(scene: UsdScene, path: Path) -> Iterator[Finding]:
    """Breaches by attributes that name files, such as textures, of the stage in the file `path`."""
    from pxr import Sdf

    kinds = (Sdf.ValueTypeNames.Asset, Sdf.ValueTypeNames.AssetArray)
    for prim in scene.prims:
        for attribute in prim.GetAuthoredAttributes():
            if attribute.GetTypeName() not in kinds:
                continue
            value = stated(prim, attribute.GetName())
            assets = [] if value is None else [value] if isinstance(value, Sdf.AssetPath) else list(value)
            for asset in assets:
                found = _name_finding(asset.path, _author(attribute), path.parent, str(prim.GetPath()))
                if found:
                    yield found


def _author(attribute: Usd.Attribute) -> Sdf.Layer:
    """The layer that says what an attribute is, from which relative names start."""
    from pxr import Usd

    stack = attribute.GetPropertyStack(Usd.TimeCode.EarliestTime())
    return next(spec.layer for spec in stack if spec.HasDefaultValue() or spec.HasInfo("timeSamples"))


def _name_finding(name: str, layer: Sdf.Layer, root: Path, where: str) -> Finding | None:
    """The breach by a file that a layer names, or None; `root` is the asset's folder."""
    from pxr import Ar, Sdf

    if not name or name.lower().endswith(_BY_SEARCH):
        return None
    if is_absolute(name):
        return Finding(
            "file-absolute", where, f"'{name}' is absolute: copy it into the folder, name it relatively"
        )
    target = Sdf.ComputeAssetPathRelativeToLayer(layer, name)
    if not _is_inside(target, root):
        return Finding("file-escapes", where, f"'{name}' is outside the asset's folder: copy it there")
    if "<UDIM>" in name:
        found = any(Path(target).parent.glob(Path(target).name.replace("<UDIM>", "1[0-9][0-9][0-9]")))
    else:
        found = bool(Ar.GetResolver().Resolve(target))
    if not found:
        return Finding("file-missing", where, f"'{name}' does not exist: add it, or drop what names it")
    return None


def _is_inside(target: str, root: Path) -> bool:
    """Whether a file, or a file of a package, is below the asset's folder and in its package."""
    from pxr import Ar

    inner = ""
    while Ar.IsPackageRelativePath(target):
        target, inner = Ar.SplitPackageRelativePathOuter(target)
        if inner.startswith(("../", "/")):
            return False
    return Path(target).resolve().is_relative_to(root.resolve())
