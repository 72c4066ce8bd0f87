"""Joints as drawings: an arrow for the axis, an arc or a segment for the travel, a label with what it is."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from simart_kit.arrays import FloatArray
from simart_kit.asset import Asset, Joint
from simart_kit.colors import Color
from simart_kit.kinematics import rotation, span

from .tape import Tape
from .text import readable

_ARC_STEP = np.deg2rad(5.0)


@dataclass(frozen=True, eq=False)
class Drawing:
    """A joint's lines at rest, in the asset frame.

    Attributes:
        tail: (3,) where the axis arrow starts [m].
        arrow: (3,) from its tail to its tip [m].
        back: (N, 3) path of a point of the part from the rest pose to the lower limit [m]; N may be 0.
        ahead: (N, 3) the same to the upper limit.
        label_at: (3,) where the text goes: the far end of the travel [m].
    """

    tail: FloatArray
    arrow: FloatArray
    back: FloatArray
    ahead: FloatArray
    label_at: FloatArray


def draw(asset: Asset, joint: Joint) -> Drawing:
    """Lines for any kind of joint; a fixed one, and one without an axis, has a label only."""
    points = asset.mesh.points_of(asset.face_part == asset.part_index(joint.child))
    if joint.turns:
        return _turn(asset, joint, points)
    if joint.kind == "prismatic":
        return _slide(asset, joint, points)
    origin, nothing = np.array(joint.origin), np.zeros((0, 3))
    return Drawing(origin, np.zeros(3), nothing, nothing, origin)


def log_joint(tape: Tape, path: str, asset: Asset, joint: Joint, color: Color, labelled: bool = True) -> None:
    """Log the lines, and `path/label`; selecting it shows the evidence, too long to stand in the scene.

    Args:
        tape: where to.
        path: entity of the joint.
        asset: whose joint it is.
        joint: what to draw.
        color: of lines and label.
        labelled: whether the label always shows, or only when it is pointed at.
    """
    import rerun as rr

    log_lines(tape, path, asset, joint, color)
    tape.static(
        f"{path}/label",
        rr.Points3D(
            [draw(asset, joint).label_at],
            radii=asset.mesh.diagonal * 0.006,
            colors=color,
            labels=label(joint),
            show_labels=labelled,
        ),
        rr.AnyValues(
            kind=joint.kind,
            travel=travel(joint),
            confidence=joint.confidence,
            evidence=readable("; ".join(joint.evidence)) or "none given",
            flags=readable("; ".join(joint.flags)) or "none",
        ),
    )


def log_lines(tape: Tape, path: str, asset: Asset, joint: Joint, color: Color) -> None:
    """Log `path/axis` and `path/travel`."""
    import rerun as rr

    drawing = draw(asset, joint)
    thick = asset.mesh.diagonal * 0.005
    if drawing.arrow.any():
        tape.static(
            f"{path}/axis",
            rr.Arrows3D(vectors=[drawing.arrow], origins=[drawing.tail], radii=thick, colors=color),
        )
    strips = [strip for strip in (drawing.back, drawing.ahead) if len(strip)]
    if strips:
        tape.static(f"{path}/travel", rr.LineStrips3D(strips, radii=thick * 0.7, colors=color))


def label(joint: Joint) -> str:
    """Name, kind, travel and confidence; a mark when a check flagged it."""
    flagged = ", flagged" if joint.flags else ""
    return f"{joint.name}\n{joint.kind} {travel(joint)} ({joint.confidence:.0%}{flagged})".replace("  ", " ")


def travel(joint: Joint) -> str:
    """The limits in degrees or metres; empty for a joint without."""
    if joint.limits is None:
        return "without end" if joint.kind == "continuous" else ""
    lower, upper = joint.limits.lower, joint.limits.upper
    if joint.turns:
        return f"{np.rad2deg(lower):.0f}° to {np.rad2deg(upper):.0f}°"
    return f"{lower:.3g} to {upper:.3g} m"


def _turn(asset: Asset, joint: Joint, points: FloatArray) -> Drawing:
    """The hinge line along the part and out of the object, and the arc of the part's farthest point."""
    origin, axis = np.array(joint.origin), np.array(joint.axis)
    heights = (points - origin) @ axis
    radial = points - origin - heights[:, None] * axis
    far = radial[np.linalg.norm(radial, axis=1).argmax()]
    # Half-way up the part: its ends are often hidden.
    center = origin + axis * (heights.min() + heights.max()) / 2
    tip = _way_out(asset, origin, axis) + 0.06 * asset.mesh.diagonal
    tail = origin + axis * heights.min()
    back, ahead = (_arc(center, axis, far, end) for end in span(joint))
    longer = ahead if len(ahead) >= len(back) else back
    label_at = longer[-2] if len(longer) else center + far
    return Drawing(tail, axis * (tip - heights.min()), back, ahead, label_at)


def _way_out(asset: Asset, origin: FloatArray, axis: FloatArray) -> float:
    """How far along the axis the object's bounding box reaches from the origin [m]."""
    corner = np.where(axis > 0, asset.mesh.bounds[1], asset.mesh.bounds[0])
    reach = [(c - o) / a for c, o, a in zip(corner, origin, axis, strict=True) if abs(a) > 1e-6]
    return max(float(min(reach)), 0.0)


def _arc(center: FloatArray, axis: FloatArray, radius: FloatArray, angle: float) -> FloatArray:
    """(N, 3) arc from rest to an angle [rad] with the radius at its end; empty without a way to go."""
    if angle == 0.0:
        return np.zeros((0, 3))
    count = max(int(np.ceil(abs(angle) / _ARC_STEP)), 2) + 1
    arc = [center + rotation(axis * a) @ radius for a in np.linspace(0.0, angle, count)]
    return np.array([*arc, center])


def _slide(asset: Asset, joint: Joint, points: FloatArray) -> Drawing:
    """The way of the part's middle, starting where the part's surface is farthest along the travel."""
    axis = np.array(joint.axis)
    lower, upper = span(joint)
    middle = (points.min(axis=0) + points.max(axis=0)) / 2
    side = axis if upper >= -lower else -axis
    start = middle + side * ((points - middle) @ side).max()
    nothing = np.zeros((0, 3))
    back, ahead = (np.array([start, start + axis * end]) if end else nothing for end in (lower, upper))
    margin = 0.12 * asset.mesh.diagonal
    arrow = axis * (max(upper, margin))
    return Drawing(start, arrow, back, ahead, start + side * max(upper, -lower, margin))
