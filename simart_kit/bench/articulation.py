"""Articulation: an object with labelled parts and joints, as a benchmark or any other system states it.

It is more lenient than an Asset: parts without faces, joints without limits and points instead of a surface
occur in the data of others, and have to be scored as they are.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from typing import Literal, get_args

import numpy as np
from numpy.typing import ArrayLike

from ..arrays import FloatArray, IntArray, Vec3, frozen_floats, frozen_ints, unit, vec3
from ..errors import BadInputError
from ..triangles import areas

LinkJointKind = Literal["fixed", "revolute", "continuous", "prismatic", "ball", "free", "unknown"]
_WITH_AXIS = ("revolute", "continuous", "prismatic")
FULL_TURN = 2 * np.pi - 1e-3
"""A turn whose range [rad] is no less is continuous, in formats that have no such kind."""
_LARGEST = 1e12  # lengths and angles beyond are damage; their squares would not be exact


@dataclass(frozen=True, slots=True)
class LinkJoint:
    """How a link moves against its parent; position 0 is the pose of the object as given.

    Attributes:
        kind: one of `LinkJointKind`; "unknown" is of a part that moves in a way nobody said.
        axis: (3,) unit direction in the object's frame; None for kinds without one.
        origin: (3,) point on the axis in the object's frame; None where nobody said.
        lower: lowest position [rad | units of the object]; None where nobody said.
        upper: highest position. One below `lower` is kept: it counts as no travel.
        name: as its source has it.
    """

    kind: LinkJointKind = "fixed"
    axis: Vec3 | None = None
    origin: Vec3 | None = None
    lower: float | None = None
    upper: float | None = None
    name: str = ""

    def __post_init__(self) -> None:
        where = f"joint '{self.name}'" if self.name else "a joint"
        if self.kind not in get_args(LinkJointKind):
            raise BadInputError(f"{where}: kind '{self.kind}' is not one of {_known()}")
        if self.kind in _WITH_AXIS:
            if self.axis is None:
                raise BadInputError(f"{where}: a {self.kind} joint needs an axis")
            object.__setattr__(self, "axis", _direction(where, self.axis))
        else:
            object.__setattr__(self, "axis", None)
        if self.origin is not None and not _sane(self.origin):
            raise BadInputError(f"{where}: origin {self.origin} is not finite, or absurd")
        if (self.lower is None) != (self.upper is None):
            raise BadInputError(f"{where}: one of its two limits is missing")
        for value in (self.lower, self.upper):
            if value is not None and not _sane(value):
                raise BadInputError(f"{where}: limit {value} is not finite, or absurd")

    @property
    def moves(self) -> bool:
        """Whether it is anything but fixed."""
        return self.kind != "fixed"

    @property
    def turns(self) -> bool:
        """Whether it turns about an axis."""
        return self.kind in ("revolute", "continuous")

    def transformed(self, new_from_old: FloatArray) -> LinkJoint:
        """The joint in another frame, by a (4, 4) similarity; travel of a slide is scaled with it."""
        linear, shift = new_from_old[:3, :3], new_from_old[:3, 3]
        scale = abs(float(np.linalg.det(linear))) ** (1 / 3)
        travel = scale if self.kind == "prismatic" else 1.0
        return replace(
            self,
            axis=None if self.axis is None else vec3(unit(linear @ np.array(self.axis))),
            origin=None if self.origin is None else vec3(linear @ np.array(self.origin) + shift),
            lower=None if self.lower is None else self.lower * travel,
            upper=None if self.upper is None else self.upper * travel,
        )


@dataclass(frozen=True, slots=True)
class Link:
    """A rigid part.

    Attributes:
        name: as its source has it; need not be unique.
        parent: index of the link that carries it, -1 for a root.
        joint: how it moves against the parent; that of a root against the world.
        also: further joints of it in the source, any of which is right to predict.
        label: what kind of thing it is, such as "door", or "".
        confidence: 0..1, of the prediction.
    """

    name: str
    parent: int = -1
    joint: LinkJoint = LinkJoint()
    also: tuple[LinkJoint, ...] = ()
    label: str = ""
    confidence: float = 1.0


@dataclass(frozen=True, eq=False)
class Articulation:
    """Surface or point cloud, the link of each face or point, and the tree of links.

    Attributes:
        name: of the object.
        vertices: (V, 3) in any frame and unit.
        faces: (F, 3) vertex indices; (0, 3) for a point cloud.
        labels: (F,) link of each face, or (V,) of each point of a cloud; -1 for none.
        links: at least one. A link may have no face.

    Raises:
        BadInputError: nothing there, no face with an area, labels of a wrong number or range, values that are
            not finite, a parent that does not exist, or links that form a loop.
    """

    name: str
    vertices: FloatArray
    faces: IntArray
    labels: IntArray
    links: tuple[Link, ...]

    def __post_init__(self) -> None:
        object.__setattr__(self, "vertices", frozen_floats(np.asarray(self.vertices).reshape(-1, 3)))
        object.__setattr__(self, "faces", frozen_ints(np.asarray(self.faces).reshape(-1, 3)))
        object.__setattr__(self, "labels", frozen_ints(self.labels))
        _check_geometry(self)
        _check_area(self)
        _check_labels(self)
        _check_tree(self.links)

    @property
    def is_cloud(self) -> bool:
        """Whether it is points and no surface."""
        return not len(self.faces)

    @cached_property
    def triangles(self) -> FloatArray:
        """(F, 3, 3) corner positions."""
        return frozen_floats(self.vertices[self.faces])

    @cached_property
    def weights(self) -> FloatArray:
        """(F,) face areas, or (V,) ones for a cloud: what a label counts for."""
        return frozen_floats(np.ones(len(self.vertices)) if self.is_cloud else areas(self.triangles))

    @cached_property
    def bounds(self) -> FloatArray:
        """(2, 3) lower and upper corner of what is there."""
        points = self.vertices if self.is_cloud else self.vertices[self.faces.ravel()]
        return frozen_floats([points.min(axis=0), points.max(axis=0)])

    @property
    def diagonal(self) -> float:
        """Length of the bounding box's diagonal."""
        return float(np.linalg.norm(self.bounds[1] - self.bounds[0]))

    @property
    def moving(self) -> tuple[int, ...]:
        """Indices of the links that move against their parents."""
        return tuple(i for i, link in enumerate(self.links) if link.joint.moves)

    @property
    def is_static(self) -> bool:
        """Whether nothing moves."""
        return not self.moving

    def carried(self, link: int) -> tuple[int, ...]:
        """Indices of a link and of all that it carries."""
        found = {link}
        for index in ordered(self.links):
            if self.links[index].parent in found:
                found.add(index)
        return tuple(sorted(found))

    def transformed(self, new_from_old: FloatArray) -> Articulation:
        """The object moved by a (4, 4) similarity, joints with it."""
        matrix = np.asarray(new_from_old, dtype=np.float64)
        links = tuple(
            replace(
                link,
                joint=link.joint.transformed(matrix),
                also=tuple(joint.transformed(matrix) for joint in link.also),
            )
            for link in self.links
        )
        return replace(self, vertices=self.vertices @ matrix[:3, :3].T + matrix[:3, 3], links=links)

    def rigid(self) -> Articulation:
        """The object with every link that is fixed to another taken together with it.

        A handle that is its own link, fixed to a door, is a piece of the door. Roots are one body.
        """
        group = _rigid_groups(self.links)
        heads = sorted(set(group))
        index = {head: i for i, head in enumerate(heads)}
        links = []
        for head in heads:
            link = self.links[head]
            links.append(replace(link, parent=index[group[link.parent]] if link.parent >= 0 else -1))
        merged = np.array([index[g] for g in group] + [-1])  # the last is found by label -1
        return replace(self, labels=merged[self.labels], links=tuple(links))


