"""ground(): what is found in a mesh, and what is written."""

import hashlib
import json
from pathlib import Path

import numpy as np
import pytest

import simart_kit as sk
from simart_kit.face_sources import face_sources
from simart_kit.grounding import Grounder
from simart_kit.submesh import submesh
from simart_kit.testing import fakes
from simart_kit.testing.meshes import boxes_mesh, cabinet_mesh

LABELS = np.repeat([0, 1, 2], [60, 24, 24])  # body, door with handle, drawer
NAMES = ("body", "door", "drawer")


class Asked(sk.Segmenter):
    """A segmenter that grounds by itself: faces 60 to 83, or what the test says."""

    name = "asked"
    answer = None

    def segment(self, mesh):
        raise AssertionError("a grounder is not asked for parts")

    def ground(self, mesh, description):
        if self.answer is not None:
            return self.answer(mesh)
        faces = np.zeros(len(mesh.faces), dtype=bool)
        faces[60:84] = description == "the door"
        return sk.Grounded(faces, 0.9, "as the test says")


@pytest.fixture(autouse=True)
def small_pictures(monkeypatch):
    monkeypatch.setattr("simart_kit.drawing.highlight.SIZE", 128)


@pytest.fixture
def cabinet(tmp_path) -> Path:
    path = tmp_path / "cabinet.mesh"
    path.write_text("a cabinet")
    return path


@pytest.fixture
def plugins(cabinet) -> sk.Plugins:
    guesses = tuple(sk.PartGuess(name, label=name) for name in NAMES)
    plugins = sk.Plugins(installed=False)
    fake = fakes.segmenter(LABELS, guesses)
    plugins.register(fakes.plugin(segmenter=fake, meshes={cabinet: cabinet_mesh()}))
    plugins.register(fakes.plugin(segmenter=Asked))
    return plugins


@pytest.fixture
def recipe(write) -> Path:
    text = 'schema = 1\n[segmenter]\nuse = "{}"\n[joints]\nuse = "hints"\n'
    write("asked.toml", text.format("asked"))
    return write("recipe.toml", text.format("fake"))


def bytes_of(folder):
    return {p.name: p.read_bytes() for p in folder.iterdir() if p.name != "provenance.json"}


