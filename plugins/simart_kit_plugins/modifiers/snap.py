"""Modifier `snap`: turn joint axes that are nearly along the geometry exactly along it."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
from pydantic import Field

import simart_kit
from simart_kit import Modifier, hookimpl
from simart_kit.arrays import vec3
from simart_kit.topology import unique_rows

# Narrow: a door that stands ajar must not pull the cabinet's own direction towards it.
_SAME_DIRECTION = np.deg2rad(0.5)

if TYPE_CHECKING:
    from simart_kit import Asset
    from simart_kit.arrays import FloatArray
    from simart_kit.hookspecs import Register


class Snap(Modifier):
    """Axes within an angle of a main direction of the surface take that direction, wheels' all one sense."""

    name = "snap"
    corrects_joints = True

    class Options(simart_kit.Options):
        """How near is near."""

        angle: float = Field(default=8.0, gt=0, le=45, description="Largest turn of an axis [degrees].")
        share: float = Field(
            default=0.05,
            gt=0,
            le=1,
            description="Share of the surface that a main direction needs to face along it.",
        )

    options: Options

    def modify(self, asset: Asset) -> Asset:
        """The asset with snapped axes; a note for each that changed."""
        directions = main_directions(asset.mesh.face_normals, asset.mesh.face_areas, self.options.share)
        changed, told = {}, []
        for joint in asset.joints:
            if joint.kind not in ("revolute", "continuous", "prismatic"):
                continue
            axis = np.array(joint.axis)
            along = directions @ axis
            best = int(np.abs(along).argmax())
            angle = float(np.degrees(np.arccos(np.clip(abs(along[best]), 0, 1))))
            if 1e-4 < angle <= self.options.angle:
                axis = directions[best] * np.sign(along[best])
                if angle > 0.01:
                    told.append(f"{joint.name}: axis turned by {angle:.2f} degrees onto the geometry")
            if joint.kind == "continuous":
                axis = one_sense(axis)
            changed[joint.name] = replace(joint, axis=vec3(axis))
        return asset.with_joints(changed).with_notes("snap", "info", told)


def one_sense(axis: FloatArray) -> FloatArray:
    """(3,) the axis or its opposite, so that one command drives all wheels of a car the same way."""
    return np.asarray(axis * np.sign(axis[np.abs(axis).argmax()]))


def main_directions(normals: FloatArray, areas: FloatArray, share: float) -> FloatArray:
    """(N, 3) unit directions that at least `share` of the area faces, either way; +z is always one.

    Args:
        normals: (F, 3) unit.
        areas: (F,).
        share: 0..1.
    """
    # Opposite faces share a direction: fold onto the half space where the largest component is positive.
    largest = np.take_along_axis(normals, np.abs(normals).argmax(axis=1)[:, None], axis=1)
    folded = normals * np.sign(largest)
    _, cell = unique_rows(np.round(folded / _SAME_DIRECTION).astype(np.int64))
    weights = np.bincount(cell, areas)
    found = [np.array([0.0, 0.0, 1.0])]
    for fullest in np.argsort(-weights, kind="stable")[: int(2 / share)]:
        seed = folded[np.flatnonzero(cell == fullest)[0]]
        near = folded @ seed >= np.cos(_SAME_DIRECTION)
        if areas[near].sum() >= share * areas.sum():
            mean = areas[near] @ folded[near]
            found.append(_clean(mean / np.linalg.norm(mean)))
    return np.array(found)


def _clean(direction: FloatArray) -> FloatArray:
    """Exactly along a coordinate axis when a quarter of a degree from it: faces are seldom truer."""
    axis = np.where(np.abs(direction) < np.sin(_SAME_DIRECTION / 2), 0.0, direction)
    return np.asarray(axis / np.linalg.norm(axis))


@hookimpl
def register_modifiers(register: Register) -> None:
    """Register `snap`."""
    register(Snap)
