"""`mass`: mass, centre and inertia of every part, by its material."""

from __future__ import annotations

import math
from dataclasses import replace

from pydantic import Field

import simart_kit as sk
from simart_kit.hookspecs import Register
from simart_kit.materials import Build, build_of
from simart_kit.physics import MIN_MASS, as_stated, weigh
from simart_kit.solids import Solid, solid

_MOSTLY = 0.5  # share of a part's volume that open surfaces stand for, above which its mass is doubtful


class Mass(sk.Modifier):
    """Weigh every part by what its surface bounds and by its material."""

    name = "mass"

    class Options(sk.Options):
        """What the surface does not say."""

        density: float | None = Field(
            None,
            gt=0,
            allow_inf_nan=False,
            description="of all parts [kg/m^3]; without it, that of each part's material",
        )
        thickness: float | None = Field(
            None,
            gt=0,
            le=1,
            description="of boards drawn as one open surface, and of walls [m]; "
            "without it, what is usual for each part's material",
        )
        hollow: bool = Field(
            True,
            description="whether closed shapes too thick to be solid have walls only, see docs/physics.md",
        )

    options: Options

    def modify(self, asset: sk.Asset) -> sk.Asset:
        """The asset with mass properties."""
        vertices, faces = asset.mesh.vertices, asset.mesh.faces
        bodies = {
            part.name: solid(vertices, faces[asset.face_part == index], self._build(part))
            for index, part in enumerate(asset.parts)
        }
        weighed = asset.with_parts(
            {part.name: self._weighed(part, bodies[part.name]) for part in asset.parts}
        )
        return weighed.with_notes("mass", "info", [_summary(weighed)]).with_notes(
            "mass", "warning", _doubts(weighed, bodies)
        )

    def _build(self, part: sk.Part) -> Build:
        usual = build_of(part.material)
        return Build(
            self.options.thickness or usual.wall, usual.solid_up_to if self.options.hollow else math.inf
        )

    def _weighed(self, part: sk.Part, body: Solid) -> sk.Part:
        mass = weigh(body, self.options.density or part.material.density)
        if part.stated_mass is not None:
            mass = as_stated(mass, part.stated_mass)
        return replace(part, mass=mass)


def _summary(asset: sk.Asset) -> str:
    return "; ".join(f"{p.name} {p.mass.mass:.3g} kg ({p.mass.method})" for p in asset.parts if p.mass)


def _doubts(asset: sk.Asset, bodies: dict[str, Solid]) -> list[str]:
    unknown = [p for p in asset.parts if p.stated_mass is None]
    tiny = [p.name for p in unknown if p.mass and p.mass.mass <= MIN_MASS]
    guessed = [p.name for p in unknown if bodies[p.name].guessed > _MOSTLY and p.name not in tiny]
    texts = {
        f"too small to weigh, {MIN_MASS * 1000:g} g assumed: {', '.join(tiny)}": tiny,
        f"open surfaces, so their masses are guesses: {', '.join(guessed)}": guessed,
    }
    return [text for text, names in texts.items() if names]


@sk.hookimpl
def register_modifiers(register: Register) -> None:
    """Register the modifier."""
    register(Mass)
