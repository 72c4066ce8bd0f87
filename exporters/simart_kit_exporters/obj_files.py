"""OBJ, MTL and PNG files with content-hashed names, as URDF and MJCF refer to them."""

from __future__ import annotations

import hashlib
from pathlib import Path

import numpy as np

from simart_kit.arrays import FloatArray, IntArray
from simart_kit.asset import ConvexMesh, clean_name
from simart_kit.bake import Color
from simart_kit.kept import kept
from simart_kit.mesh import Image, VisualMaterial
from simart_kit.srgb import linear_to_srgb
from simart_kit.surfaces import Surface

_BLOCK = 4096


def srgb_color(material: VisualMaterial) -> Color:
    """Its base colour as sRGB with alpha, 0..1, as MTL, URDF and MJCF write colours."""
    red, green, blue = (float(c) for c in linear_to_srgb(np.array(material.base_color[:3])))
    return (red, green, blue, material.base_color[3])


def write_surface(surface: Surface, folder: Path, with_material: bool = True) -> str:
    """Write a surface as OBJ, with its MTL and PNG if asked; returns the OBJ's file name."""
    header = ""
    if with_material:
        name = f"{surface.part}_{clean_name(surface.material.name, 'material')}"
        library = _write(folder, surface.part, ".mtl", _mtl(name, surface.material, folder).encode())
        header = f"mtllib {library}\nusemtl {name}\n"
    return _write(folder, surface.part, ".obj", (header + _surface_text(surface)).encode())


def write_hull(part: str, hull: ConvexMesh, origin: FloatArray, folder: Path) -> str:
    """Write a collision shape as OBJ in the frame at (3,) `origin`; returns the file name."""
    return _write(folder, f"{part}_hull", ".obj", obj_text(hull.vertices - origin, hull.faces).encode())


def write_texture(image: Image, folder: Path) -> str:
    """Write a picture once, however many surfaces share it; returns the file name."""
    return _write(folder, "texture", ".png", image.png)


@kept
def _surface_text(surface: Surface) -> str:
    return obj_text(surface.vertices, surface.faces, surface.uv, surface.normals)


def obj_text(
    vertices: FloatArray, faces: IntArray, uv: FloatArray | None = None, normals: FloatArray | None = None
) -> str:
    """A mesh in OBJ.

    Args:
        vertices: (V, 3) [m]; written to 7 digits, as exact as the 32-bit floats of readers.
        faces: (F, 3).
        uv: (V, 2) origin bottom left, or None.
        normals: (V, 3) unit, or None.
    """
    lines = [_rows("v %.7g %.7g %.7g\n", vertices)]
    if uv is not None:
        lines.append(_rows("vt %.7g %.7g\n", uv))
    if normals is not None:
        lines.append(_rows("vn %.4g %.4g %.4g\n", normals))
    corner = {(False, False): "{0}", (True, False): "{0}/{0}", (False, True): "{0}//{0}"}.get(
        (uv is not None, normals is not None), "{0}/{0}/{0}"
    )
    corners = [corner.format(number) for number in range(1, len(vertices) + 1)]
    lines += [f"f {corners[a]} {corners[b]} {corners[c]}\n" for a, b, c in faces.tolist()]
    return "".join(lines)


def _rows(template: str, values: FloatArray) -> str:
    """A line a row; `+ 0.0` turns -0.0 into 0."""
    text = []
    for start in range(0, len(values), _BLOCK):  # one long template would be slower to parse
        block = values[start : start + _BLOCK] + 0.0
        text.append(template * len(block) % tuple(block.ravel().tolist()))
    return "".join(text)


def _mtl(name: str, material: VisualMaterial, folder: Path) -> str:
    red, green, blue, alpha = srgb_color(material)
    # The exponent that gives a Phong highlight the width of a microfacet one: 2 / roughness^4 - 2.
    shininess = min(max(2.0 / max(material.roughness, 0.1) ** 4 - 2.0, 0.0), 1000.0)
    lines = [
        f"newmtl {name}",
        f"Kd {red:.6g} {green:.6g} {blue:.6g}",
        "Ks 0.04 0.04 0.04",
        f"Ns {shininess:.6g}",
        f"Pr {material.roughness:.6g}",
        f"Pm {material.metallic:.6g}",
        f"d {alpha:.6g}",
        "illum 2",
    ]
    if material.base_color_image is not None:
        lines.append(f"map_Kd {write_texture(material.base_color_image, folder)}")
    return "\n".join(lines) + "\n"


def _write(folder: Path, stem: str, suffix: str, data: bytes) -> str:
    name = f"{stem}_{hashlib.sha256(data).hexdigest()[:8]}{suffix}"
    path = folder / name
    if not path.exists():
        path.write_bytes(data)
    return name
