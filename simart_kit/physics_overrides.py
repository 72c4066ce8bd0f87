"""`[physics]` of a recipe: what a person knows better about materials and parts."""

from __future__ import annotations

import difflib
from dataclasses import replace
from fnmatch import fnmatchcase

from pydantic import BaseModel, ConfigDict, Field, model_validator

from .asset import Asset, Material, Part
from .materials import DEFAULT_MATERIAL, MATERIALS

_STRICT = ConfigDict(extra="forbid", frozen=True, strict=True)


class MaterialChange(BaseModel):
    """Properties of a material; those left out stay as in the table."""

    model_config = _STRICT
    density: float | None = Field(default=None, gt=0, allow_inf_nan=False, description="[kg/m^3].")
    friction: float | None = Field(
        default=None, ge=0, allow_inf_nan=False, description="Sliding friction coefficient."
    )
    restitution: float | None = Field(default=None, ge=0, le=1, description="0 (no bounce) .. 1.")
    youngs_modulus: float | None = Field(
        default=None, gt=0, allow_inf_nan=False, description="Stiffness [Pa]."
    )


class PartChange(BaseModel):
    """What parts are made of or weigh; what is left out stays."""

    model_config = _STRICT
    material: str | None = Field(default=None, description="Key of the material table or of `materials`.")
    density: float | None = Field(default=None, gt=0, allow_inf_nan=False, description="[kg/m^3].")
    friction: float | None = Field(
        default=None, ge=0, allow_inf_nan=False, description="Sliding friction coefficient."
    )
    restitution: float | None = Field(default=None, ge=0, le=1, description="0 (no bounce) .. 1.")
    mass: float | None = Field(
        default=None, gt=0, allow_inf_nan=False, description="Of each such part [kg], whatever its volume."
    )


class PhysicsTable(BaseModel):
    """Physical properties that a recipe states: they win over the material table and over the segmenter.

    A name in `materials` that is not in the table makes a new material, which needs a density. A part takes
    the changes of all patterns that match its name, the later ones winning.
    """

    model_config = _STRICT
    materials: dict[str, MaterialChange] = Field(
        default_factory=dict, description="Changed and new materials by name."
    )
    parts: dict[str, PartChange] = Field(
        default_factory=dict, description='Changes by part name or glob, such as `"drawer_*"`.'
    )

    @model_validator(mode="after")
    def _known(self) -> PhysicsTable:
        known = set(MATERIALS) | set(self.materials)
        mistakes = [
            f"material '{name}' is new and needs a density"
            for name, change in self.materials.items()
            if name not in MATERIALS and change.density is None
        ]
        mistakes += [
            f"part '{pattern}': unknown material '{change.material}'{_alternatives(change.material, known)}"
            for pattern, change in self.parts.items()
            if change.material is not None and change.material not in known
        ]
        if mistakes:
            raise ValueError("; ".join(mistakes))
        return self


def overridden(asset: Asset, table: PhysicsTable) -> Asset:
    """The asset with materials and stated masses as a table says; patterns that match no part are told."""
    if not (table.materials or table.parts):
        return asset
    materials = _materials(table)
    changed = {part.name: _changed(part, table, materials) for part in asset.parts}
    texts = [f"{part.name}: {told}" for part in asset.parts if (told := _told(part, changed[part.name]))]
    names = [part.name for part in asset.parts]
    idle = [pattern for pattern in table.parts if not any(fnmatchcase(name, pattern) for name in names)]
    warnings = [f"no part matches '{pattern}': parts are {', '.join(names)}" for pattern in idle]
    result = asset.with_parts(changed)
    return result.with_notes("physics", "info", texts).with_notes("physics", "warning", warnings)


def _materials(table: PhysicsTable) -> dict[str, Material]:
    """The material table with the changes of a recipe."""
    base = MATERIALS[DEFAULT_MATERIAL]
    changes = {
        name: replace(MATERIALS.get(name, base), name=name, **change.model_dump(exclude_none=True))
        for name, change in table.materials.items()
    }
    return MATERIALS | changes


def _changed(part: Part, table: PhysicsTable, materials: dict[str, Material]) -> Part:
    """The part as the patterns that match its name say, one after the other."""
    # A material that the recipe does not change stays the part's own, also one of no table.
    material = materials[part.material.name] if part.material.name in table.materials else part.material
    mass = part.stated_mass
    for pattern, change in table.parts.items():
        if not fnmatchcase(part.name, pattern):
            continue
        if change.material is not None:
            material = materials[change.material]
        values = change.model_dump(exclude_none=True, exclude={"material", "mass"})
        material = replace(material, **values)
        mass = change.mass if change.mass is not None else mass
    return replace(part, material=material, stated_mass=mass)


def _told(before: Part, after: Part) -> str:
    """What changed, in words; "" when nothing did."""
    old, new = before.material, after.material
    texts = [new.name] if new.name != old.name else []
    if new.density != old.density:
        texts.append(f"{new.density:g} kg/m3")
    if new.friction != old.friction:
        texts.append(f"friction {new.friction:g}")
    if new.restitution != old.restitution:
        texts.append(f"restitution {new.restitution:g}")
    if new.youngs_modulus != old.youngs_modulus:
        texts.append(f"Young's modulus {new.youngs_modulus:g} Pa")
    if after.stated_mass is not None and after.stated_mass != before.stated_mass:
        texts.append(f"{after.stated_mass:g} kg")
    return f"{', '.join(texts)} as the recipe states" if texts else ""


def _alternatives(name: str, known: set[str]) -> str:
    near = difflib.get_close_matches(name, known, 1)
    guess = f", did you mean '{near[0]}'?" if near else ":"
    return f"{guess} known are {', '.join(sorted(known))}"
