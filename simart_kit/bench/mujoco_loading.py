"""A MuJoCo model of an MJCF or URDF file, loaded as a user of MuJoCo would: nothing is repaired but paths."""

from __future__ import annotations

import re
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    import mujoco

_SCHEME = re.compile(r"^(package|model|file)://+")
_PARENTS = 3  # folders above a file that a package may be
NEIGHBOURS = "neighbours: "
"""What names of excludes begin with that the file need not ask for, as a joint connects the two bodies."""
_NUMBERS = (
    "jnt_axis",
    "jnt_pos",
    "jnt_range",
    "body_pos",
    "body_quat",
    "body_mass",
    "body_inertia",
    "geom_pos",
)


class LoadError(Exception):
    """MuJoCo does not take a file; the message says why, in one line."""


def load_model(file: Path) -> mujoco.MjModel:
    """Load and compile a file. Its folder is only read.

    A base that floats is fixed where it stands, as is every other thing with a free joint. Of URDF, visuals
    are left out, as MuJoCo does by itself, for they move nothing and may be in formats that it cannot read.
    Bodies without mass get none: MuJoCo refuses those that move.

    Args:
        file: MJCF or URDF, by its root element.

    Raises:
        LoadError: missing or damaged, or MuJoCo refuses it.
    """
    return compiled(load_spec(file))


def load_spec(file: Path, fuse: bool = True) -> mujoco.MjSpec:
    """The same, to be changed before it is compiled.

    Args:
        file: MJCF or URDF, by its root element.
        fuse: whether links of URDF that stand still become part of the world, as MuJoCo does by itself.

    Raises:
        LoadError: as in `load_model`.
    """
    import mujoco

    with quiet_mujoco():
        try:
            if file.suffix == ".mjz":
                with file.open("rb") as archive:  # of a path it would leave the file open
                    spec = mujoco.MjSpec.from_zip(archive)
            else:
                spec = _urdf(file, fuse) if is_urdf(file) else mujoco.MjSpec.from_file(str(file))
            spec.compile()  # fixing the base changes what only a compiled model has names for
            _fix_base(spec)
        except (ValueError, TypeError, RuntimeError, OSError, MemoryError, mujoco.FatalError) as error:
            raise LoadError(one_line(error)) from error
    return spec


def compiled(spec: mujoco.MjSpec) -> mujoco.MjModel:
    """The model of a spec; raises LoadError when MuJoCo refuses it or its numbers are not finite."""
    import mujoco

    with quiet_mujoco():
        try:
            model = spec.compile()
        except (ValueError, TypeError, RuntimeError, OSError, MemoryError, mujoco.FatalError) as error:
            raise LoadError(one_line(error)) from error
    _check_numbers(model)
    return model


@contextmanager
def quiet_mujoco() -> Iterator[None]:
    """Keep MuJoCo from writing its warnings to stderr and to MUJOCO_LOG.TXT in the current folder."""
    import mujoco

    before = mujoco.get_mju_user_warning()
    mujoco.set_mju_user_warning(lambda _: None)
    try:
        yield
    finally:
        mujoco.set_mju_user_warning(before)


def is_urdf(file: Path) -> bool:
    """Whether the first element of a file is that of URDF."""
    first = re.search(r"<(?![?!])\s*([\w:]+)", re.sub(r"<!--.*?-->", "", _text(file), flags=re.DOTALL))
    return first is not None and first.group(1) == "robot"


def one_line(error: Exception) -> str:
    """What MuJoCo says, without its word "Error" and what it tells of its own state."""
    lines = [line.strip() for line in str(error).splitlines()]
    kept = [line for line in lines if line and not line.startswith("The static bodies of the spec")]
    return " ".join(kept).removeprefix("Error: ") or type(error).__name__


def _urdf(file: Path, fuse: bool) -> mujoco.MjSpec:
    import mujoco

    text = re.sub(r"\bstrippath\s*=\s*([\"']).*?\1", 'strippath="false"', _text(file))
    text = re.sub(r"\bdiscardvisual\s*=\s*([\"']).*?\1", 'discardvisual="true"', text)
    spec = mujoco.MjSpec.from_string(text)
    spec.compiler.fusestatic = spec.compiler.fusestatic and fuse
    for mesh in spec.meshes:
        if mesh.file:
            mesh.file = str(_mesh_file(mesh.file, file.resolve().parent, spec.meshdir))
    return spec


def _mesh_file(name: str, folder: Path, mesh_folder: str) -> Path:
    """The file that a URDF means, which stands beside it or in a package around it."""
    path = _SCHEME.sub("/" if name.startswith("file:") else "", name.replace("\\", "/"))
    in_package = path.partition("/")[2]
    for home in (folder / mesh_folder, folder, *folder.parents[:_PARENTS]):
        for candidate in (path, in_package) if "://" in name else (path,):
            if candidate and (home / candidate).is_file():
                return home / candidate
    raise OSError(f"no such mesh file: {name}")


def _fix_base(spec: mujoco.MjSpec) -> bool:
    """Take free joints out; returns whether there were any. Key frames no longer fit then."""
    import mujoco

    free = [joint for joint in spec.joints if joint.type == mujoco.mjtJoint.mjJNT_FREE]
    for joint in free:
        # MuJoCo lets a body pass through its parent, but not through one that stands still.
        for child in joint.parent.bodies:
            name = NEIGHBOURS + child.name
            spec.add_exclude(name=name, bodyname1=joint.parent.name, bodyname2=child.name)
    for thing in [*free, *(spec.keys if free else [])]:
        spec.delete(thing)
    return bool(free)


def _check_numbers(model: mujoco.MjModel) -> None:
    for name in _NUMBERS:
        if not np.isfinite(getattr(model, name)).all():
            raise LoadError(f"the model has NaN or infinite numbers in {name}")


def _text(file: Path) -> str:
    return file.read_text(encoding="utf-8-sig", errors="replace")
