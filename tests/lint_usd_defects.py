"""Defects to seed in a USD file, each with the one rule that must tell of it."""

from __future__ import annotations

from collections.abc import Callable
from math import inf, nan
from typing import Any

import numpy as np
from numpy.typing import NDArray
from pxr import Gf, Sdf, Usd, UsdGeom, UsdPhysics, UsdShade, Vt

from .lint_cases import SeededStage, put, scaled

Seed = Callable[[SeededStage], object]
Numbers = NDArray[Any]
STAGE: dict[str, tuple[str, Seed]] = {
    "no_up_axis": ("up-axis-missing", lambda s: s.stage.ClearMetadata("upAxis")),
    "y_up": ("up-axis", lambda s: UsdGeom.SetStageUpAxis(s.stage, "Y")),
    "no_metres": ("units-missing", lambda s: s.stage.ClearMetadata("metersPerUnit")),
    "centimetres": ("units", lambda s: UsdGeom.SetStageMetersPerUnit(s.stage, 0.01)),
    "no_kilograms": ("kilograms-missing", lambda s: s.stage.ClearMetadata("kilogramsPerUnit")),
    "grams": ("kilograms", lambda s: UsdPhysics.SetStageKilogramsPerUnit(s.stage, 0.001)),
    "no_default_prim": ("default-prim-missing", lambda s: s.stage.ClearDefaultPrim()),
    "empty_scene": ("scene-gravity", lambda s: UsdPhysics.Scene.Define(s.stage, "/scene")),
    "texture_missing": ("file-missing", lambda s: image(s, "./textures/none.png")),
    "texture_escaping": ("file-escapes", lambda s: image(s, "../outside.png")),
    "texture_absolute": ("file-absolute", lambda s: image(s, "/usr/share/wood.png")),
    "texture_url": ("file-absolute", lambda s: image(s, "https://example.org/wood.png")),
    "reference_missing": ("file-missing", lambda s: s.root.GetReferences().AddReference("./none.usda")),
    "reference_escaping": ("file-escapes", lambda s: s.root.GetPayloads().AddPayload("../outside.usda")),
    "sublayer_absolute": (
        "file-absolute",
        lambda s: s.stage.GetRootLayer().subLayerPaths.append("/etc/x.usda"),
    ),
    "reference_to_no_prim": (
        "composition",
        lambda s: s.root.GetReferences().AddReference("./cabinet.usda", "/nothing"),
    ),
}


def image(s: SeededStage, name: str) -> None:
    put(s.shader("base_color"), "inputs:file", Sdf.AssetPath(name))


def door(name: str, value: object) -> Seed:
    return lambda s: put(s.body("door"), f"physics:{name}", value)


def unscaled(s: SeededStage) -> None:
    UsdGeom.Xformable(s.body("door")).AddScaleOp().Set(Gf.Vec3f(2.0))


def no_mass(s: SeededStage) -> None:
    s.body("door").RemoveAPI(UsdPhysics.MassAPI)


def density_only(s: SeededStage) -> None:
    s.body("door").GetAttribute("physics:mass").Block()
    UsdPhysics.MassAPI(s.body("door")).CreateDensityAttr(600.0)


def mistyped_mass(s: SeededStage) -> None:
    spec = s.stage.GetRootLayer().GetPrimAtPath(s.body("door").GetPath())
    del spec.properties["physics:mass"]
    Sdf.AttributeSpec(spec, "physics:mass", Sdf.ValueTypeNames.String).default = "heavy"


def nested_body(s: SeededStage) -> None:
    knob = s.stage.DefinePrim(s.body("door").GetPath().AppendChild("knob"), "Xform")
    UsdPhysics.RigidBodyAPI.Apply(knob)
    mass = UsdPhysics.MassAPI.Apply(knob)
    mass.CreateMassAttr(1.0)
    mass.CreateDiagonalInertiaAttr(Gf.Vec3f(0.1))


def no_bodies(s: SeededStage) -> None:
    for prim in [p for p in s.stage.Traverse() if p.IsA(UsdPhysics.Joint)]:
        prim.SetActive(False)
    for prim in s.having("RigidBodyAPI"):
        prim.RemoveAPI(UsdPhysics.RigidBodyAPI)


