"""Evidence of a stage: what is valid, and what the recording shows of it."""

from dataclasses import replace

import numpy as np
import pytest
from simart_kit_plugins.recorder import Recorder

from simart_kit.colors import part_color
from simart_kit.evidence import (
    PictureEvidence,
    PointEvidence,
    TextEvidence,
    VertexEvidence,
    VoxelEvidence,
    check_evidence,
)
from simart_kit.report import Report
from simart_kit.testing.meshes import cabinet_asset
from simart_kit.voxels import GridFrame

from .recordings import paths_in, run_in, segmentation_of, source_of, text, values, views

FRAME = GridFrame((1.0, 2.0, 3.0), 0.5, 64)
CELLS = np.array([[0, 0, 0], [1, 2, 3], [63, 0, 5]])
PIXELS = np.arange(24, dtype=np.uint8).reshape(2, 4, 3)


def test_arrays_are_copies_that_nobody_can_write_to():
    indices, shares = CELLS.copy(), np.array([0.0, 0.5, 1.0])
    voxels, vertices = VoxelEvidence("voxels", FRAME, indices, shares), VertexEvidence("shares", shares)
    indices[0], shares[0] = 9, 9.0
    assert voxels.indices[0].tolist() == [0, 0, 0]
    assert voxels.values[0] == 0.0
    assert vertices.values.shape == (3, 1)
    assert vertices.values[0, 0] == 0.0
    for array in (voxels.indices, voxels.values, vertices.values):
        with pytest.raises(ValueError, match="read-only"):
            array[0] = 1


def test_whole_values_are_kinds():
    assert VoxelEvidence("codes", FRAME, CELLS, np.array([7, 0, 4095])).categorical
    assert not VoxelEvidence("heights", FRAME, CELLS, np.array([7.0, 0.0, 1.0])).categorical


@pytest.mark.parametrize(
    ("make", "told"),
    [
        (lambda: VoxelEvidence("a", FRAME, CELLS[:, :2], np.zeros(3)), r"'a': indices has shape \(3, 2\)"),
        (lambda: VoxelEvidence("a", FRAME, CELLS, np.zeros(2)), r"values has shape \(2,\), expected \(3,\)"),
        (lambda: VoxelEvidence("a", FRAME, CELLS, np.array([0, np.nan, 1])), "must be finite"),
        (lambda: VoxelEvidence("a", FRAME, CELLS, np.array([0, 1, 2]), ("x", "y")), r"0\.\.2 for 2 names"),
        (lambda: VoxelEvidence("a", FRAME, CELLS, np.zeros(3), ("x",)), "names are for whole values"),
        (lambda: VoxelEvidence(" ", FRAME, CELLS, np.zeros(3)), "needs a name"),
        (
            lambda: PointEvidence("a", np.zeros((2, 2)), np.zeros(2, int), ("x",)),
            r"points has shape \(2, 2\)",
        ),
        (lambda: PointEvidence("a", np.zeros((2, 3)), np.array([0, 1]), ("x",)), r"0\.\.1 for 1 names"),
        (lambda: PointEvidence("a", np.zeros((2, 3)), np.zeros(2), ("x",)), "must be whole numbers"),
        (
            lambda: VertexEvidence("a", np.zeros((4, 2)), ("x",)),
            r"values has shape \(4, 2\), expected \(4, 1\)",
        ),
        (lambda: VertexEvidence("a", np.array([0.0, 1.5])), r"must lie in 0\.\.1"),
        (lambda: VertexEvidence("a", np.array([0.0, np.nan])), r"must lie in 0\.\.1"),
        (lambda: TextEvidence("", "words"), "text evidence needs a name"),
        (lambda: PictureEvidence("a", PIXELS[..., :2]), r"shape \(2, 4, 2\), expected \(2, 4, 3\)"),
        (lambda: PictureEvidence("a", PIXELS[0]), r"shape \(4, 3\), expected \(4, 3, 3\)"),
        (lambda: PictureEvidence("a", PIXELS / 255), "must be uint8, found float64"),
        (lambda: PictureEvidence("a", PIXELS[:0]), "there is no pixel"),
    ],
)
def test_wrong_evidence_is_refused(make, told):
    with pytest.raises(ValueError, match=told):
        make()


def test_evidence_has_to_be_of_the_mesh_and_have_names_of_its_own():
    shares = VertexEvidence("shares", np.zeros(5))
    check_evidence((shares,), 5)
    with pytest.raises(ValueError, match="'shares' has 5 rows for a mesh of 6 vertices"):
        check_evidence((shares,), 6)
    with pytest.raises(ValueError, match="'shares' comes twice"):
        check_evidence((shares, shares), 5)
    with pytest.raises(ValueError, match="'said' comes twice"):
        check_evidence((TextEvidence("said", "yes"), PictureEvidence("said", PIXELS)), 5)


