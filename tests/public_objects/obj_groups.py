"""OBJ files by group and material, with the colours of their materials."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path

import numpy as np

from simart_kit.arrays import FloatArray, IntArray

_OPAQUE = 20  # of 255: pixels below are holes, whose colour nobody sees


@dataclass(frozen=True, eq=False)
class Group:
    """The (F, 3) faces of one group and material, indices from 0; polygons are fans."""

    name: str
    material: str
    faces: IntArray


@dataclass(frozen=True, eq=False)
class ObjFile:
    """(V, 3) vertices, groups as they first occur, and (3,) colours by material, 0..255."""

    vertices: FloatArray
    groups: tuple[Group, ...]
    colors: dict[str, FloatArray]


def read_obj(path: Path) -> ObjFile:
    """Read a file and the materials that it names."""
    vertices: list[list[float]] = []
    faces: dict[tuple[str, str], list[tuple[int, int, int]]] = {}
    colors: dict[str, FloatArray] = {}
    group, material = "default", ""
    for key, words in _lines(path):
        if key == "v":
            vertices.append([float(word) for word in words[:3]])
        elif key in ("g", "o"):
            group = "_".join(words) or "default"
        elif key == "mtllib":
            colors |= read_colors(path.with_name(" ".join(words)))
        elif key == "usemtl":
            material = " ".join(words)
        elif key == "f":
            corners = [_corner(word, len(vertices)) for word in words]
            fan = [(corners[0], b, c) for b, c in pairwise(corners[1:])]
            faces.setdefault((group, material), []).extend(fan)
    groups = tuple(Group(name, look, np.array(found)) for (name, look), found in faces.items() if found)
    return ObjFile(np.array(vertices), groups, colors)


def read_colors(path: Path) -> dict[str, FloatArray]:
    """Colours of the materials of an MTL file, of a texture its mean; none where there is no such file."""
    plain: dict[str, FloatArray] = {}
    textured: dict[str, FloatArray] = {}
    name = ""
    for key, words in _lines(path) if path.is_file() else ():
        if key == "newmtl":
            name = " ".join(words)
        elif key == "Kd":
            plain[name] = np.array([float(word) for word in words[:3]]) * 255
        elif key == "map_Kd":
            picture = path.parent / words[-1].replace("\\", "/")
            if picture.is_file():
                textured[name] = _mean(picture)
    return plain | textured


def look(colors: Mapping[str, FloatArray], material: str, otherwise: FloatArray) -> FloatArray:
    """The (3,) colour of a material; "wood.001" is one of "wood", where that alone is known."""
    return colors.get(material, colors.get(material.split(".")[0], otherwise))


def _lines(path: Path) -> Iterator[tuple[str, list[str]]]:
    for line in path.read_text(encoding="latin-1").splitlines():
        words = line.split()
        if words and not words[0].startswith("#"):
            yield words[0], words[1:]


def _corner(word: str, count: int) -> int:
    index = int(word.partition("/")[0])
    return index - 1 if index > 0 else count + index


def _mean(picture: Path) -> FloatArray:
    from PIL import Image

    with Image.open(picture) as image:
        pixels = np.asarray(image.convert("RGBA"), dtype=np.float64).reshape(-1, 4)
    seen = pixels[pixels[:, 3] > _OPAQUE]
    return np.asarray((seen if len(seen) else pixels)[:, :3].mean(axis=0))
