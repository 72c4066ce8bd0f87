"""A good asset in three formats, and how defects are seeded in its files."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any
from xml.etree import ElementTree
from xml.etree.ElementTree import Element

import numpy as np
from pxr import Sdf, Usd, UsdGeom, UsdPhysics
from simart_kit_exporters.mjcf import Mjcf
from simart_kit_exporters.urdf import Urdf
from simart_kit_exporters.usd import Usd as UsdExporter

from simart_kit.asset import Asset
from simart_kit.lint import RULES, Finding
from simart_kit.stages import Exporter

from .usd_cases import glossy_asset

EXPORTERS: tuple[type[Exporter], ...] = (UsdExporter, Urdf, Mjcf)


def good_asset() -> Asset:
    """The cabinet with textures, a normal map, a door that is revolute and a drawer that slides."""
    return replace(glossy_asset(), name="cabinet")


def export(exporter: type[Exporter], asset: Asset, folder: Path) -> Path:
    """Write an asset into a new folder; returns the main file."""
    folder.mkdir(parents=True)
    return exporter(exporter.Options()).export(asset, folder)


def rules(findings: Iterable[Finding]) -> set[str]:
    """The rules that findings are about."""
    return {finding.rule for finding in findings}


def assert_told(findings: Iterable[Finding], rule: str) -> None:
    """Only this rule is broken, and every finding says so on one line."""
    found = tuple(findings)
    assert rules(found) == {rule}, found
    assert all(finding.text and "\n" not in finding.text for finding in found)


def rules_of(form: str) -> set[str]:
    """All rules on a format."""
    return {name for name, rule in RULES.items() if form in rule.formats}


def seeded_xml(good: Path, name: str, defect: Callable[[Element], object]) -> Path:
    """The good file with a defect, beside it: meshes are found."""
    tree = ElementTree.parse(good)
    defect(tree.getroot())
    path = good.with_name(f"{name}{good.suffix}")
    tree.write(path)
    return path


def set_at(where: str, **attributes: str) -> Callable[[Element], None]:
    """A defect: attributes of the first element at a path."""

    def seed(root: Element) -> None:
        first(root, where).attrib.update(attributes)

    return seed


def unset_at(where: str, *attributes: str) -> Callable[[Element], None]:
    """A defect: attributes of the first element at a path are missing."""

    def seed(root: Element) -> None:
        for name in attributes:
            del first(root, where).attrib[name]

    return seed


def without(where: str, tag: str) -> Callable[[Element], None]:
    """A defect: all elements at a path have lost their children of a tag."""

    def seed(root: Element) -> None:
        for parent in root.findall(where):
            for child in parent.findall(tag):
                parent.remove(child)

    return seed


def with_text(where: str, text: str) -> Callable[[Element], None]:
    """A defect: the first element at a path has one more child."""

    def seed(root: Element) -> None:
        first(root, where).append(ElementTree.fromstring(text))

    return seed


def first(root: Element, where: str) -> Element:
    found = root.find(where)
    assert found is not None, where
    return found


@dataclass(frozen=True)
class SeededStage:
    """A stage to be changed, and its prims by what they are."""

    stage: Usd.Stage

    @property
    def root(self) -> Usd.Prim:
        return self.stage.GetDefaultPrim()

    def body(self, name: str) -> Usd.Prim:
        return next(p for p in self.stage.Traverse() if p.GetName() == name and _is(p, "RigidBodyAPI"))

    def joint(self, kind: str) -> Usd.Prim:
        """The first joint of a kind, such as "Revolute"."""
        return next(p for p in self.stage.Traverse() if p.GetTypeName() == f"Physics{kind}Joint")

    def visual(self, name: str) -> Usd.Prim:
        return next(p for p in self._meshes(name) if not _is(p, "CollisionAPI"))

    def collider(self, name: str) -> Usd.Prim:
        return next(p for p in self._meshes(name) if _is(p, "CollisionAPI"))

    def having(self, schema: str) -> list[Usd.Prim]:
        """The prims with a schema of UsdPhysics."""
        return [p for p in self.stage.Traverse() if _is(p, schema)]

    def shader(self, name: str) -> Usd.Prim:
        """The first prim of a name with an image file."""
        return next(p for p in self.stage.Traverse() if name in p.GetName() and p.HasAttribute("inputs:file"))

    def _meshes(self, name: str) -> list[Usd.Prim]:
        return [p for p in Usd.PrimRange(self.body(name)) if p.IsA(UsdGeom.Mesh)]


def _is(prim: Usd.Prim, schema: str) -> bool:
    return bool(prim.HasAPI(getattr(UsdPhysics, schema)))


def seeded_usd(good: Path, name: str, defect: Callable[[SeededStage], object]) -> Path:
    """The good file with a defect, beside it: textures are found."""
    path = good.with_name(f"{name}{good.suffix}")
    layer = Sdf.Layer.CreateNew(str(path))
    layer.TransferContent(Sdf.Layer.FindOrOpen(str(good)))
    defect(SeededStage(Usd.Stage.Open(layer)))
    layer.Save()
    return path


def put(prim: Usd.Prim, name: str, value: Any) -> None:
    """Set an attribute that exists."""
    attribute = prim.GetAttribute(name)
    assert attribute, name
    assert attribute.Set(value), name


def scaled(prim: Usd.Prim, name: str, factor: float) -> None:
    """Multiply an attribute of numbers."""
    found = prim.GetAttribute(name).Get()
    put(prim, name, type(found)(*(np.array(found, dtype=np.float64) * factor).tolist()))
