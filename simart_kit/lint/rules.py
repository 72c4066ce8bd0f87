"""Every rule of the linter, in one place: its id, how bad a breach is, where it applies, and what it says."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Literal

Severity = Literal["error", "warning"]


@dataclass(frozen=True, slots=True)
class Rule:
    """What must hold of a file.

    Attributes:
        severity: "error" where a simulator is misled or refuses the file, "warning" where some are.
        formats: of "usd", "urdf" and "mjcf", those that the rule looks at.
        doc: what is wrong when it is broken, one line.
    """

    severity: Severity
    formats: tuple[str, ...]
    doc: str


_FILES = """
E all        unreadable              the file is damaged, is of another format, or has a DOCTYPE
E all        file-missing            a file that it names does not exist
E all        file-absolute           a file is named by an absolute path or a URL: the folder cannot be moved
E all        file-escapes            a file is named outside the folder of the asset
W urdf       file-package            a file is named by `package://`: some loaders drop its shape in silence
E usd        composition             USD cannot put the layers together
E usd        attribute-type          an attribute is of another type than its schema says
E all        number-invalid          a number is NaN, infinite or no number, or there are too few of them
W urdf       tag-unknown             an element is none of URDF or a known simulator: nobody reads it
E mjcf       mujoco-refuses          MuJoCo does not load the file
"""
_STAGE = """
E usd        up-axis-missing         the stage does not say `upAxis`: the fallback is Y
W usd        up-axis                 a stage with physics is not Z up, or one for AR is not Y up
E usd        units-missing           the stage does not say `metersPerUnit`: the fallback is centimetres
W usd        units                   a stage with physics is not in metres
W usd        kilograms-missing       the stage does not say `kilogramsPerUnit`
W usd        kilograms               masses are not in kilograms
E usd        default-prim-missing    the stage has no default prim: it cannot be referenced
W usd        scene-gravity           a physics scene leaves out gravity: some engines take infinity
"""
_BODIES = """
E all        body-missing            there is no body or link
E usd        body-scaled             a rigid body is scaled or sheared
W usd        body-nested             a rigid body stands below another one: some applications cannot read that
E urdf       name-missing            a link or joint has no name
E urdf       name-duplicate          two links or two joints have one name
E usd,urdf   mass-missing            a body has no mass of its own: simulators make one up
W usd,mjcf   mass-guessed            mass comes from shapes and density instead of being stated
E all        mass-not-positive       a mass is zero or negative
W usd        inertia-missing         a body has a mass but no inertia of its own
E all        inertia-not-positive    an inertia tensor is not positive definite
E all        inertia-triangle        principal moments a + b < c: no real body has such an inertia
W usd,mjcf   inertia-implausible     an inertia is too large or far too small for the body's mass and size
W usd,mjcf   com-outside             the centre of mass is outside the body's bounds
E usd        quaternion-not-unit     a rotation of a joint frame or of principal axes is no unit quaternion
"""
_COLLIDERS = """
E all        collider-missing        nothing in the asset collides
W all        body-collider-missing   a body is drawn and does not collide
E usd        collider-api            a collision schema is applied to a prim that it is not for
E usd        collider-approximation  `physics:approximation` is none of the schema's tokens
W usd        collider-concave        a moving body collides by its raw triangles: engines take something else
W usd        collider-visible        a collider is drawn and has no look: its purpose should be `guide`
E urdf       geometry-missing        a visual or collision has no shape
E usd,urdf   size-not-positive       a box, cylinder, sphere or scale is zero or negative in size
E urdf       scale-negative          a mesh is mirrored by a negative scale: its faces turn inside out
E all        friction-negative       a friction or density is negative
E usd,urdf   restitution-range       a restitution is not in 0..1
"""
_JOINTS = """
E urdf       joint-type              a joint is of no known type
E usd,urdf   joint-target-missing    a joint names a body that does not exist
E usd,urdf   joint-self              a joint connects a body to itself
E usd        joint-no-body           neither end of a joint is a rigid body
E usd,urdf   joint-loop              joints form a loop, or a link has two parents
E urdf       link-orphan             a link hangs on no joint, so that there are several roots
W urdf       axis-missing            a moving joint has no `<axis>`: the fallback is x
E usd        axis-token              the axis of a joint is none of X, Y and Z
E urdf       axis-zero               an axis has no length
E urdf       axis-not-unit           an axis is no unit vector: some loaders scale the motion
E urdf       limit-missing           a revolute or prismatic joint has no limits
E urdf       effort-missing          a limit has no effort or no velocity
E all        limits-reversed         the lower limit is above the upper one
W usd,urdf   limits-empty            both limits are the same: the joint cannot move
W all        limits-rest             the rest pose is outside the limits: simulation begins with a jump
W urdf       limits-large            limits are beyond two turns: degrees instead of radians?
W urdf,mjcf  limit-unused            limits are given and not in force
E all        damping-negative        a damping, friction, stiffness, armature, effort or velocity is negative
W urdf       mimic                   a joint mimics another one: several simulators ignore it
E urdf       mimic-target            a joint mimics itself or one that does not exist
E usd        joint-frames            the two frames of a joint disagree at rest: the joint snaps together
W usd        joint-offset            a joint is not at 0 in the rest pose
E usd        articulation-missing    bodies are connected by joints and no articulation root is above them
E usd        articulation-nested     bodies belong to more than one articulation root
E usd        articulation-static     an articulation root is on a body that is static or kinematic
"""
_MESHES = """
E usd        mesh-index              a face names a point that does not exist
E usd        mesh-counts             face counts and face indices do not fit each other
W usd        mesh-empty              a mesh has no faces
E usd        mesh-extent             the extent of a shape is missing or not that of its points
W usd        mesh-degenerate         faces have no area
W usd        mesh-subdivided         `subdivisionScheme` is not none: renderers round the mesh off
E usd        normals-count           there are more or fewer normals than their interpolation asks for
W usd        normals-not-unit        normals are not of length 1
W usd        normals-flipped         normals point against the winding of the faces
W usd        winding-flipped         the faces of a closed mesh are wound inwards
E usd        binding-api-missing     a material is bound without `MaterialBindingAPI`: it is ignored
E usd        binding-target-missing  the material bound to a prim does not exist
E usd        normal-map              a normal map is not read as raw values of -1..1
"""


def _parsed(text: str) -> Iterator[tuple[str, Rule]]:
    """The rules of a table: E or W, formats, id and doc a line."""
    severities: dict[str, Severity] = {"E": "error", "W": "warning"}
    for line in text.strip().splitlines():
        severity, formats, rule, doc = line.split(maxsplit=3)
        known = ("usd", "urdf", "mjcf") if formats == "all" else tuple(formats.split(","))
        yield rule, Rule(severities[severity], known, doc)


RULES: dict[str, Rule] = {
    name: rule
    for text in (_FILES, _STAGE, _BODIES, _COLLIDERS, _JOINTS, _MESHES)
    for name, rule in _parsed(text)
}


def rule_table(severity: Severity) -> str:
    """A Markdown table of the rules of one severity, in order, for the documentation."""
    from ..describe import cell, table

    rows = (
        (f"`{name}`", ", ".join(rule.formats), cell(rule.doc))
        for name, rule in RULES.items()
        if rule.severity == severity
    )
    return table(("Rule", "Formats", "What is wrong"), rows)
