"""The oracle ladder: what each step keeps of a truth, on objects whose numbers can be worked out by hand."""

import json
import re
from dataclasses import replace

import numpy as np
import pytest
import torch
from simart_kit_plugins.nano.array_network import ArrayNetwork
from simart_kit_plugins.nano.config import NanoConfig
from simart_kit_plugins.nano.generate.catalogue import CATEGORIES
from simart_kit_plugins.nano.generate.category import named
from simart_kit_plugins.nano.generate.data_set import write_objects
from simart_kit_plugins.nano.network import NanoNetwork
from simart_kit_plugins.nano.oracle import network as asking
from simart_kit_plugins.nano.oracle.judging import judge, right
from simart_kit_plugins.nano.oracle.ladder import CANDIDATES, GROUPING, PIECES, WHOLE, Ladder, ladders
from simart_kit_plugins.nano.oracle.totals import KindShare, kind_shares, lacking, rungs
from simart_kit_plugins.nano.predicting import PredictedPart
from simart_kit_plugins.nano.weights import save_network

from simart_kit import Joint, Limits, PartGuess, Segmentation
from simart_kit.bench.articulation import Articulation, Link, LinkJoint
from simart_kit.bench.cases import Prediction, Truth
from simart_kit.bench.importing import write_case
from simart_kit.bench.protocols.simart import Simart
from simart_kit.cli.main import run
from simart_kit.errors import BadInputError
from simart_kit.plugins import Plugins
from simart_kit.testing.meshes import boxes_mesh

torch.set_num_threads(1)
TINY = NanoConfig(channels=16, layers=1, heads=2, hidden=16, point_channels=8)
BODY = ((0.0, 0.0, 0.0), (1.0, 0.5, 2.0))
DOOR = ((0.0, -0.05, 0.55), (1.0, -0.02, 2.0))
DRAWER = ((0.0, -0.05, 0.0), (1.0, -0.02, 0.5))
HINGE = LinkJoint("revolute", (0, 0, 1), (0.0, -0.035, 0.0), -1.5, 0.0)
SLIDE = LinkJoint("prismatic", (0, -1, 0), None, 0.0, 0.4)
LINKS = (Link("body"), Link("door", 0, HINGE, label="door"), Link("drawer", 0, SLIDE, label="drawer"))


def wardrobe(links=LINKS, labels=(0, 1, 2)):
    """A body, a door and a drawer of a box each, +Z up and 2 m high; labels of boxes, or of faces."""
    mesh = boxes_mesh([BODY, DOOR, DRAWER])
    labels = np.repeat(labels, 12) if len(labels) == 3 else labels
    return Articulation("wardrobe", mesh.vertices, mesh.faces, labels, links)


def written(folder, articulation):
    write_case(Truth(articulation.name, articulation, up="+z"), folder / articulation.name)
    return folder


def climbed(folder, **options):
    return list(ladders(folder, Plugins(), **options))


def test_pieces_that_are_the_parts_lose_nothing(tmp_path):
    (one,) = climbed(written(tmp_path, wardrobe()))
    pieces, candidates = one.steps.values()
    assert list(one.steps) == [PIECES, CANDIDATES]
    assert pieces.iou == pytest.approx(1.0)
    assert [part.name for part in pieces.parts] == ["door", "drawer"]
    assert all(part.kept and part.joint for part in (*pieces.parts, *candidates.parts))
    assert lacking(one) == ()


def test_a_shut_cabinet_that_generate_wrote_has_its_pieces_and_candidates(tmp_path):
    write_objects([named("cabinet", CATEGORIES)], 2, 5, tmp_path / "made", open_share=0)
    found = climbed(tmp_path / "made")
    pieces, candidates = rungs(found)
    assert len(found) == 2
    assert pieces.iou >= 0.95
    assert pieces.kept == candidates.joints == 1
    shares = kind_shares(found).values()
    assert sum(share.parts for share in shares) == sum(share.right for share in shares) > 1