BODIES: dict[str, tuple[str, Seed]] = {
    "no_bodies": ("body-missing", no_bodies),
    "scaled_body": ("body-scaled", unscaled),
    "nested_body": ("body-nested", nested_body),
    "no_mass_api": ("mass-missing", no_mass),
    "density_only": ("mass-guessed", density_only),
    "mass_zero": ("mass-not-positive", door("mass", 0.0)),
    "mass_negative": ("mass-not-positive", door("mass", -1.0)),
    "mass_nan": ("number-invalid", door("mass", nan)),
    "mass_is_text": ("attribute-type", mistyped_mass),
    "mass_infinite": ("number-invalid", door("mass", inf)),
    "center_nan": ("number-invalid", door("centerOfMass", Gf.Vec3f(0.0, nan, 0.0))),
    "no_inertia": (
        "inertia-missing",
        lambda s: s.body("door").GetAttribute("physics:diagonalInertia").Block(),
    ),
    "inertia_zero": ("inertia-not-positive", door("diagonalInertia", Gf.Vec3f(0.0))),
    "inertia_negative": ("inertia-not-positive", door("diagonalInertia", Gf.Vec3f(0.1, 0.1, -0.1))),
    "inertia_triangle": ("inertia-triangle", door("diagonalInertia", Gf.Vec3f(0.01, 0.01, 0.03))),
    "inertia_in_centimetres": (
        "inertia-implausible",
        lambda s: scaled(s.body("door"), "physics:diagonalInertia", 1e4),
    ),
    "inertia_in_tonnes": (
        "inertia-implausible",
        lambda s: scaled(s.body("door"), "physics:diagonalInertia", 1e-6),
    ),
    "center_elsewhere": ("com-outside", door("centerOfMass", Gf.Vec3f(5.0, 0.0, 0.0))),
    "principal_axes_zero": ("quaternion-not-unit", door("principalAxes", Gf.Quatf(0.0))),
}


def without_colliders(s: SeededStage, *names: str) -> None:
    for prim in s.having("CollisionAPI"):
        if not names or prim.GetParent().GetName() in names:
            prim.RemoveAPI(UsdPhysics.CollisionAPI)
            prim.RemoveAPI(UsdPhysics.MeshCollisionAPI)


def drawn_collider(s: SeededStage) -> None:
    put(s.collider("door"), "purpose", "default")


def flat_ball(s: SeededStage) -> None:
    ball = UsdGeom.Sphere.Define(s.stage, s.body("door").GetPath().AppendChild("ball"))
    ball.CreateRadiusAttr(0.0)
    ball.CreatePurposeAttr("guide")
    UsdPhysics.CollisionAPI.Apply(ball.GetPrim())


def slides(name: str, value: float) -> Seed:
    return lambda s: put(s.having("MaterialAPI")[0], f"physics:{name}", value)


def approximated(token: str) -> Seed:
    return lambda s: put(s.collider("door"), "physics:approximation", token)


COLLIDERS: dict[str, tuple[str, Seed]] = {
    "no_collider": ("collider-missing", without_colliders),
    "no_collider_of_the_door": ("body-collider-missing", lambda s: without_colliders(s, "door")),
    "approximation_token": ("collider-approximation", approximated("convex")),
    "approximation_none": ("collider-concave", approximated("none")),
    "approximation_missing": (
        "collider-concave",
        lambda s: s.collider("door").RemoveAPI(UsdPhysics.MeshCollisionAPI),
    ),
    "collision_on_a_body": ("collider-api", lambda s: UsdPhysics.CollisionAPI.Apply(s.body("door"))),
    "mesh_collision_on_a_body": (
        "collider-api",
        lambda s: s.body("door").AddAppliedSchema("PhysicsMeshCollisionAPI"),
    ),
    "mesh_collision_alone": ("collider-api", lambda s: UsdPhysics.MeshCollisionAPI.Apply(s.visual("door"))),
    "collider_drawn": ("collider-visible", drawn_collider),
    "sphere_of_no_size": ("size-not-positive", flat_ball),
    "friction_negative": ("friction-negative", slides("dynamicFriction", -0.5)),
    "density_negative": ("friction-negative", slides("density", -1.0)),
    "restitution_of_2": ("restitution-range", slides("restitution", 2.0)),
}


def ends(kind: str, **bodies: str | None) -> Seed:
    """Other bodies at a joint: a path, or None for none."""

    def seed(s: SeededStage) -> None:
        for side, path in bodies.items():
            relation = s.joint(kind).GetRelationship(f"physics:{side}")
            relation.SetTargets([Sdf.Path(path.format(root=s.root.GetPath()))] if path else [])

    return seed


def at_itself(s: SeededStage) -> None:
    joint = s.joint("Revolute")
    joint.GetRelationship("physics:body0").SetTargets(joint.GetRelationship("physics:body1").GetTargets())


def joint_value(kind: str, name: str, value: object) -> Seed:
    return lambda s: put(s.joint(kind), f"physics:{name}", value)


