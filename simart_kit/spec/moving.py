"""The joints of a run made those that a spec states: kinds, axes, limits and parents."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from ..arrays import vec3
from ..asset import Joint, JointKind, Limits, unique_names
from ..mesh import Mesh
from ..stages import Segmentation
from .places import EDGES, Place, fits, part_places
from .shaping import body_of
from .values import AxisWord, Spec
from .wishes import Wish, wishes_of

_SUFFIX = {"revolute": "hinge", "prismatic": "slide", "continuous": "spin"}
_QUARTER = np.pi / 2
_DRAWN = 0.8  # of its own depth: how far a slide goes where nothing is stated
_SAME_LIMIT = 1e-4  # [rad | m]


def with_joints(
    joints: Sequence[Joint], segmentation: Segmentation, given: Mesh, spec: Spec
) -> tuple[Joint, ...]:
    """The joints as a spec states them; those of which it says nothing stay as they are.

    A predictor's own line is kept where it lies as stated; else one is drawn along the part's box.

    Args:
        joints: what a predictor says.
        segmentation: as `shaping.with_parts` returns it.
        given: the mesh that the segmenter was given.
        spec: what is stated.
    """
    mesh = segmentation.mesh_of(given)
    names = [guess.name for guess in segmentation.parts]
    body = _root(segmentation, joints, mesh, spec)
    wishes = dict(zip(names, wishes_of(spec, segmentation.parts, mesh.bounds), strict=True))
    if not any(wish != Wish() for wish in wishes.values()) and not any(part.root for part in spec.parts):
        return tuple(joints)
    labels = [guess.label or guess.name for guess in segmentation.parts]
    places = dict(zip(names, part_places(mesh, segmentation.face_part, labels), strict=True))
    said = {joint.child: joint for joint in joints}
    order = [*said, *(name for name in names if name not in said)]
    made = [wished(said.get(n), wishes[n], places[n], n, body) for n in order if n != body and n in wishes]
    found = [joint for joint in made if joint is not None]
    loose = [name for name in names if name != body and name not in {joint.child for joint in found}]
    if any(part.root for part in spec.parts):
        found += [Joint(f"{name}_mount", "fixed", body, name) for name in loose]
    named = zip(found, unique_names([joint.name for joint in found]), strict=True)
    return _untangled([replace(joint, name=name) for joint, name in named], wishes, body)


def wished(joint: Joint | None, wish: Wish, place: Place, name: str, body: str) -> Joint | None:
    """A part's joint as it is wished.

    Args:
        joint: what is said of it; None: nothing moves it.
        wish: what is stated.
        place: of the part.
        name: of the part.
        body: name of the part that stands still.
    """
    if wish == Wish():
        return joint
    parent = wish.parent or (joint.parent if joint else body)
    states_motion = wish.joint is not None or wish.axis is not None or wish.through is not None
    if wish.joint == "fixed" or (joint is None and not states_motion):
        if joint is not None and not joint.moves:
            return replace(joint, parent=parent)
        return Joint(f"{name}_mount", "fixed", parent, name) if wish.parent or joint else None
    kind = wish.joint or (joint.kind if joint and joint.moves else "revolute")
    if joint is None or joint.kind != kind:
        joint = drawn(kind, wish.axis, place, name)
    if wish.axis is not None and not fits(joint, wish.axis, place):
        joint = turned(joint, wish.axis, place)
    if wish.through is not None:
        joint = replace(joint, origin=wish.through, evidence=(*joint.evidence, "through the point stated"))
    return _limited(replace(joint, parent=parent), wish.limits)


def drawn(kind: JointKind, word: AxisWord | None, place: Place, name: str) -> Joint:
    """A joint along the box of a part: a hinge on an edge, a slide or a spin out of its front."""
    limits, axis, origin = None, place.axes[2], place.center
    if kind == "revolute":
        edges = (place.edges(word) if word else ()) or (("top",) if place.facing == "top" else place.outer)
        axis, origin = place.line(edges[0])
        limits = Limits(0.0, _QUARTER)
    elif kind == "prismatic":
        limits = Limits(0.0, _travel(place))
    told = ("as the spec states, along the part's box",)
    suffix = _SUFFIX.get(kind, "joint")
    return Joint(
        f"{name}_{suffix}", kind, name, name, vec3(origin), vec3(axis), limits, confidence=0.5, evidence=told
    )


def turned(joint: Joint, word: AxisWord, place: Place) -> Joint:
    """The joint with the nearest line that lies as a word says; unchanged where there is none."""
    told = (*joint.evidence, f"{word}, as the spec states")
    way = place.way(word)
    if word.endswith("edge") or (way is None and joint.turns):
        lines = [place.line(edge) for edge in place.edges(word) or _hinge_edges(word)]
        moved = [replace(joint, axis=vec3(axis), origin=vec3(point), evidence=told) for axis, point in lines]
        fitting = [one for one in moved if fits(one, word, place)]
        if fitting:
            nearest = min(fitting, key=lambda one: _apart(one, joint))
            return replace(nearest, limits=Limits(0.0, _QUARTER)) if joint.kind == "revolute" else nearest
    if way is None:
        way = np.array([0.0, 0.0, 1.0]) if word == "vertical" else place.axes[2]
    one = replace(joint, axis=vec3(way), evidence=told)
    if not fits(one, word, place):
        return joint
    return replace(one, limits=Limits(0.0, _travel(place))) if joint.kind == "prismatic" else one


def _hinge_edges(word: AxisWord) -> tuple[str, ...]:
    return EDGES if word in ("vertical", "horizontal") else ()


def _apart(one: Joint, other: Joint) -> float:
    return float(np.linalg.norm(np.subtract(one.origin, other.origin)))


def _travel(place: Place) -> float:
    """How far a slide goes [m]: most of a box's own depth, half the object's where it is a panel."""
    depth, whole = float(place.size[2]), float(place.whole[1, 2] - place.whole[0, 2])
    return _DRAWN * depth if depth > 0.3 * whole else 0.5 * whole


def _limited(joint: Joint, limits: tuple[float, float] | None) -> Joint:
    """The joint with stated limits, where these are others than its own and it has any."""
    if limits is None or joint.limits is None or same_limits(joint.limits, limits):
        return joint
    return replace(joint, limits=Limits(*limits))


def same_limits(limits: Limits, stated: tuple[float, float], scale: float = 1.0) -> bool:
    """Whether limits are those stated, but for what is lost when they are written."""
    own = np.array([limits.lower, limits.upper])
    return bool((np.abs(own - scale * np.array(stated)) <= _SAME_LIMIT * max(1.0, scale)).all())


def _root(segmentation: Segmentation, joints: Sequence[Joint], mesh: Mesh, spec: Spec) -> str:
    """The part that no joint moves: the one stated, else the largest of those that stand still."""
    names = [guess.name for guess in segmentation.parts]
    root = next((part.name for part in spec.parts if part.root), None)
    if root in names:
        return str(root)
    return names[body_of(replace(segmentation, joints=tuple(joints)), mesh, spec)]


def _untangled(joints: Sequence[Joint], wishes: dict[str, Wish], body: str) -> tuple[Joint, ...]:
    """No loops: a parent that nobody stated gives way to the body."""
    parent = {joint.child: joint.parent for joint in joints}
    for start in list(parent):
        way = [start]
        while (above := parent.get(way[-1])) is not None and above not in way:
            way.append(above)
        if above is not None:
            loose = next((name for name in way if not wishes[name].parent), start)
            parent[loose] = body
    return tuple(replace(joint, parent=parent[joint.child]) for joint in joints)


def axis_words(joint: Joint, place: Place) -> AxisWord | None:
    """The word that says best how the axis of a joint lies: an edge first, then a direction."""
    edges: tuple[AxisWord, ...] = ("left edge", "right edge", "top edge", "bottom edge")
    ways: tuple[AxisWord, ...] = ("front", "back", "left", "right", "up", "down", "vertical", "horizontal")
    return next((word for word in (*edges, *ways) if fits(joint, word, place)), None)
