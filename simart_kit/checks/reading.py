"""Reading the file of a format back: as a Mechanism, and as a MuJoCo model."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from ..bench.mujoco_loading import NEIGHBOURS, LoadError, compiled, is_urdf, load_spec
from ..errors import BadInputError
from .mechanism import Mechanism

if TYPE_CHECKING:
    import mujoco


def read_mechanism(kind: str, path: Path) -> Mechanism:
    """What a file says, in metres with z up.

    Args:
        kind: "urdf", "mjcf" or "usd".
        path: its main file.

    Raises:
        BadInputError: it cannot be read; the file is named.
    """
    if kind == "usd":
        from .reading_usd import read_usd

        return read_usd(path)
    from .reading_mujoco import mechanism_of

    return mechanism_of(compiled_spec(read_spec(path)))


def read_spec(path: Path) -> mujoco.MjSpec:
    """A URDF or MJCF file with a fixed base, as MuJoCo takes it; raises BadInputError when it does not.

    Of URDF, a link and the one that it moves on do not touch, as in PyBullet, Drake and Isaac Sim; in MuJoCo
    they do where the latter stands still.
    """
    try:
        spec = load_spec(path, fuse=False)
    except LoadError as error:
        raise BadInputError(f"MuJoCo does not load {path.name}: {error}") from error
    if is_urdf(path):
        for body in [child for parent in spec.bodies[1:] for child in parent.bodies]:
            spec.add_exclude(name=NEIGHBOURS + body.name, bodyname1=body.parent.name, bodyname2=body.name)
    return spec


def compiled_spec(spec: mujoco.MjSpec) -> mujoco.MjModel:
    """The model of a spec; raises BadInputError when MuJoCo refuses it."""
    try:
        return compiled(spec)
    except LoadError as error:
        raise BadInputError(f"MuJoCo refuses it: {error}") from error
