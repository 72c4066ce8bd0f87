"""A stage in the making, whose opinions are sorted into layers while they are written."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal, get_args

if TYPE_CHECKING:
    from pxr import Sdf, Usd

Role = Literal["base", "newton", "mujoco", "physics", "materials", "instances", "geometries"]
"""What a layer holds, strongest first: bodies, a simulator's own attributes, UsdPhysics, looks, which look
and collider is which mesh, and the arrays of the meshes."""


@dataclass(frozen=True)
class Draft:
    """A stage in memory.

    Attributes:
        stage: where everything shows, whatever layer it is in.
        layers: where each role is written; roles that are not apart share the root layer with "base".
    """

    stage: Usd.Stage
    layers: Mapping[Role, Sdf.Layer]

    def writing(self, role: Role) -> Usd.EditContext:
        """A context in which the stage writes into the layer of a role."""
        from pxr import Usd

        return Usd.EditContext(self.stage, self.layers[role])


def new_draft(name: str, apart: Collection[Role]) -> Draft:
    """An empty component `/name` in metres and kilograms, Z up; roles in `apart` have layers of their own."""
    from pxr import Kind, Sdf, Usd, UsdGeom

    stage = Usd.Stage.CreateInMemory()
    root = stage.GetRootLayer()
    layers: dict[Role, Sdf.Layer] = dict.fromkeys(get_args(Role), root)
    for role in get_args(Role):
        if role in apart:
            layers[role] = Sdf.Layer.CreateAnonymous(".usda")
            root.subLayerPaths.append(layers[role].identifier)
    for layer in {layer.identifier: layer for layer in layers.values()}.values():
        set_units(layer, name)
    prim = UsdGeom.Xform.Define(stage, f"/{name}").GetPrim()
    Usd.ModelAPI(prim).SetKind(Kind.Tokens.component)
    return Draft(stage, layers)


def set_units(layer: Sdf.Layer, name: str) -> None:
    """Say that a layer is about `/name`, in metres and kilograms, Z up."""
    layer.defaultPrim = name
    for key, value in {"upAxis": "Z", "metersPerUnit": 1.0, "kilogramsPerUnit": 1.0}.items():
        layer.pseudoRoot.SetInfo(key, value)
