"""The Asset: parts, joints and surface as frozen values. The one thing that exporters read."""

from __future__ import annotations

import math
import re
import unicodedata
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import TYPE_CHECKING, Literal, get_args

import numpy as np

from .arrays import FloatArray, IntArray, Mat3, Vec3, frozen_floats, frozen_ints, unit, vec3
from .errors import BadInputError
from .mesh import Mesh, Note
from .primitives import Primitive

if TYPE_CHECKING:
    from .kinematics import Positions

JointKind = Literal["fixed", "revolute", "continuous", "prismatic", "ball", "free"]
NAME_PATTERN = re.compile(r"[a-z][a-z0-9_]*")


@dataclass(frozen=True, slots=True)
class Limits:
    """Range of a joint about its rest position 0, which it includes.

    Attributes:
        lower: lowest position [rad or m], at most 0.
        upper: highest position [rad or m], at least 0.
    """

    lower: float
    upper: float

    def __post_init__(self) -> None:
        if not (math.isfinite(self.lower) and math.isfinite(self.upper) and self.lower <= 0.0 <= self.upper):
            raise BadInputError(
                f"limits ({self.lower}, {self.upper}): need finite lower <= 0 <= upper, "
                "for 0 is the pose of the input mesh"
            )


@dataclass(frozen=True, slots=True)
class Joint:
    """How one part moves against another; position 0 is the pose of the input mesh.

    Attributes:
        name: unique, `[a-z][a-z0-9_]*`.
        kind: one of `JointKind`.
        parent: name of the part that carries it.
        child: name of the part that it moves.
        origin: (3,) a point on the axis, in the asset frame at rest [m]; the child's frame sits there.
        axis: (3,) unit direction in the asset frame at rest; positive turns follow the right hand.
        limits: travel [rad | m]; required for revolute and prismatic, None for the other kinds.
        damping: [N*m*s/rad | N*s/m].
        friction: dry friction, torque or force [N*m | N].
        armature: inertia added for the solver's sake, as of a rotor [kg*m^2 | kg].
        effort: most that an actuator may exert [N*m | N].
        velocity: highest speed [rad/s | m/s].
        confidence: 0..1, the predictor's own.
        evidence: why this joint was chosen, a phrase each.
        flags: checks that it failed, a phrase each; a flagged joint is kept.
    """

    name: str
    kind: JointKind
    parent: str
    child: str
    origin: Vec3 = (0.0, 0.0, 0.0)
    axis: Vec3 = (0.0, 0.0, 1.0)
    limits: Limits | None = None
    damping: float = 0.0
    friction: float = 0.0
    armature: float = 0.0
    effort: float = 50.0
    velocity: float = 2.0
    confidence: float = 1.0
    evidence: tuple[str, ...] = ()
    flags: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        where = f"joint '{self.name}'"
        _check_name(where, self.name)
        if self.kind not in get_args(JointKind):
            raise BadInputError(f"{where}: kind '{self.kind}' is not one of {', '.join(get_args(JointKind))}")
        if not np.isfinite(self.origin).all():
            raise BadInputError(f"{where}: origin {self.origin} is not finite")
        if not np.isclose(np.linalg.norm(self.axis), 1.0, atol=1e-6):
            raise BadInputError(f"{where}: axis {self.axis} is not a unit vector")
        if (self.limits is not None) != (self.kind in ("revolute", "prismatic")):
            wanted = "needs limits" if self.limits is None else "takes no limits"
            raise BadInputError(f"{where}: a {self.kind} joint {wanted}")
        for name in ("damping", "friction", "armature", "effort", "velocity"):
            value = getattr(self, name)
            if not (math.isfinite(value) and value >= 0):
                raise BadInputError(f"{where}: {name} {value} must be a finite number >= 0")
        if not 0.0 <= self.confidence <= 1.0:
            raise BadInputError(f"{where}: confidence {self.confidence} must lie in 0..1")

    @property
    def moves(self) -> bool:
        """Whether it is anything but fixed."""
        return self.kind != "fixed"

    @property
    def rigid(self) -> bool:
        """Whether it cannot move: fixed, or without travel, which loaders refuse as a range."""
        return self.kind == "fixed" or (self.limits is not None and self.limits.lower == self.limits.upper)

    @property
    def turns(self) -> bool:
        """Whether its position is an angle about `axis`."""
        return self.kind in ("revolute", "continuous")

    def transformed(self, new_from_old: FloatArray) -> Joint:
        """The joint in another frame, by a (4, 4) similarity without mirroring; travel of a slide scales."""
        linear, shift = new_from_old[:3, :3], new_from_old[:3, 3]
        scale = float(np.linalg.det(linear)) ** (1 / 3)
        limits = self.limits
        if limits and self.kind == "prismatic":
            limits = Limits(limits.lower * scale, limits.upper * scale)
        return replace(
            self,
            origin=vec3(linear @ np.array(self.origin) + shift),
            axis=vec3(unit(linear @ np.array(self.axis))),
            limits=limits,
        )


