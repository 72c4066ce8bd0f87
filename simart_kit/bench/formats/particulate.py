"""Particulate's files: point clouds with truth, and what its `infer.py --eval` predicts.

Source: github.com/RuiningLi/particulate (DATA.md, infer.py, particulate/articulation_utils.py). Both kinds of
.npz hold, for P parts:

    motion_hierarchy   (E, 2) pairs (parent, child)
    is_part_revolute   (P,)   flags; with is_part_prismatic, too, a part both turns and slides
    is_part_prismatic  (P,)   flags; a part with neither is fixed
    revolute_plucker   (P, 6) axis: see `plucker`; zeros where there is none
    revolute_range     (P, 2) [rad]; a full turn (or more) is a continuous joint: the format has no other way
    prismatic_axis     (P, 3)
    prismatic_range    (P, 2) in units of the frame

A truth, and a prediction as its `evaluate.py` reads it, has `points` (N, 3) and `part_ids` (N,) besides; what
`infer.py` writes has `face_part_ids` (F,) for the faces of the pred.obj beside it.
"""

from __future__ import annotations

import zipfile
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...arrays import FloatArray, IntArray, Vec3, frozen_ints, vec3
from ...errors import BadInputError
from ...mesh import UpAxis, z_up_from
from ..articulation import FULL_TURN, Articulation, Link, LinkJoint
from ..cases import Prediction, Truth
from ..frame import unit_from_object
from ..plucker import lines
from . import DEFAULT_VARIANT, PredictionFormat, TruthFormat
from .files import reading
from .mesh_files import read_triangles

_Arrays = Mapping[str, NDArray[Any]]
_SAME_BOX = 5e-3  # of the longest side; boxes of sampled points fall short by up to this
_NEAREST = (
    "joint origins are the points of the axes that are nearest to the frame's origin: "
    "the format holds lines, not points"
)


class ParticulateTruth(TruthFormat):
    """Point clouds with parts and joints: ROOT/NAME.npz, +Z up, longest side 1."""

    name = "particulate"
    layout = "NAME.npz with points, part_ids and motion_hierarchy"

    def find(self, root: Path) -> dict[str, Path]:
        """The point clouds right in a folder; told from other .npz files by the names of their arrays."""
        if root.is_file():
            return {root.stem: root} if root.suffix == ".npz" and _is_cloud(root) is not False else {}
        kinds = {path: _is_cloud(path) for path in sorted(root.glob("*.npz"))}
        # A damaged one is an object among others of its kind; alone, it may be anything.
        return {
            path.stem: path for path, kind in kinds.items() if kind or (kind is None and any(kinds.values()))
        }

    def read(self, path: Path, variant: str = DEFAULT_VARIANT) -> Truth:
        """Read a point cloud; a part that both turns and slides is revolute, and right as prismatic, too."""
        if variant != DEFAULT_VARIANT:
            raise BadInputError(
                f"{path}: no variant '{variant}': Particulate's truth has '{DEFAULT_VARIANT}' only"
            )
        arrays = _read_arrays(path)
        links = _links(path, arrays)
        for link in links:
            for joint in (link.joint, *link.also):
                if joint.lower is not None and joint.upper is not None and joint.lower > joint.upper:
                    raise BadInputError(
                        f"{path}: range of {link.name} runs from {joint.lower} to {joint.upper}"
                    )
        cloud = _cloud(path, path.stem, arrays, links)
        notes = (_NEAREST,) if any(link.joint.turns for link in links) else ()
        return Truth(path.stem, cloud, up="+z", metres_per_unit=None, notes=notes)


class ParticulatePrediction(PredictionFormat):
    """Predictions of `infer.py --eval`, or point clouds as `evaluate.py` reads them.

    `infer.py` turns its input to +Z up by `--up_dir`, and scales it to a longest side of 1, before it
    predicts. It writes joints in that frame, but pred.obj as the input was. So joints are turned back as if
    `--up_dir` was what the truth says is up; no file tells. A pred.obj that lies in the normalised frame
    itself (and not where the truth is) shares it with the joints: then both are turned back, or left as they
    are where the truth's box says that nothing had been turned.
    """

    name = "particulate"
    layout = "NAME/pred.npz or NAME/eval/pred.npz with pred.obj beside it, or NAME.npz with points"
    knows_frame = True

    def find(self, root: Path, name: str) -> Path | None:
        """The first of NAME/pred.npz, NAME/eval/pred.npz and a NAME.npz with points that there is."""
        folder = root / name
        for path in (folder / "pred.npz", folder / "eval" / "pred.npz"):
            if path.is_file():
                return path
        cloud = root / f"{name}.npz"
        return cloud if cloud.is_file() and _is_cloud(cloud) is not False else None

    def read(self, path: Path, truth: Truth) -> Prediction:
        """Read one and bring it to the frame of the truth; a part that turns and slides is revolute."""
        arrays = _read_arrays(path)
        links = tuple(replace(link, also=()) for link in _links(path, arrays))
        if "face_part_ids" in arrays:
            found = _surface(path, truth.name, arrays, links)
        else:
            found = _cloud(path, truth.name, arrays, links)
        return _in_frame_of(truth, found)


