"""The sweep: joint after joint goes from rest to its lower limit, to its upper limit and back to rest."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from simart_kit.arrays import FloatArray
from simart_kit.asset import Asset, Joint
from simart_kit.colors import Color, part_color
from simart_kit.kinematics import ordered_joints, rest_to_posed, span

from .tape import Tape

_SECONDS_A_JOINT = 2.4
_FRAMES_A_JOINT = 49
# An object with hundreds of joints gets coarser motion, not an endless recording.
_FRAMES = 1000


@dataclass(frozen=True, eq=False)
class Move:
    """One joint's turn in the sweep.

    Attributes:
        joint: that moves while all others rest.
        seconds: (T,) times [s].
        positions: (T,) joint positions [rad | m]; 0 at both ends.
    """

    joint: Joint
    seconds: FloatArray
    positions: FloatArray


def moves(asset: Asset) -> tuple[Move, ...]:
    """The sweep of every joint that has a range to go through, parents first."""
    joints = [j for j in ordered_joints(asset) if span(j) != (0.0, 0.0)]
    frames = int(np.clip(_FRAMES // max(len(joints), 1), 7, _FRAMES_A_JOINT))
    return tuple(_move(joint, index * _SECONDS_A_JOINT, frames) for index, joint in enumerate(joints))


def shown_positions(move: Move) -> FloatArray:
    """(T,) positions as people read them [degree | m]."""
    return np.asarray(np.rad2deg(move.positions)) if move.joint.turns else move.positions


def log_sweep(tape: Tape, asset: Asset, part_path: str, joint_path: str, position_path: str) -> None:
    """Log how parts, joint drawings and joint positions go over the sweep timeline.

    Args:
        tape: where to.
        asset: whose parts move.
        part_path: `part_path/PART` gets transforms that move a surface drawn at rest.
        joint_path: `joint_path/JOINT` gets the transforms of the part that carries the joint.
        position_path: `position_path/JOINT` gets positions [degree | m].
    """
    made = moves(asset)
    if not made:
        return
    end = float(made[-1].seconds[-1])
    poses = {
        move.joint.name: [rest_to_posed(asset, {move.joint.name: q}) for q in move.positions] for move in made
    }
    for part in asset.parts:
        carriers = _carriers(asset, part.name)
        mine = [move for move in made if move.joint.name in carriers]
        if not mine:
            continue
        seconds = np.concatenate([[0.0], *(move.seconds for move in mine)])
        frames = [poses[move.joint.name][i][part.name] for move in mine for i in range(len(move.seconds))]
        posed_T_rest = np.array([np.eye(4), *frames])
        followers = [f"{joint_path}/{j.name}" for j in asset.joints if j.parent == part.name]
        for path in (f"{part_path}/{part.name}", *followers):
            _log_transforms(tape, path, seconds, posed_T_rest)
    for move in made:
        color = part_color(asset.part_index(move.joint.child))
        _log_positions(tape, f"{position_path}/{move.joint.name}", move, color, end)


def _move(joint: Joint, start: float, frames: int) -> Move:
    """Through the range at an even pace, with both limits among the frames."""
    lower, upper = span(joint)
    way = np.array([0.0, lower, upper, 0.0])
    length = np.concatenate([[0.0], np.cumsum(np.abs(np.diff(way)))])
    along = np.union1d(np.linspace(0.0, length[-1], frames), length)
    stops, first = np.unique(length, return_index=True)
    positions = np.interp(along, stops, way[first])
    return Move(joint, start + along / length[-1] * _SECONDS_A_JOINT, positions)


def _carriers(asset: Asset, part: str) -> set[str]:
    """Names of the joints between a part and the root."""
    found = set()
    joint = asset.joint_to(part)
    while joint is not None:
        found.add(joint.name)
        joint = asset.joint_to(joint.parent)
    return found


def _log_transforms(tape: Tape, path: str, seconds: FloatArray, posed_T_rest: FloatArray) -> None:
    import rerun as rr

    columns = rr.Transform3D.columns(translation=posed_T_rest[:, :3, 3], mat3x3=posed_T_rest[:, :3, :3])
    tape.over_sweep(path, seconds, columns)


def _log_positions(tape: Tape, path: str, move: Move, color: Color, end: float) -> None:
    import rerun as rr

    tape.static(path, rr.SeriesLines(names=move.joint.name, colors=color))
    seconds = np.concatenate([[0.0], move.seconds, [end]])
    tape.over_sweep(
        path, seconds, rr.Scalars.columns(scalars=np.concatenate([[0.0], shown_positions(move), [0.0]]))
    )
