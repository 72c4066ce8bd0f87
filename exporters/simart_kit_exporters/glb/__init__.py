"""GLB (glTF 2.0): what web viewers, game engines and headsets show, with a clip for every joint."""

from __future__ import annotations

from pathlib import Path

from pydantic import Field

from simart_kit import stages
from simart_kit.asset import Asset
from simart_kit.hookspecs import Register, hookimpl

from .document import glb_bytes
from .gaps import gaps


class Glb(stages.Exporter):
    """One file: a node a part, in the tree of the joints, and an animation clip a joint.

    Y up, metres. Joints and masses are in the `extras` of the nodes.
    """

    name = "glb"

    class Options(stages.Options):
        """Options of the GLB exporter."""

        experimental_physics: bool = Field(
            default=False,
            description="Write bodies, convex colliders and joints by the draft KHR_physics_rigid_bodies.",
        )

    options: Options

    def export(self, asset: Asset, directory: Path) -> Path:
        """Write and return `NAME.glb`."""
        path = directory / f"{asset.name}.glb"
        path.write_bytes(glb_bytes(asset, self.options.experimental_physics))
        return path

    def unsupported(self, asset: Asset) -> tuple[str, ...]:
        """See `gaps`."""
        return gaps(asset, self.options.experimental_physics)


@hookimpl
def register_exporters(register: Register) -> None:
    """Register the GLB exporter."""
    register(Glb)
