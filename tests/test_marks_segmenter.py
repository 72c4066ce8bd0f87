"""Segmenter and joint predictor `p3sam-vlm` with a model that knows the truth."""

import json

import numpy as np
import pytest
from simart_kit_plugins.marks.predictor import VlmJoints
from simart_kit_plugins.marks.segmenter import P3SamVlm
from simart_kit_plugins.vlm.asking import Asking
from simart_kit_plugins.vlm.values import Completion

from simart_kit.assemble import assemble, checked
from simart_kit.errors import BadInputError, UnknownPluginError
from simart_kit.evidence import PictureEvidence, TextEvidence
from simart_kit.grounding import Grounder
from simart_kit.mesh import Mesh
from simart_kit.plugins import Plugins
from simart_kit.recipe import load_recipe, read_options
from simart_kit.spec.protocols import prediction_by, segment_by
from simart_kit.spec.values import Spec
from simart_kit.stages import PartGuess, Segmentation
from simart_kit.testing.meshes import cabinet_asset
from simart_kit.usage import ModelUsage

from .marks_cases import Knowing, Scripted, small_pictures

PLUGINS = Plugins(installed=False)
GEOMETRIC = {"proposer": {"use": "geometric"}}
ASSET = cabinet_asset(textured=False)
STILL = {"name": "body", "kind": "fixed", "parent": -1, "axis": None, "origin": None}
PARTS = [
    STILL,
    *(
        {"name": j.child, "kind": j.kind, "parent": 0, "axis": np.array(j.axis), "origin": np.array(j.origin)}
        for j in ASSET.joints
    ),
]


@pytest.fixture(autouse=True)
def _small(monkeypatch):
    small_pictures(monkeypatch)


def stage(vlm, **options):
    return P3SamVlm(read_options(P3SamVlm, {**GEOMETRIC, **options}), plugins=PLUGINS, vlm=vlm)


def pieces(vlm, **options):
    """(F,) pieces that the segmenter numbers."""
    return stage(vlm, **options)._proposed(ASSET.mesh).piece


def opening(joint):
    """(3,) axis with the sense in which the joint goes farther."""
    return np.array(joint.axis) * (1 if joint.limits.upper >= -joint.limits.lower else -1)


def knowing():
    return Knowing(ASSET.mesh, pieces(None), ASSET.face_part, PARTS)


@pytest.fixture(scope="module")
def told():
    """What the model was asked, and the segmentation."""
    with pytest.MonkeyPatch.context() as patch:
        small_pictures(patch)
        vlm = knowing()
        return vlm, checked(stage(vlm).segment(ASSET.mesh), ASSET.mesh)


def test_a_model_that_knows_the_truth_gives_it(told):
    _, found = told
    assert [part.name for part in found.parts] == ["body", "door", "drawer"]
    assert np.array_equal(found.face_part, ASSET.face_part)
    asset = assemble("cabinet", ASSET.mesh, found, found.joints, np.eye(4))
    for true in ASSET.joints:
        mine = asset.joint_to(true.child)
        assert (mine.kind, mine.parent) == (true.kind, "body")
        assert opening(mine) == pytest.approx(opening(true))


def test_the_recording_gets_every_picture_question_and_answer(told):
    vlm, found = told
    shown = [piece.pixels for piece in found.evidence if isinstance(piece, PictureEvidence)]
    sent = [picture for question in vlm.asked for picture in question.pictures]
    assert len(shown) == len(sent)
    assert all(map(np.array_equal, shown, sent))
    texts = [piece.markdown for piece in found.evidence if isinstance(piece, TextEvidence)]
    assert len(texts) == 3  # links, door, drawer
    assert all(question.text in text for question, text in zip(vlm.asked, texts, strict=True))
    assert any(
        "model scripted, answers: 3, 0 from the cache; calls: 3, 3000 tokens read, 150 written" in note.text
        for note in found.notes
    )


def test_a_wrong_axis_and_direction_are_mended_by_the_critic():
    vlm = knowing()
    vlm.mistaken = {"door"}
    rounds = iter([[{"link": "door", "wrong": "axis"}, {"link": "drawer", "wrong": "direction"}], []])
    vlm.answers["CriticAnswer"] = lambda question: {"faults": next(rounds)}
    found = stage(vlm, critic=3).segment(ASSET.mesh)
    door, drawer = found.joints
    assert opening(door) == pytest.approx(opening(ASSET.joints[0]))
    assert any(phrase.startswith("not ") for phrase in door.evidence)
    assert opening(drawer) == pytest.approx(-opening(ASSET.joints[1]))  # it was right before
    assert sum(question.answer.__name__ == "CriticAnswer" for question in vlm.asked) == 2


def test_a_piece_that_the_critic_misses_changes_its_link():
    vlm = knowing()
    handle = int(pieces(None)[72])  # the cabinet's seventh box, on the door
    vlm.part_of_piece[handle] = 0
    faults = [{"link": "door", "wrong": "pieces", "add": [handle]}]
    vlm.answers["CriticAnswer"] = lambda question: {"faults": faults}
    assert np.array_equal(stage(vlm, critic=1).segment(ASSET.mesh).face_part, ASSET.face_part)


def test_pieces_that_are_not_named_stay_with_the_body_and_are_told():
    vlm = knowing()
    whole = vlm.answers["ObjectAnswer"]

    def forgetful(question):
        answer = whole(question)
        answer["links"][0]["pieces"] = []
        return answer

    vlm.answers["ObjectAnswer"] = forgetful
    found = stage(vlm).segment(ASSET.mesh)
    assert np.array_equal(found.face_part, ASSET.face_part)
    assert any("were not named and stay with the body" in note.text for note in found.notes)