@dataclass(frozen=True, slots=True)
class Material:
    """What a part is made of.

    Attributes:
        name: key of the material table, such as "wood".
        density: [kg/m^3].
        friction: sliding friction coefficient.
        restitution: 0 (no bounce) .. 1.
        youngs_modulus: stiffness of the solid material [Pa].
    """

    name: str = "wood"
    density: float = 600.0
    friction: float = 0.5
    restitution: float = 0.1
    youngs_modulus: float = 1e10


@dataclass(frozen=True, slots=True)
class MassProperties:
    """Inertial properties of a part at rest.

    Attributes:
        mass: [kg].
        center: (3,) centre of mass in the asset frame [m].
        inertia: (3, 3) about `center`, along the asset's axes [kg*m^2].
        method: how the volume was found, such as "closed mesh" or "convex hull".
    """

    mass: float
    center: Vec3
    inertia: Mat3
    method: str = ""


@dataclass(frozen=True, eq=False)
class ConvexMesh:
    """One convex collision shape, in the asset frame at rest.

    Attributes:
        vertices: (V, 3) corners [m].
        faces: (F, 3) outward triangles.
        primitive: what it is exactly, where that is a primitive; the mesh is then drawn after it.
    """

    vertices: FloatArray
    faces: IntArray
    primitive: Primitive | None = None

    def __post_init__(self) -> None:
        object.__setattr__(self, "vertices", frozen_floats(self.vertices))
        object.__setattr__(self, "faces", frozen_ints(self.faces))


@dataclass(frozen=True, slots=True, eq=False)
class Part:
    """A rigid piece; its faces are those that `Asset.face_part` gives its index.

    Attributes:
        name: unique, `[a-z][a-z0-9_]*`; the link name in every export.
        label: what kind of thing it is, such as "door".
        description: for people.
        material: what it is made of.
        stated_mass: what a person says that it weighs [kg]; the `mass` modifier keeps to it.
        mass: inertial properties, or None until the `mass` modifier ran.
        collision: convex shapes, empty until the `collision` modifier ran.
    """

    name: str
    label: str = ""
    description: str = ""
    material: Material = Material()
    mass: MassProperties | None = None
    collision: tuple[ConvexMesh, ...] = ()
    stated_mass: float | None = None

    def __post_init__(self) -> None:
        _check_name(f"part '{self.name}'", self.name)


@dataclass(frozen=True, slots=True)
class Scale:
    """How the size was decided.

    Attributes:
        factor: what the nominal metres of the file were multiplied by.
        reason: one sentence.
    """

    factor: float = 1.0
    reason: str = "as the file says"


