"""A segmenter that cuts faces: what the core checks, and that everything after it has the cut mesh."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import trimesh
from simart_kit_plugins.nano.boundaries.cutting import cut

import simart_kit as sk
from simart_kit.assemble import assemble, checked
from simart_kit.asset_io import load_asset
from simart_kit.errors import StageError
from simart_kit.evidence import VertexEvidence
from simart_kit.mesh import Mesh, Note
from simart_kit.testing import fakes
from simart_kit.topology import edges, weld

# The front of a box of 0.8 x 0.6 x 1 m has 4 x 4 corners; the inner four are painted red. Between them and
# the white ones paint fades, so that the door ends half-way.
WIDE, DEEP, HIGH = 0.8, 0.6, 1.0
ACROSS, UP = np.array([0.0, 0.2, 0.6, 0.8]), np.array([0.0, 0.25, 0.75, 1.0])
HINGE = sk.Joint("hinge", "revolute", "body", "door", (0.1, 0.0, 0.5), (0.0, 0.0, 1.0), sk.Limits(0.0, 1.5))
# A rectangle of 0.6 x 0.75 m from half-way to half-way. At two of its corners the diagonal of a cell runs
# from red to white and cuts off a triangle of half of 0.1 x 0.125 m; at the other two it runs along the end
# and fills none.
DOOR = 0.6 * 0.75 - 4 * 0.1 * 0.125 / 2


def skin() -> Mesh:
    """The box as one watertight skin of 60 triangles with texture coordinates and a door of paint."""
    front = np.array([[x, 0.0, z] for z in UP for x in ACROSS])
    back = front + [0.0, DEEP, 0.0]
    cells = [(i + 4 * j, i + 1 + 4 * j, i + 5 + 4 * j, i + 4 + 4 * j) for j in range(3) for i in range(3)]
    rim = [0, 1, 2, 3, 7, 11, 15, 14, 13, 12, 8, 4]
    faces = [t for a, b, c, d in cells for t in ((a, b, c), (a, c, d))]
    faces += [tuple(16 + k for k in t[::-1]) for t in faces]
    for a, b in zip(rim, rim[1:] + rim[:1], strict=True):
        faces += [(a, a + 16, b), (b, a + 16, b + 16)]
    colors = np.full((32, 4), 255, dtype=np.uint8)
    colors[[5, 6, 9, 10]] = (255, 0, 0, 255)
    vertices = np.concatenate([front, back])
    return Mesh(vertices, np.array(faces), uv=vertices[:, [0, 2]], colors=colors)


class Painted(sk.Segmenter):
    """Everything that is more red than white is the door; its faces are cut out."""

    name = "painted"

    def segment(self, mesh: Mesh) -> sk.Segmentation:
        red = (mesh.colors[:, 1] == 0).astype(float)

        def door_at(face, weights):
            return (np.einsum("nk,nk->n", weights, red[mesh.faces[face]]) > 0.5).astype(np.int32)

        by_middle = door_at(np.arange(len(mesh.faces)), np.full((len(mesh.faces), 3), 1 / 3))
        made = cut(mesh, by_middle, door_at, 0.12)
        parts = (sk.PartGuess("body"), sk.PartGuess("door"))
        segment = np.arange(len(made.face_part), dtype=np.int32)
        shares = VertexEvidence("height", made.mesh.vertices[:, 2] / HIGH)
        return sk.Segmentation(made.face_part, parts, (HINGE,), segment, evidence=(shares,), mesh=made.mesh)


def looking(seen: list) -> type[sk.JointPredictor]:
    """A joint predictor that remembers how many faces and labels it was shown."""

    class Looks(sk.JointPredictor):
        """Hinges the door."""

        name = "looks"

        def predict(self, mesh, segmentation):
            seen.append((len(mesh.faces), len(segmentation.face_part)))
            return (HINGE,)

    return Looks


def recipe(joints: str, *formats: str) -> dict:
    return {
        "schema": 1,
        "segmenter": {"use": "painted"},
        "joints": {"use": joints},
        "export": [{"use": name} for name in formats],
    }


def is_watertight(mesh: Mesh) -> bool:
    """Whether each edge has two faces, walked in opposite senses."""
    corners = weld(mesh.vertices, 1e-7)[mesh.faces]
    walked = {(a, b) for t in corners.tolist() for a, b in zip(t, t[1:] + t[:1], strict=True)}
    twice = (np.bincount(edges(corners).ravel()) == 2).all()
    return bool(twice) and all((b, a) in walked for a, b in walked)


def obj_area(path: Path) -> float:
    """Surface in an OBJ file [m2]."""
    return float(trimesh.load(path, process=False, force="mesh").area)


@pytest.fixture(scope="module")
def segmented() -> sk.Segmentation:
    return Painted().segment(skin())


@pytest.fixture
def plugins(simart_plugins):
    simart_plugins.register(fakes.plugin(segmenter=Painted))
    return simart_plugins


def test_a_painted_door_is_cut_out_of_a_coarse_skin(run_recipe, plugins):
    assert is_watertight(skin())
    seen = []
    plugins.register(fakes.plugin(joint_predictor=looking(seen)))
    result = run_recipe(skin(), recipe("looks", "urdf"), plugins, record=True)
    asset = result.asset
    mesh = asset.mesh
    assert len(mesh.faces) > len(skin().faces)
    assert seen == [(len(mesh.faces), len(mesh.faces))]
    assert is_watertight(mesh)
    assert mesh.face_areas.sum() == pytest.approx(2 * (0.8 * 0.6 + 0.8 * 1.0 + 0.6 * 1.0))
    door = asset.face_part == asset.part_index("door")
    assert mesh.face_areas[door].sum() == pytest.approx(DOOR, rel=0.05)
    at_origin = mesh.vertices - mesh.bounds[0]
    assert np.allclose(mesh.uv, at_origin[:, [0, 2]], atol=1e-9)
    assert result.paths["recording"].is_file()
    assert not [note for note in result.report.notes if note.stage == "observer"]
    assert np.array_equal(load_asset(result.folder).mesh.faces, mesh.faces)
    written = [obj_area(path) for path in result.paths["urdf"].parent.glob("meshes/*.obj")]
    # The door is flat, and exporters give flat parts a back.
    expected = [mesh.face_areas[~door].sum(), 2 * mesh.face_areas[door].sum()]
    assert sorted(written, reverse=True) == pytest.approx(expected, rel=1e-4)


def test_what_the_loader_noted_is_kept(segmented):
    given = replace(skin(), notes=(Note("load", "info", "it was red"),))
    asset = assemble("box", given, checked(segmented, given), (HINGE,), np.eye(4))
    assert asset.notes == given.notes
    assert asset.mesh.notes == ()


def test_without_a_mesh_the_labels_are_of_the_one_given():
    given = skin()
    segmentation = sk.Segmentation(np.zeros(len(given.faces), np.int32), (sk.PartGuess("body"),))
    assert segmentation.mesh_of(given) is given
    assert checked(segmentation, given).mesh is None


@pytest.mark.parametrize(
    ("change", "said"),
    [
        (lambda mesh: "a mesh", "mesh is a str, expected a simart_kit.Mesh or None"),
        (lambda mesh: replace(mesh, vertices=mesh.vertices + [0.01, 0, 0]), "its bounds are 0.01 m off"),
        (lambda mesh: replace(mesh, uv=None), "it lost uv"),
        (lambda mesh: replace(mesh, colors=None, uv=None), "it lost uv, colors"),
        (lambda mesh: replace(mesh, materials=mesh.materials * 2), "it lost materials|materials"),
        (lambda mesh: replace(mesh, up="+y"), "its up axis or unit differs"),
        (lambda mesh: Mesh(mesh.vertices, mesh.faces[:-1], uv=mesh.uv, colors=mesh.colors), "its area is"),
    ],
)
def test_a_mesh_that_is_no_cut_of_the_one_given_is_refused(change, said):
    given = skin()
    labels = np.zeros(len(given.faces), np.int32)
    segmentation = sk.Segmentation(labels, (sk.PartGuess("body"),), mesh=change(given))
    with pytest.raises(ValueError, match=said):
        checked(segmentation, given)


def test_labels_and_evidence_must_be_of_the_cut_mesh(segmented):
    with pytest.raises(ValueError, match=r"face_part has shape \(60,\), expected \(\d{3,},\)"):
        checked(replace(segmented, face_part=np.zeros(60, np.int32)), skin())
    whole = VertexEvidence("whole", np.zeros(32))
    with pytest.raises(ValueError, match="evidence 'whole' has 32 rows for a mesh of"):
        checked(replace(segmented, evidence=(whole,)), skin())


def test_a_failing_joint_stage_leaves_the_cut_mesh(run_recipe, plugins, tmp_path):
    plugins.register(fakes.plugin(joint_predictor=fakes.joint_predictor(error=RuntimeError("no idea"))))
    with pytest.raises(StageError):
        run_recipe(skin(), recipe("fake"), plugins)
    (labels,) = tmp_path.rglob("segmentation.npz")
    with np.load(labels) as stored, np.load(labels.with_name("mesh.npz")) as kept:
        assert len(stored["face_part"]) == len(kept["faces"]) > len(skin().faces)