def test_an_answer_that_names_a_piece_twice_is_asked_for_again():
    vlm = knowing()

    class Speaker:
        who = "a model"

        def __init__(self):
            self.corrections = []

        def say(self, question, correction):
            if question.answer.__name__ == "AxisAnswer":
                return Completion(vlm.ask(question).raw, True)
            answer = json.loads(vlm.ask(question).raw)
            if correction is None:
                answer["links"][1]["pieces"] += answer["links"][0]["pieces"][:1]
            else:
                self.corrections.append(correction.mistake)
            return Completion(json.dumps(answer), True)

    speaker = Speaker()
    found = stage(Asking("m", speaker, None, 4096)).segment(ASSET.mesh)
    assert np.array_equal(found.face_part, ASSET.face_part)
    (mistake,) = speaker.corrections
    assert "is in two links" in mistake


def test_one_piece_is_not_asked_about():
    silent = Scripted({})
    sheet = Mesh(np.array([[0, 0, 0], [1, 0, 0], [1, 0, 1], [0, 0, 1.0]]), np.array([[0, 1, 2], [0, 2, 3]]))
    found = stage(silent).segment(sheet)
    assert [part.name for part in found.parts] == ["body"]
    assert not silent.asked
    assert any(note.level == "warning" and "one piece" in note.text for note in found.notes)


def test_a_size_far_from_the_mesh_s_is_a_warning():
    vlm = knowing()
    whole = vlm.answers["ObjectAnswer"]
    vlm.answers["ObjectAnswer"] = lambda question: whole(question) | {"longest_side_m": 0.008}
    notes = stage(vlm).segment(ASSET.mesh).notes  # 0.8 m high
    assert any(note.level == "warning" and "convert with --scale 0.01" in note.text for note in notes)


def test_grounding_takes_the_pieces_that_belong():
    true = np.bincount(pieces(None), ASSET.face_part == 1) > 0
    table = [{"piece": i, "belongs": "yes" if y else "no", "confidence": 80} for i, y in enumerate(true)]
    vlm = Scripted({"GroundingAnswer": lambda question: {"matches": table}})
    assert isinstance(stage(vlm), Grounder)
    found = stage(vlm).ground(ASSET.mesh, "the door")
    assert np.array_equal(found.faces, ASSET.face_part == 1)
    assert found.score == pytest.approx(0.8)
    assert '"the door"' in vlm.asked[0].text


@pytest.mark.parametrize(("belongs", "count"), [("no", 0), ("partly", 1)])
def test_grounding_without_a_yes_takes_the_surest_partly(belongs, count):
    number = int(pieces(None).max()) + 1
    table = [{"piece": i, "belongs": belongs, "confidence": 10 + i} for i in range(number)]
    found = stage(Scripted({"GroundingAnswer": lambda question: {"matches": table}})).ground(ASSET.mesh, "x")
    assert len(np.unique(found.face_candidate[found.faces])) == count
    if count:
        assert found.face_candidate[found.faces][0] == number - 1


def test_the_predictor_moves_the_parts_of_any_segmenter():
    found = Segmentation(ASSET.face_part, tuple(PartGuess(part.name) for part in ASSET.parts))
    vlm = Knowing(ASSET.mesh, ASSET.face_part, ASSET.face_part, PARTS)
    said = prediction_by(VlmJoints(vlm=vlm), ASSET.mesh, found, None)
    shown = [piece.pixels for piece in said.evidence if isinstance(piece, PictureEvidence)]
    sent = [picture for question in vlm.asked for picture in question.pictures]
    assert all(map(np.array_equal, shown, sent))
    assert len(shown) == len(sent) > 0
    assert VlmJoints(vlm=vlm).predict(ASSET.mesh, found) == said.joints
    assert said.usage == (ModelUsage("scripted", 3, 0, 3, 3000, 150),)
    joints = said.joints
    for mine, true in zip(joints, ASSET.joints, strict=True):
        assert (mine.child, mine.kind) == (true.child, true.kind)
        assert opening(mine) == pytest.approx(opening(true))


def test_what_a_person_states_goes_with_every_question():
    stated = {"schema": 1, "parts": [{"name": "flap", "joint": "revolute", "pieces": [3]}]}
    spec = Spec.model_validate_json(json.dumps(stated))
    vlm = knowing()
    found = segment_by(stage(vlm), ASSET.mesh, spec)
    assert np.array_equal(found.face_part, ASSET.face_part)
    texts = [question.text for question in vlm.asked]
    assert len(texts) == 3
    assert all('"name": "flap"' in text for text in texts)
    assert not any('"pieces"' in text for text in texts)  # its numbers are not those in the pictures


def test_an_unknown_proposer_is_told_with_those_that_exist():
    with pytest.raises(UnknownPluginError, match=r"unknown segmenter 'nosuch': known are .*geometric"):
        stage(Scripted({}), proposer={"use": "nosuch"}).segment(ASSET.mesh)


def test_without_a_model_it_says_what_to_set():
    with pytest.raises(BadInputError, match="set the option model"):
        stage(None).segment(ASSET.mesh)


def test_the_recipe_is_shipped():
    recipe = load_recipe("p3sam-vlm", PLUGINS)
    assert (recipe.segmenter.use, recipe.segmenter.options["proposer"]["use"]) == ("p3sam-vlm", "p3sam")