def _is_cloud(path: Path) -> bool | None:
    """Whether an .npz is a point cloud with parts, by the names of its arrays; None of a damaged one."""
    try:
        with zipfile.ZipFile(path) as archive:
            names = archive.namelist()
    except (OSError, zipfile.BadZipFile):
        return None
    return "motion_hierarchy.npy" in names and "part_ids.npy" in names


def _read_arrays(path: Path) -> _Arrays:
    # Opened here: numpy leaves a file that it cannot read open.
    with reading(path, "an .npz archive"), path.open("rb") as file:
        archive = np.load(file, allow_pickle=False)
        if not isinstance(archive, np.lib.npyio.NpzFile):
            raise BadInputError("it is a single array: an .npz archive is needed")
        with archive:
            return {name: archive[name] for name in archive.files}


def _array(path: Path, arrays: _Arrays, name: str, shape: tuple[int, ...]) -> FloatArray:
    """An array of numbers of this shape, -1 for any length."""
    if name not in arrays:
        raise BadInputError(f"{path} has no array '{name}': it has {', '.join(sorted(arrays)) or 'none'}")
    array = arrays[name]
    if array.dtype.kind not in "biuf":
        raise BadInputError(f"{path}: '{name}' holds no numbers")
    fits = len(array.shape) == len(shape) and all(
        n in (-1, m) for n, m in zip(shape, array.shape, strict=True)
    )
    if not fits:
        raise BadInputError(f"{path}: '{name}' has shape {array.shape}, expected {shape} (-1 is any)")
    if not np.isfinite(array).all():
        raise BadInputError(f"{path}: '{name}' holds values that are NaN or infinite")
    return array.astype(np.float64)


def _labels(path: Path, arrays: _Arrays, name: str, count: int, parts: int) -> IntArray:
    """(count,) part ids, each of 0..parts-1."""
    ids = _array(path, arrays, name, (-1,))
    if len(ids) != count:
        raise BadInputError(f"{path}: '{name}' has {len(ids)} values for {count} faces or points")
    if count and not ((ids >= 0) & (ids < parts) & (ids % 1 == 0)).all():
        raise BadInputError(f"{path}: '{name}' holds ids that are none of 0..{parts - 1}")
    return frozen_ints(ids)


def _cloud(path: Path, name: str, arrays: _Arrays, links: tuple[Link, ...]) -> Articulation:
    points = _array(path, arrays, "points", (-1, 3))
    labels = _labels(path, arrays, "part_ids", len(points), len(links))
    with reading(path, "a point cloud with parts"):
        return Articulation(name, points, frozen_ints(np.zeros((0, 3))), labels, links)


def _surface(path: Path, name: str, arrays: _Arrays, links: tuple[Link, ...]) -> Articulation:
    vertices, faces = read_triangles(path.with_suffix(".obj"))
    labels = _labels(path, arrays, "face_part_ids", len(faces), len(links))
    with reading(path, "parts of a mesh"):
        return Articulation(name, vertices, faces, labels, links)


def _links(path: Path, arrays: _Arrays) -> tuple[Link, ...]:
    """A link a part; one that both turns and slides is revolute, with the slide in `also`."""
    turns = _array(path, arrays, "is_part_revolute", (-1,)).astype(bool)
    count = len(turns)
    slides = _array(path, arrays, "is_part_prismatic", (count,)).astype(bool)
    axes, points = lines(_array(path, arrays, "revolute_plucker", (count, 6)))
    angles = _array(path, arrays, "revolute_range", (count, 2))
    directions = _array(path, arrays, "prismatic_axis", (count, 3))
    ways = _array(path, arrays, "prismatic_range", (count, 2))
    links = []
    for index, parent in enumerate(_parents(path, arrays, count)):
        name = f"part_{index}"
        joints = []
        with reading(path, "joints"):
            if turns[index]:
                joints.append(_turn(name, vec3(axes[index]), vec3(points[index]), angles[index]))
            if slides[index]:
                lower, upper = (float(v) for v in ways[index])
                joints.append(LinkJoint("prismatic", vec3(directions[index]), None, lower, upper, name))
        joint = joints[0] if joints else LinkJoint(name=name)
        links.append(Link(name, parent, joint, tuple(joints[1:])))
    return tuple(links)