@dataclass(frozen=True, eq=False)
class Asset:
    """An articulated object: surface, parts and a tree of joints. Canonical frame, metres.

    Attributes:
        name: `[a-z][a-z0-9_]*`; names the exported files.
        mesh: the whole surface at rest.
        face_part: (F,) index into `parts` of each face.
        parts: at least one; every part has a face.
        joints: one for every part but the root, parents before or after children in any order.
        asset_from_source: (4, 4) maps the source file's coordinates to the asset frame.
        scale: how the size was decided.
        floating: whether the root is free instead of fixed to the world.
        notes: what stages decided or could not do.

    Raises:
        BadInputError: labels of a wrong shape or range, names that are not unique or unknown, or joints that
            are not a tree with one root.
    """

    name: str
    mesh: Mesh
    face_part: IntArray
    parts: tuple[Part, ...]
    joints: tuple[Joint, ...] = ()
    asset_from_source: FloatArray = field(default_factory=lambda: frozen_floats(np.eye(4)))
    scale: Scale = Scale()
    floating: bool = False
    notes: tuple[Note, ...] = ()

    def __post_init__(self) -> None:
        object.__setattr__(self, "face_part", frozen_ints(self.face_part))
        object.__setattr__(self, "asset_from_source", frozen_floats(self.asset_from_source))
        _check_name("asset", self.name)
        if self.face_part.shape != (len(self.mesh.faces),):
            raise BadInputError(
                f"face_part has shape {self.face_part.shape}, expected ({len(self.mesh.faces)},)"
            )
        used = np.unique(self.face_part)
        if not np.array_equal(used, np.arange(len(self.parts))):
            raise BadInputError(
                f"face_part uses ids {used.tolist()}, expected each of 0..{len(self.parts) - 1}"
            )
        _check_unique("part", [p.name for p in self.parts])
        _check_unique("joint", [j.name for j in self.joints])
        self._check_tree()

    def bare(self) -> Asset:
        """The same without what was worked out of it and is kept with it: to be sent to another process."""
        return replace(self, mesh=replace(self.mesh))

    @cached_property
    def root(self) -> Part:
        """The part that no joint moves."""
        children = {j.child for j in self.joints}
        return next(p for p in self.parts if p.name not in children)

    def part(self, name: str) -> Part:
        """The part of this name; raises BadInputError naming those that exist."""
        return self.parts[self.part_index(name)]

    def part_index(self, name: str) -> int:
        """Its index in `parts` and `face_part`; raises BadInputError naming those that exist."""
        if name not in self._part_indices:
            raise BadInputError(f"no part '{name}': parts are {', '.join(p.name for p in self.parts)}")
        return self._part_indices[name]

    def joint(self, name: str) -> Joint:
        """The joint of this name; raises BadInputError naming those that exist."""
        if name not in self._joints_by_name:
            known = ", ".join(j.name for j in self.joints) or "none"
            raise BadInputError(f"no joint '{name}': joints are {known}")
        return self._joints_by_name[name]

    def has_joint(self, name: str) -> bool:
        """Whether there is a joint of this name."""
        return name in self._joints_by_name

    def joint_to(self, part: str) -> Joint | None:
        """The joint that moves a part; None for the root."""
        return self._joints_by_child.get(part)

    def at(self, positions: Positions) -> dict[str, FloatArray]:
        """Posed part frames: `world_T_part` (4, 4) by part name; see `kinematics.forward`."""
        from .kinematics import forward

        return forward(self, positions)

    def with_notes(self, stage: str, level: Literal["info", "warning"], texts: Iterable[str]) -> Asset:
        """The asset with one more note a text."""
        noted = replace(self, notes=self.notes + tuple(Note(stage, level, text) for text in texts))
        # What is computed of an asset and kept with it does not depend on its notes.
        vars(noted).update({name: value for name, value in vars(self).items() if name not in vars(noted)})
        return noted

    def with_parts(self, changed: Mapping[str, Part]) -> Asset:
        """The asset with some parts replaced, by name."""
        return replace(self, parts=tuple(changed.get(p.name, p) for p in self.parts))

    def with_joints(self, changed: Mapping[str, Joint]) -> Asset:
        """The asset with some joints replaced, by name."""
        return replace(self, joints=tuple(changed.get(j.name, j) for j in self.joints))

    @cached_property
    def _part_indices(self) -> dict[str, int]:
        return {part.name: index for index, part in enumerate(self.parts)}

    @cached_property
    def _joints_by_name(self) -> dict[str, Joint]:
        return {joint.name: joint for joint in self.joints}

    @cached_property
    def _joints_by_child(self) -> dict[str, Joint]:
        return {joint.child: joint for joint in self.joints}

    def _check_tree(self) -> None:
        names = {p.name for p in self.parts}
        for joint in self.joints:
            for end in (joint.parent, joint.child):
                if end not in names:
                    raise BadInputError(
                        f"joint '{joint.name}' names part '{end}': parts are {', '.join(sorted(names))}"
                    )
        _check_unique("joint child", [j.child for j in self.joints])
        roots = names - {j.child for j in self.joints}
        if len(roots) != 1:
            found = ", ".join(sorted(roots)) or "none (the joints form a loop)"
            raise BadInputError(f"an asset needs one root part, found {found}")
        parent = {j.child: j.parent for j in self.joints}
        for name in names:
            seen = {name}
            while name in parent:
                name = parent[name]
                if name in seen:
                    raise BadInputError(f"the joints form a loop through part '{name}'")
                seen.add(name)


def clean_name(text: str, fallback: str = "part") -> str:
    """Turn any text into `[a-z][a-z0-9_]*`; "world" is MuJoCo's and gets the fallback before it."""
    plain = unicodedata.normalize("NFKD", text).encode("ascii", "ignore").decode()  # without accents
    name = re.sub(r"[^a-z0-9]+", "_", plain.lower()).strip("_")
    if not name:
        return fallback
    if name == "world":
        return f"{fallback}_world"
    return name if name[0].isalpha() else f"{fallback}_{name}"


def unique_names(names: Sequence[str]) -> list[str]:
    """Number the second and later uses of a name: door, door_2, door_3."""
    taken: set[str] = set()
    result = []
    for name in names:
        candidate, number = name, 2
        while candidate in taken:
            candidate, number = f"{name}_{number}", number + 1
        taken.add(candidate)
        result.append(candidate)
    return result


def _check_name(where: str, name: str) -> None:
    if not NAME_PATTERN.fullmatch(name):
        raise BadInputError(f"{where}: name '{name}' must start with a letter and use only a-z, 0-9 and _")


def _check_unique(what: str, names: Sequence[str]) -> None:
    twice = sorted({n for n in names if names.count(n) > 1})
    if twice:
        raise BadInputError(f"{what} name used twice: {', '.join(twice)}")
