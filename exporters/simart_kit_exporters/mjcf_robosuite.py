"""What robosuite asks of an object around its parts: the body `object`, three sites and a bounding box."""

from __future__ import annotations

from typing import TYPE_CHECKING
from xml.etree import ElementTree
from xml.etree.ElementTree import TreeBuilder, XMLParser

import numpy as np

from simart_kit.arrays import FloatArray
from simart_kit.asset import Asset, unique_names

if TYPE_CHECKING:
    import mujoco

_OBJECT, _MAIN = "object", "main"  # robosuite looks for the one and renames it to the other
_SITE_SIZE = 0.005


def body_names(asset: Asset) -> dict[str, str]:
    """Name of the body of each part: its own, or numbered where robosuite takes it for something else."""
    names = [part.name for part in asset.parts]
    return dict(zip(names, unique_names([_OBJECT, _MAIN, *names])[2:], strict=True))


def add_object(spec: mujoco.MjSpec, asset: Asset) -> mujoco.MjsBody:
    """Add the body `object`, in the asset's frame, to carry the parts, and the marks that go with it."""
    outer = spec.worldbody.add_body()
    lower, upper = asset.mesh.bounds
    radius = float(np.linalg.norm(asset.mesh.vertices[:, :2], axis=1).max())
    # Objects further apart than the sum of their radii cannot touch: robosuite's meaning of the third.
    for name, place in (
        ("bottom_site", [0.0, 0.0, lower[2]]),
        ("top_site", [0.0, 0.0, upper[2]]),
        ("horizontal_radius_site", [radius, radius, 0.0]),
    ):
        outer.add_site(name=name, pos=place, size=[_SITE_SIZE] * 3, rgba=[0.0] * 4)
    body = outer.add_body(name=_OBJECT)
    _add_bounds(spec, body, lower, upper)
    return body


def spelled_out(model: str) -> str:
    """The text of a model with the groups and places that MuJoCo leaves out, and robosuite asks for."""
    parser = XMLParser(target=TreeBuilder(insert_comments=True))
    root = ElementTree.fromstring(model, parser)
    for site in root.iter("site"):
        site.attrib.setdefault("pos", "0 0 0")
    for geom in root.iterfind("default/default/geom"):
        geom.attrib.setdefault("group", "0")
    return ElementTree.tostring(root, encoding="unicode") + "\n"


def _add_bounds(spec: mujoco.MjSpec, body: mujoco.MjsBody, lower: FloatArray, upper: FloatArray) -> None:
    """The asset's bounds at rest as RoboCasa marks them: a box that is neither seen nor felt nor weighed."""
    import mujoco

    region = spec.add_default("region", spec.default)
    region.geom.contype = region.geom.conaffinity = 0
    region.geom.group = 1
    region.geom.mass = 0.0
    region.geom.rgba = [0.0, 1.0, 0.0, 0.0]
    box = body.add_geom(region, name="reg_bbox", type=mujoco.mjtGeom.mjGEOM_BOX)
    box.pos = (lower + upper) / 2
    box.size = np.maximum((upper - lower) / 2, _SITE_SIZE)  # MuJoCo refuses a box without thickness