def _turn(name: str, axis: Vec3, origin: Vec3, limits: FloatArray) -> LinkJoint:
    lower, upper = (float(v) for v in limits)
    if upper - lower >= FULL_TURN:
        return LinkJoint("continuous", axis, origin, lower, upper, name)
    return LinkJoint("revolute", axis, origin, lower, upper, name)


def _parents(path: Path, arrays: _Arrays, count: int) -> list[int]:
    """For each part, the one that carries it; -1 for a root."""
    name = "motion_hierarchy"
    none = name in arrays and arrays[name].size == 0  # numpy gives an empty list of pairs the shape (0,)
    pairs = np.zeros((0, 2)) if none else _array(path, arrays, name, (-1, 2))
    parents = [-1] * count
    for parent, child in np.unique(pairs, axis=0).tolist():
        if not {parent, child} <= set(range(count)):
            raise BadInputError(f"{path}: '{name}' pairs {parent:g} with {child:g}: parts are 0..{count - 1}")
        if parents[int(child)] >= 0:
            raise BadInputError(f"{path}: '{name}' gives part {child:g} two parents")
        parents[int(child)] = int(parent)
    return parents


def _in_frame_of(truth: Truth, found: Articulation) -> Prediction:
    """Bring geometry and joints to the truth's frame: see `ParticulatePrediction`."""
    unit_T_found, unit_T_truth = (unit_from_object(a.bounds) for a in (found, truth.articulation))
    truth_T_unit = np.linalg.inv(unit_T_truth)
    back = _rotation(z_up_from(truth.up).T)
    in_place = _apart(found.bounds, truth.articulation.bounds) < _SAME_BOX
    normalised = _apart(found.bounds, _turned(np.eye(4), found.bounds)) < _SAME_BOX
    if found.is_cloud and in_place:
        return Prediction(found, notes=("points and joints lie in the truth's frame",))
    if found.is_cloud or (normalised and not in_place):
        target = _turned(np.eye(4), truth.articulation.bounds)
        turn = min((back, np.eye(4)), key=lambda way: _apart(_turned(way, found.bounds), target))
        how = f"turned from +z up to {truth.up} up" if turn is back else "not turned: that fits better"
        return Prediction(
            found.transformed(truth_T_unit @ turn @ unit_T_found),
            notes=(f"geometry and joints, of one normalised frame, fitted to the truth's box, {how}",),
        )
    truth_T_found = np.eye(4) if in_place else truth_T_unit @ unit_T_found
    truth_T_joints = truth_T_found @ np.linalg.inv(unit_T_found) @ back
    where = "lies in the truth's frame" if in_place else "was fitted to the truth's box"
    notes = (f"pred.obj {where}; joints turned back as if from {_option(truth.up)}",)
    still = tuple(replace(link, joint=LinkJoint()) for link in found.links)
    moved = replace(found, links=still).transformed(truth_T_found)
    links = tuple(replace(link, joint=link.joint.transformed(truth_T_joints)) for link in found.links)
    return Prediction(replace(moved, links=links), notes=notes)


def _option(up: UpAxis) -> str:
    """How `infer.py` was told of an up axis: "+y" is "--up_dir Y"."""
    return f"--up_dir {up.removeprefix('+').upper()}"


def _rotation(turn: FloatArray) -> FloatArray:
    matrix = np.eye(4)
    matrix[:3, :3] = turn
    return matrix


def _turned(turn: FloatArray, bounds: FloatArray) -> FloatArray:
    """The (2, 3) box, brought to the unit frame and turned by quarter turns (4, 4)."""
    matrix = turn @ unit_from_object(bounds)
    corners = bounds @ matrix[:3, :3].T + matrix[:3, 3]
    return np.array([corners.min(axis=0), corners.max(axis=0)])


def _apart(bounds: FloatArray, target: FloatArray) -> float:
    """Largest distance between the sides of two (2, 3) boxes, over the longest side of the second."""
    return float(np.abs(bounds - target).max() / (target[1] - target[0]).max())
