"""Triangles of a mesh file, in the order of the file and without looks."""

from __future__ import annotations

from itertools import pairwise
from pathlib import Path

import numpy as np

from ...arrays import FloatArray, IntArray, frozen_ints
from ...errors import BadInputError
from .files import LARGEST, reading

MESH_SUFFIXES = (".glb", ".obj", ".ply", ".stl", ".gltf", ".off", ".dae")
Triangles = tuple[FloatArray, IntArray]


def read_triangles(path: Path) -> Triangles:
    """Read a mesh file as one surface; node transforms are applied, units and up axes are left as they are.

    Vertices are not merged. Faces of OBJ, STL, PLY and OFF keep the order of the file.

    Args:
        path: OBJ, STL, PLY, OFF, DAE, GLB or glTF.

    Returns:
        (V, 3) vertices and (F, 3) faces.

    Raises:
        BadInputError: missing, damaged, of another format, without a triangle, or with NaN; names the file.
    """
    if path.suffix.lower() not in MESH_SUFFIXES:
        raise BadInputError(f"{path}: no mesh file: known are {', '.join(s[1:] for s in MESH_SUFFIXES)}")
    if not path.is_file():
        raise BadInputError(f"no such mesh file: {path}")
    with reading(path, "a mesh"):
        return _checked(*(_obj(path) if path.suffix.lower() == ".obj" else _with_trimesh(path)))


def read_surface(path: Path) -> Triangles:
    """Read a mesh file as `trimesh.load(path, process=False, force="mesh")` does: faces are numbered alike.

    Returns:
        (V, 3) vertices and (F, 3) faces, node transforms applied, nothing merged or dropped.

    Raises:
        BadInputError: as `read_triangles`.
    """
    import trimesh

    with reading(path, f"a mesh ({path.suffix or 'no suffix'})"):
        mesh = trimesh.load(path, process=False, force="mesh")
        vertices = np.asarray(getattr(mesh, "vertices", []), dtype=np.float64).reshape(-1, 3)
        return _checked(vertices, np.asarray(getattr(mesh, "faces", []), dtype=np.int64).reshape(-1, 3))


def joined(pieces: list[Triangles]) -> Triangles:
    """Several surfaces, at least one, as one: faces in the order of the pieces."""
    starts = np.cumsum([0] + [len(vertices) for vertices, _ in pieces[:-1]])
    faces = [faces + start for (_, faces), start in zip(pieces, starts, strict=True)]
    return np.concatenate([vertices for vertices, _ in pieces]), np.concatenate(faces)


def moved(piece: Triangles, new_from_old: FloatArray) -> Triangles:
    """A surface moved by a (4, 4) matrix; a mirrored one is turned outside again."""
    vertices, faces = piece
    matrix = new_from_old[:3, :3]
    turned = faces[:, ::-1] if np.linalg.det(matrix) < 0 else faces
    return vertices @ matrix.T + new_from_old[:3, 3], turned


def _obj(path: Path) -> Triangles:
    """Positions and faces of an OBJ; polygons become fans.

    trimesh regroups faces by material and miscounts relative indices, so labels of faces would not fit.
    """
    vertices: list[list[str]] = []
    faces: list[tuple[int, int, int]] = []
    for line in path.read_text(encoding="utf-8", errors="replace").splitlines():
        words = line.partition("#")[0].split()
        if words and words[0] == "v":
            if len(words) < 4:
                raise BadInputError("it has a vertex of fewer than three numbers: is it complete?")
            vertices.append(words[1:4])
        elif words and words[0] == "f":
            corners = [_corner(word, len(vertices)) for word in words[1:]]
            faces += [(corners[0], b, c) for b, c in pairwise(corners[1:])]
    positions = np.array(vertices, dtype=np.float64).reshape(len(vertices), 3)
    return positions, np.array(faces, dtype=np.int32).reshape(-1, 3)


def _corner(word: str, count: int) -> int:
    """Index from 0 of a corner such as "3/1/2" or "-1", with `count` vertices before it."""
    index = int(word.partition("/")[0])
    found = index - 1 if index > 0 else count + index
    if index == 0 or found < 0:
        raise ValueError(f"face index {index} is out of range")
    return found


def _with_trimesh(path: Path) -> Triangles:
    import trimesh

    scene = trimesh.load_scene(path, process=False)
    placed = [scene.graph[node] for node in scene.graph.nodes_geometry]
    pieces = [
        moved((np.asarray(mesh.vertices, dtype=np.float64), np.asarray(mesh.faces)), np.asarray(matrix))
        for matrix, mesh in ((matrix, scene.geometry[name]) for matrix, name in placed)
        if isinstance(mesh, trimesh.Trimesh)
    ]
    return joined(pieces) if pieces else (np.zeros((0, 3)), np.zeros((0, 3), dtype=np.int32))


def _checked(vertices: FloatArray, faces: IntArray) -> Triangles:
    if not len(faces):
        raise BadInputError("it has no triangles: is it complete?")
    if faces.min() < 0 or faces.max() >= len(vertices):
        raise BadInputError(f"it has face indices outside 0..{len(vertices) - 1}")
    if not (np.abs(vertices) < LARGEST).all():
        raise BadInputError(f"it has vertices that are NaN, infinite or beyond {LARGEST:.0e}")
    return vertices, frozen_ints(faces)
