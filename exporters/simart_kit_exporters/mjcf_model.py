"""An MJCF model that is being written: its options, its classes, and the files that it refers to."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from .mjcf_flavors import ASSETS, Flavor

if TYPE_CHECKING:
    import mujoco


@dataclass(frozen=True, eq=False)
class Model:
    """What all that writes into a model needs to know.

    Attributes:
        spec: MuJoCo's editor of it.
        flavor: how to group and name things.
        folder: where meshes and pictures go.
    """

    spec: mujoco.MjSpec
    flavor: Flavor
    folder: Path

    def add_mesh(self, file: str) -> str:
        """Refer to a file of the folder, once; returns the mesh's name."""
        name = Path(file).stem
        if self.spec.mesh(name) is None:
            self.spec.add_mesh(name=name, file=self.flavor.path(file))
        return name

    def add_texture(self, file: str) -> str:
        """Refer to a picture of the folder, once; returns the texture's name."""
        import mujoco

        name = Path(file).stem
        if self.spec.texture(name) is None:
            # MuJoCo's renderer decodes sRGB textures and never encodes its picture: they would come out dark.
            self.spec.add_texture(
                name=name,
                file=self.flavor.path(file),
                type=mujoco.mjtTexture.mjTEXTURE_2D,
                colorspace=mujoco.mjtColorSpace.mjCOLORSPACE_LINEAR,
            )
        return name


def empty_model(name: str, flavor: Flavor, timestep: float, directory: Path) -> Model:
    """A model without bodies, and an empty folder for its files.

    Args:
        name: of the model.
        flavor: how to group and name things.
        timestep: of a simulation [s].
        directory: where the model itself will be.
    """
    import mujoco

    folder = directory / ASSETS
    folder.mkdir()
    spec = mujoco.MjSpec()
    spec.modelname = name
    spec.modelfiledir = str(directory)
    spec.compiler.degree = False
    spec.compiler.meshdir = spec.compiler.texturedir = flavor.asset_dir
    # The file then holds the asset's own numbers, to all digits, instead of what compilation made of them.
    spec.compiler.savecompiled = spec.compiler.savecanonical = False
    spec.option.integrator = mujoco.mjtIntegrator.mjINT_IMPLICITFAST
    # By default the solver is content once what it errs by is little for the heaviest: handles would creep.
    spec.option.tolerance = 1e-10
    spec.option.timestep = timestep
    _add_classes(spec, flavor)
    return Model(spec, flavor, folder)


def _add_classes(spec: mujoco.MjSpec, flavor: Flavor) -> None:
    import mujoco

    visual = spec.add_default("visual", spec.default)
    visual.geom.contype = visual.geom.conaffinity = 0
    visual.geom.group = flavor.visual_group
    collision = spec.add_default("collision", spec.default)
    collision.geom.group = flavor.collision_group
    collision.geom.condim = 4
    for default in (visual, collision):
        default.geom.type = mujoco.mjtGeom.mjGEOM_MESH
