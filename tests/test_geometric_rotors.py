"""Blades around a hub turn together, whatever else there is; spokes, feet and loose pieces do not."""

from dataclasses import replace

import numpy as np
import pytest
import trimesh
from simart_kit_plugins.geometric.predictor import GeometricJoints
from simart_kit_plugins.geometric.segmenter import Geometric
from simart_kit_plugins.nano.proposals import Proposal, of_geometry
from simart_kit_plugins.nano.rotors import with_rotors

import simart_kit as sk
from simart_kit.mesh import Mesh

CENTER = np.array([0.0, -0.1, 1.0])


def turned(angle, axis=(0, 1, 0)):
    return trimesh.transformations.rotation_matrix(angle, axis)


def box(size, middle):
    return trimesh.creation.box(size, trimesh.transformations.translation_matrix(middle))


def blades(count=3, size=(0.1, 0.01, 0.2), pitch=0.4, angles=None):
    """Flat boxes from the middle up, pitched, around an axis along y."""
    made = []
    for angle in np.arange(count) * 2 * np.pi / count if angles is None else angles:
        blade = trimesh.creation.box(size, turned(pitch, (0, 0, 1)))
        blade.apply_translation((0, 0, 0.03 + size[2] / 2))
        blade.apply_transform(turned(angle))
        blade.apply_translation(CENTER)
        made.append(blade)
    return made


def stand(height=0.9):
    """A foot, a pole and a motor behind the blades, and their hub."""
    hub = trimesh.creation.cylinder(0.035, 0.03, transform=turned(np.pi / 2, (1, 0, 0)))
    hub.apply_translation(CENTER)
    motor = box((0.1, 0.12, 0.1), CENTER + (0, 0.1, 0))
    return [box((0.4, 0.4, 0.05), (0, 0, 0.025)), box((0.04, 0.04, height), (0, 0, height / 2)), motor, hub]


def mesh_of(*bodies):
    made = trimesh.util.concatenate(bodies)
    return Mesh(np.array(made.vertices), np.array(made.faces))


def joints_found(mesh):
    found = Geometric().segment(mesh)
    return {part.label for part in found.parts[1:]}, GeometricJoints().predict(mesh, found)


@pytest.mark.parametrize("count", [3, 4, 5])
def test_blades_turn_with_their_hub_about_its_axis_without_end(count):
    mesh = mesh_of(*stand(), *blades(count))
    labels, (joint,) = joints_found(mesh)
    assert labels == {"rotor"}
    assert joint.kind == "continuous"
    assert abs(joint.axis[1]) == pytest.approx(1, abs=1e-6)
    np.testing.assert_allclose(np.array(joint.origin)[[0, 2]], CENTER[[0, 2]], atol=1e-6)
    found = Geometric().segment(mesh).face_part
    assert (found[-12 * count :] == 1).all()  # the blades
    assert (found[:36] == 0).all()  # foot, pole, motor


def test_narrow_blades_turn_where_they_are_thin_as_those_of_aeroplanes_are():
    assert joints_found(mesh_of(*stand(), *blades(4, size=(0.02, 0.002, 0.2))))[0] == {"rotor"}


@pytest.mark.parametrize(
    "others",
    [
        blades(5, size=(0.01, 0.004, 0.2)),  # thin as spokes
        blades(angles=(0.0, 1.0, 2.6)),  # not evenly around
        [*blades(3), box((0.6, 0.004, 0.6), CENTER + (0, -0.006, 0))],  # held by a disc before them
    ],
)
def test_what_is_not_shaped_placed_or_free_as_blades_are_stays(others):
    assert "rotor" not in joints_found(mesh_of(*stand(), *others))[0]


@pytest.mark.parametrize(("pole", "expected"), [((-0.7, -0.02), True), ((0.02, 0.7), False)])
def test_blades_hang_in_the_air_and_feet_stand_on_the_ground(pole, expected):
    """A whirligig on its pole, and the same upside down: a stand with five flat feet."""
    lying = [b.apply_transform(turned(np.pi / 2, (1, 0, 0))) for b in [stand()[3], *blades(5)]]
    for body in lying:
        body.apply_translation(-turned(np.pi / 2, (1, 0, 0))[:3, :3] @ CENTER)
    low, high = pole
    mesh = mesh_of(box((0.06, 0.06, high - low), (0, 0, (low + high) / 2)), *lying)
    assert ("rotor" in joints_found(mesh)[0]) is expected


def test_what_a_network_takes_single_blades_for_becomes_one_part():
    mesh = mesh_of(*stand(), *blades(4))

    def proposal(faces, name, parent=None, sure=0.6):
        mask = np.zeros(len(mesh.faces), dtype=bool)
        mask[faces] = True
        hinge = sk.Joint("j", "revolute", "body", "part", axis=(1, 0, 0), limits=sk.Limits(0, 1))
        return Proposal(mask, sk.PartGuess(name, label=name), replace(hinge, confidence=sure), parent)

    first, motor = len(mesh.faces) - 48, range(24, 36)
    head = proposal([*motor, *range(first, first + 3)], "head")
    said = [
        head,
        proposal(range(first + 12, first + 24), "blades", 0),
        proposal(range(first + 24, first + 48), "pan", 1),
    ]
    rotor = next(p for p in of_geometry(mesh, 0) if p.guess.label == "rotor")

    kept = with_rotors(mesh, said, [rotor])

    assert [p.guess.label for p in kept] == ["head", "rotor"]
    assert np.flatnonzero(kept[0].faces).tolist() == list(motor)
    assert (kept[1].faces == rotor.faces).all()
    assert (kept[1].joint.kind, kept[1].parent) == ("continuous", None)
    again = with_rotors(mesh, [head, replace(said[1], parent=0)], [rotor])
    assert [(p.guess.label, p.parent) for p in again] == [("head", None), ("blades", 0)]
    assert with_rotors(mesh, [], [rotor])[0].faces.sum() == rotor.faces.sum()
    # Blades that surely turn about a line across the rotor's axis are set, as a wind turbine's are.
    surely = [head, *(proposal(np.flatnonzero(p.faces), "blade", 0, 0.8) for p in said[1:])]
    assert [p.guess.label for p in with_rotors(mesh, surely, [rotor])] == ["head", "blade", "blade"]
    assert len(with_rotors(mesh, [*surely[:2], said[2]], [rotor])) == 2