def limits(lower: float, upper: float) -> Seed:
    def seed(s: SeededStage) -> None:
        put(s.joint("Revolute"), "physics:lowerLimit", lower)
        put(s.joint("Revolute"), "physics:upperLimit", upper)

    return seed


def moved_frame(s: SeededStage) -> None:
    place = s.joint("Revolute").GetAttribute("physics:localPos0")
    place.Set(place.Get() + Gf.Vec3f(0.0, 0.0, 0.01))


def turned_frame(s: SeededStage) -> None:
    turn = s.joint("Prismatic").GetAttribute("physics:localRot0")
    turn.Set(turn.Get() * Gf.Quatf(Gf.Rotation(Gf.Vec3d(1.0, 0.0, 0.0), 5.0).GetQuat()))


def opened(s: SeededStage) -> None:
    """The drawer, whose frames have x along the way, stands 5 cm out at rest."""
    joint = s.joint("Prismatic")
    way = joint.GetAttribute("physics:localRot0").Get().Transform(Gf.Vec3f(1.0, 0.0, 0.0))
    place = joint.GetAttribute("physics:localPos0")
    place.Set(place.Get() - way * 0.05)


def ajar(s: SeededStage) -> None:
    """The door, whose frames have x along the hinge, is turned by -20 degrees at rest."""
    turn = s.joint("Revolute").GetAttribute("physics:localRot0")
    turn.Set(turn.Get() * Gf.Quatf(Gf.Rotation(Gf.Vec3d(1.0, 0.0, 0.0), 20.0).GetQuat()))


def loop(s: SeededStage) -> None:
    joint = UsdPhysics.FixedJoint.Define(s.stage, s.root.GetPath().AppendChild("strut"))
    one, two = s.body("door"), s.body("drawer")
    joint.CreateBody0Rel().SetTargets([one.GetPath()])
    joint.CreateBody1Rel().SetTargets([two.GetPath()])
    cache = UsdGeom.XformCache()
    between = cache.GetLocalToWorldTransform(two) * cache.GetLocalToWorldTransform(one).GetInverse()
    joint.CreateLocalPos0Attr(Gf.Vec3f(between.ExtractTranslation()))
    joint.CreateLocalRot0Attr(Gf.Quatf(between.ExtractRotationQuat()))


def rootless(s: SeededStage) -> None:
    for prim in s.having("ArticulationRootAPI"):
        prim.RemoveAPI(UsdPhysics.ArticulationRootAPI)


def kinematic_root(s: SeededStage) -> None:
    rootless(s)
    UsdPhysics.ArticulationRootAPI.Apply(s.body("body"))
    UsdPhysics.RigidBodyAPI(s.body("body")).CreateKinematicEnabledAttr(True)


def negative_damping(s: SeededStage) -> None:
    UsdPhysics.DriveAPI.Apply(s.joint("Revolute"), "angular").CreateDampingAttr(-1.0)


def negative_newton_friction(s: SeededStage) -> None:
    s.joint("Revolute").CreateAttribute("newton:friction", Sdf.ValueTypeNames.Float).Set(-0.1)


JOINTS: dict[str, tuple[str, Seed]] = {
    "target_missing": ("joint-target-missing", ends("Revolute", body1="{root}/nothing")),
    "ends_are_one": ("joint-self", at_itself),
    "no_ends": ("joint-no-body", ends("Revolute", body0=None, body1=None)),
    "limits_reversed": ("limits-reversed", limits(0.0, -90.0)),
    "limits_nan": ("number-invalid", limits(nan, 0.0)),
    "limits_empty": ("limits-empty", limits(0.0, 0.0)),
    "limits_without_rest": ("limits-rest", limits(10.0, 90.0)),
    "frames_apart": ("joint-frames", moved_frame),
    "frames_turned": ("joint-frames", turned_frame),
    "drawer_out_at_rest": ("joint-offset", opened),
    "door_ajar_at_rest": ("joint-offset", ajar),
    "axis_token": ("axis-token", joint_value("Revolute", "axis", "x")),
    "rotation_zero": ("quaternion-not-unit", joint_value("Revolute", "localRot0", Gf.Quatf(0.0))),
    "damping_negative": ("damping-negative", negative_damping),
    "newton_friction_negative": ("damping-negative", negative_newton_friction),
    "no_articulation_root": ("articulation-missing", rootless),
    "loop": ("joint-loop", loop),
    "nested_articulation": (
        "articulation-nested",
        lambda s: UsdPhysics.ArticulationRootAPI.Apply(s.root),
    ),
    "kinematic_articulation": ("articulation-static", kinematic_root),
}


def array(name: str, change: Callable[[Numbers], Numbers]) -> Seed:
    """Change an array of the door's visual mesh."""

    def seed(s: SeededStage) -> None:
        found = s.visual("door").GetAttribute(name).Get()
        put(s.visual("door"), name, type(found).FromNumpy(change(np.array(found))))

    return seed


