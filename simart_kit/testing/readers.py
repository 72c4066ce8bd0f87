"""Independent readers: what other software finds in an exported file."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path


def reader(main: Path) -> Callable[[Path], int] | None:
    """The function that counts moving joints of this kind of file, or None when we know none."""
    suffix = main.suffix.lower()
    if suffix.startswith(".usd"):
        return usd_joints
    return {".urdf": urdf_joints, ".xml": mjcf_joints}.get(suffix)


def urdf_joints(path: Path) -> int:
    """Moving joints that yourdfpy finds; it reads the meshes too."""
    import yourdfpy

    robot = yourdfpy.URDF.load(str(path)).robot
    return sum(joint.type != "fixed" for joint in robot.joints)


def mjcf_joints(path: Path) -> int:
    """Joints of the model that MuJoCo compiles, without that of a floating base."""
    import mujoco

    model = mujoco.MjModel.from_xml_path(str(path))
    return sum(kind != mujoco.mjtJoint.mjJNT_FREE for kind in model.jnt_type)


def usd_joints(path: Path) -> int:
    """Physics joints of the stage that are not fixed."""
    from pxr import Usd, UsdPhysics

    stage = Usd.Stage.Open(str(path))
    joints = [prim for prim in stage.Traverse() if prim.IsA(UsdPhysics.Joint)]
    return sum(not prim.IsA(UsdPhysics.FixedJoint) for prim in joints)
