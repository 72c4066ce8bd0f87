"""P3-SAM through its worker: a stand-in with the documented interface and its traps, where all goes well."""

import numpy as np
import pytest
from simart_kit_plugins.p3sam.program import VERSION, P3SamProgram
from simart_kit_plugins.p3sam.segmenter import P3Sam
from simart_kit_plugins.workers.caching import AnswerCache, answer_key
from simart_kit_plugins.workers.failures import WorkerError
from simart_kit_plugins.workers.surface import sent_surface

from simart_kit import Mesh
from simart_kit.errors import BadInputError
from simart_kit.recipe import read_options
from simart_kit.testing.meshes import boxes_mesh, cabinet_mesh

from .p3sam_stand_in import StandIn, expected_labels, segment, still_there

ASKED = {"seed": 0, "threshold": 0.95, "post_process": True, "prompt_batch": 32, "checkpoint": ""}


def partition(labels):
    """Labels by where each is met first, so that numbers do not matter."""
    _, first, which = np.unique(labels, return_index=True, return_inverse=True)
    return first[which].tolist()


def middles(mesh):
    return mesh.triangles.mean(axis=1)


def truth(mesh):
    """The stand-in's rule without its holes: handles take the part that their backs are of."""
    at = middles(mesh)
    return np.where(at[:, 2] > 0.6, 7, np.where(at[:, 0] > 0, 3, 12))


def replayed(folder, mesh, ids, **options):
    """What is made of an answer in the cache: (F,) ids in the order of the mesh's faces."""
    sent = sent_surface(mesh, "+y")
    arrays = {"face_ids": np.asarray(ids)[sent.face], "vertices": sent.vertices, "faces": sent.faces}
    cache = AnswerCache(folder / "p3sam")
    cache.check_writable()
    cache.put(answer_key("p3sam", VERSION, ASKED, sent), arrays)
    return P3Sam(read_options(P3Sam, {"cache": str(folder), **options})).segment(mesh)


def understood(mesh, ids, vertices, faces):
    program = P3SamProgram(mesh, sent_surface(mesh, "+y"), "", "", ASKED)
    return program.understand({"face_ids": ids, "vertices": vertices, "faces": faces})


def test_parts_come_back_on_the_faces_that_were_given(tmp_path):
    mesh = cabinet_mesh()
    assert (expected_labels(middles(mesh)) == -1).sum() == 20, "two handles, all but their backs"
    stand_in = StandIn(tmp_path, real_trimesh=True)
    found = segment(stand_in, mesh)
    assert partition(found.face_part) == partition(truth(mesh))
    assert [part.name for part in found.parts] == ["body", "part_1", "part_2"]
    areas = np.bincount(found.face_part, mesh.face_areas)
    assert (np.diff(areas) < 0).all(), "the largest is the body"
    assert found.mesh is None
    assert found.joints is None
    told = " ".join(note.text for note in found.notes)
    assert "South Korea" in told
    assert "nearest over the surface" in told
    assert still_there(stand_in.pids) == []


def test_labels_of_a_mesh_that_it_cleaned_are_laid_back(tmp_path):
    mesh = cabinet_mesh()
    found = segment(StandIn(tmp_path, "cleans anyway"), mesh)
    # The two faces that it drops are the last of the drawer's handle.
    assert partition(found.face_part) == partition(truth(mesh))


