"""The numbers of the SIMART protocol: what each is, and what a part without partner gets."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal

import numpy as np

from ..articulation import LinkJoint
from ..metrics.joints import limited
from ..states import opening
from . import Metric


@dataclass(frozen=True)
class PartMetric:
    """A number of a matched pair, and what a missed or invented part gets for it.

    Attributes:
        key: of the number.
        worst: what a part without partner gets; lengths as a share of the object's diagonal.
        is_length: whether `worst` is such a share.
        defined: whether a joint has this number at all, asked of the true joint of a pair or of a missed
            part, and of the predicted joint of an invented one.
    """

    key: str
    worst: float
    is_length: bool = False
    defined: Callable[[LinkJoint], bool] = lambda joint: True


def _has_axis(joint: LinkJoint) -> bool:
    return joint.axis is not None


def _opens(joint: LinkJoint) -> bool:
    return opening(joint) is not None


def _has_line(joint: LinkJoint) -> bool:
    return joint.turns and joint.origin is not None


PART_METRICS = (
    PartMetric("type", 0.0),
    PartMetric("type_coarse", 0.0),
    PartMetric("axis", np.pi / 2, defined=_has_axis),
    PartMetric("direction", np.pi, defined=_opens),
    PartMetric("origin", 0.5, is_length=True, defined=_has_line),
    PartMetric("origin_line", 0.5, is_length=True, defined=_has_line),
    PartMetric("limits_iou", 0.0, defined=limited),
    PartMetric("iou", 0.0),
    PartMetric("iou_voxel", 0.0),
    PartMetric("cd", 0.5, is_length=True),
    PartMetric("articulated_cd", 0.5, is_length=True),
    PartMetric("articulated_giou", -1.0),
    PartMetric("hierarchy", 0.0),
)


# key, title, which way is better, what it is; each comes penalised and matched-only.
_TWICE: tuple[tuple[str, str, Literal["higher", "lower"], str], ...] = (
    ("type", "Type", "higher", "share of moving parts whose joint is of the true kind"),
    ("type_coarse", "Type, coarse", "higher", "the same with continuous counted as revolute"),
    ("axis", "Axis", "lower", "angle between true and predicted axis, whichever way they point [rad]"),
    ("direction", "Direction", "lower", "angle between the directions in which the joints open [rad]"),
    ("origin", "Origin", "lower", "distance of the origins of joints that turn [object size]"),
    ("origin_line", "Origin, line", "lower", "distance of the origin from the true axis line [object size]"),
    ("limits_iou", "Limits", "higher", "overlap of the ranges of travel along the true axis"),
    ("iou", "IoU", "higher", "overlap of true and predicted part, by face area or points"),
    ("iou_voxel", "IoU, voxels", "higher", "overlap of the parts' surface voxels in a 64^3 grid"),
    ("cd", "CD", "lower", "chamfer distance of the parts, mean of the two directed means [object size]"),
    ("articulated_cd", "CD, moving", "lower", "the same over five states of all joints [object size]"),
    ("articulated_giou", "gIoU, moving", "higher", "generalised IoU of the parts' boxes over five states"),
    ("hierarchy", "Hierarchy", "higher", "share of parts whose parent is the match of the true parent"),
)
_ONCE: tuple[tuple[str, str, Literal["higher", "lower"], str], ...] = (
    ("range_turn_matched", "Range, turns", "lower", "error of the range of matched turns [rad]"),
    ("range_slide_matched", "Range, slides", "lower", "error of the range of matched slides [object size]"),
    ("body_iou", "Body IoU", "higher", "overlap of what does not move"),
    ("precision", "Precision", "higher", "share of predicted moving parts with IoU 0.5 with a true one"),
    ("recall", "Recall", "higher", "share of true moving parts with IoU 0.5 with a predicted one"),
    ("f1", "F1", "higher", "harmonic mean of precision and recall"),
    (
        "penetration",
        "Penetration",
        "lower",
        "share of a part's surface that passes through others on its way",
    ),
    ("loads", "Loads", "higher", "1 when MuJoCo loads the predicted asset"),
    ("settles", "Settles", "higher", "1 when it comes to rest under gravity"),
    ("travels", "Travels", "higher", "share of its joints that can be driven through their range"),
    ("executable", "Executable", "higher", "1 when it loads, settles and all its joints travel"),
)
_HEADLINES = ("type", "axis", "origin", "iou", "cd", "f1", "executable")
_ZERO = ("body_iou", "precision", "recall", "f1", "loads", "settles", "travels", "executable")

WORST = {m.key: m.worst for m in PART_METRICS} | dict.fromkeys(_ZERO, 0.0)
"""What a failed object gets, by key; lengths as a share of the object's diagonal. Others are not defined."""


def _metrics() -> tuple[Metric, ...]:
    found = []
    for key, title, better, text in _TWICE:
        penalised = f"{text}; missed and invented parts count with the worst"
        found.append(Metric(key, title, better, penalised, headline=key in _HEADLINES))
        found.append(Metric(f"{key}_matched", f"{title}, matched", better, f"{text}; matched parts only"))
    found += [Metric(key, title, better, text, key in _HEADLINES) for key, title, better, text in _ONCE]
    return tuple(found)


METRICS = _metrics()