def first_is(value: float) -> Callable[[Numbers], Numbers]:
    def change(found: Numbers) -> Numbers:
        found.reshape(-1)[0] = value
        return found

    return change


def emptied(s: SeededStage) -> None:
    mesh = s.visual("door")
    for name in ("faceVertexCounts", "faceVertexIndices"):
        put(mesh, name, Vt.IntArray())


def flat_face(found: Numbers) -> Numbers:
    found[1] = found[0]
    return found


def unbound(s: SeededStage) -> None:
    s.visual("door").RemoveAPI(UsdShade.MaterialBindingAPI)


def bound_to_nothing(s: SeededStage) -> None:
    s.visual("door").GetRelationship("material:binding").SetTargets(["/nothing"])


def flat_normal_map(s: SeededStage) -> None:
    s.shader("normal").GetAttribute("inputs:scale").Block()


MESHES: dict[str, tuple[str, Seed]] = {
    "index_out_of_range": ("mesh-index", array("faceVertexIndices", first_is(10**6))),
    "index_negative": ("mesh-index", array("faceVertexIndices", first_is(-1))),
    "counts": ("mesh-counts", array("faceVertexCounts", first_is(4))),
    "no_faces": ("mesh-empty", emptied),
    "points_nan": ("number-invalid", array("points", first_is(nan))),
    "extent_wrong": ("mesh-extent", array("extent", lambda e: e * 2)),
    "extent_missing": ("mesh-extent", lambda s: s.visual("door").GetAttribute("extent").Block()),
    "zero_area": ("mesh-degenerate", array("faceVertexIndices", flat_face)),
    "subdivided": ("mesh-subdivided", lambda s: put(s.visual("door"), "subdivisionScheme", "catmullClark")),
    "normals_too_few": ("normals-count", array("normals", lambda n: n[:-1])),
    "normals_long": ("normals-not-unit", array("normals", lambda n: n * 2)),
    "normals_flipped": ("normals-flipped", array("normals", lambda n: -n)),
    "winding_flipped": ("winding-flipped", array("faceVertexIndices", lambda i: i[::-1].copy())),
    "left_handed": ("winding-flipped", lambda s: put(s.visual("door"), "orientation", "leftHanded")),
    "no_binding_api": ("binding-api-missing", unbound),
    "bound_to_nothing": ("binding-target-missing", bound_to_nothing),
    "normal_map_srgb": (
        "normal-map",
        lambda s: put(s.shader("normal"), "inputs:sourceColorSpace", "sRGB"),
    ),
    "normal_map_unscaled": ("normal-map", flat_normal_map),
}
DEFECTS = STAGE | BODIES | COLLIDERS | JOINTS | MESHES


def with_primitives(s: SeededStage) -> None:
    """Native shapes as colliders, attributes of other schemas, points without a role: nothing is wrong."""
    shapes = (UsdGeom.Cube, UsdGeom.Cylinder, UsdGeom.Sphere, UsdGeom.Capsule)
    for schema in shapes:
        shape = schema.Define(s.stage, s.body("door").GetPath().AppendChild(schema.__name__.lower()))
        shape.AddTranslateOp().Set(Gf.Vec3d(0.2, 0.0, 0.2))
        shape.AddScaleOp().Set(Gf.Vec3f(0.05, 0.1, 0.05))
        shape.CreatePurposeAttr("guide")
        UsdPhysics.CollisionAPI.Apply(shape.GetPrim())
    points = s.visual("door").GetAttribute("points").Get()
    spec = Sdf.CreatePrimInLayer(s.stage.GetRootLayer(), s.visual("door").GetPath())
    if "points" in spec.properties:
        del spec.properties["points"]
    Sdf.AttributeSpec(spec, "points", Sdf.ValueTypeNames.Float3Array).default = points
    joint = s.joint("Revolute")
    for name in ("newton:friction", "newton:armature", "mjc:frictionloss"):
        joint.CreateAttribute(name, Sdf.ValueTypeNames.Float).Set(0.01)
    joint.AddAppliedSchema("NewtonJointAPI")
    put(joint, "physics:breakForce", inf)


def without_physics(stage: Usd.Stage, up: str) -> None:
    """A cube to look at."""
    UsdGeom.SetStageUpAxis(stage, up)
    UsdGeom.SetStageMetersPerUnit(stage, 1.0)
    stage.SetDefaultPrim(UsdGeom.Xform.Define(stage, "/thing").GetPrim())
    UsdGeom.Cube.Define(stage, "/thing/cube")
