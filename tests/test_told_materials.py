"""Parts are of what the file calls their materials; what it does not tell stays a guess."""

from dataclasses import replace

import numpy as np
import pytest

from simart_kit import convert
from simart_kit.material_words import rows_meant, words_of
from simart_kit.mesh import VisualMaterial
from simart_kit.stages import PartGuess, Segmentation
from simart_kit.testing.meshes import boxes_mesh
from simart_kit.told_materials import as_told, told_materials

from .furniture import cabinet_with_door

# A body with a tenth of the surface of the two others, side by side: 600, 6 and 6 square units.
_BIG, _LEFT, _RIGHT = (
    ((0, 0, 0), (10, 10, 10)),
    ((20, 0, 0), (21, 1, 1)),
    ((30, 0, 0), (31, 1, 1)),
)


def _of(*names: str, boxes=(_LEFT, _RIGHT), **looks):
    """Boxes, each with a material of its name."""
    materials = tuple(VisualMaterial(name, **looks) for name in names)
    number = np.repeat(np.arange(len(names)), 12)
    return replace(boxes_mesh(list(boxes)[: len(names)]), materials=materials, face_material=number)


def _told(*names: str, **looks) -> list[str]:
    """Of parts of a material each; "" for those of which the file does not tell."""
    told = told_materials(_of(*names, **looks), np.repeat(np.arange(len(names)), 12))
    return [told.get(part, "") for part in range(len(names))]


def test_names_are_taken_apart_as_artists_write_them():
    assert words_of("MI_OakWood_01") == ["mi", "oak", "wood"]
    assert words_of("stainless-steel.002") == ["stainless", "steel"]
    assert words_of("ABSPlastic") == ["abs", "plastic"]


@pytest.mark.parametrize(
    ("word", "rows"),
    [
        ("oak", ("wood",)),
        ("tyres", ("rubber",)),
        ("glass", ("glass",)),
        ("metal", ("steel", "aluminium", "brass")),
        ("door", ()),
        ("glasses", ()),
    ],
)
def test_a_word_means_rows_of_the_table(word, rows):
    assert rows_meant(word) == rows


def test_each_part_is_of_what_its_material_is_called():
    assert _told("M_Oak", "BrushedMetal") == ["wood", "steel"]
    assert _told("Metal_Aluminium", "tyre.001") == ["aluminium", "rubber"]
    assert _told("Material.001", "Handle_Chrome") == ["", "steel"]


def test_what_contradicts_itself_tells_nothing():
    assert _told("wood_metal", "white") == ["", ""]


def test_a_material_of_the_whole_object_may_be_called_as_the_object_is():
    assert _told("glass_cabinet") == [""]
    assert _told("black_plastic_mat") == ["plastic"]
    assert _told("glass_cabinet", "white") == ["glass", ""]


def test_what_one_sees_through_is_glass_unless_it_is_called_otherwise():
    clear = {"base_color": (0.8, 0.9, 0.9, 0.3)}
    assert _told("pane", "lens", **clear) == ["glass", "glass"]
    assert _told("acrylic", "pane", **clear) == ["plastic", "glass"]
    assert _told("pane", "lens", base_color=(0.8, 0.9, 0.9, 0.9)) == ["", ""]


def test_most_of_its_surface_decides():
    mesh = _of("steel", "walnut", boxes=(_BIG, _LEFT))
    assert told_materials(mesh, np.zeros(24, dtype=int)) == {0: "steel"}
    mesh = _of("white", "walnut", boxes=(_BIG, _LEFT))
    assert told_materials(mesh, np.zeros(24, dtype=int)) == {}


def test_the_others_keep_what_was_guessed_and_a_note_says_what_was_told():
    mesh, faces = _of("white", "pine"), np.repeat([0, 1], 12).astype(np.int32)
    found = Segmentation(faces, (PartGuess("body", material="steel"), PartGuess("door", material="mdf")))
    result = as_told(found, mesh)
    assert [part.material for part in result.parts] == ["steel", "wood"]
    guessed = "materials are guesses ([physics] of a recipe states others)"
    assert [note.text for note in result.notes] == [
        "materials as the file tells: door wood",
        f"{guessed}: body steel",
    ]
    unknown = as_told(found, _of("white", "grey"))
    assert unknown.parts == found.parts
    assert [note.text for note in unknown.notes] == [f"{guessed}: body steel, door mdf"]


def test_what_a_model_or_a_person_states_stays():
    mesh, faces = _of("chrome", "pine"), np.repeat([0, 1], 12).astype(np.int32)
    stated = PartGuess("body", material="plastic", material_stated=True)
    result = as_told(Segmentation(faces, (stated, PartGuess("door", material="mdf"))), mesh)
    assert [part.material for part in result.parts] == ["plastic", "wood"]


def _saved(mesh, names, folder):
    """An OBJ of boxes, each of a material of its name."""
    lines = ["mtllib of.mtl", *(f"v {x} {y} {z}" for x, y, z in mesh.vertices.tolist())]
    for number, (a, b, c) in enumerate((mesh.faces + 1).tolist()):
        lines += [f"usemtl {names[number // 12]}"] if number % 12 == 0 else []
        lines.append(f"f {a} {b} {c}")
    (folder / "boxes.obj").write_text("\n".join(lines) + "\n")
    looks = [f"newmtl {name}\nKd 0.5 0.5 0.5" for name in dict.fromkeys(names)]
    (folder / "of.mtl").write_text("\n".join(looks) + "\n")
    return folder / "boxes.obj"


def test_a_part_that_a_spec_makes_is_of_what_the_file_tells_of_it(tmp_path):
    path = _saved(boxes_mesh([_BIG, _LEFT]), ["Steel", "Tempered_Glass"], tmp_path)
    lid = {"name": "lid", "points": [[20.0, 0.5, 0.5]], "joint": "prismatic", "axis": "up"}
    spec = {"schema": 1, "coordinates": "m", "parts": [lid]}
    result = convert(path, "geometric", out=tmp_path / "out", up="+z", record=False, spec=spec)
    assert {part.name: part.material.name for part in result.asset.parts} == {"body": "steel", "lid": "glass"}


@pytest.mark.parametrize("recipe", ["geometric", "nano"])
def test_a_cabinet_is_of_what_its_file_tells(tmp_path, recipe):
    names = ["Walnut"] * 5 + ["Tempered_Glass", "brass"]
    path = _saved(boxes_mesh(cabinet_with_door("left")), names, tmp_path)
    result = convert(path, recipe, out=tmp_path / "out", up="+z", record=False)
    assert {part.name: part.material.name for part in result.asset.parts} == {"body": "wood", "door": "glass"}
    notes = {note.text for note in result.report.notes}
    assert "materials as the file tells: body wood, door glass" in notes
