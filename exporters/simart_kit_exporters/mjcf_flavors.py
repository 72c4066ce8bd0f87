"""Two customs of writing MJCF: that of MuJoCo Menagerie, and that of robosuite's objects.

Menagerie: what is drawn has class `visual` and group 2, what is solid has class `collision` and group 3, and
the root body stands in the world (https://github.com/google-deepmind/mujoco_menagerie). robosuite: what is
drawn has group 1, what is solid has group 0, and the root stands in a body `object`, which stands in a
nameless one with three sites (https://robosuite.ai/docs/modeling/object_model.html); RoboCasa adds a box
`reg_bbox`.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

FlavorName = Literal["menagerie", "robosuite"]


@dataclass(frozen=True)
class Flavor:
    """How shapes are grouped and named, and what the model looks like around the root body.

    Attributes:
        visual_group: of shapes that are drawn; their class is `visual`.
        collision_group: of shapes that are solid; their class is `collision`.
        visual_name: template of names with `part` and `index`.
        collision_name: likewise.
        asset_dir: what `meshdir` and `texturedir` say, or "" where paths of files hold the folder.
        wrapped: whether the model is an object to put into robosuite's worlds.
    """

    visual_group: int
    collision_group: int
    visual_name: str
    collision_name: str
    asset_dir: str
    wrapped: bool

    def path(self, file: str) -> str:
        """How the model refers to a file of its folder of assets."""
        return file if self.asset_dir else f"{ASSETS}/{file}"


ASSETS = "assets"
FLAVORS: dict[FlavorName, Flavor] = {
    "menagerie": Flavor(2, 3, "{part}_visual_{index}", "{part}_collision_{index}", ASSETS, wrapped=False),
    # robosuite joins paths to the file's own folder and knows no `meshdir`; it names copies of solid shapes
    # NAME_visual, so that drawn ones need another ending.
    "robosuite": Flavor(1, 0, "{part}_g{index}_vis", "{part}_g{index}", "", wrapped=True),
}
