"""Who judges what."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Literal

HERE = Path(__file__).parent
Format = Literal["urdf", "mjcf", "usd", "usdz", "glb"]
ENDINGS: dict[Format, tuple[str, ...]] = {
    "urdf": ("urdf",),
    "mjcf": ("xml",),
    "usd": ("usda", "usdc", "usd"),
    "usdz": ("usdz",),
    "glb": ("glb",),
}


@dataclass(frozen=True)
class Judge:
    """One tool, and the format that it reads.

    Attributes:
        name: in tables and on the command line.
        format: of the files that it is given.
        script: what reads a file, in `scripts/`.
        sees: defects of `seeding` that it must object to, lest its silence mean nothing.
        home: environment that it runs in: requirements of that name, "npm" or "apt"; None is our own.
    """

    name: str
    format: Format
    script: str
    sees: tuple[str, ...]
    home: str | None = None

    @property
    def light(self) -> bool:
        """Whether it runs in our own environment, so that the test suite can ask it."""
        return self.home is None

    @property
    def script_path(self) -> Path:
        """Path of the script."""
        return HERE / "scripts" / self.script

    @property
    def requirements(self) -> Path | None:
        """Pinned requirements of its environment, where that is one of pip's."""
        path = HERE / "requirements" / f"{self.home}.txt"
        return path if path.exists() else None


BODIES = ("mass", "axis", "collider", "limit")
ROBOT = (*BODIES, "parent")
JUDGES = (
    Judge("mujoco-urdf", "urdf", "judge_mujoco.py", ROBOT),
    Judge("yourdfpy", "urdf", "judge_yourdfpy.py", ROBOT),
    Judge("mujoco-mjcf", "mjcf", "judge_mujoco.py", BODIES),
    Judge("usd-validation", "usd", "judge_usd_validation.py", ("unit",)),
    Judge("usd-physics", "usd", "judge_usd_physics.py", ("mass", "collider", "limit")),
    Judge("usdz-validation", "usdz", "judge_usd_validation.py", ("compressed",)),
    Judge("check-urdf", "urdf", "judge_check_urdf.py", ("parent",), "apt"),
    Judge("pybullet", "urdf", "judge_pybullet.py", ROBOT, "pybullet"),
    Judge("pinocchio", "urdf", "judge_pinocchio.py", ROBOT, "pinocchio"),
    Judge("drake", "urdf", "judge_drake.py", ROBOT, "drake"),
    Judge("sapien", "urdf", "judge_sapien.py", ROBOT, "sapien"),
    Judge("urchin", "urdf", "judge_urchin.py", ROBOT, "urchin"),
    Judge("ikpy", "urdf", "judge_ikpy.py", ("axis", "parent"), "ikpy"),
    Judge("placo", "urdf", "judge_placo.py", ("axis", "limit", "parent"), "placo"),
    Judge("newton-urdf", "urdf", "judge_newton.py", ROBOT, "newton"),
    Judge("newton-usd", "usd", "judge_newton.py", BODIES, "newton"),
    Judge("nvidia", "usd", "judge_nvidia.py", ("unit",), "simready"),
    Judge("simready", "usd", "judge_simready.py", ("unit",), "simready"),
    Judge("arkit", "usdz", "judge_arkit.py", ("compressed",), "arkit"),
    Judge("gltf-validator", "glb", "judge_gltf.js", ("index",), "npm"),
)


def file_of(folder: Path, form: Format, name: str) -> Path | None:
    """The main file of an asset in a format, where a conversion wrote one."""
    paths = (folder / form / f"{name}.{ending}" for ending in ENDINGS[form])
    return next((path for path in paths if path.exists()), None)
