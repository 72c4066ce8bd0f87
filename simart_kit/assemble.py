"""From labels and joints to an Asset: names cleaned, labels checked, loose parts fixed to the body."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from .arrays import FloatArray, frozen_ints
from .asset import Asset, Joint, Part, clean_name, unique_names
from .evidence import check_evidence
from .mesh import Mesh, Note
from .physics import DEFAULT_MATERIAL, MATERIALS
from .stages import PartGuess, Prediction, Segmentation

if TYPE_CHECKING:
    from .evidence import Evidence
    from .usage import ModelUsage

# How much bounds and area of a cut mesh may differ from the whole one, as a share.
_SAME = 1e-5


def checked(segmentation: Segmentation, mesh: Mesh) -> Segmentation:
    """The segmentation with clean, unique names; joint hints follow the new names.

    Args:
        segmentation: what a segmenter returned.
        mesh: the mesh that it was given.

    Raises:
        ValueError: a mesh of its own that is not the same surface, labels of a wrong dtype, shape or range,
            guesses that do not match them, or evidence that is not of this mesh.
    """
    if not isinstance(segmentation, Segmentation):
        raise ValueError(f"returned {type(segmentation).__name__}, expected a simart_kit.Segmentation")
    if segmentation.mesh is not None:
        _check_surface(segmentation.mesh, mesh)
        mesh = segmentation.mesh
    labels = np.asarray(segmentation.face_part)
    if not np.issubdtype(labels.dtype, np.integer):
        raise ValueError(f"face_part has dtype {labels.dtype}, expected int32")
    if labels.shape != (len(mesh.faces),):
        raise ValueError(
            f"face_part has shape {labels.shape}, expected ({len(mesh.faces)},): one label a face"
        )
    count = len(segmentation.parts)
    used = np.unique(labels)
    if not np.array_equal(used, np.arange(count)):
        shown = ", ".join(map(str, used[:10].tolist()))
        raise ValueError(f"face_part uses ids {shown} for {count} parts, expected each of 0..{count - 1}")
    check_evidence(segmentation.evidence, len(mesh.vertices))
    old = [p.name for p in segmentation.parts]
    new = unique_names([clean_name(name) for name in old])
    hints = segmentation.joints
    if hints is not None:
        renamed = dict(zip(old, new, strict=True))
        hints = tuple(
            replace(j, parent=renamed.get(j.parent, j.parent), child=renamed.get(j.child, j.child))
            for j in hints
        )
    return replace(
        segmentation,
        face_part=frozen_ints(labels),
        parts=tuple(replace(p, name=n) for p, n in zip(segmentation.parts, new, strict=True)),
        joints=hints,
    )


def _check_surface(cut: Mesh, given: Mesh) -> None:
    """Refuse a cut mesh that is not the surface that was given, in the same place and with the same looks."""
    if not isinstance(cut, Mesh):
        raise ValueError(f"mesh is a {type(cut).__name__}, expected a simart_kit.Mesh or None")
    off = float(np.abs(cut.bounds - given.bounds).max())
    if off > _SAME * given.diagonal:
        raise ValueError(f"mesh is no cut of the one given: its bounds are {off:.3g} m off")
    area, expected = float(cut.face_areas.sum()), float(given.face_areas.sum())
    if abs(area - expected) > _SAME * expected:
        raise ValueError(f"mesh is no cut of the one given: its area is {area:.6g} m2, not {expected:.6g} m2")
    lost = [name for name in ("normals", "uv", "colors", "face_node") if _has(given, name) > _has(cut, name)]
    if lost or len(cut.materials) != len(given.materials):
        raise ValueError(f"mesh is no cut of the one given: it lost {', '.join(lost) or 'materials'}")
    if (cut.up, cut.metres_per_unit) != (given.up, given.metres_per_unit):
        raise ValueError("mesh is no cut of the one given: its up axis or unit differs")


def _has(mesh: Mesh, name: str) -> bool:
    return getattr(mesh, name) is not None


@dataclass(frozen=True, eq=False)
class Articulation:
    """What the joints stage leaves.

    Attributes:
        asset: the parts with their joints.
        evidence: how the joints came about, for the recording.
        usage: what that took of models that were asked.
    """

    asset: Asset
    evidence: tuple[Evidence, ...] = ()
    usage: tuple[ModelUsage, ...] = ()


def articulation(asset: Asset, said: Prediction) -> Articulation:
    """An assembled asset with what its joint predictor tells beside its joints.

    Raises:
        ValueError: evidence that is not of the asset's mesh.
    """
    check_evidence(said.evidence, len(asset.mesh.vertices))
    return Articulation(replace(asset, notes=asset.notes + said.notes), said.evidence, said.usage)


def assemble(
    name: str,
    mesh: Mesh,
    segmentation: Segmentation,
    joints: Sequence[Joint],
    asset_from_source: FloatArray,
    floating: bool = False,
) -> Asset:
    """Put an Asset together; parts that no joint moves are fixed to the body.

    The body is the largest part (by area) that no joint moves.

    Args:
        name: of the asset.
        mesh: the one that the segmenter was given; the asset holds the cut one where there is one.
        segmentation: as `checked` returns it.
        joints: of its parts.
        asset_from_source: (4, 4) from the file's coordinates [m].
        floating: whether the base is free.

    Raises:
        BadInputError: joints that name unknown parts or are not a tree.
    """
    surface = segmentation.mesh_of(mesh)
    children = {j.child for j in joints}
    still = [i for i, p in enumerate(segmentation.parts) if p.name not in children]
    areas = np.bincount(segmentation.face_part, surface.face_areas, minlength=len(segmentation.parts))
    body = segmentation.parts[max(still, key=lambda i: areas[i])] if still else segmentation.parts[0]
    loose = [segmentation.parts[i] for i in still if segmentation.parts[i] is not body]
    fixed = [Joint(f"{p.name}_mount", "fixed", body.name, p.name) for p in loose]
    unknown = sorted({p.material for p in segmentation.parts} - set(MATERIALS))
    texts = [f"material '{m}' is not in the table: {DEFAULT_MATERIAL} is used" for m in unknown]
    return Asset(
        name=name,
        mesh=replace(surface, notes=()),
        face_part=segmentation.face_part,
        parts=tuple(_part(guess) for guess in segmentation.parts),
        joints=(*joints, *fixed),
        asset_from_source=asset_from_source,
        floating=floating,
        notes=mesh.notes + segmentation.notes + tuple(Note("assemble", "warning", t) for t in texts),
    )


def _part(guess: PartGuess) -> Part:
    material = MATERIALS.get(guess.material, MATERIALS[DEFAULT_MATERIAL])
    return Part(
        guess.name,
        label=guess.label,
        description=guess.description,
        material=material,
        stated_mass=guess.mass,
    )
