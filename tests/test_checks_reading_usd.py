"""USD of others read as a Mechanism: units, axes, turned bodies, shapes, and what a file leaves unsaid."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from simart_kit import Subject
from simart_kit.checks.reading import read_mechanism
from simart_kit.errors import BadInputError

from .checks_cases import judged

HEAD = '#usda 1.0\n(\n  upAxis = "{up}"\n  metersPerUnit = {meters}\n  kilogramsPerUnit = {kilograms}\n)\n'
BODY = """def Xform "{name}" (prepend apiSchemas = ["PhysicsRigidBodyAPI"{mass_api}])
{{
  {mass}
  double3 xformOp:translate = {at}
  quatf xformOp:orient = {turned}
  uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:orient"]
  {inside}
}}
"""
CUBE = 'def Cube "shape" (prepend apiSchemas = ["PhysicsCollisionAPI"]) {{ double size = {size}; {more} }}'
HINGE = """def PhysicsRevoluteJoint "hinge" (prepend apiSchemas = ["PhysicsDriveAPI:angular"])
{
  rel physics:body0 = </base>
  rel physics:body1 = </door>
  uniform token physics:axis = "X"
  float physics:lowerLimit = -90
  float physics:upperLimit = 45
  point3f physics:localPos1 = (0, 0, 100)
  float drive:angular:physics:damping = 0.5
}
"""


def body(
    name: str, at: str = "(0, 0, 0)", turned: str = "(1, 0, 0, 0)", mass: str = "", inside: str = ""
) -> str:
    api = ', "PhysicsMassAPI"' if mass else ""
    inside = inside or CUBE.format(size=20, more="")
    return BODY.format(name=name, at=at, turned=turned, mass=mass, mass_api=api, inside=inside)


@pytest.fixture
def stage(write: Callable[[str, str], Path]) -> Callable[..., Path]:
    """Write a stage of some prims."""

    def make(*prims: str, up: str = "Z", meters: float = 0.01, kilograms: float = 0.001) -> Path:
        head = HEAD.format(up=up, meters=meters, kilograms=kilograms)
        return write("made.usda", head + "".join(prims))

    return make


def test_centimetres_grams_and_y_up(stage: Callable[..., Path]) -> None:
    """The stage's y is up; the door is a quarter turn about y, so that its z is the stage's x.

    It stands 200 cm up; its joint's x axis, in the door's frame, is the stage's -z: forwards, the world's +y.
    """
    mass = """float physics:mass = 3000
    point3f physics:centerOfMass = (0, 0, 10)
    float3 physics:diagonalInertia = (1e7, 2e7, 2.5e7)"""
    door = body("door", "(0, 200, 0)", "(0.70710678, 0, 0.70710678, 0)", mass)
    read = read_mechanism("usd", stage(body("base"), door, HINGE, up="Y"))
    (link,) = read.links
    assert (link.kind, link.parent, link.child) == ("revolute", "base", "door")
    assert (link.lower, link.upper) == pytest.approx((-np.pi / 2, np.pi / 4))
    assert link.damping == pytest.approx(np.degrees(0.5))
    np.testing.assert_allclose(link.axis, (0, 1, 0), atol=1e-6)
    np.testing.assert_allclose(link.origin, (1, 0, 2), atol=1e-6)  # 1 m along the door's z
    found = read.body["door"].mass
    assert found is not None
    assert found.mass == pytest.approx(3.0)
    np.testing.assert_allclose(found.center, (0.1, 0, 2), atol=1e-6)
    # Moments 1, 2 and 2.5 kg m^2 about the door's x, y, z, which are the world's y, z, x.
    np.testing.assert_allclose(found.inertia, np.diag([2.5, 1.0, 2.0]), atol=1e-6)
    (corners,) = read.body["door"].colliders
    np.testing.assert_allclose(corners.min(axis=0), (-0.1, -0.1, 1.9), atol=1e-6)


def test_an_inertia_that_is_not_stated_is_that_of_the_shapes(stage: Callable[..., Path]) -> None:
    """A cube of 0.2 m and 6 kg: 6 * 0.2^2 / 6 = 0.04 kg m^2, about its middle, 0.5 m up."""
    cube = CUBE.format(size=20, more="double3 xformOp:translate = (0, 0, 50);").replace(
        "}", 'uniform token[] xformOpOrder = ["xformOp:translate"]; }'
    )
    path = stage(body("base", mass="float physics:mass = 6000", inside=cube))
    found = read_mechanism("usd", path).body["base"].mass
    assert found is not None
    np.testing.assert_allclose(found.inertia, np.eye(3) * 0.04, atol=1e-9)
    np.testing.assert_allclose(found.center, (0, 0, 0.5), atol=1e-9)
    subject = Subject({"usd": path})
    assert judged("mass", subject).passed
    assert judged("settle", subject).passed


@pytest.mark.parametrize(
    ("shape", "half"),
    [
        ('Sphere "s" {api} {{ double radius = 3; }}', (3, 3, 3)),
        (
            'Cylinder "s" {api} {{ double radius = 3; double height = 10; uniform token axis = "X"; }}',
            (5, 3, 3),
        ),
        (
            'Cylinder "s" {api} {{ double radius = 3; double height = 10; uniform token axis = "Y"; }}',
            (3, 5, 3),
        ),
        (
            'Capsule "s" {api} {{ double radius = 3; double height = 10; uniform token axis = "Z"; }}',
            (3, 3, 8),
        ),
        ('Mesh "s" {api} {{ point3f[] points = [(-1, -2, -3), (1, 2, 3)]; }}', (1, 2, 3)),
    ],
)
def test_shapes(shape: str, half: tuple[float, float, float], stage: Callable[..., Path]) -> None:
    text = "def " + shape.format(api='(prepend apiSchemas = ["PhysicsCollisionAPI"])')
    read = read_mechanism("usd", stage(body("base", inside=text), meters=1.0))
    np.testing.assert_allclose(read.bounds, [-np.array(half), np.array(half)], atol=1e-9)


def test_shapes_that_are_switched_off_or_not_read(stage: Callable[..., Path]) -> None:
    off = CUBE.format(size=20, more="bool physics:collisionEnabled = false;")
    assert read_mechanism("usd", stage(body("base", inside=off))).body["base"].colliders == ()


def test_a_shape_of_another_type(stage: Callable[..., Path]) -> None:
    cone = 'def Cone "cone" (prepend apiSchemas = ["PhysicsCollisionAPI"]) {}'
    with pytest.raises(BadInputError, match="/base/cone: collision shapes of type Cone are not read"):
        read_mechanism("usd", stage(body("base", inside=cone)))


def test_what_holds_the_base_is_no_joint_between_bodies(stage: Callable[..., Path]) -> None:
    for ends in ("rel physics:body1 = </base>", "rel physics:body0 = </base>"):
        fixed = f'def PhysicsFixedJoint "hold" {{ {ends}; }}\n'
        assert read_mechanism("usd", stage(body("base"), fixed)).links == ()


def test_a_hinge_on_the_world(stage: Callable[..., Path]) -> None:
    hinge = HINGE.replace("  rel physics:body0 = </base>\n", "")
    (link,) = read_mechanism("usd", stage(body("door", mass="float physics:mass = 5000"), hinge)).links
    assert (link.parent, link.child) == ("world", "door")
    subject = Subject({"usd": stage(body("door", mass="float physics:mass = 5000"), hinge)})
    assert judged("energy", subject).passed
    assert "hang on the world" in judged("settle", subject).text


def test_bodies_of_one_name_go_by_their_paths(stage: Callable[..., Path]) -> None:
    groups = "".join(f'def Xform "{side}" {{ {body("leg")} }}\n' for side in ("left", "right"))
    assert set(read_mechanism("usd", stage(body("base"), groups)).body) == {"base", "/left/leg", "/right/leg"}


def test_without_limits_a_hinge_turns_on(stage: Callable[..., Path]) -> None:
    free = "".join(line + "\n" for line in HINGE.splitlines() if "Limit" not in line)
    (link,) = read_mechanism("usd", stage(body("base"), body("door"), free)).links
    assert (link.kind, link.lower, link.upper) == ("continuous", None, None)


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("no usd", r"cannot open made\.usda: no USD file"),
        ('#usda 1.0\ndef Xform "empty" {}\n', r"made\.usda has no prim with PhysicsRigidBodyAPI"),
    ],
)
def test_files_that_say_nothing(text: str, told: str, write: Callable[[str, str], Path]) -> None:
    with pytest.raises(BadInputError, match=told):
        read_mechanism("usd", write("made.usda", text))


def test_a_loop_of_joints_fails_its_checks(stage: Callable[..., Path]) -> None:
    back = HINGE.replace("hinge", "back").replace("</base>", "<#>").replace("</door>", "</base>")
    path = stage(body("base"), body("door"), HINGE, back.replace("<#>", "</door>"))
    result = judged("penetration", Subject({"usd": path}))
    assert (result.passed, result.text.startswith("the joints are no tree")) == (False, True)