def test_answers_are_kept_need_nothing_installed_then_and_are_made_again_when_damaged(tmp_path):
    stand_in = StandIn(tmp_path)
    first = segment(stand_in)
    (name,) = stand_in.kept
    replay = {"cache": str(stand_in.cache)}
    again = P3Sam(read_options(P3Sam, replay), seed=42).segment(cabinet_mesh())
    assert again.face_part.tolist() == first.face_part.tolist()
    assert again.notes == first.notes
    with pytest.raises(BadInputError, match="SIMART_P3SAM_FOLDER is not set"):
        P3Sam(read_options(P3Sam, replay), seed=43).segment(cabinet_mesh())
    file = stand_in.cache / "p3sam" / name
    content = file.read_bytes()
    file.write_bytes(content[: len(content) // 2])
    assert segment(stand_in).face_part.tolist() == first.face_part.tolist()
    assert len(stand_in.pids) == 2, "it ran at first, and once it was damaged"
    assert file.read_bytes() == content


def test_a_mesh_cut_at_uv_seams_is_sent_welded_and_with_y_up():
    loose = cabinet_mesh(textured=False)
    loose = Mesh(loose.vertices[loose.faces].reshape(-1, 3), np.arange(3 * len(loose.faces)).reshape(-1, 3))
    sent = sent_surface(loose, "+y")
    places = {tuple(corner) for corner in loose.vertices.round(6).tolist()}
    assert len(sent.vertices) == len(places) < len(loose.vertices)
    x, y, z = loose.triangles[sent.face].transpose(2, 0, 1)
    assert np.allclose(sent.vertices[sent.faces], np.stack([x, z, -y], axis=-1))


def test_faces_without_neighbours_are_sent_first_and_keep_their_labels(tmp_path):
    mesh = cabinet_mesh(textured=False)
    alone = np.array([[0.0, 0.0, 0.7], [0.1, 0.0, 0.7], [0.0, 0.1, 0.7]])  # touches nothing
    mesh = Mesh(np.r_[mesh.vertices, alone], np.r_[mesh.faces, [[72, 73, 74]]])
    assert sent_surface(mesh, "+y").face[0] == len(mesh.faces) - 1
    found = replayed(tmp_path, mesh, np.r_[np.zeros(108, dtype=int), 5])
    assert found.face_part.tolist() == [0] * 108 + [1]


def test_no_part_at_all_is_one_part_and_a_warning(tmp_path):
    found = replayed(tmp_path, cabinet_mesh(), np.full(108, -1))
    assert not found.face_part.any()
    assert [note.text for note in found.notes if note.level == "warning"] == [
        "P3-SAM saw no part: the object stays one"
    ]


def test_most_parts_joins_the_smallest_to_their_neighbours(tmp_path):
    bounds = [
        ((0, 0, 0), (0.9, 0.4, 0.5)),
        ((-0.4, 0, 0), (-0.1, 0.4, 0.5)),
        ((0.4, 0.2, 0.7), (0.5, 0.3, 0.8)),
    ]
    mesh = boxes_mesh(bounds)  # the last is small, and above the first
    found = replayed(tmp_path, mesh, np.repeat([30, 0, 12], 12), max_parts=2)
    assert found.face_part.tolist() == [0] * 12 + [1] * 12 + [0] * 12
    assert found.face_segment.tolist() == [0] * 12 + [1] * 12 + [2] * 12
    assert any("1 of the parts, the smallest" in note.text for note in found.notes)


def test_answers_that_make_no_sense_are_refused():
    mesh = cabinet_mesh(textured=False)
    sent = sent_surface(mesh, "+y")
    ids = np.zeros(len(sent.faces), dtype=np.int64)
    with pytest.raises(WorkerError, match="gave 103 face ids for a mesh of 108 faces"):
        understood(mesh, ids[5:], sent.vertices, sent.faces)
    with pytest.raises(WorkerError, match="gave face id -7: parts are 0 or more"):
        understood(mesh, ids - 7, sent.vertices, sent.faces)
    with pytest.raises(WorkerError, match="faces without vertices"):
        understood(mesh, ids, sent.vertices[:-1], sent.faces)
    with pytest.raises(WorkerError, match="gave back another surface than it was sent"):
        understood(mesh, ids, sent.vertices + 5, sent.faces)
    with pytest.raises(WorkerError, match="gave back a mesh that is none"):
        understood(mesh, ids, sent.vertices * 0, sent.faces)
