"""Shapes of URDF links with their looks: mesh files with materials, and primitives."""

from __future__ import annotations

import os
from dataclasses import fields, replace
from pathlib import Path
from xml.etree.ElementTree import Element

import numpy as np

from simart_kit import BadInputError, Image, Mesh, VisualMaterial
from simart_kit.bench.formats.mesh_files import Triangles
from simart_kit.bench.formats.urdf_shapes import mesh_file, mesh_scale, primitive, shape_of
from simart_kit.bench.formats.urdf_tree import origin
from simart_kit.bench.formats.xml_files import numbers
from simart_kit.srgb import srgb_to_linear

from ..loaders.guards import reading
from ..loaders.materials import PLAIN, Palette
from ..loaders.pieces import Piece
from ..loaders.trimesh_loader import read_mesh


class Looks:
    """Reads the shapes of one URDF; every mesh file, material and picture is kept once.

    A mesh file with several materials, vertex colours or a picture keeps its own looks; all else gets the
    `<material>` of the URDF, where there is one. Its colours are sRGB, as what writes and shows them takes
    them. Mesh files are not turned, whatever axis is up in their format; units that COLLADA and 3MF tell are
    applied. So do the readers of robots.

    Args:
        robot: the root element.
        folder: of the URDF file.

    Attributes:
        warnings: what is left out, a sentence each.
    """

    def __init__(self, robot: Element, folder: Path) -> None:
        self.warnings: list[str] = []
        self._folder = folder
        self._named = {element.get("name", ""): element for element in robot.findall("material")}
        self._palette = Palette()
        self._meshes: dict[Path, Mesh] = {}

    @property
    def materials(self) -> tuple[VisualMaterial, ...]:
        """All of them, by the indices of the pieces."""
        return self._palette.materials

    def pieces(self, link: Element) -> list[Piece]:
        """The visual shapes of a link in its frame; its collision shapes where it has no visual.

        Raises:
            BadInputError: a shape that is unknown or incomplete, or a mesh file that is missing or damaged.
        """
        found = []
        for element in link.findall("visual") or link.findall("collision"):
            shape = shape_of(element)
            if shape.tag == "mesh":
                piece = self._of_mesh(shape, element).moved(mesh_scale(shape))
            else:
                piece = self._of_primitive(primitive(shape), element)
            found.append(piece.moved(origin(element)))
        self.warnings += [text for text in self._palette.warnings if text not in self.warnings]
        return found

    def _of_primitive(self, surface: Triangles, element: Element) -> Piece:
        vertices, faces = surface
        index = self._palette.add(replace(self._stated(element) or PLAIN, base_color_image=None))
        return Piece(vertices, faces, np.full(len(faces), index, dtype=np.int32))

    def _of_mesh(self, shape: Element, element: Element) -> Piece:
        mesh = self._mesh(mesh_file(shape.get("filename", ""), self._folder))
        looks = mesh.materials
        own = len(looks) > 1 or mesh.colors is not None or looks[0].base_color_image is not None
        said = None if own else self._stated(element)
        if said is not None:
            image = None if mesh.uv is None else said.base_color_image
            looks = (replace(looks[0], name=said.name, base_color=said.base_color, base_color_image=image),)
        places = np.array([self._palette.add(self._shared(material)) for material in looks])
        return Piece(
            mesh.vertices * (mesh.metres_per_unit or 1.0),
            mesh.faces,
            places[mesh.face_material],
            mesh.normals,
            mesh.uv,
            mesh.colors,
        )

    def _mesh(self, path: Path) -> Mesh:
        if path not in self._meshes:
            if not path.is_file():
                raise BadInputError(f"no such mesh file: {path}")
            mesh = read_mesh(path, _around(path, self._folder))
            if mesh is None:
                raise BadInputError(
                    f"{path}: no mesh file: known are obj, stl, dae, glb, gltf, ply, off, 3mf"
                )
            self.warnings += [f"{path.name}: {note.text}" for note in mesh.notes]
            self._meshes[path] = mesh
        return self._meshes[path]

    def _shared(self, material: VisualMaterial) -> VisualMaterial:
        """The material with pictures that are held once, however many files hold them."""
        images = {
            field.name: self._palette.image(value.png)
            for field in fields(material)
            if isinstance(value := getattr(material, field.name), Image)
        }
        return replace(
            material,
            base_color_image=images.get("base_color_image"),
            metallic_roughness_image=images.get("metallic_roughness_image"),
            normal_image=images.get("normal_image"),
        )

    def _stated(self, element: Element) -> VisualMaterial | None:
        """The `<material>` of a visual, there or by its name; None where it says nothing."""
        here = element.find("material")
        if here is None:
            return None
        name = here.get("name", "") or "material"
        said = here if len(here) else self._named.get(name, here)
        color, texture = said.find("color"), said.find("texture")
        if color is None and texture is None:
            return None
        rgba = np.clip(np.ones(4) if color is None else numbers(color, "rgba", 4, "1 1 1 1"), 0, 1)
        red, green, blue = (float(value) for value in srgb_to_linear(rgba[:3]))
        image = None if texture is None else self._picture(texture.get("filename", ""), name)
        if image is not None:
            red = green = blue = 1.0
        return replace(
            PLAIN, name=name, base_color=(red, green, blue, float(rgba[3])), base_color_image=image
        )

    def _picture(self, name: str, material: str) -> Image | None:
        from PIL import Image as Pillow

        path = mesh_file(name, self._folder)
        try:
            with reading(path, "a picture"), Pillow.open(path) as picture:
                return self._palette.picture(picture, material, alpha=True)
        except BadInputError as error:
            self.warnings.append(f"a texture of material '{material}' is left out: {error}")
            return None


def _around(path: Path, folder: Path) -> Path:
    """The folder that a mesh and what it refers to lie in: one around URDF and mesh, if they share any."""
    home, other = path.parent.resolve(), folder.resolve()
    common = Path(os.path.commonpath([home, other]))
    return home if common == Path(common.anchor) else common