@pytest.fixture(scope="module")
def recording(tmp_path_factory):
    """Of a cabinet whose left half has share 0 of the first thing and 1 of the second, the right half 0.5."""
    asset = cabinet_asset()
    right = (asset.mesh.vertices[:, 0] > 0).astype(float)
    shares = np.stack([0.5 * right, 1 - 0.5 * right], axis=1)
    evidence = (
        VoxelEvidence("Codes", FRAME, CELLS, np.array([7, 7, 9])),
        VoxelEvidence("Errors", FRAME, CELLS, np.array([0, 1, 1]), ("missing", "added")),
        VoxelEvidence("Nothing", FRAME, CELLS[:0], np.zeros(0)),
        PointEvidence("Seeds", np.arange(12.0).reshape(4, 3), np.array([1, 0, 1, 1]), ("body", "Tür Ω")),
        VertexEvidence("Chances", shares, ("body", "door")),
        TextEvidence("Question", "What is **this**? Eine Tür, Ω?"),
        PictureEvidence("Picture shown", PIXELS),
        TextEvidence("Said", "a cabinet"),
    )
    run, recorder = run_in(tmp_path_factory.mktemp("evidence")), Recorder()
    recorder.run_started(run)
    recorder.stage_finished(run, "load", "glb", source_of(asset), 0.1)
    found = replace(segmentation_of(asset), evidence=evidence)
    recorder.stage_finished(run, "segment", "mine", found, 0.1)
    recorder.run_finished(run, Report(run.name, asset, (), (), {}, ()))
    return run.folder / f"{run.name}.rrd"


def test_each_piece_has_a_view_and_vertex_evidence_one_for_each_name(recording):
    shown = views(recording)["3D"]
    assert {f"evidence/{name}" for name in ("codes", "errors", "nothing", "seeds")} <= shown
    assert {"evidence/chances/body", "evidence/chances/door"} <= shown


def test_voxels_are_where_they_are_and_equal_kinds_have_one_colour(recording):
    entity = "/evidence/codes"
    assert values(recording, entity, "VoxelGridMap:voxel_indices")[0][0] == CELLS.tolist()
    assert values(recording, entity, "VoxelGridMap:translation")[0][0] == [[1.0, 2.0, 3.0]]
    assert values(recording, entity, "VoxelGridMap:voxel_size")[0][0] == [[0.5, 0.5, 0.5]]
    a, b, c = values(recording, entity, "VoxelGridMap:colors")[0][0]
    assert a == b != c
    one, two, three = values(recording, "/evidence/errors", "VoxelGridMap:colors")[0][0]
    assert one != two == three


def test_points_have_the_colours_of_parts(recording):
    entity = "/evidence/seeds/tur"
    assert values(recording, entity, "Points3D:positions")[0][0] == [[0, 1, 2], [6, 7, 8], [9, 10, 11]]
    r, g, b = part_color(1)
    assert values(recording, entity, "Points3D:colors")[0][0] == [(r << 24) + (g << 16) + (b << 8) + 255]
    assert values(recording, f"{entity}/label", "Points3D:labels")[0][0] == ["Tür \\u03a9"]


def test_shares_are_drawn_where_they_are_not_zero(recording):
    asset = cabinet_asset()
    touched = (asset.mesh.vertices[asset.mesh.faces][:, :, 0] > 0).any(axis=1)
    for name, count in (("body", touched.sum()), ("door", len(asset.mesh.faces))):
        faces = values(recording, f"/evidence/chances/{name}", "Mesh3D:triangle_indices")[0][0]
        assert len(faces) == count
    places = np.array(values(recording, "/evidence/chances/door", "Mesh3D:vertex_positions")[0][0])
    colors = np.array(values(recording, "/evidence/chances/door", "Mesh3D:vertex_colors")[0][0])
    right = places[:, 0] > 0
    # Yellow is a whole share, green-blue the middle of the scale.
    assert set(colors[~right]) == {(253 << 24) + (231 << 16) + (37 << 8) + 255}
    assert set(colors[right]) == {(33 << 24) + (145 << 16) + (140 << 8) + 255}


def test_an_empty_piece_leaves_its_view_empty(recording):
    assert "/evidence/nothing" not in paths_in(recording)


def test_words_and_pictures_have_views_of_their_kind(recording):
    shown = views(recording)
    assert {"evidence/question", "evidence/said"} <= shown["TextDocument"]
    assert "evidence/picture_shown" in shown["2D"]
    # The viewer has no glyph for the omega.
    assert text(recording, "/evidence/question") == "What is **this**? Eine Tür, \\u03a9?"
    assert values(recording, "/evidence/picture_shown", "Image:buffer")[0][0] == [PIXELS.ravel().tolist()]
