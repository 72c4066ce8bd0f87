"""Failed checks at the pose where they failed, with the deepest contact."""

from __future__ import annotations

import numpy as np

from simart_kit.asset import Asset
from simart_kit.checks import CheckResult
from simart_kit.colors import part_color
from simart_kit.kinematics import rest_to_posed
from simart_kit.mesh import Mesh

from .history import History
from .meshes import plain_mesh
from .tape import Tape

_RED = (255, 40, 40)
_RADIUS = 0.012  # of the mark, in diagonals


def faults(history: History) -> tuple[CheckResult, ...]:
    """Failed checks that failed at a place."""
    return tuple(check for check in history.checks if check.fault is not None and not check.passed)


def fault_path(check: CheckResult) -> str:
    """Where a failed check is logged."""
    return f"faults/{check.name}"


def log_fault(tape: Tape, check: CheckResult, asset: Asset, mesh: Mesh) -> None:
    """Log the parts as they stood, see-through, and a mark with its text.

    Args:
        tape: where to.
        check: with a fault.
        asset: that was checked.
        mesh: its surface with normals.
    """
    import rerun as rr

    fault = check.fault
    assert fault is not None
    known = {name: value for name, value in fault.positions.items() if asset.has_joint(name)}
    for part, posed_T_rest in rest_to_posed(asset, known).items():
        index = asset.part_index(part)
        path = f"{fault_path(check)}/{part}"
        faces = np.flatnonzero(asset.face_part == index)
        tape.static(path, plain_mesh(mesh, faces, (*part_color(index)[:3], 110)))
        pose = rr.Transform3D(translation=posed_T_rest[:3, 3], mat3x3=posed_T_rest[:3, :3])
        tape.static(path, pose)
    text = f"{fault.text}, {fault.depth * 1000:.3g} mm deep" if fault.depth else fault.text
    mark = rr.Points3D([fault.point], radii=_RADIUS * mesh.diagonal, colors=_RED, labels=[text])
    tape.static(f"{fault_path(check)}/where", mark)
