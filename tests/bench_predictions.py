"""Predictions and objects written to files as others write them, for tests of whole runs."""

from __future__ import annotations

import json
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
import trimesh

from simart_kit.arrays import FloatArray
from simart_kit.asset import Asset, Joint, Limits, Part, clean_name, unique_names
from simart_kit.asset_io import save_asset
from simart_kit.bench.articulation import Articulation, Link, LinkJoint
from simart_kit.mesh import Mesh

Row = dict[str, Any]
Z_UP = np.eye(4)
Z_UP[:3, :3] = [[1, 0, 0], [0, 0, -1], [0, 1, 0]]  # (x, y, z) with +Y up is (x, -z, y) with +Z up


def write_labels(root: Path, name: str, value: Articulation) -> None:
    """NAME.npy and NAME.json, in the frame of the truth."""
    root.mkdir(parents=True, exist_ok=True)
    np.save(root / f"{name}.npy", value.labels)
    parts = [
        {
            "id": i,
            "name": link.name,
            "parent": link.parent,
            "label": link.label,
            "joint": joint_row(link.joint),
        }
        for i, link in enumerate(value.links)
    ]
    (root / f"{name}.json").write_text(json.dumps({"parts": parts}))


def joint_row(joint: LinkJoint) -> Row:
    row = {"type": joint.kind, "axis": joint.axis, "origin": joint.origin, "name": joint.name}
    return row | {"lower": joint.lower, "upper": joint.upper}


def write_urdf(root: Path, name: str, value: Articulation, file_from_truth: FloatArray = Z_UP) -> None:
    """NAME/NAME.urdf, +Z up, a mesh file a link in the frame of the joint that carries it."""
    (root / name).mkdir(parents=True)
    value = value.transformed(file_from_truth)
    places = [np.array(link.joint.origin or (0, 0, 0), float) * (link.parent >= 0) for link in value.links]
    lines = [f'<robot name="{name}">']
    for index, link in enumerate(value.links):
        shape = ""
        if (value.labels == index).any():
            mesh = trimesh.Trimesh(
                value.vertices - places[index], value.faces[value.labels == index], process=False
            )
            write_obj(root / name / f"{index}.obj", mesh.vertices, mesh.faces)
            shape = f'<visual><geometry><mesh filename="{index}.obj"/></geometry></visual>'
        lines.append(f'<link name="{link.name}">{shape}</link>')
        if link.parent >= 0:
            lines.append(urdf_joint(link, value.links[link.parent].name, places[index] - places[link.parent]))
    (root / name / f"{name}.urdf").write_text("\n".join([*lines, "</robot>"]))


def urdf_joint(link: Link, parent: str, shift: FloatArray) -> str:
    joint = link.joint
    limit = ""
    if joint.lower is not None:
        limit = f'<limit lower="{joint.lower!r}" upper="{joint.upper!r}" effort="9" velocity="1"/>'
    axis = f'<axis xyz="{spaced(joint.axis)}"/>' if joint.axis else ""
    ends = f'<parent link="{parent}"/><child link="{link.name}"/><origin xyz="{spaced(shift)}"/>'
    return f'<joint name="{joint.name or link.name}" type="{joint.kind}">{ends}{axis}{limit}</joint>'


def spaced(values: Sequence[float] | FloatArray) -> str:
    return " ".join(repr(float(value)) for value in values)


def write_obj(path: Path, vertices: FloatArray, faces: FloatArray) -> None:
    path.write_text(
        "\n".join([*(f"v {spaced(v)}" for v in vertices), *(f"f {a} {b} {c}" for a, b, c in faces + 1)])
    )


def write_output(root: Path, name: str, value: Articulation) -> None:
    """NAME/asset.json with parts.npz: +Z up, half as large as the source and moved."""
    asset_from_source = np.diag([0.5, 0.5, 0.5, 1.0]) @ Z_UP
    asset_from_source[:3, 3] = (1.0, 2.0, 3.0)
    moved = value.transformed(asset_from_source)
    names = unique_names([clean_name(link.name) for link in moved.links])
    joints = tuple(
        Joint(
            f"to_{child}", link.joint.kind, names[link.parent], child,
            link.joint.origin or (0, 0, 0), link.joint.axis or (0, 0, 1),
            None if link.joint.lower is None else Limits(link.joint.lower, link.joint.upper),
        )
        for link, child in zip(moved.links, names, strict=True)
        if link.parent >= 0
    )  # fmt: skip
    parts = tuple(Part(n, link.label) for n, link in zip(names, moved.links, strict=True))
    mesh = Mesh(moved.vertices, moved.faces)
    save_asset(Asset("thing", mesh, moved.labels, parts, joints, asset_from_source), root / name)


def write_particulate(root: Path, name: str, value: Articulation) -> None:
    """NAME/pred.npz with joints +Z up in a box of longest side 1, and pred.obj as the input was."""
    lower, upper = value.bounds
    side = float((upper - lower).max())
    matrix = Z_UP @ np.diag([1 / side, 1 / side, 1 / side, 1.0])
    matrix[:3, 3] = -matrix[:3, :3] @ (lower + upper) / 2
    count = len(value.links)
    flags, lines = np.zeros((2, count), bool), np.zeros((count, 6))
    ranges, ways = np.zeros((2, count, 2)), np.zeros((count, 3))
    for i, joint in enumerate(link.joint.transformed(matrix) for link in value.links):
        if joint.axis is None:
            continue
        flags[int(joint.kind == "prismatic"), i] = True
        limits = (-np.pi, np.pi) if joint.kind == "continuous" else (joint.lower, joint.upper)
        if joint.kind == "prismatic":
            ways[i], ranges[1, i] = joint.axis, limits
        else:
            lines[i] = [*joint.axis, *np.cross(joint.axis, joint.origin or (0, 0, 0))]
            ranges[0, i] = limits
    (root / name).mkdir(parents=True)
    pairs = [(link.parent, i) for i, link in enumerate(value.links) if link.parent >= 0]
    np.savez(
        root / name / "pred.npz", motion_hierarchy=np.array(pairs), is_part_revolute=flags[0],
        is_part_prismatic=flags[1], revolute_plucker=lines, revolute_range=ranges[0], prismatic_axis=ways,
        prismatic_range=ranges[1], face_part_ids=value.labels,
    )  # fmt: skip
    write_obj(root / name / "pred.obj", value.vertices, value.faces)


def write_anymesh(root: Path, name: str, value: Articulation) -> None:
    """NAME/mobility.json and a GLB a part, centred, diagonal 2."""
    size = 2 / value.diagonal
    matrix = np.diag([size, size, size, 1.0])
    matrix[:3, 3] = -size * value.bounds.mean(axis=0)
    value = value.transformed(matrix)
    meshes = root / name / "mesh_parts"
    meshes.mkdir(parents=True)
    rows = []
    for index, link in enumerate(value.links):
        mesh = trimesh.Trimesh(value.vertices, value.faces[value.labels == index], process=False)
        mesh.export(meshes / f"{link.name}.glb")
        axis = {"origin": link.joint.origin or (0, 0, 0), "direction": link.joint.axis}
        row = {"id": index, "name": link.name, "parent": link.parent, "joint": link.joint.kind}
        rows.append(row | {"jointData": {"axis": axis} if link.joint.axis else {}})
    (root / name / "mobility.json").write_text(json.dumps(rows))


def flatten(path: Path, factors: tuple[float, float, float]) -> None:
    """Squeeze a mesh file along the axes, faces kept as they are."""
    mesh = trimesh.load(path, process=False, force="mesh")
    mesh.vertices = mesh.vertices * factors
    mesh.export(path)
