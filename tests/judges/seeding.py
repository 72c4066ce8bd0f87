"""Defects put into exports on purpose: a judge that does not object to them says nothing by its silence."""

from __future__ import annotations

import shutil
import struct
import zipfile
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from xml.etree import ElementTree
from xml.etree.ElementTree import Element

from pxr import Usd, UsdGeom, UsdPhysics

from simart_kit.asset_io import load_asset

from .panel import Format, file_of

Defect = Callable[[Path], None]
FURTHER = 0.1  # than a limit was [rad | m], or degrees in USD


def seeded(folder: Path, form: Format, defect: str, target: Path) -> Path:
    """Copy an asset's export of one format below `target`, with a defect; returns the copy's folder."""
    copy = target / folder.name
    shutil.rmtree(copy, ignore_errors=True)
    copy.mkdir(parents=True)
    for name in ("asset.json", "parts.npz"):
        shutil.copy(folder / name, copy)
    shutil.copytree(folder / form, copy / form)
    path = file_of(copy, form, load_asset(copy).name)
    assert path is not None
    DEFECTS[form][defect](path)
    return copy


@contextmanager
def _edited(path: Path) -> Iterator[Element]:
    tree = ElementTree.parse(path)
    yield tree.getroot()
    tree.write(path)


def _double(element: Element, key: str) -> None:
    element.set(key, str(2 * float(element.attrib[key])))


def _reversed(axis: str) -> str:
    """The axis the other way."""
    return " ".join(str(-float(value)) for value in axis.split())


def _urdf_mass(path: Path) -> None:
    with _edited(path) as robot:
        _double(next(robot.iter("mass")), "value")


def _urdf_axis(path: Path) -> None:
    with _edited(path) as robot:
        for axis in robot.iter("axis"):
            axis.set("xyz", _reversed(axis.attrib["xyz"]))


def _urdf_collider(path: Path) -> None:
    with _edited(path) as robot:
        link = next(robot.iter("link"))
        link.remove(link.findall("collision")[0])


def _urdf_limit(path: Path) -> None:
    with _edited(path) as robot:
        limit = next(robot.iter("limit"))
        limit.set("upper", str(float(limit.attrib["upper"]) + FURTHER))


def _urdf_parent(path: Path) -> None:
    with _edited(path) as robot:
        next(robot.iter("parent")).set("link", "nothing")


def _mjcf_mass(path: Path) -> None:
    with _edited(path) as model:
        _double(next(model.iter("inertial")), "mass")


def _mjcf_axis(path: Path) -> None:
    with _edited(path) as model:
        for body in model.iter("body"):
            for joint in body.findall("joint"):
                joint.set("axis", _reversed(joint.get("axis", "0 0 1")))


def _mjcf_collider(path: Path) -> None:
    with _edited(path) as model:
        body = next(model.iter("body"))
        body.remove(next(geom for geom in body.findall("geom") if "_collision_" in geom.get("name", "")))


def _mjcf_limit(path: Path) -> None:
    with _edited(path) as model:
        joint = next(joint for joint in model.iter("joint") if joint.get("range"))
        lower, upper = map(float, joint.attrib["range"].split())
        joint.set("range", f"{lower} {upper + FURTHER}")


@contextmanager
def _staged(path: Path) -> Iterator[Usd.Stage]:
    stage = Usd.Stage.Open(str(path))
    yield stage
    stage.GetRootLayer().Save()


def _usd_mass(path: Path) -> None:
    with _staged(path) as stage:
        mass = next(UsdPhysics.MassAPI(p) for p in stage.Traverse() if p.HasAPI(UsdPhysics.MassAPI))
        mass.GetMassAttr().Set(2 * mass.GetMassAttr().Get())


def _usd_axis(path: Path) -> None:
    """Another axis of the same frames."""
    with _staged(path) as stage:
        for prim in stage.Traverse():
            if prim.IsA(UsdPhysics.RevoluteJoint) or prim.IsA(UsdPhysics.PrismaticJoint):
                axis = prim.GetAttribute("physics:axis")
                axis.Set("Y" if axis.Get() != "Y" else "Z")


def _usd_collider(path: Path) -> None:
    with _staged(path) as stage:
        next(p for p in stage.Traverse() if p.HasAPI(UsdPhysics.CollisionAPI)).SetActive(False)


def _usd_limit(path: Path) -> None:
    with _staged(path) as stage:
        limits = (p.GetAttribute("physics:upperLimit") for p in stage.Traverse() if p.IsA(UsdPhysics.Joint))
        limit = next(limit for limit in limits if limit and limit.HasAuthoredValue())
        limit.Set(limit.Get() + FURTHER)


def _usd_unit(path: Path) -> None:
    with _staged(path) as stage:
        stage.ClearMetadata(UsdGeom.Tokens.metersPerUnit)


def _usdz_compressed(path: Path) -> None:
    with zipfile.ZipFile(path) as archive:
        files = {name: archive.read(name) for name in archive.namelist()}
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, data in files.items():
            archive.writestr(name, data)


def _glb_index(path: Path) -> None:
    """A scene that is not there: one digit of the JSON chunk, which keeps its length."""
    data = path.read_bytes()
    (length,) = struct.unpack_from("<I", data, 12)
    json = data[20 : 20 + length]
    assert json.count(b'"scene":0') == 1
    path.write_bytes(data[:20] + json.replace(b'"scene":0', b'"scene":9') + data[20 + length :])


DEFECTS: dict[Format, dict[str, Defect]] = {
    "urdf": {
        "mass": _urdf_mass,
        "axis": _urdf_axis,
        "collider": _urdf_collider,
        "limit": _urdf_limit,
        "parent": _urdf_parent,
    },
    "mjcf": {"mass": _mjcf_mass, "axis": _mjcf_axis, "collider": _mjcf_collider, "limit": _mjcf_limit},
    "usd": {
        "mass": _usd_mass,
        "axis": _usd_axis,
        "collider": _usd_collider,
        "limit": _usd_limit,
        "unit": _usd_unit,
    },
    "usdz": {"compressed": _usdz_compressed},
    "glb": {"index": _glb_index},
}
