"""What is made of an answer's words: how sure the model was, and how a recording shows them."""

import math

import numpy as np
import pytest
from simart_kit_plugins.simart.answer.values import Motion, ObjectAnswer, PartAnswer
from simart_kit_plugins.simart.answer_evidence import MEETINGS, meetings, stream_text
from simart_kit_plugins.simart.asking import Word
from simart_kit_plugins.simart.certainty import caption_certainty, certainty
from simart_kit_plugins.simart.codec import object_frame, occupancy
from simart_kit_plugins.simart.surviving import surviving
from simart_kit_plugins.simart.tokens import TokenGrid, VoxelTokens

from simart_kit.testing.meshes import boxes_mesh

VOXELS = VoxelTokens(TokenGrid(), np.array([0]), np.array([1]))


def forced(text):
    return Word(text, 1.0, True)


def chosen(text, probability):
    return Word(text, probability, False)


WORDS = (
    forced('{"object_captions":{"name":"'),
    chosen("Box", 0.01),
    forced('"},"parts_captions":{"0":{"name":"'),
    chosen("bo", 0.5),
    chosen("dy", 0.5),
    forced('"},"1":{"name":"'),
    chosen("lid", 0.9),
    forced('","type":"'),
    chosen("hinge", 0.4),
    forced('"}},"parts_voxels":{"0":"'),
    forced("<voxel>"),
    chosen("<xyz_3>", 0.25),
    chosen("<mesh_7>", 0.125),
    chosen("<voxel>", 0.75),
    forced("<xyz_4>"),
    chosen("<mesh_8>", 0.5),
    forced('"}}'),
)


def test_certainty_is_the_geometric_mean_of_what_was_chosen():
    assert certainty([forced("a"), chosen("b", 0.9), chosen("c", 0.4)]) == pytest.approx(0.6)
    assert certainty([forced("a")]) == 1
    assert 0 < certainty([chosen("a", 0.0)]) < 1e-6


def test_a_part_is_as_sure_as_its_own_captions():
    assert caption_certainty(WORDS, 2) == pytest.approx([0.5, math.sqrt(0.9 * 0.4)])
    assert caption_certainty((), 2) is None
    assert caption_certainty(WORDS, 3) is None


def test_the_stream_has_a_row_for_each_choice_and_each_voxel():
    text = stream_text(WORDS)
    assert text.startswith("17 tokens: 9 chosen by the model, 8 forced by the grammar.")
    rows = [tuple(cell.strip() for cell in line.strip("|").split("|")) for line in text.splitlines()[4:]]
    assert rows[:3] == [
        ('`{"object_captions":{"name":"`', "forced"),
        ("`Box`", "0.010"),
        ('`"},"parts_captions":{"0":{"name":"`', "forced"),
    ]
    assert rows[-3:] == [
        ("`<voxel><xyz_3><mesh_7>`", "0.250 x 0.125"),
        ("`<voxel><xyz_4><mesh_8>`", "0.750 x 0.500"),
        ('`"}}`', "forced"),
    ]


def test_a_long_stream_is_cut_and_says_so():
    text = stream_text([chosen("a", 0.5)] * 700)
    assert text.count("`a`") == 600
    assert text.endswith("... and 100 rows more")


def test_children_of_lost_parts_move_up_to_who_is_left():
    turn = Motion((100, 100, 100), (0, 0, 100), (-50, 0))
    kinds = [("fixed", None), ("fixed", 0), ("revolute", 1), ("revolute", 2), ("fixed", 2)]
    parts = [
        PartAnswer(kind, VOXELS, f"p{number}", parent, turn if kind == "revolute" else None)
        for number, (kind, parent) in enumerate(kinds)
    ]
    answer = ObjectAnswer("thing", 10.0, tuple(parts))
    assert surviving(answer, range(5)) == answer
    without_middle = surviving(answer, [0, 1, 3, 4]).parts
    assert [part.name for part in without_middle] == ["p0", "p1", "p3", "p4"]
    assert [part.parent for part in without_middle] == [None, 0, 1, 1]
    without_root = surviving(answer, [2, 3, 4]).parts
    assert [(part.type, part.parent) for part in without_root] == [
        ("fixed", None),
        ("revolute", 0),
        ("fixed", 0),
    ]
    assert without_root[0].motion is None
    assert without_root[1].motion == turn


def test_voxels_are_told_apart_by_whose_they_are():
    """Two boxes side by side; the left one is decoded as it is, of the right one a layer as the left's."""
    mesh = boxes_mesh([((0, 0, 0), (1, 1, 1)), ((1.5, 0, 0), (2.5, 1, 1))])
    frame = object_frame(mesh)
    left, right = (occupancy(mesh.triangles[part], frame) for part in (slice(12), slice(12, 24)))
    layer = right.copy()
    layer[:-1] = False
    air = np.zeros_like(left)
    air[32, 0, 0] = True
    piece = meetings(mesh, frame, np.stack([left | layer | air, np.zeros_like(left)]), np.repeat([0, 1], 12))
    counts = dict(zip(MEETINGS, np.bincount(piece.values, minlength=4).tolist(), strict=True))
    assert counts == {
        "same part": left.sum(),
        "other part": layer.sum(),
        "decoded alone": 1,
        "labelled alone": right.sum() - layer.sum(),
    }
