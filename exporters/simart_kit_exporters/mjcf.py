"""MJCF: NAME.xml and assets/, with relative paths only, written through MuJoCo's own model editor."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING

from pydantic import Field

from simart_kit.asset import Asset, Part, clean_name, unique_names
from simart_kit.bake import textured_surfaces
from simart_kit.hookspecs import Register, hookimpl
from simart_kit.kinematics import rest_origin
from simart_kit.mesh import VisualMaterial
from simart_kit.stages import Exporter
from simart_kit.stages import Options as StageOptions
from simart_kit.surfaces import Surface, asset_surfaces

from .gaps import joined, look_gaps, rigid
from .mjcf_bodies import add_bodies, set_inertial
from .obj_files import srgb_color, write_hull, write_surface, write_texture
from .overlaps import overlapping_parts, told
from .sheets import backed, backed_hull, is_speck

if TYPE_CHECKING:
    import mujoco

_FOLDER = "assets"
_TORSIONAL, _ROLLING = 0.005, 0.0001  # MuJoCo's own defaults [m]


class Mjcf(Exporter):
    """Writes MJCF with `visual` and `collision` classes, in the layout of MuJoCo Menagerie."""

    name = "mjcf"

    class Options(StageOptions):
        """How MJCF is written."""

        timestep: float = Field(default=0.002, gt=0, description="Simulation step [s].")
        armature: float = Field(
            default=0.001, ge=0, description="Inertia added to joints for stability [kg*m^2 | kg]."
        )

    options: Options

    def export(self, asset: Asset, directory: Path) -> Path:
        """Write the folder; returns NAME.xml."""
        folder = directory / _FOLDER
        folder.mkdir()
        spec = _empty_spec(asset, self.options.timestep)
        spec.modelfiledir = str(directory)
        visual, collision = _add_classes(spec)
        bodies = add_bodies(spec, asset, self.options.armature)
        surfaces = textured_surfaces(asset)
        drawn = {n: [backed(s) for s in group if not is_speck(s)] for n, group in surfaces.items()}
        materials = _add_materials(spec, drawn, folder)
        for part in asset.parts:
            if part.mass:
                set_inertial(bodies[part.name], part.mass, rest_origin(asset, part.name))
            for surface in drawn[part.name]:
                _add_visual(spec, bodies[part.name], visual, surface, materials[surface.material], folder)
            _add_collision(spec, bodies[part.name], collision, asset, part, folder)
        _add_excludes(spec, asset)
        path = directory / f"{asset.name}.xml"
        path.write_text(spec.to_xml(), encoding="utf-8")
        return path

    def unsupported(self, asset: Asset) -> tuple[str, ...]:
        """A sentence for each thing that is lost."""
        moving = [j for j in asset.joints if not rigid(j)]
        groups = asset_surfaces(asset)
        found = (
            ("MJCF has no speed limit of joints: none for", [j.name for j in moving if j.kind != "free"]),
            (
                "a free joint's pose is written against the world",
                [j.name for j in moving if j.kind == "free"],
            ),
            (
                "a joint without travel is written as fixed",
                [j.name for j in asset.joints if rigid(j) and j.moves],
            ),
            (
                "no mass is known: MuJoCo takes it from the shapes at 1000 kg/m^3",
                [p.name for p in asset.parts if p.mass is None],
            ),
            (
                "MuJoCo ignores the transparency of textures",
                [part for part, group in groups.items() if any(s.translucent for s in group)],
            ),
            told(overlapping_parts(asset)),
        )
        restitution = ("MJCF has no restitution: contacts have MuJoCo's default softness",)
        return restitution + joined(found) + look_gaps(groups)


def _empty_spec(asset: Asset, timestep: float) -> mujoco.MjSpec:
    import mujoco

    spec = mujoco.MjSpec()
    spec.modelname = asset.name
    spec.compiler.degree = False
    spec.compiler.meshdir = spec.compiler.texturedir = _FOLDER
    # The file then holds the asset's own numbers, to all digits, instead of what compilation made of them.
    spec.compiler.savecompiled = spec.compiler.savecanonical = False
    spec.option.integrator = mujoco.mjtIntegrator.mjINT_IMPLICITFAST
    spec.option.timestep = timestep
    return spec


def _add_classes(spec: mujoco.MjSpec) -> tuple[mujoco.MjsDefault, mujoco.MjsDefault]:
    import mujoco

    visual = spec.add_default("visual", spec.default)
    visual.geom.contype = visual.geom.conaffinity = 0
    visual.geom.group = 2
    collision = spec.add_default("collision", spec.default)
    collision.geom.group = 3
    collision.geom.condim = 4
    for default in (visual, collision):
        default.geom.type = mujoco.mjtGeom.mjGEOM_MESH
    return visual, collision


def _add_materials(
    spec: mujoco.MjSpec, drawn: Mapping[str, list[Surface]], folder: Path
) -> dict[VisualMaterial, str]:
    """Add every material once; returns their names."""
    looks = list(dict.fromkeys(surface.material for group in drawn.values() for surface in group))
    names = unique_names([clean_name(look.name, "material") for look in looks])
    textures: set[str] = set()
    for look, name in zip(looks, names, strict=True):
        _add_material(spec, look, name, textures, folder)
    return dict(zip(looks, names, strict=True))


def _add_material(
    spec: mujoco.MjSpec, look: VisualMaterial, name: str, textures: set[str], folder: Path
) -> None:
    import mujoco

    material = spec.add_material(
        name=name,
        rgba=srgb_color(look),
        metallic=look.metallic,
        roughness=look.roughness,
        specular=0.5 * (1.0 - look.roughness),
        shininess=1.0 - look.roughness,
    )
    if look.base_color_image is None:
        return
    file = write_texture(look.base_color_image, folder)
    texture = Path(file).stem
    if texture not in textures:
        textures.add(texture)
        # MuJoCo's renderer decodes sRGB textures and never encodes its picture: they would come out dark.
        spec.add_texture(
            name=texture,
            file=file,
            type=mujoco.mjtTexture.mjTEXTURE_2D,
            colorspace=mujoco.mjtColorSpace.mjCOLORSPACE_LINEAR,
        )
    material.textures[mujoco.mjtTextureRole.mjTEXROLE_RGB] = texture


def _add_visual(
    spec: mujoco.MjSpec,
    body: mujoco.MjsBody,
    default: mujoco.MjsDefault,
    surface: Surface,
    material: str,
    folder: Path,
) -> None:
    mesh = _add_mesh(spec, write_surface(surface, folder, with_material=False))
    body.add_geom(default, name=f"{surface.part}_visual_{surface.index}", meshname=mesh, material=material)


def _add_collision(
    spec: mujoco.MjSpec,
    body: mujoco.MjsBody,
    default: mujoco.MjsDefault,
    asset: Asset,
    part: Part,
    folder: Path,
) -> None:
    friction = [part.material.friction, _TORSIONAL, _ROLLING]
    origin = rest_origin(asset, part.name)
    for index, hull in enumerate(part.collision):
        mesh = _add_mesh(spec, write_hull(part.name, backed_hull(hull), origin, folder))
        body.add_geom(default, name=f"{part.name}_collision_{index}", meshname=mesh, friction=friction)


def _add_excludes(spec: mujoco.MjSpec, asset: Asset) -> None:
    pairs = overlapping_parts(asset)
    for first, second in pairs:
        spec.add_exclude(name=f"{first}_{second}", bodyname1=first, bodyname2=second)
    if pairs:
        names = ", ".join(" and ".join(pair) for pair in pairs)
        spec.comment = f"No contact between parts whose shapes overlap at rest or on the way: {names}"


def _add_mesh(spec: mujoco.MjSpec, file: str) -> str:
    """Refer to a mesh file, once; returns the mesh's name."""
    name = Path(file).stem
    if spec.mesh(name) is None:
        spec.add_mesh(name=name, file=file)
    return name


@hookimpl
def register_exporters(register: Register) -> None:
    """Offer MJCF."""
    register(Mjcf)