def test_a_name_finds_its_faces_and_writes_nothing_unasked(cabinet, recipe, plugins, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    found = sk.ground(cabinet, "the drawer", recipe, plugins=plugins)

    np.testing.assert_array_equal(found.grounded.faces, LABELS == 2)
    assert not found.grounded.faces.flags.writeable
    assert found.grounded.score == 1.0
    assert [c.name for c in found.grounded.candidates if c.chosen] == ["drawer"]
    assert [c.name for c in found.grounded.candidates] == list(NAMES)
    assert found.paths == {}
    assert found.folder is None
    assert not (tmp_path / "out").exists()


def test_the_folder_holds_part_picture_labels_and_scores(cabinet, recipe, plugins, tmp_path):
    out = tmp_path / "found"
    found = sk.ground(cabinet, "the door", recipe, out=out, plugins=plugins)

    assert {p.name for p in out.iterdir()} == {path.name for path in found.paths.values()}
    with np.load(out / "labels.npz") as labels:
        np.testing.assert_array_equal(labels["faces"], LABELS == 1)
        np.testing.assert_array_equal(labels["face_part"], LABELS)
        np.testing.assert_array_equal(labels["source_face"], np.arange(108))
    table = json.loads((out / "grounding.json").read_text())
    assert (table["faces"], table["faces_of_object"]) == (24, 108)
    # A door of 0.55 x 0.02 x 0.495 m and its handle of 0.02 x 0.03 x 0.1 m.
    assert table["area"] == pytest.approx(
        2 * (0.55 * 0.02 + 0.55 * 0.495 + 0.02 * 0.495) + 2 * (0.02 * 0.03 + 0.02 * 0.1 + 0.03 * 0.1),
        abs=1e-6,
    )
    assert table["parts"] == ["door"]
    record = json.loads((out / "provenance.json").read_text())
    assert record["recipe"]["segmenter"]["use"] == "fake"
    assert record["outputs"]["part.glb"] == hashlib.sha256((out / "part.glb").read_bytes()).hexdigest()
    assert record["arguments"]["description"] == "the door"


def test_the_part_alone_keeps_its_place_and_texture(cabinet, recipe, plugins, tmp_path):
    sk.ground(cabinet, "the door", recipe, out=tmp_path / "found", plugins=plugins)

    again = plugins.manager.hook.load_mesh(path=tmp_path / "found" / "part.glb")
    assert len(again.faces) == 24
    assert again.materials[0].base_color_image is not None
    # The door's box in the canonical frame, its y moved by 0.015 m so that the object's middle is 0; glTF's
    # axes are x, z and -y of that.
    np.testing.assert_allclose(again.bounds, [[-0.275, 0.025, 0.165], [0.275, 0.52, 0.215]], atol=1e-6)


def test_the_picture_marks_the_part_alone(cabinet, recipe, plugins, tmp_path):
    from PIL import Image

    sk.ground(cabinet, "the door", recipe, out=tmp_path / "found", plugins=plugins)

    with Image.open(tmp_path / "found" / "picture.png") as picture:
        pixels = np.asarray(picture.convert("RGB")).astype(int)
    strong = (pixels[..., 0] - pixels[..., 2]) > 90  # orange: much red, little blue
    rows = np.flatnonzero(strong.any(axis=1))
    assert 0.08 < strong.mean() < 0.4
    assert rows.min() > 0.35 * len(pixels)  # the door is in the lower half, the drawer above is pale


def test_what_other_faces_hide_shines_through(tmp_path):
    from io import BytesIO

    from PIL import Image

    from simart_kit.drawing.highlight import highlight_png

    nested = boxes_mesh([((-1, -1, 0), (1, 1, 2)), ((-0.5, -0.5, 0.5), (0.5, 0.5, 1.5))])
    inner = np.arange(24) >= 12
    with Image.open(BytesIO(highlight_png(nested, inner))) as picture:
        pixels = np.asarray(picture).astype(int)
    assert ((pixels[..., 0] - pixels[..., 2]) > 40).mean() > 0.03


def test_twice_gives_the_same_bytes_and_no_path_of_this_machine(cabinet, recipe, plugins, tmp_path):
    for name in ("one", "two"):
        sk.ground(cabinet, "the door", recipe, out=tmp_path / name, plugins=plugins)

    first, second = bytes_of(tmp_path / "one"), bytes_of(tmp_path / "two")
    assert first == second
    assert len(first) == 4
    for content in (*first.values(), (tmp_path / "one" / "provenance.json").read_bytes()):
        assert str(tmp_path).encode() not in content


def test_again_into_the_same_folder_replaces_and_keeps_what_was_changed(cabinet, recipe, plugins, tmp_path):
    out = tmp_path / "found"
    sk.ground(cabinet, "the door", recipe, out=out, plugins=plugins)
    (out / "labels.npz").write_bytes(b"mine")
    found = sk.ground(cabinet, "the drawer", recipe, out=out, plugins=plugins)

    assert (out / "labels.npz.bak1").read_bytes() == b"mine"
    assert any("labels.npz" in note.text for note in found.notes)
    assert json.loads((out / "grounding.json").read_text())["parts"] == ["drawer"]
    assert not (out / "part.glb.bak1").exists()


def test_nothing_fits_names_the_parts_and_writes_nothing(cabinet, recipe, plugins, tmp_path):
    out = tmp_path / "found"
    with pytest.raises(sk.BadInputError, match="no part fits 'the lid': its parts are body, door, drawer"):
        sk.ground(cabinet, "the lid", recipe, out=out, plugins=plugins)
    assert not out.exists()


@pytest.mark.parametrize("description", ["", "  \n"])
def test_an_empty_description_is_refused(cabinet, recipe, plugins, description):
    with pytest.raises(sk.BadInputError, match="description is empty"):
        sk.ground(cabinet, description, recipe, plugins=plugins)


def test_a_segmenter_that_can_ground_is_asked(cabinet, recipe, plugins, tmp_path):
    assert isinstance(Asked(), Grounder)
    assert not isinstance(plugins.find("segmenter", "fake").value(), Grounder)
    asked = recipe.with_name("asked.toml")

    found = sk.ground(cabinet, "the door", asked, out=tmp_path / "found", plugins=plugins)

    assert np.flatnonzero(found.grounded.faces).tolist() == list(range(60, 84))
    assert found.grounded.reason == "as the test says"
    with np.load(tmp_path / "found" / "labels.npz") as labels:
        assert (labels["face_part"] == -1).all()
    with pytest.raises(sk.BadInputError, match="no part fits 'the moon': as the test says"):
        sk.ground(cabinet, "the moon", asked, plugins=plugins)


@pytest.mark.parametrize(
    ("answer", "told"),
    [
        (lambda mesh: "a string", "returned str"),
        (lambda mesh: sk.Grounded(np.ones(5, dtype=bool), 1.0, ""), r"expected \(108,\)"),
        (lambda mesh: sk.Grounded(np.ones(108, dtype=bool), 1.5, ""), "score 1.5"),
        (
            lambda mesh: sk.Grounded(np.ones(108, dtype=bool), 1.0, "", face_candidate=np.zeros(108)),
            "face_candidate",
        ),
        (lambda mesh: 1 / 0, "ZeroDivisionError"),
    ],
)
def test_what_a_grounder_does_wrong_names_it(cabinet, recipe, plugins, monkeypatch, answer, told):
    monkeypatch.setattr(Asked, "answer", staticmethod(answer))
    with pytest.raises(sk.StageError, match=f"segmenter 'asked' failed .*{told}"):
        sk.ground(cabinet, "the door", recipe.with_name("asked.toml"), plugins=plugins)


def test_faces_of_a_cut_mesh_are_those_that_they_were_cut_from():
    given = boxes_mesh([((0, 0, 0), (1, 1, 1)), ((2, 0, 0), (3, 1, 1))])
    # Face 5 in three, about a point inside it.
    a, b, c = given.faces[5]
    middle = len(given.vertices)
    vertices = np.vstack([given.vertices, given.triangles[5].mean(axis=0)])
    others = np.delete(given.faces, 5, axis=0)
    cut = sk.Mesh(vertices, np.vstack([others, [[a, b, middle], [b, c, middle], [c, a, middle]]]))

    expected = [*np.delete(np.arange(24), 5), 5, 5, 5]
    np.testing.assert_array_equal(face_sources(cut, given), expected)
    np.testing.assert_array_equal(face_sources(given, given), np.arange(24))


def test_faces_that_lie_on_each_other_are_told_apart_by_where_they_look():
    # The boxes touch: the first one's right side and the second one's left are one rectangle, seen twice.
    given = boxes_mesh([((0, 0, 0), (1, 1, 1)), ((1, 0, 0), (2, 1, 1))])
    a, b, c = given.faces.T
    middle = np.arange(24) + len(given.vertices)
    faces = np.vstack([np.c_[a, b, middle], np.c_[b, c, middle], np.c_[c, a, middle]])
    cut = sk.Mesh(np.vstack([given.vertices, given.triangles.mean(axis=1)]), faces)

    np.testing.assert_array_equal(face_sources(cut, given), np.tile(np.arange(24), 3))


def test_a_submesh_keeps_order_looks_and_only_its_vertices():
    mesh = cabinet_mesh()
    part = submesh(mesh, LABELS == 2)

    assert len(part.vertices) == 16  # two boxes
    np.testing.assert_array_equal(part.triangles, mesh.triangles[84:])
    assert part.materials == mesh.materials


def test_parts_that_a_file_states_are_those_that_are_compared(tmp_path):
    box = '<visual><geometry><box size="1 1 {}"/></geometry></visual>'
    (tmp_path / "visor.urdf").write_text(
        f'<robot name="helmet"><link name="base">{box.format(1)}</link><link name="visor">{box.format(0.1)}'
        '</link><joint name="pivot" type="revolute"><parent link="base"/><child link="visor"/>'
        '<origin xyz="0 0 0.6"/><axis xyz="0 1 0"/><limit lower="0" upper="1" effort="1" velocity="1"/>'
        "</joint></robot>"
    )
    found = sk.ground(tmp_path / "visor.urdf", "the visor", "geometric")
    assert np.flatnonzero(found.grounded.faces).tolist() == list(range(12, 24))
    assert {candidate.name for candidate in found.grounded.candidates} == {"base", "visor"}
