"""`collision`: convex shapes for every part."""

from __future__ import annotations

from dataclasses import replace
from typing import Literal

import numpy as np
from pydantic import Field

import simart_kit as sk
from simart_kit.asset import ConvexMesh
from simart_kit.decompose import decompose
from simart_kit.hookspecs import Register
from simart_kit.hulls import bounding_box, convex_hull, shrunk


class Collision(sk.Modifier):
    """Give every part convex collision shapes, in the asset frame."""

    name = "collision"

    class Options(sk.Options):
        """How tight and how large the shapes may be."""

        mode: Literal["auto", "hull", "box", "none"] = Field(
            "auto",
            description="auto: one hull, or one a connected piece where a single hull is loose; "
            "hull: one convex hull; box: the bounding box; none: no shape",
        )
        max_shapes: int = Field(32, ge=1, description="most shapes of a part in mode auto")
        max_vertices: int = Field(64, ge=8, description="most vertices of a shape; simulators take 64")
        margin: float = Field(0.0, ge=0, le=0.05, description="shapes are smaller by this on each side [m]")

    options: Options

    def modify(self, asset: sk.Asset) -> sk.Asset:
        """The asset with new collision shapes."""
        changed = {
            part.name: replace(part, collision=self._shapes(asset, index))
            for index, part in enumerate(asset.parts)
        }
        counts = ", ".join(f"{name} {len(part.collision)}" for name, part in changed.items())
        text = f"convex shapes ({self.options.mode}): {counts}"
        return asset.with_parts(changed).with_notes("collision", "info", [text])

    def _shapes(self, asset: sk.Asset, index: int) -> tuple[ConvexMesh, ...]:
        options, vertices = self.options, asset.mesh.vertices
        faces = asset.mesh.faces[asset.face_part == index]
        match options.mode:
            case "none":
                return ()
            case "box":
                shapes: tuple[ConvexMesh, ...] = (bounding_box(vertices[faces.ravel()]),)
            case "hull":
                shapes = (convex_hull(vertices[np.unique(faces)], options.max_vertices),)
            case "auto":
                shapes = decompose(vertices, faces, options.max_shapes, options.max_vertices)
        return tuple(shrunk(shape, options.margin) for shape in shapes) if options.margin else shapes


@sk.hookimpl
def register_modifiers(register: Register) -> None:
    """Register the modifier."""
    register(Collision)
