"""Objects as files: a SIMART-Bench folder with a textured GLB and its ground truth."""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from simart_kit.arrays import ByteArray, FloatArray, IntArray, Vec3, vec3
from simart_kit.bench.articulation import Link, LinkJoint
from simart_kit.bench.formats.truth_tables import part_rows
from simart_kit.topology import unique_rows

from ...shapes.dice import Dice
from .objects import Body, GeneratedObject, Motion
from .texture import atlas, coordinates

LICENCE = "CC0-1.0"
# +Z up, front -Y to glTF's +Y up, front +Z.
_GLTF = np.array([[1.0, 0, 0], [0, 0, 1], [0, -1, 0]])
# Corners closer than this share of the object are one.
_SAME = 1e-6


@dataclass(frozen=True, eq=False)
class GeneratedMesh:
    """The surface of an object as a file holds it: +Y up [m].

    Attributes:
        vertices: (V, 3) float32; corners of one body and tile at one place and texture coordinate are one.
        uv: (V, 2) float32, origin at the bottom left.
        faces: (F, 3).
        face_part: (F,) int32 number of the body of every face.
        picture: (H, W, 3) sRGB.
    """

    vertices: FloatArray
    uv: FloatArray
    faces: IntArray
    face_part: IntArray
    picture: ByteArray


def mesh_of(made: GeneratedObject, dice: Dice) -> GeneratedMesh:
    """The object as one textured mesh."""
    looks = list(dict.fromkeys(surface.look for body in made.bodies for surface in body.surfaces))
    everything = np.concatenate([body.triangles for body in made.bodies]).reshape(-1, 3)
    low = everything.min(axis=0)
    size = float(np.ptp(everything, axis=0).max())
    corners, uv, part = [], [], []
    for number, body in enumerate(made.bodies):
        for surface in body.surfaces:
            corners.append(surface.triangles)
            uv.append(coordinates((surface.triangles - low) / size, looks.index(surface.look), len(looks)))
            part.append(np.full(len(surface.triangles), number, dtype=np.int32))
    face_part = np.concatenate(part)
    places, spots = np.concatenate(corners).reshape(-1, 3), np.concatenate(uv).reshape(-1, 2)
    keys = np.column_stack([places / (size * _SAME), spots / _SAME, np.repeat(face_part, 3)])
    first, same = unique_rows(np.round(keys).astype(np.int64))
    return GeneratedMesh(
        (places[first] @ _GLTF.T).astype(np.float32),
        spots[first].astype(np.float32),
        same.reshape(-1, 3),
        face_part,
        atlas(looks, dice),
    )


def write_object(made: GeneratedObject, name: str, folder: Path, dice: Dice) -> GeneratedMesh:
    """Write input.glb, gt.npz and gt.json into a folder, which is made.

    Args:
        made: in the pose that is written; positions count from it.
        name: of the object.
        folder: to write.
        dice: of the texture.

    Returns:
        The mesh that was written.
    """
    mesh = mesh_of(made, dice)
    folder.mkdir(parents=True)
    (folder / "input.glb").write_bytes(_glb(mesh, name))
    np.savez_compressed(folder / "gt.npz", allow_pickle=False, face_part=mesh.face_part)
    text = json.dumps(_table(made, name), indent=1, allow_nan=False)
    (folder / "gt.json").write_text(text + "\n", encoding="utf-8")
    return mesh


def _glb(mesh: GeneratedMesh, name: str) -> bytes:
    import trimesh
    from PIL import Image

    material = trimesh.visual.material.PBRMaterial(
        name=name,
        baseColorTexture=Image.fromarray(mesh.picture),
        baseColorFactor=[255, 255, 255, 255],
        metallicFactor=0.0,
        roughnessFactor=0.7,
        doubleSided=True,
    )
    surface = trimesh.Trimesh(
        mesh.vertices,
        mesh.faces,
        process=False,
        visual=trimesh.visual.TextureVisuals(uv=mesh.uv, material=material),
    )
    data: bytes = trimesh.Scene({name: surface}).export(file_type="glb")
    return data


def _table(made: GeneratedObject, name: str) -> dict[str, Any]:
    rows = part_rows([_link(body) for body in made.bodies])
    for row, body in zip(rows, made.bodies, strict=True):
        row["material"] = body.material
    return {
        "case": name,
        "category": made.category,
        "licence": LICENCE,
        "frame": {"up": "+Y", "metres_per_unit": 1.0},
        "parts": rows,
    }


def _link(body: Body) -> Link:
    return Link(body.name, body.parent, _joint(body.motion), (), body.label)


def _joint(motion: Motion | None) -> LinkJoint:
    if motion is None:
        return LinkJoint()
    limited = motion.kind in ("revolute", "prismatic")
    return LinkJoint(
        motion.kind,
        _turned(motion.axis) if limited or motion.kind == "continuous" else None,
        _turned(motion.origin) if motion.kind not in ("prismatic", "free") else None,
        motion.lower if limited else None,
        motion.upper if limited else None,
    )


def _turned(vector: FloatArray) -> Vec3:
    return vec3(_GLTF @ vector)
