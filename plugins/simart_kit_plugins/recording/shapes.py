"""Surfaces in the recording: the source, its voxels, segments, parts and collision shapes."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from simart_kit.arrays import FloatArray, IntArray
from simart_kit.asset import Asset
from simart_kit.colors import part_color
from simart_kit.mesh import Mesh
from simart_kit.stages import Segmentation
from simart_kit.voxels import cube_frame, voxelise

from .colors import faded, segment_colors
from .meshes import convex_edges, mesh3d, plain_mesh, textured_mesh
from .tape import Tape
from .text import readable

VOXELS = 64
# Texels that all surfaces of one view may hold together; rerun keeps textures uncompressed.
_TEXELS = 1 << 22


def log_textured(tape: Tape, path: str, mesh: Mesh, face_groups: Mapping[str, IntArray]) -> None:
    """Log faces with their look, an entity `path/NAME/surface` (`surface_2` ...) for each group's materials.

    Args:
        tape: where to.
        path: entity above the groups.
        mesh: with normals.
        face_groups: face ids by name.
    """
    pieces = []
    for name, faces in face_groups.items():
        used = np.unique(mesh.face_material[faces])
        for index, material in enumerate(used):
            suffix = "" if index == 0 else f"_{index + 1}"
            group = faces[mesh.face_material[faces] == material]
            pieces.append((f"{path}/{name}/surface{suffix}", group, int(material)))
    textured = sum(mesh.materials[material].base_color_image is not None for _, _, material in pieces)
    for entity, faces, material in pieces:
        tape.static(entity, textured_mesh(mesh, faces, material, _TEXELS // max(textured, 1)))


def log_voxels(tape: Tape, mesh: Mesh) -> None:
    """Log the surface voxels, coloured by height."""
    import rerun as rr

    grid = voxelise(mesh.triangles, cube_frame(mesh.bounds, VOXELS))
    tape.static(
        "voxels",
        rr.VoxelGridMap(
            grid.indices,
            [grid.frame.voxel_size] * 3,
            values=grid.indices[:, 2].astype(np.float32),
            value_range=[0.0, float(VOXELS)],
            colormap=rr.components.Colormap.Viridis,
            translation=grid.frame.origin,
        ),
    )


def log_segments(tape: Tape, mesh: Mesh, face_segment: IntArray) -> None:
    """Log the surface with a colour a segment."""
    _, segment = np.unique(face_segment, return_inverse=True)
    segment = segment.reshape(-1)
    # A vertex on a border between segments is needed in both colours.
    key = mesh.faces.astype(np.int64) * (segment.max() + 1) + segment[:, None]
    used, faces = np.unique(key, return_inverse=True)
    vertex, own = np.divmod(used, segment.max() + 1)
    assert mesh.normals is not None
    colors = segment_colors(int(segment.max()) + 1)[own]
    tape.static("segments", mesh3d(mesh.vertices[vertex], faces, mesh.normals[vertex], colors=colors))


def log_parts(tape: Tape, mesh: Mesh, segmentation: Segmentation) -> None:
    """Log each part in its colour, `parts/NAME`, and their names, `part_labels`."""
    import rerun as rr

    middles = []
    for index, guess in enumerate(segmentation.parts):
        faces = np.flatnonzero(segmentation.face_part == index)
        color = part_color(index)
        tape.static(f"parts/{guess.name}", plain_mesh(mesh, faces, color))
        middles.append(_middle(mesh, faces))
    labels = [_part_label(guess.name, guess.label) for guess in segmentation.parts]
    tape.static(
        "part_labels",
        rr.Points3D(
            middles,
            radii=rr.Radius.ui_points(3.0),
            colors=[part_color(index) for index in range(len(labels))],
            labels=labels,
            show_labels=True,
        ),
    )


def log_collision(tape: Tape, asset: Asset) -> None:
    """Log the convex shapes of each part, translucent and as wires, `collision/NAME`."""
    import rerun as rr

    for index, part in enumerate(asset.parts):
        if not part.collision:
            continue
        color = part_color(index)
        corners = np.concatenate([shape.vertices[shape.faces] for shape in part.collision]).reshape(-1, 3)
        flat = Mesh(corners, np.arange(len(corners)).reshape(-1, 3))
        normals = np.repeat(flat.face_normals, 3, axis=0)
        edges = np.concatenate([s.vertices[convex_edges(s.vertices, s.faces)] for s in part.collision])
        tape.static(
            f"collision/{part.name}", mesh3d(flat.vertices, flat.faces, normals, factor=faded(color, 90))
        )
        tape.static(
            f"collision/{part.name}/edges",
            rr.LineStrips3D(edges, radii=rr.Radius.ui_points(1.0), colors=[color] * len(edges)),
        )


def _middle(mesh: Mesh, faces: IntArray) -> FloatArray:
    """(3,) centroid of some faces by area; of their corners when they have none."""
    areas = mesh.face_areas[faces]
    weights = areas if areas.sum() > 0 else np.ones(len(faces))
    return np.asarray(np.average(mesh.triangles[faces].mean(axis=1), axis=0, weights=weights))


def _part_label(name: str, label: str) -> str:
    return readable(f"{name} ({label})") if label and label not in name else name
