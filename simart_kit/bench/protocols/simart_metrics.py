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
        of_joint: whether a true joint has this number at all; None for a number that every part has.
        of_surface: whether it needs surfaces: points leave cells of theirs empty.
    """

    key: str
    worst: float
    is_length: bool = False
    of_joint: Callable[[LinkJoint], bool] | None = None
    of_surface: bool = False

    def defined(self, joint: LinkJoint) -> bool:
        """Whether a true part with this joint has the number."""
        return self.of_joint is None or self.of_joint(joint)


def _has_axis(joint: LinkJoint) -> bool:
    return joint.axis is not None


def _opens(joint: LinkJoint) -> bool:
    return opening(joint) is not None


def _has_line(joint: LinkJoint) -> bool:
    return joint.turns and joint.origin is not None


PART_METRICS = (
    PartMetric("type", 0.0),
    PartMetric("type_coarse", 0.0),
    PartMetric("axis", np.pi / 2, of_joint=_has_axis),
    PartMetric("direction", np.pi, of_joint=_opens),
    PartMetric("origin", 0.5, is_length=True, of_joint=_has_line),
    PartMetric("origin_line", 0.5, is_length=True, of_joint=_has_line),
    PartMetric("limits_iou", 0.0, of_joint=limited),
    PartMetric("iou", 0.0),
    PartMetric("iou_voxel", 0.0, of_surface=True),
    PartMetric("cd", 0.5, is_length=True),
    PartMetric("articulated_cd", 0.5, is_length=True),
    PartMetric("articulated_giou", -1.0),
    PartMetric("hierarchy", 0.0),
)


# key, title, unit, which way is better, what it is; each comes penalised and matched-only.
_Told = tuple[str, str, str, Literal["higher", "lower"], str]
_TWICE: tuple[_Told, ...] = (
    ("type", "Type", "", "higher", "Share of moving parts whose joint is of the true kind"),
    ("type_coarse", "Type, coarse", "", "higher", "The same with continuous counted as revolute"),
    ("axis", "Axis", "rad", "lower", "Angle of true and predicted axis as lines, whatever the kind of joint"),
    (
        "direction",
        "Direction",
        "rad",
        "lower",
        "Angle of the directions of opening, the longer way from 0",
    ),
    ("origin", "Origin", "size", "lower", "Distance of the origins of joints that turn"),
    ("origin_line", "Origin, line", "size", "lower", "Distance of the origin from the true axis line"),
    ("limits_iou", "Limits", "", "higher", "Overlap of the ranges of travel along the true axis"),
    ("iou", "IoU", "", "higher", "Overlap of true and predicted part, by face area or points"),
    ("iou_voxel", "IoU, voxels", "", "higher", "Overlap of the parts' surface voxels in a 64^3 grid"),
    ("cd", "CD", "size", "lower", "Chamfer distance of the parts, mean of the two directed means"),
    ("articulated_cd", "CD, moving", "size", "lower", "The same over five states of all joints"),
    (
        "articulated_giou",
        "gIoU, moving",
        "",
        "higher",
        "Generalised IoU of the parts' boxes in five states",
    ),
    ("hierarchy", "Hierarchy", "", "higher", "Share of parts whose parent is the match of the true parent"),
)
_ONCE: tuple[_Told, ...] = (
    ("range_turn_matched", "Range, turns", "rad", "lower", "Error of the range of matched turns."),
    ("range_slide_matched", "Range, slides", "size", "lower", "Error of the range of matched slides."),
    ("body_iou", "Body IoU", "", "higher", "Overlap of what does not move."),
    ("precision", "Precision", "", "higher", "Share of predicted moving parts with IoU 0.5 with a true one."),
    ("recall", "Recall", "", "higher", "Share of true moving parts with IoU 0.5 with a predicted one."),
    ("f1", "F1", "", "higher", "Harmonic mean of precision and recall."),
    ("penetration", "Penetration", "", "lower",
     "Share of the surface of what was predicted to move that passes through other parts; others rest."),
    ("loads", "Loads", "", "higher", "1 when MuJoCo loads the predicted asset."),
    ("settles", "Settles", "", "higher", "1 when it comes to rest under gravity."),
    ("travels", "Travels", "", "higher", "Share of its joints that can be driven through their range."),
    ("executable", "Executable", "", "higher",
     "1 when it loads, settles and all its joints travel; 0 where truth moves and it has none."),
)  # fmt: skip
_HEADLINES = ("type", "axis", "origin", "iou", "cd", "f1", "executable")
_ZERO = ("body_iou", "precision", "recall", "f1", "loads", "settles", "travels", "executable")

WORST = {m.key: m.worst for m in PART_METRICS} | dict.fromkeys(_ZERO, 0.0)
"""What a failed object gets, by key; lengths as a share of the object's diagonal. Others are not defined."""


def _metrics() -> tuple[Metric, ...]:
    found = []
    for key, title, unit, better, text in _TWICE:
        penalised = f"{text}; missed and invented parts count with the worst."
        found.append(Metric(key, title, better, penalised, key in _HEADLINES, unit))
        matched = f"{text}; matched parts only."
        found.append(Metric(f"{key}_matched", f"{title}, matched", better, matched, unit=unit))
    for key, title, unit, better, text in _ONCE:
        found.append(Metric(key, title, better, text, key in _HEADLINES, unit))
    return tuple(found)


METRICS = _metrics()