def test_a_piece_that_two_parts_share_goes_to_the_larger_and_costs_what_it_covers(tmp_path):
    mesh = boxes_mesh([BODY, DOOR, DRAWER])
    labels = np.repeat([0, 1, 2], 12)
    front = mesh.face_normals[:, 1] < -0.9
    labels[12:24][front[12:24]] = 3
    links = (*LINKS, Link("panel", 0, SLIDE))
    (one,) = climbed(written(tmp_path, wardrobe(links, labels)))
    # Sides of the door: two of 1 x 1.45, two of 1 x 0.03, two of 0.03 x 1.45. The panel is one of the first.
    whole, panel = 2 * (1.45 + 0.03 + 0.03 * 1.45), 1.45
    pieces = one.steps[PIECES]
    assert [part.iou for part in pieces.parts] == pytest.approx([(whole - panel) / whole, 1, 0], abs=1e-6)
    assert pieces.iou == pytest.approx(((whole - panel) / whole + 1) / 3, abs=1e-6)
    assert [part.kept for part in pieces.parts] == [True, True, False]
    total = rungs([one])
    assert total[0].kept == total[1].joints == pytest.approx(2 / 3)
    assert [part.name for part in lacking(one)] == ["panel"]


def test_a_part_that_has_all_pieces_cannot_be_found(tmp_path):
    mesh = boxes_mesh([DOOR, DRAWER])
    labels = np.where(mesh.face_normals[:, 1] < -0.9, 0, 1)
    (one,) = climbed(written(tmp_path, Articulation("door", mesh.vertices, mesh.faces, labels, LINKS[:2])))
    assert one.steps[PIECES].parts[0].kept
    assert lacking(one) == one.steps[CANDIDATES].parts
    assert one.steps[CANDIDATES].iou == 0


def test_a_hinge_far_from_its_part_has_no_candidate_but_one_of_several_right_ones_is_enough(tmp_path):
    far = replace(HINGE, origin=(-1.0, -0.035, 0.0))
    links = (LINKS[0], replace(LINKS[1], joint=far), LINKS[2])
    (one,) = climbed(written(tmp_path, wardrobe(links)))
    (part,) = lacking(one)
    assert part.name == "door"
    # 1 m from the door's edge, where the longest side is 2 m; the points lie a little inside that edge.
    assert part.line == pytest.approx(0.5, abs=0.02)
    assert kind_shares([one])["revolute"] == KindShare(1, 0)
    assert kind_shares([one])["prismatic"] == KindShare(1, 1)

    links = (LINKS[0], replace(LINKS[1], joint=far, also=(HINGE,)), LINKS[2])
    (one,) = climbed(written(tmp_path / "also", wardrobe(links)))
    assert lacking(one) == ()


@pytest.mark.parametrize(
    ("degrees", "away", "is_right"), [(0, 0, 1), (9, 0.04, 1), (-9, 0.04, 1), (11, 0, 0), (0, 0.06, 0)]
)
def test_a_joint_is_right_within_ten_degrees_and_a_twentieth(degrees, away, is_right):
    tilt = np.deg2rad(degrees)
    axis = (np.sin(tilt), 0, -np.cos(tilt))  # an axis has no sense
    true = LinkJoint("revolute", (0, 0, 1), (0, 0, 0))
    assert right(true, LinkJoint("revolute", axis, (away, 0, 0))) == bool(is_right)
    assert not right(true, LinkJoint("continuous", axis, (away, 0, 0)))
    slid = LinkJoint("prismatic", axis, (away, 0, 0))
    assert right(LinkJoint("prismatic", (0, 0, 1)), slid) == (abs(degrees) < 10)


def test_iou_and_type_are_the_benchs():
    truth = wardrobe()
    labels = np.repeat([0, 1, 0], 12)
    labels[0:2], labels[24:26] = 2, 2  # a third part of a side of the body and one of the drawer
    wrong = (LINKS[0], replace(LINKS[1], joint=replace(SLIDE, origin=None)), LINKS[2])
    said = wardrobe(wrong, labels)
    bench = Simart().score(Truth("wardrobe", truth), Prediction(said)).values
    judged = judge(truth, said)
    assert judged.iou == pytest.approx(bench["iou"])
    assert judged.type == pytest.approx(bench["type"])
    still = wardrobe((LINKS[0], Link("door", 0), Link("drawer", 0)))
    assert (judge(still, still).iou, judge(still, still).type) == (1, 1)
    assert (judge(still, said).iou, judge(still, said).invented) == (0, 2)


def slide_of(group):
    none = np.zeros(3)
    return PredictedPart(
        group.pieces, "", 1.0, "prismatic", np.array([0.0, 1.0, 0.0]), none, 0, 0.2, 0, 1.0, 1.0
    )


class Knowing:
    """A segmenter that knows the wardrobe, but takes its drawer for a part of the body."""

    def segment(self, mesh):
        shift = mesh.bounds[0] - (0, -0.05, 0)
        middle = mesh.triangles.mean(axis=1) - shift
        moves = (middle[:, 1] < -0.01) & (middle[:, 2] > 0.52)
        origin = tuple(np.add(HINGE.origin, shift))
        joint = Joint("hinge", "revolute", "body", "door", origin, HINGE.axis, Limits(-1.5, 0))
        parts = (PartGuess("body"), PartGuess("door"))
        return Segmentation(moves.astype(np.int32), parts, joints=(joint,))


