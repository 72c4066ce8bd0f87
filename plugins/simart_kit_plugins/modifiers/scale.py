"""`scale`: decides the real size of an asset."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
from pydantic import Field, model_validator

import simart_kit as sk
from simart_kit.arrays import FloatArray, frozen_floats, mat3, vec3
from simart_kit.asset import ConvexMesh, Joint, Limits, MassProperties, Part
from simart_kit.errors import BadInputError
from simart_kit.hookspecs import Register

# What a file's numbers were multiplied by in mistake, undone; in the order of how common the mistake is.
_SLIPS = {
    "millimetres taken for metres": 0.001,
    "centimetres taken for metres": 0.01,
    "metres taken for millimetres": 1000.0,
    "metres taken for centimetres": 100.0,
    "inches taken for metres": 0.0254,
    "metres taken for inches": 1 / 0.0254,
}


# Diagonals [m] with which shapes, clearances and solvers still work.
_LEAST, _MOST = 0.001, 1000.0


class Scale(sk.Modifier):
    """Trust the file's metres if the object is then of a plausible size, else undo a unit slip."""

    name = "scale"

    class Options(sk.Options):
        """Without `height` and `factor` the size is decided automatically."""

        height: float | None = Field(None, gt=0, allow_inf_nan=False, description="real height [m]")
        factor: float | None = Field(
            None, gt=0, allow_inf_nan=False, description="factor on the metres of the file"
        )
        smallest: float = Field(0.02, gt=0, description="smallest plausible bounding box diagonal [m]")
        largest: float = Field(8.0, gt=0, description="largest plausible bounding box diagonal [m]")

        @model_validator(mode="after")
        def _consistent(self) -> Scale.Options:
            if self.height is not None and self.factor is not None:
                raise ValueError(f"height {self.height:g} m and factor {self.factor:g}: give one, not both")
            if not self.smallest < self.largest:
                raise ValueError(f"smallest {self.smallest:g} m must be below largest {self.largest:g} m")
            return self

    options: Options

    def modify(self, asset: sk.Asset) -> sk.Asset:
        """The asset in its real size, with `scale` saying why.

        Raises:
            BadInputError: nobody could simulate an object of the size that is asked for.
        """
        factor, reason, sure = self._decide(asset)
        total = sk.Scale(asset.scale.factor * factor, reason)
        return replace(scaled(asset, factor), scale=total).with_notes(
            "scale", "info" if sure else "warning", [reason]
        )

    def _decide(self, asset: sk.Asset) -> tuple[float, str, bool]:
        """Factor, reason, and whether it is more than a guess."""
        diagonal, options = asset.mesh.diagonal, self.options
        if options.factor is not None:
            factor, why = options.factor, f"factor {options.factor:g} as asked"
            return self._asked(diagonal, factor, f"{why}: the diagonal is now {diagonal * factor:.3g} m")
        if options.height is not None:
            height = float(asset.mesh.bounds[1, 2] - asset.mesh.bounds[0, 2])
            if not height > 0:
                raise BadInputError("the object is flat on the ground: give scale's factor, not height")
            why = f"height {options.height:g} m as asked, {height:.3g} m in the file"
            factor = options.height / height
            return self._asked(diagonal, factor, f"{why}: factor {factor:.4g}")
        plausible = self._plausible
        if options.smallest <= diagonal <= options.largest:
            return 1.0, f"the file's metres: its diagonal of {diagonal:.3g} m is plausible {plausible}", True
        said = f"a diagonal of {diagonal:.3g} m is implausible {plausible}"
        slip = self._slip(diagonal)
        if slip is None:
            return 1 / diagonal, f"{said}, as with any usual unit: scaled to a diagonal of 1 m", False
        factor = _SLIPS[slip]
        told = f"{said}: {slip}? scaled by {factor:.4g} to {diagonal * factor:.3g} m (--scale 1 leaves it)"
        return factor, told, False

    @property
    def _plausible(self) -> str:
        return f"({self.options.smallest:g} to {self.options.largest:g} m)"

    def _asked(self, diagonal: float, factor: float, reason: str) -> tuple[float, str, bool]:
        """A factor that the user gave, unless it is one that nothing can be done with."""
        size = diagonal * factor
        if not _LEAST <= size <= _MOST:
            raise BadInputError(
                f"the object would have a diagonal of {size:.4g} m, and simulators take {_LEAST:g} to "
                f"{_MOST:g} m: check scale's height or factor (--height is in metres, --scale a factor)"
            )
        if self.options.smallest <= size <= self.options.largest:
            return factor, reason, True
        told = f"{reason}; a diagonal of {size:.3g} m is unusual {self._plausible}: is it meant?"
        return factor, told, False

    def _slip(self, diagonal: float) -> str | None:
        """The unit slip that explains a diagonal [m]: metric before inches, then nearest to 1 m."""
        fits = [
            (("inches" in slip), abs(math.log(diagonal * factor)), slip)
            for slip, factor in _SLIPS.items()
            if self.options.smallest <= diagonal * factor <= self.options.largest
        ]
        return min(fits)[2] if fits else None


def scaled(asset: sk.Asset, factor: float) -> sk.Asset:
    """The asset with all lengths multiplied about the frame's origin; densities stay."""
    if factor == 1.0:
        return asset
    matrix = np.diag([factor, factor, factor, 1.0])
    return replace(
        asset,
        mesh=asset.mesh.transformed(matrix),
        parts=tuple(_part(part, factor) for part in asset.parts),
        joints=tuple(_joint(joint, factor) for joint in asset.joints),
        asset_from_source=frozen_floats(matrix @ asset.asset_from_source),
    )


def _part(part: Part, factor: float) -> Part:
    mass = _mass(part.mass, factor, part.stated_mass is not None) if part.mass else None
    return replace(part, collision=tuple(_shape(shape, factor) for shape in part.collision), mass=mass)


def _shape(shape: ConvexMesh, factor: float) -> ConvexMesh:
    primitive = shape.primitive
    if primitive is not None:
        pose = np.array(primitive.asset_T_shape)
        pose[:3, 3] *= factor
        primitive = replace(primitive, size=vec3(np.array(primitive.size) * factor), asset_T_shape=pose)
    return replace(shape, vertices=shape.vertices * factor, primitive=primitive)


def _mass(mass: MassProperties, factor: float, stated: bool) -> MassProperties:
    """Of a body of the same density, or of the same mass where that is stated."""
    heavier = 1.0 if stated else factor**3
    inertia: FloatArray = np.array(mass.inertia) * heavier * factor**2
    center = vec3(np.array(mass.center) * factor)
    return replace(mass, mass=mass.mass * heavier, center=center, inertia=mat3(inertia))


def _joint(joint: Joint, factor: float) -> Joint:
    limits = joint.limits
    if limits and joint.kind == "prismatic":
        limits = Limits(limits.lower * factor, limits.upper * factor)
    return replace(joint, origin=vec3(np.array(joint.origin) * factor), limits=limits)


@sk.hookimpl
def register_modifiers(register: Register) -> None:
    """Register the modifier."""
    register(Scale)
