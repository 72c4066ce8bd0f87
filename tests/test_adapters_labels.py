"""Labels a face in the files of other segmenters come back on the mesh, whichever mesh they are of."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import trimesh
from simart_kit_plugins.adapters import LabelFiles, P3samFiles, PartfieldFiles
from simart_kit_plugins.adapters.laying import filled

import simart_kit as sk
from simart_kit.assemble import checked
from simart_kit.errors import BadInputError, StageError
from simart_kit.loading import read_source
from simart_kit.mesh import Mesh, canonical
from simart_kit.plugins import Plugins
from simart_kit.stages import Segmentation, Segmenter

from .bench_objects import cabinet
from .real_objects import EXAMPLE, truth

LABELS = cabinet().labels


def cabinet_mesh() -> Mesh:
    file = cabinet()
    return canonical(Mesh(file.vertices, file.faces, up="+y"))[0]


def read(stage: type[Segmenter], file: Path, given: Mesh | None = None, **options: Any) -> Segmentation:
    given = given or cabinet_mesh()
    return checked(stage(stage.Options(file=str(file), **options)).segment(given), given)


def save(path: Path, labels: Any) -> Path:
    path.parent.mkdir(parents=True, exist_ok=True)
    np.save(path, labels)
    return path


def as_p3sam_writes(folder: Path, twice: bool = True) -> Path:
    """Faces in another order, in another box, as many or one of them twice; and the face ids of those."""
    file = cabinet()
    order = [*range(47, -1, -1), *([5] if twice else [])]
    scale = 2 / np.ptp(file.vertices, axis=0).max()
    mesh = trimesh.Trimesh(scale * file.vertices + 3.0, file.faces[order], process=False)
    folder.mkdir(exist_ok=True)
    mesh.export(folder / "auto_mask_mesh_final.ply")
    return save(folder / "cabinet_face_ids.npy", LABELS[order])


def test_a_label_a_face_is_a_part_and_joints_are_left_to_others(tmp_path: Path) -> None:
    found = read(LabelFiles, save(tmp_path / "a.npy", np.array([7, 3, 4, 0])[LABELS]))
    assert [part.name for part in found.parts] == ["part_0", "part_3", "part_4", "part_7"]
    np.testing.assert_array_equal(found.face_part, np.array([3, 1, 2, 0])[LABELS])
    assert found.joints is None


@pytest.mark.parametrize("none", [-1, -2])
def test_faces_without_a_label_take_that_of_their_own_surface(none: int, tmp_path: Path) -> None:
    labels = np.where(np.arange(48) % 3 == 1, none, LABELS)
    found = read(P3samFiles, save(tmp_path / "a_face_ids.npy", labels))
    np.testing.assert_array_equal(found.face_part, LABELS)
    assert "16 of 48 faces had no label: they take that of their neighbours" in [n.text for n in found.notes]


def test_labels_spread_along_the_surface_and_not_through_the_air() -> None:
    # Three strips of a zigzag: the last face is near the first in space and far from it along the surface.
    points = np.array([[0, 0, 0], [0, 1, 0], [5, 0, 0], [5, 1, 0], [0, 0, 0.1], [0, 1, 0.1]], float)
    faces = np.array([[0, 2, 1], [1, 2, 3], [2, 4, 3], [3, 4, 5]])
    mesh = Mesh(points, faces)
    np.testing.assert_array_equal(filled(np.array([1, -1, -1, 2]), mesh), [1, 1, 2, 2])
    island = Mesh(np.vstack([points, points[:3] + (0, 0, 9)]), np.vstack([faces, [[6, 8, 7]]]))
    np.testing.assert_array_equal(filled(np.array([1, 1, 1, 2, -1]), island), [1, 1, 1, 2, 2])


@pytest.mark.parametrize("twice", [False, True])
@pytest.mark.parametrize("named", ["folder", "file", "mesh"])
def test_labels_of_the_mesh_that_p3sam_wrote_are_laid_on_by_place(
    named: str, twice: bool, tmp_path: Path
) -> None:
    file = as_p3sam_writes(tmp_path / "out", twice)
    options = {"mesh": str(file.with_name("auto_mask_mesh_final.ply"))} if named == "mesh" else {}
    found = read(P3samFiles, file.parent if named == "folder" else file, **options)
    np.testing.assert_array_equal(found.face_part, LABELS)
    assert any("from auto_mask_mesh_final.ply: its up axis is +y" in note.text for note in found.notes)


def test_clusters_are_chosen_by_their_number_and_object(tmp_path: Path) -> None:
    folder = tmp_path / "cluster_out"
    for count in (2, 3):
        save(folder / f"chair_0_{count:02d}.npy", LABELS % count)
    assert len(read(PartfieldFiles, folder, clusters=3).parts) == 3
    assert len(read(PartfieldFiles, folder / "chair_0_02.npy").parts) == 2
    with pytest.raises(BadInputError, match=r"more than one number of clusters: .*clusters=\.\.\., of 2, 3"):
        read(PartfieldFiles, folder)
    with pytest.raises(BadInputError, match="no number of clusters 9: choose with"):
        read(PartfieldFiles, folder, clusters=9)
    save(folder / "cup_0_02.npy", LABELS)
    with pytest.raises(BadInputError, match=r"more than one object: .*uid=\.\.\., of chair, cup"):
        read(PartfieldFiles, folder, clusters=2)
    assert len(read(PartfieldFiles, folder, uid="cup").parts) == 4


@pytest.mark.parametrize(
    ("write", "told"),
    [
        (lambda path: path.write_bytes(b"\x93NUMPY"), "cannot be read as a NumPy array"),
        (lambda path: save(path, LABELS + 0.5), "labels with fractions or NaN"),
        (lambda path: save(path, np.zeros((48, 2))), "one number a face is needed"),
        (lambda path: save(path, np.array(["a"])), "whole numbers are needed"),
        (lambda path: save(path, -np.ones(48)), "gives no face a label"),
        (lambda path: save(path, LABELS - 3), "has label -3: labels are 0 or more"),
        (lambda path: save(path, np.arange(2000)), "has 2000 labels: more than 1000 are no parts"),
        (lambda path: save(path, LABELS[1:]), "labels 47 faces, the mesh has 48 and no mesh is beside it"),
        (lambda path: None, "no such file"),
    ],
)
def test_damage_is_one_line_that_names_the_file(
    write: Callable[[Path], object], told: str, tmp_path: Path
) -> None:
    path = tmp_path / "a.npy"
    write(path)
    with pytest.raises(BadInputError, match=told) as caught:
        read(LabelFiles, path)
    assert str(path) in str(caught.value)
    assert "\n" not in str(caught.value)


def test_a_mesh_that_does_not_fit_the_labels_is_refused(tmp_path: Path) -> None:
    file = as_p3sam_writes(tmp_path)
    trimesh.creation.box().export(tmp_path / "box.ply")
    with pytest.raises(BadInputError, match=r"labels 49 faces, but .*box.ply has 12"):
        read(P3samFiles, file, mesh=str(tmp_path / "box.ply"))
    save(tmp_path / "box_face_ids.npy", np.zeros(12))
    with pytest.raises(BadInputError, match=r"box.ply: it is not of this mesh: its box differs by"):
        read(LabelFiles, tmp_path / "box_face_ids.npy", mesh=str(tmp_path / "box.ply"))
    with pytest.raises(
        BadInputError, match=r"one file \*_face_ids.npy, it has box_face_ids.npy, cabinet_face"
    ):
        read(P3samFiles, tmp_path)


def test_the_true_labels_of_the_example_come_back_from_a_merged_mesh(tmp_path: Path) -> None:
    """As P3-SAM does: vertices merged, repeated faces dropped, the rest shuffled, GLB's frame."""
    known = truth("example")
    mesh = read_source(EXAMPLE, Plugins(installed=False)).mesh
    whole = trimesh.load(EXAMPLE, process=False, force="mesh")
    order = np.random.default_rng(0).permutation(len(whole.faces))[5:]
    trimesh.Trimesh(whole.vertices, whole.faces[order], process=False).export(
        tmp_path / "auto_mask_mesh_final.ply"
    )
    save(tmp_path / "cabinet_face_ids.npy", known.face_part[order])
    found = read(P3samFiles, tmp_path, mesh)
    names = np.array([int(part.name.removeprefix("part_")) for part in found.parts])
    right = names[found.face_part] == known.face_part
    assert mesh.face_areas[right].sum() > 0.999 * mesh.face_areas.sum()


def test_a_run_ends_in_one_line_when_labels_do_not_fit(tmp_path: Path) -> None:
    save(tmp_path / "a_face_ids.npy", LABELS)
    with pytest.raises(StageError) as caught:
        sk.convert(
            EXAMPLE,
            "p3sam-files",
            out=tmp_path / "out",
            record=False,
            sets=[f"segmenter.options.file={tmp_path / 'a_face_ids.npy'}"],
        )
    assert "labels 48 faces" in str(caught.value)
    assert not (tmp_path / "out" / "asset.json").exists()