def ordered(links: tuple[Link, ...]) -> tuple[int, ...]:
    """Indices of links, each after its parent."""
    children: dict[int, list[int]] = {}
    for index, link in enumerate(links):
        children.setdefault(link.parent, []).append(index)
    found = list(children.get(-1, []))
    for index in found:  # grows while it is gone through
        found += children.get(index, [])
    return tuple(found)


def _rigid_groups(links: tuple[Link, ...]) -> list[int]:
    """For each link, the one that stands for its rigid body; all roots that do not move are one."""
    still = [i for i in ordered(links) if links[i].parent < 0 and not links[i].joint.moves]
    group = list(range(len(links)))
    for index in ordered(links):
        if not links[index].joint.moves:
            group[index] = still[0] if links[index].parent < 0 else group[links[index].parent]
    return group


def _direction(where: str, axis: Vec3) -> Vec3:
    try:
        return vec3(unit(axis))
    except ValueError as error:
        raise BadInputError(f"{where}: axis {axis}: {error}") from error


def _sane(values: ArrayLike) -> bool:
    return bool((np.abs(values) < _LARGEST).all())  # NaN is not


def _known() -> str:
    return ", ".join(get_args(LinkJointKind))


def _check_geometry(value: Articulation) -> None:
    if not len(value.vertices):
        raise BadInputError(f"'{value.name}' has no vertices")
    if not _sane(value.vertices):
        raise BadInputError(f"'{value.name}' has vertices that are NaN, infinite or beyond {_LARGEST:.0e}")
    if len(value.faces) and not 0 <= value.faces.min() <= value.faces.max() < len(value.vertices):
        raise BadInputError(f"'{value.name}' has face indices outside 0..{len(value.vertices) - 1}")


def _check_area(value: Articulation) -> None:
    if not value.weights.sum() > 0:
        raise BadInputError(f"'{value.name}' has no surface: none of its faces has an area")


def _check_labels(value: Articulation) -> None:
    what, count = ("points", len(value.vertices)) if value.is_cloud else ("faces", len(value.faces))
    if value.labels.shape != (count,):
        raise BadInputError(
            f"'{value.name}' has labels of shape {value.labels.shape} for {count} {what}: one each is needed"
        )
    if not value.links:
        raise BadInputError(f"'{value.name}' has no parts")
    if value.labels.min() < -1 or value.labels.max() >= len(value.links):
        raise BadInputError(
            f"'{value.name}' has labels {value.labels.min()}..{value.labels.max()} "
            f"for {len(value.links)} parts: allowed are -1..{len(value.links) - 1}"
        )


def _check_tree(links: tuple[Link, ...]) -> None:
    for link in links:
        if not -1 <= link.parent < len(links):
            raise BadInputError(f"part '{link.name}' has parent {link.parent}: there is no such part")
    missing = set(range(len(links))) - set(ordered(links))
    if missing:
        names = ", ".join(f"'{links[i].name}'" for i in sorted(missing))
        raise BadInputError(f"the parts {names} form a loop of parents")
