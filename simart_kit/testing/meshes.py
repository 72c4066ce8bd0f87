"""Generated meshes and assets with exact numbers, for tests of plugins."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ..arrays import FloatArray, IntArray, Vec3, vec3
from ..asset import Asset, ConvexMesh, Joint, Limits, MassProperties, Part
from ..mesh import Image, Mesh, VisualMaterial

# A unit cube's corners in binary order of (x, y, z), and its 12 outward triangles.
_CORNERS = np.array([[x, y, z] for x in (0.0, 1.0) for y in (0.0, 1.0) for z in (0.0, 1.0)])
_TRIANGLES = np.array(
    [
        [0, 1, 3],
        [0, 3, 2],
        [4, 6, 7],
        [4, 7, 5],
        [0, 4, 5],
        [0, 5, 1],
        [2, 3, 7],
        [2, 7, 6],
        [0, 2, 6],
        [0, 6, 4],
        [1, 5, 7],
        [1, 7, 3],
    ]
)


def box(lower: Sequence[float], upper: Sequence[float]) -> tuple[FloatArray, IntArray]:
    """Closed box of 8 vertices and 12 outward triangles between two corners [m]."""
    low, high = np.array(lower, dtype=np.float64), np.array(upper, dtype=np.float64)
    return low + _CORNERS * (high - low), _TRIANGLES.astype(np.int32)


def boxes_mesh(bounds: Sequence[tuple[Sequence[float], Sequence[float]]], textured: bool = False) -> Mesh:
    """Several boxes as one mesh, 12 faces each; with a texture and UVs if asked."""
    pieces = [box(lower, upper) for lower, upper in bounds]
    vertices = np.concatenate([v for v, _ in pieces])
    faces = np.concatenate([f + 8 * i for i, (_, f) in enumerate(pieces)])
    if not textured:
        return Mesh(vertices, faces)
    uv = vertices[:, [0, 2]] - vertices[:, [0, 2]].min(axis=0)
    pixels = np.zeros((8, 8, 3), dtype=np.uint8)
    pixels[::2, ::2] = (200, 120, 40)
    pixels[1::2, 1::2] = (40, 90, 200)
    material = VisualMaterial("checks", (1.0, 1.0, 1.0, 1.0), base_color_image=Image.from_pixels(pixels))
    return Mesh(vertices, faces, uv=uv / uv.max(), materials=(material,))


# An open-fronted cabinet 0.6 x 0.4 x 0.8 m with a door hinged on the left and a drawer above it. Front is -y.
_BODY = [
    ((-0.30, -0.20, 0.0), (-0.28, 0.20, 0.8)),
    ((0.28, -0.20, 0.0), (0.30, 0.20, 0.8)),
    ((-0.28, -0.20, 0.0), (0.28, 0.20, 0.02)),
    ((-0.28, -0.20, 0.78), (0.28, 0.20, 0.8)),
    ((-0.28, 0.18, 0.02), (0.28, 0.20, 0.78)),
]
_DOOR = [((-0.275, -0.20, 0.025), (0.275, -0.18, 0.52)), ((0.20, -0.23, 0.25), (0.22, -0.20, 0.35))]
_DRAWER = [((-0.27, -0.20, 0.54), (0.27, 0.15, 0.77)), ((-0.05, -0.23, 0.65), (0.05, -0.20, 0.67))]


def cabinet_mesh(textured: bool = True) -> Mesh:
    """A cabinet of nine boxes, 108 faces: body (faces 0-59), door with handle (60-83), drawer (84-107)."""
    return boxes_mesh(_BODY + _DOOR + _DRAWER, textured)


def cabinet_asset(textured: bool = True, physics: bool = True) -> Asset:
    """The cabinet with a revolute door (opens by 1.5 rad about -z) and a prismatic drawer (0.3 m along -y).

    With `physics`, each part has the mass of its boxes at 600 kg/m^3 and one collision box a box.
    """
    mesh = cabinet_mesh(textured)
    face_part = np.repeat([0, 1, 2], [60, 24, 24])
    groups = {"body": _BODY, "door": _DOOR, "drawer": _DRAWER}
    parts = tuple(_part(name, bounds, physics) for name, bounds in groups.items())
    joints = (
        Joint(
            "door_hinge",
            "revolute",
            "body",
            "door",
            (-0.275, -0.19, 0.0),
            (0.0, 0.0, 1.0),
            Limits(-1.5, 0.0),
            damping=0.05,
            friction=0.02,
        ),
        Joint(
            "drawer_slide",
            "prismatic",
            "body",
            "drawer",
            (0.0, -0.2, 0.65),
            (0.0, -1.0, 0.0),
            Limits(0.0, 0.3),
            damping=2.0,
            friction=0.5,
        ),
    )
    return Asset("cabinet", mesh, face_part, parts, joints)


def chain_asset() -> Asset:
    """Three boxes in a chain with slanted axes: a continuous joint, then a revolute one on it."""
    bounds = [
        ((-0.1, -0.1, 0.0), (0.1, 0.1, 0.1)),
        ((-0.05, -0.05, 0.11), (0.05, 0.05, 0.4)),
        ((0.06, -0.03, 0.3), (0.3, 0.03, 0.36)),
    ]
    parts = tuple(_part(n, [b], True) for n, b in zip(("base", "post", "arm"), bounds, strict=True))
    slanted = vec3(np.array([0.6, 0.0, 0.8]))
    joints = (
        Joint("arm_hinge", "revolute", "post", "arm", (0.05, 0.0, 0.33), slanted, Limits(-0.7, 0.9)),
        Joint("post_spin", "continuous", "base", "post", (0.0, 0.0, 0.1), (0.0, 0.0, 1.0)),
    )
    return Asset("chain", boxes_mesh(bounds), np.repeat([0, 1, 2], 12), parts, joints)


def static_asset() -> Asset:
    """One box that nothing moves."""
    bounds = [((0.0, 0.0, 0.0), (0.4, 0.3, 0.5))]
    return Asset(
        "block", boxes_mesh(bounds, textured=True), np.zeros(12, np.int32), (_part("body", bounds, True),)
    )


def _part(name: str, bounds: Sequence[tuple[Vec3, Vec3]], physics: bool) -> Part:
    if not physics:
        return Part(name, label=name)
    shapes = tuple(ConvexMesh(*box(lower, upper)) for lower, upper in bounds)
    return Part(name, label=name, mass=_box_mass(bounds), collision=shapes)


def _box_mass(bounds: Sequence[tuple[Vec3, Vec3]], density: float = 600.0) -> MassProperties:
    """Analytic mass of boxes that do not overlap, by the parallel-axis theorem."""
    low, high = np.array([b[0] for b in bounds]), np.array([b[1] for b in bounds])
    size, middle = high - low, (low + high) / 2
    masses = density * size.prod(axis=1)
    center = masses @ middle / masses.sum()
    inertia = np.zeros((3, 3))
    for mass, extent, position in zip(masses, size, middle - center, strict=True):
        square = extent**2
        inertia += np.diag(mass / 12 * (square.sum() - square))
        inertia += mass * (position @ position * np.eye(3) - np.outer(position, position))
    a, b, c = (vec3(row) for row in inertia)
    return MassProperties(float(masses.sum()), vec3(center), (a, b, c), "boxes")