def test_a_network_is_asked_for_the_joints_of_true_parts_and_then_for_everything(tmp_path, monkeypatch):
    monkeypatch.setattr(asking, "predict_groups", lambda _, __, found: tuple(map(slide_of, found)))
    nothing = ArrayNetwork(TINY, {})
    monkeypatch.setattr(asking, "load_model", lambda _: asking.Model(nothing, nothing, Knowing()))
    (one,) = climbed(written(tmp_path, wardrobe()), model=tmp_path)
    grouping, whole = one.steps[GROUPING], one.steps[WHOLE]
    # The door is said to slide, along the drawer's way.
    assert grouping.iou == pytest.approx(1.0)
    assert grouping.type == 0.5
    assert [part.joint for part in grouping.parts] == [False, True]
    assert whole.iou == whole.type == pytest.approx(0.5)
    assert [part.joint for part in whole.parts] == [True, False]
    total = {rung.step: rung for rung in rungs([one])}
    assert (total[GROUPING].joints, total[WHOLE].joints, total[WHOLE].kept) == (0.5, 0.5, 0.5)
    assert total[GROUPING].type == total[WHOLE].type == 0.5


def test_an_untrained_network_climbs_all_steps(tmp_path, capfd):
    save_network(NanoNetwork(TINY, 0), tmp_path / "model")
    data = written(tmp_path / "data", wardrobe())
    assert run(["bench", "oracle", str(data), "--model", str(tmp_path / "model"), "--json"]) == 0
    told = json.loads(capfd.readouterr().out)
    assert [rung["step"] for rung in told["ladder"]] == [PIECES, CANDIDATES, GROUPING, WHOLE]
    assert told["ladder"][2]["iou"] == pytest.approx(1.0)
    assert told["ladder"][2]["invented"] == 0


def test_the_command_prints_a_ladder_and_passes_over_what_cannot_be_read(tmp_path, capfd):
    data = written(tmp_path / "data", wardrobe())
    written(data, replace(wardrobe(), name="damaged"))
    (data / "damaged" / "gt.npz").write_bytes(b"")
    out = tmp_path / "numbers.json"
    assert run(["bench", "oracle", str(data), "-v", "--out", str(out)]) == 0
    said, err = capfd.readouterr()
    lines = said.splitlines()
    assert lines[0] == "wardrobe  pieces 1.000 2/2  candidates 1.000 2/2"
    assert lines[1] == "1 object, 2 moving parts, 1 skipped"
    assert re.fullmatch(r" +part IoU +parts kept +Type +joints right +invented", lines[2])
    assert lines[3].split() == ["pieces", "1.000", "1.000", "-", "-", "0"]
    assert lines[4].split() == ["candidates", "1.000", "1.000", "-", "1.000", "0"]
    assert lines[6].split() == ["revolute", "1", "of", "1"]
    assert re.fullmatch(r"damaged: skipped: \S*gt\.npz.*", err.strip())
    table = json.loads(out.read_text())
    assert table["skipped"].keys() == {"damaged"}
    assert table["candidates"]["prismatic"] == {"parts": 1, "right": 1}
    assert run(["bench", "oracle", str(data), "--json"]) == 0
    assert json.loads(capfd.readouterr().out) == table


def test_what_cannot_be_done_is_one_line(tmp_path, capfd):
    data = written(tmp_path / "data", wardrobe())
    for words, told in (
        ([str(tmp_path / "none")], "no such folder"),
        ([str(data), "--variant", "fused"], "variant"),
        ([str(data), "--out", str(tmp_path / "no" / "x.json")], "its folder does not exist"),
        ([str(data), "--model", str(tmp_path)], "config.json: no such file"),
    ):
        assert run(["bench", "oracle", *words]) == 2
        err = capfd.readouterr().err
        assert err.startswith("error: ")
        assert told in err
        assert len(err.splitlines()) == 1
    with pytest.raises(BadInputError, match="no object could be read"):
        rungs([])
    (data / "wardrobe" / "gt.npz").write_bytes(b"")
    assert run(["bench", "oracle", str(data)]) == 2
    assert "no object could be read" in capfd.readouterr().err
    assert isinstance(next(ladders(written(tmp_path / "b", wardrobe()), Plugins())), Ladder)
