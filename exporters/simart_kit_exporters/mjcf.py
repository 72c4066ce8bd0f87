"""MJCF: NAME.xml and assets/, with relative paths only, written through MuJoCo's own model editor."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from pydantic import Field

from simart_kit.asset import Asset
from simart_kit.bake import textured_surfaces
from simart_kit.errors import BadInputError
from simart_kit.hookspecs import Register, hookimpl
from simart_kit.kinematics import rest_origin
from simart_kit.stages import Exporter
from simart_kit.stages import Options as StageOptions

from .mjcf_bodies import add_bodies, set_inertial
from .mjcf_flavors import FLAVORS, FlavorName
from .mjcf_gaps import gaps
from .mjcf_looks import add_materials
from .mjcf_model import Model, empty_model
from .mjcf_robosuite import add_object, body_names, spelled_out
from .mjcf_shapes import add_collision, add_visual
from .mjz import pack
from .overlaps import overlapping_parts
from .sheets import backed, is_speck

if TYPE_CHECKING:
    import mujoco


class Mjcf(Exporter):
    """Writes MJCF with `visual` and `collision` classes, as MuJoCo Menagerie or robosuite have it."""

    name = "mjcf"

    class Options(StageOptions):
        """How MJCF is written."""

        flavor: FlavorName = Field(
            default="menagerie",
            description="Whose customs to follow in classes, groups and names; robosuite's objects also have "
            "a body `object`, and sites and a region for their bounds.",
        )
        single_file: bool = Field(
            default=False, description="Write one archive NAME.mjz, which MjSpec.from_file reads."
        )
        timestep: float = Field(default=0.002, gt=0, description="Simulation step [s].")

    options: Options

    def export(self, asset: Asset, directory: Path) -> Path:
        """Write the folder; returns NAME.xml, or NAME.mjz.

        Raises:
            BadInputError: MuJoCo refuses it, as where it cannot find the mass of a part by itself.
        """
        model = empty_model(asset.name, FLAVORS[self.options.flavor], self.options.timestep, directory)
        bodies = _add_bodies(model, asset)
        _add_shapes(model, asset, bodies)
        _add_excludes(model, asset, bodies)
        path = directory / f"{asset.name}.xml"
        text = _text(model, asset)
        path.write_text(spelled_out(text) if model.flavor.wrapped else text, encoding="utf-8")
        return pack(path) if self.options.single_file else path

    def unsupported(self, asset: Asset) -> tuple[str, ...]:
        """See `gaps`."""
        return gaps(asset, FLAVORS[self.options.flavor])


def _text(model: Model, asset: Asset) -> str:
    try:
        text: str = model.spec.to_xml()
    except ValueError as error:
        said = str(error).partition("\n")[0].removeprefix("Error: ")
        massless = [part.name for part in asset.parts if part.mass is None]
        advice = f"; no mass is given for {', '.join(massless)}: add the modifier mass" if massless else ""
        raise BadInputError(f"MuJoCo does not take {asset.name}: {said}{advice}") from error
    return text


def _add_bodies(model: Model, asset: Asset) -> dict[str, mujoco.MjsBody]:
    if model.flavor.wrapped:
        return add_bodies(add_object(model.spec, asset), asset, body_names(asset), free=False)
    return add_bodies(model.spec.worldbody, asset, {part.name: part.name for part in asset.parts})


def _add_shapes(model: Model, asset: Asset, bodies: dict[str, mujoco.MjsBody]) -> None:
    """Add mass, drawn and solid shapes to the bodies."""
    surfaces = textured_surfaces(asset)
    drawn = {part: [backed(s) for s in group if not is_speck(s)] for part, group in surfaces.items()}
    materials = add_materials(model, (surface for group in drawn.values() for surface in group))
    for part in asset.parts:
        body, origin = bodies[part.name], rest_origin(asset, part.name)
        if part.mass:
            set_inertial(body, part.mass, origin)
        for surface in drawn[part.name]:
            add_visual(model, body, surface, materials[surface.material])
        add_collision(model, body, part, origin)


def _add_excludes(model: Model, asset: Asset, bodies: dict[str, mujoco.MjsBody]) -> None:
    """Rule out contact of overlapping pairs; the name of each says why, a comment how deep."""
    overlaps = overlapping_parts(asset)
    for (first, second), overlap in overlaps.items():
        model.spec.add_exclude(
            name=f"{first}_{second}_{'at_rest' if overlap.at_rest else 'on_the_way'}",
            bodyname1=bodies[first].name,
            bodyname2=bodies[second].name,
        )
    if overlaps:
        words = ", ".join(overlap.words(*pair) for pair, overlap in overlaps.items())
        model.spec.comment = f"No contact between parts whose shapes overlap: {words}"


@hookimpl
def register_exporters(register: Register) -> None:
    """Offer MJCF."""
    register(Mjcf)
