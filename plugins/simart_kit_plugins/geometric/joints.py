"""Joints of given parts: candidates from geometry, chosen by evidence, never by least collision."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from simart_kit import Segmentation
from simart_kit.arrays import vec3
from simart_kit.asset import Joint, Limits, clean_name, unique_names
from simart_kit.kinematics import turned_about
from simart_kit.segments import find_segments
from simart_kit.sweeping import Sweep

from .candidates import AS_FREE, Candidate, Choice, at_depth, hinges, lift, slide, spin
from .choice import (
    RACKS,
    SPINNING,
    STANDING_OPEN,
    Surroundings,
    edge_score,
    hardware_on,
    hinge_score,
    says,
    sides,
    slide_score,
)
from .contact import Contacts
from .control_joints import pressed, pulled, tilted, turned
from .inner_drawers import out_of_hiding
from .levers import LEVERS, levering, pierced, with_handle
from .open_leaves import opened
from .pivots import is_post, on_post, pivot
from .racks import sliding_out
from .rotors import ROTORS, about_symmetry
from .rough_discs import rough_disc
from .rounds import round_axis
from .sashes import SASHES, sliding
from .scene import Box, Scene, make_scene
from .seats import turned_up
from .skin_wheels import THICK
from .spray_arms import SPRAY_ARMS, whirling
from .supports import unheld
from .views import View, view_part

if TYPE_CHECKING:
    from simart_kit import Mesh
    from simart_kit.arrays import BoolArray, FloatArray
    from simart_kit.spec.values import Spec

_SUFFIX = {"revolute": "hinge", "prismatic": "slide", "continuous": "spin", "free": "joint"}
_SHUT = np.deg2rad(0.5)
_POST = 0.3  # of the diagonal: lower rods hold no leaf
_HARDWARE = 0.12  # pieces of the body smaller than this share of the diagonal may be hinges


def joints_of(
    mesh: Mesh, segmentation: Segmentation, spec: Spec | None, open_angle: float
) -> tuple[Joint, ...]:
    """A joint for every part but the body.

    Args:
        mesh: whose faces the segmentation tells apart.
        segmentation: any segmenter's.
        spec: what is stated of joints, or None.
        open_angle: travel of a hinge that nothing stops [rad].
    """
    if len(segmentation.parts) == 1:
        return ()
    scene = make_scene(mesh, segmentation.face_part)
    body = _body(scene, segmentation)
    moving = [i for i in range(scene.count) if i != body]
    labels = [part.label or part.name for part in segmentation.parts]
    levers = [i for i in moving if says(labels[i], LEVERS)]
    views = {i: with_handle(scene, view_part(scene, i, sides(labels[i])), levers) for i in moving}
    pieces = make_scene(mesh, find_segments(mesh, relief=True).face_segment)
    hardware = _hardware(pieces, scene, body)
    posts = _posts(pieces, scene, body)
    contacts = Contacts(scene)
    granted = _granting(mesh, segmentation, spec)
    found = []
    for part in moving:
        label = labels[part]
        around = _surroundings(scene, views[part], hardware, posts, [i for i in moving if i != part])
        carrier = pierced(scene, part, moving) if part in levers else None
        carrier = _carrier(contacts, body, part, moving) if carrier is None else carrier
        made = partial(_joint, scene, views[part], segmentation, carrier, open_angle)
        joint = made(_choose(scene, views[part], label, around))
        if not granted(part, joint):
            from .honouring import alternatives

            others = alternatives(scene, views[part], label, around)
            fitting = next((other for other in others if granted(part, made(other))), None)
            joint = made(_deepened(scene, views[part], fitting)) if fitting else joint
        found.append(joint)
    return _renamed(found)


def _choose(scene: Scene, view: View, label: str, around: Surroundings) -> Choice:
    for words, special in _SPECIAL:
        chosen = special(scene, view) if says(label, words) else None
        if chosen is not None:
            candidate, confidence, reasons = chosen
            return candidate, confidence, (f"labelled '{label}'", *reasons)
    sliding, hinged = slide_score(view, label), hinge_score(view, label)
    if sliding.value > hinged.value:
        return slide(view), _confidence(sliding.value - hinged.value), sliding.reasons
    if view.facing == "top" and _lies_loose(scene, view, around):
        return lift(view), 0.5, ("round, and nothing like a hinge is on its rim",)
    turning = pivot(view, around.hardware)
    if turning is not None:
        return turning
    scored = [(edge_score(view, hinge, around), hinge) for hinge in hinges(view)]
    scored.sort(key=lambda item: -item[0].value)
    (best, hinge), (second, _) = scored[0], scored[1]
    margin = min(best.value - second.value, hinged.value - sliding.value)
    post = on_post(hinge, view.box, around.posts)
    line = _deep_enough(scene, view, hinge) if post is hinge else post
    return line, _confidence(margin), hinged.reasons + best.reasons


def _lies_loose(scene: Scene, view: View, around: Surroundings) -> bool:
    """Whether a lid is round, as that of a pot is, and has no hinge."""
    round_lid = round_axis(scene.points_of(view.part)) == 2
    return round_lid and not any(hardware_on(view, hinge, around) for hinge in hinges(view))


def _spinning(scene: Scene, view: View) -> Choice | None:
    """About the axis of something round."""
    points = scene.points_of(view.part)
    axis = round_axis(points)
    if axis is None:
        disc = rough_disc(points, THICK)
        if disc is None:
            return None
        axis = disc.axis
    middle = view.axes @ ((points.max(axis=0) + points.min(axis=0)) / 2)
    return spin(view.axes[:, axis], middle), 0.7, ("round about this axis",)


# What is said of parts that are called so; of none where the shape does not bear it out.
_SPECIAL: tuple[tuple[tuple[str, ...], Callable[[Scene, View], Choice | None]], ...] = (
    (LEVERS, levering),
    (ROTORS, about_symmetry),
    (SASHES, sliding),
    (SPRAY_ARMS, whirling),
    (("seat",), turned_up),
    (("knob",), turned),
    (SPINNING, _spinning),
    (("button", "touchpad", "squeeze"), pressed),
    (("trigger",), pulled),
    (("thumbstick",), tilted),
    (STANDING_OPEN, opened),
    (("drawer",), out_of_hiding),
    (RACKS, sliding_out),
)


def _joint(
    scene: Scene,
    view: View,
    segmentation: Segmentation,
    parent: int,
    open_angle: float,
    choice: Choice,
) -> Joint:
    candidate, confidence, evidence = choice
    child = segmentation.parts[view.part].name
    limits = None
    if candidate.kind == "revolute":
        closed = float(_closed(view, candidate))
        travel = open_angle if candidate.edge else candidate.upper
        limits = Limits(closed, max(travel + closed, 0.1))
    elif candidate.kind == "prismatic":
        limits = Limits(0.0, float(candidate.upper * scene.size))
    return Joint(
        name=f"{clean_name(child)}_{_SUFFIX[candidate.kind]}",
        kind=candidate.kind,
        parent=segmentation.parts[parent].name,
        child=child,
        origin=vec3(scene.points_to_asset(candidate.origin @ view.axes)),
        axis=vec3(_rounded(scene.vector_to_asset(candidate.axis @ view.axes))),
        limits=limits,
        confidence=confidence,
        evidence=evidence,
    )


def _granting(mesh: Mesh, segmentation: Segmentation, spec: Spec | None) -> Callable[[int, Joint], bool]:
    """Whether the joint of the part of a number is as stated; without a spec, always."""
    if spec is None:
        return lambda part, joint: True
    from .honouring import granting

    return granting(mesh, segmentation, spec)


def _body(scene: Scene, segmentation: Segmentation) -> int:
    """The part called body or base, else the largest."""
    for index, part in enumerate(segmentation.parts):
        if (part.label or part.name).lower() in ("body", "base", "frame"):
            return index
    return int(scene.areas.argmax())


def _hardware(pieces: Scene, scene: Scene, body: int) -> Scene | None:
    """Small connected pieces of the body, as a scene in the same frame; None when there are none."""
    sizes = np.array([np.linalg.norm(box.size) for box in pieces.boxes])
    small = np.flatnonzero((sizes < _HARDWARE) & _of_body(pieces, scene, body))
    faces = np.flatnonzero(np.isin(pieces.labels, small))
    if not len(faces):
        return None
    _, labels = np.unique(pieces.labels[faces], return_inverse=True)
    surface = replace(pieces.surface, faces=pieces.faces[faces])
    return Scene(surface, labels, int(labels.max()) + 1)


def _posts(pieces: Scene, scene: Scene, body: int) -> tuple[Box, ...]:
    """Round rods of the body that stand upright."""
    upright = np.array([box.size[2] > 4 * box.size[:2].max() for box in pieces.boxes])
    high = np.array([box.size[2] > _POST for box in pieces.boxes])
    able = np.flatnonzero(upright & high & _of_body(pieces, scene, body))
    return tuple(
        pieces.boxes[i] for i in able if is_post(pieces.triangles[pieces.labels == i].reshape(-1, 3))
    )


def _of_body(pieces: Scene, scene: Scene, body: int) -> BoolArray:
    """(N,) which pieces have no face in any other part."""
    return np.asarray(np.bincount(pieces.labels, scene.labels != body, pieces.count) == 0)


def _surroundings(
    scene: Scene, view: View, hardware: Scene | None, posts: tuple[Box, ...], others: list[int]
) -> Surroundings:
    return Surroundings(
        tuple(box.turned(view.axes) for box in hardware.boxes) if hardware else (),
        tuple(scene.boxes[i].turned(view.axes) for i in others),
        tuple(box.turned(view.axes) for box in posts),
        unheld(scene, view, tuple(others)),
    )


def _carrier(contacts: Contacts, body: int, part: int, moving: list[int]) -> int:
    """The part that carries this one: the body if near, else the nearest other part."""
    others = [i for i in moving if i != part and i < part]
    if contacts.gap(part, body) < np.inf or not others:
        return body
    nearest = min(others, key=lambda other: contacts.gap(part, other))
    return nearest if contacts.gap(part, nearest) < np.inf else body


def _deepened(scene: Scene, view: View, choice: Choice) -> Choice:
    """The choice, a hinge moved to where it opens most freely."""
    candidate, confidence, evidence = choice
    if candidate.kind != "revolute":
        return choice
    return _deep_enough(scene, view, candidate), confidence, evidence


def _deep_enough(scene: Scene, view: View, hinge: Candidate) -> Candidate:
    """The hinge in the middle, front or back of the panel's thickness: the first that opens most freely.

    A lid is tried at its lower side first: that is where it meets what it closes.
    """
    mine = scene.labels == view.part
    sweep = Sweep(scene.vertices @ view.axes.T, scene.faces[mine], scene.faces[~mine])
    stops = np.linspace(0.05, 1.0, 20) * hinge.upper
    lower, upper = _thickness(scene, view, hinge)
    middle = (lower + upper) / 2
    depths = (lower, middle, upper) if view.facing == "top" else (middle, upper, lower)
    tried = [at_depth(hinge, float(w)) for w in depths]
    shares = [float(sweep.blocked(partial(turned_about, one.axis, one.origin), stops)[-1]) for one in tried]
    # An inset door that turns about its middle cuts into its frame with a narrow strip, a percent of it.
    return next(one for one, share in zip(tried, shares, strict=True) if share <= min(shares) + AS_FREE)


def _thickness(scene: Scene, view: View, hinge: Candidate) -> tuple[float, float]:
    """Where the panel begins and ends in depth [w]; at the hinge, where it stands ajar."""
    if abs(view.ajar) < _SHUT or hinge.edge not in ("left", "right"):
        return float(view.box.lower[2]), float(view.box.upper[2])
    points = scene.points_of(view.part) @ view.axes.T
    near = np.abs(points[:, 0] - hinge.origin[0]) < 0.05 * view.box.size[0]
    return float(points[near, 2].min()), float(points[near, 2].max())


def _closed(view: View, hinge: Candidate) -> float:
    """Position at which a panel that stands ajar is closed [rad], at most 0."""
    if hinge.closed:
        return hinge.closed
    opened = {"left": -view.ajar, "right": view.ajar}.get(hinge.edge, 0.0)
    return -opened if opened > _SHUT else 0.0


def _confidence(margin: float) -> float:
    return float(np.round(np.clip(0.5 + 0.2 * margin, 0.3, 0.95), 2))


def _rounded(axis: FloatArray) -> FloatArray:
    """Without the last bits of a turn to and fro, so that an axis along x reads 1, 0, 0."""
    axis = np.where(np.abs(axis) < 1e-9, 0.0, axis)
    return np.asarray(axis / np.linalg.norm(axis))


def _renamed(joints: list[Joint]) -> tuple[Joint, ...]:
    names = unique_names([joint.name for joint in joints])
    return tuple(replace(joint, name=name) for joint, name in zip(joints, names, strict=True))
