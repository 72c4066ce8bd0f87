"""Segmenter `simart`: a model that is random, and one on a server that says the truth."""

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from PIL import Image
from simart_kit_plugins.simart.answer.units import answer_of
from simart_kit_plugins.simart.answer.writing import answer_text, grounding_text
from simart_kit_plugins.simart.codec import encode_parts
from simart_kit_plugins.simart.endpoint.asking import prompt_messages
from simart_kit_plugins.simart.prompt.processor import Processor
from simart_kit_plugins.simart.prompt.values import Prompt
from simart_kit_plugins.simart.segmenter import Simart
from simart_kit_plugins.simart.tokens import VoxelTokens

from simart_kit.assemble import assemble, checked
from simart_kit.cli.main import run
from simart_kit.errors import BadInputError
from simart_kit.grounding import Grounder
from simart_kit.recipe import read_options
from simart_kit.stages import PartGuess
from simart_kit.testing.meshes import boxes_mesh, cabinet_asset

from .endpoint_cases import completion, serving, status
from .mllm_cases import bundle, saved
from .recordings import paths_in, text, views
from .token_models import use_dictionary

NAMES = ("body", "door", "drawer")


@pytest.fixture(autouse=True)
def _direct(monkeypatch):
    monkeypatch.setattr("simart_kit.render.write_preview", lambda asset, path: path)
    monkeypatch.setenv("no_proxy", "*")
    monkeypatch.delenv("SIMART_API_KEY", raising=False)


@pytest.fixture(scope="module")
def model(tmp_path_factory):
    return str(saved(tmp_path_factory.mktemp("simart")))


@pytest.fixture
def encoded(tmp_path, monkeypatch):
    """A cabinet's tokens by a voxel model that loses nothing and counts as the shipped one."""
    codec = use_dictionary(monkeypatch, tmp_path / "codec")
    asset = cabinet_asset()
    return encode_parts(codec, asset.mesh, asset.face_part, NAMES)


@pytest.fixture
def truth(encoded):
    """The true answer."""
    parts = [PartGuess(name, name, "steel") for name in NAMES]
    return answer_of("Cabinet", 1.6, parts, cabinet_asset().joints, encoded.parts, encoded.frame)


def stage(seed=0, **options):
    return Simart(read_options(Simart, options), seed=seed)


def served(served, **options):
    return stage(endpoint=served.url, endpoint_model="simart", endpoint_timeout=20, **options)


def iou(mesh, mine, true):
    areas = mesh.face_areas
    return areas[mine & true].sum() / areas[mine | true].sum()


@pytest.mark.parametrize("seed", range(3))
def test_whatever_a_random_model_says_becomes_an_asset(model, seed):
    mesh = cabinet_asset().mesh
    options = {"model": model, "temperature": 1.0, "vision": "off", "max_parts": 5}
    found = checked(stage(seed, **options).segment(mesh), mesh)
    asset = assemble("cabinet", mesh, found, found.joints, np.eye(4))
    assert len(asset.joints) == len(asset.parts) - 1
    assert len(found.parts) <= 5
    assert all(0 <= part.score <= 1 for part in found.parts)
    assert any("tokens" in note.text for note in found.notes)


def test_a_run_shows_what_was_asked_and_said(model, tmp_path):
    Image.new("RGB", (300, 100), (10, 200, 30)).save(tmp_path / "photo.png")
    options = {"model": model, "image": str(tmp_path / "photo.png"), "text": "a fridge", "max_parts": 2}
    found = stage(**options).segment(cabinet_asset().mesh)
    shown = {piece.name: piece for piece in found.evidence}
    assert list(shown) == [
        "Picture shown",
        "Tokens by code",
        "Part seeds",
        "Decoded voxels and labels",
        "Probability",
        "Prompt",
        "Answer",
        "Tokens",
        "Parts said",
    ]
    pixels = shown["Picture shown"].pixels
    assert pixels.shape == (64, 64, 3)
    # The photo is fitted in width, white above and below.
    assert pixels[32, 32].tolist() == [10, 200, 30]
    assert pixels[2, 32].tolist() == [255, 255, 255]
    assert "This object is a fridge. Describe the object" in shown["Prompt"].markdown
    answer = shown["Answer"].markdown.removeprefix("```text\n").removesuffix("\n```")
    assert set(json.loads(answer)) == {"object_captions", "parts_captions", "parts_voxels"}
    assert '"object_captions":{"name":"` | forced' in shown["Tokens"].markdown
    assert "| 0 |" in shown["Parts said"].markdown


@pytest.mark.parametrize(
    ("options", "told"),
    [
        (
            {"max_tokens": 20},
            "does not end within max_tokens, 20: raise segmenter.options.max_tokens",
        ),
        ({"vision": "off", "image": "photo.png"}, "vision is off: leave one of the two out"),
        ({"image": "nowhere.png"}, "nowhere.png: there is no such picture file"),
        ({"text": "a <voxel>"}, "holds < or >"),
        ({"model": "nowhere"}, "nowhere: there is no such folder"),
        ({"model": "tests"}, "simart.json"),
    ],
)
def test_what_cannot_be_had_is_told(model, options, told):
    with pytest.raises(BadInputError) as caught:
        stage(**({"model": model} | options)).segment(cabinet_asset().mesh)
    assert told in str(caught.value)
    assert "\n" not in str(caught.value)


def test_no_model_is_told_with_what_to_give(monkeypatch):
    monkeypatch.setattr("simart_kit_plugins.simart.opening.shipped_folder", lambda: Path("nowhere"))
    with pytest.raises(BadInputError, match=r"add --set segmenter.options.model=FOLDER, .*endpoint=URL"):
        stage().segment(cabinet_asset().mesh)


def test_a_server_that_says_the_truth_gives_the_true_parts_and_joints(truth):
    asset = cabinet_asset()
    with serving(completion(answer_text(truth, atoms=True))) as server:
        found = checked(served(server).segment(asset.mesh), asset.mesh)
    assert {part.name for part in found.parts} == set(NAMES)
    assert {part.material for part in found.parts} == {"steel"}
    for number, part in enumerate(found.parts):
        assert iou(asset.mesh, found.face_part == number, asset.face_part == NAMES.index(part.name)) > 0.99
    joints = {joint.child: joint for joint in found.joints}
    # The grid of centres is 1/200 of 0.8 m apart, limits are 1.8 degrees and 1/100 of 0.8 m apart.
    assert joints["door"].kind == "revolute"
    np.testing.assert_allclose(joints["door"].origin[:2], (-0.275, -0.19), atol=0.003)
    assert sorted(map(abs, (joints["door"].limits.lower, joints["door"].limits.upper))) == pytest.approx(
        [0, 1.5], abs=np.deg2rad(1)
    )
    assert joints["drawer"].kind == "prismatic"
    reach = np.outer((joints["drawer"].limits.lower, joints["drawer"].limits.upper), joints["drawer"].axis)
    assert min(reach[:, 1]) == pytest.approx(-0.3, abs=0.005)
    notes = [note.text for note in found.notes]
    assert f"model simart at {server.url}: 'Cabinet', parts: 3, 2 of them moving" in notes
    assert (
        "the model takes the longest side for 1.6 m, the file says 0.8 m: --scale 2 takes the model's word"
        in notes
    )
    assert not [note for note in found.notes if note.level == "warning"]


def test_a_server_is_sent_the_prompt_of_training_without_transformers(truth):
    with serving(completion(answer_text(truth))) as server:
        served(server, text="a cupboard", temperature=0.5, max_tokens=3000).segment(cabinet_asset().mesh)
    ((_, _, table),) = server.asked
    system, user = table["messages"]
    assert system["content"].startswith("You are a multimodal 3D reasoning assistant")
    picture, text = user["content"]
    assert picture["image_url"]["url"].startswith("data:image/png;base64,")
    assert text["text"].startswith("<voxel><xyz_")
    assert text["text"].endswith(
        ">This object is a cupboard. Describe the object with real scale and separate the object to "
        "different functional parts with each physical properties."
    )
    assert (table["temperature"], table["max_tokens"], table["seed"]) == (0.5, 3000, 0)


def test_the_chat_of_a_server_is_the_sequence_of_training():
    """A server writes its ids by the tokenizer's own chat template."""
    pytest.importorskip("jinja2")
    made = bundle()
    voxels = VoxelTokens(made.vocabulary.grid, np.array([3, 1023]), np.array([7, 8191]))
    for system in ("", "Be strict."):
        prompt = Prompt(system, "What is it?", voxels)
        messages = prompt_messages(prompt)
        chat = made.tokenizer.apply_chat_template(messages, add_generation_prompt=True, tokenize=False)
        ids = made.tokenizer.encode(chat, add_special_tokens=False)
        assert ids == Processor.of(made).ids(prompt)


def test_decoded_voxels_agree_with_the_labels_of_the_truth(truth):
    with serving(completion(answer_text(truth))) as server:
        found = served(server, vision="off").segment(cabinet_asset().mesh)
    pieces = {piece.name: piece for piece in found.evidence}
    assert "Picture shown" not in pieces
    assert "Tokens" not in pieces
    meetings = pieces["Decoded voxels and labels"]
    shares = np.bincount(meetings.values, minlength=4) / len(meetings.values)
    assert shares[0] > 0.98
    assert shares[1] < 0.02


def test_a_mistake_is_asked_about_once_and_told(truth):
    good = answer_text(truth)
    with serving(completion(good[:200]), completion(good)) as server:
        found = served(server).segment(cabinet_asset().mesh)
    assert len(found.parts) == 3
    assert any("its first answer could not be read" in note.text for note in found.notes)
    with (
        serving(completion('{"object_captions": {}}')) as server,
        pytest.raises(BadInputError, match="two answers could not be read"),
    ):
        served(server).segment(cabinet_asset().mesh)


def test_voxels_outside_the_object_are_refused(truth):
    grid = truth.parts[0].voxels.grid
    free = next(cell for cell in range(grid.cells) if cell not in truth.parts[0].voxels.index)
    stray = replace(truth.parts[1], voxels=VoxelTokens(grid, np.array([free]), np.array([1])))
    wrong = answer_text(replace(truth, parts=(truth.parts[0], stray)))
    block = boxes_mesh([((0, 0, 0), (1, 0.1, 0.1))])
    with serving(completion(wrong)) as server, pytest.raises(BadInputError, match="parts_voxels"):
        served(server).segment(block)


def test_parts_that_come_to_nothing_leave_their_children_to_their_parent(truth):
    """The door is empty and carries the drawer: the drawer then hangs on the body, on its own axis."""
    door = next(n for n, part in enumerate(truth.parts) if part.name == "door")
    drawer = next(n for n, part in enumerate(truth.parts) if part.name == "drawer")
    grid = truth.parts[0].voxels.grid
    nothing = VoxelTokens(grid, np.zeros(0, np.int32), np.zeros(0, np.int32))
    parts = [
        truth.parts[0],
        replace(truth.parts[door], voxels=nothing),
        replace(truth.parts[drawer], parent=1),
    ]
    with serving(completion(answer_text(replace(truth, parts=tuple(parts))))) as server:
        found = served(server).segment(cabinet_asset().mesh)
    assert [part.name for part in found.parts] == ["body", "drawer"]
    (joint,) = found.joints
    assert (joint.kind, joint.parent, joint.child) == ("prismatic", "body", "drawer")
    assert any("part 'door' decodes to no voxel" in note.text for note in found.notes)


def test_max_parts_holds_for_servers_too(truth):
    with serving(completion(answer_text(truth))) as server:
        found = served(server, max_parts=2).segment(cabinet_asset().mesh)
    assert len(found.parts) == 2
    assert any("parts beyond max_parts, 2, are left out: 1" in note.text for note in found.notes)


def test_a_description_is_grounded(truth):
    asset = cabinet_asset()
    door = next(part for part in truth.parts if part.name == "door")
    with serving(completion(grounding_text(door.voxels))) as server:
        asked = served(server)
        assert isinstance(asked, Grounder)
        found = asked.ground(asset.mesh, "the  door")
    assert iou(asset.mesh, found.faces, asset.face_part == 1) > 0.99
    assert server.asked[0][2]["messages"][1]["content"][1]["text"].endswith("with description: the door")
    assert f"gives it {len(door.voxels.index)} of " in found.reason


def test_nothing_and_everything_are_grounded_too(encoded):
    mesh = cabinet_asset().mesh
    with serving(completion("")) as server:
        nothing = served(server).ground(mesh, "the wheel")
    assert not nothing.faces.any()
    assert nothing.score == 0
    with serving(completion(grounding_text(encoded.whole))) as server:
        everything = served(server).ground(mesh, "all of it")
    assert everything.faces.all()


def test_a_random_model_grounds_something_valid(model):
    mesh = cabinet_asset().mesh
    found = stage(model=model, vision="off").ground(mesh, "the lid")
    assert found.faces.shape == (len(mesh.faces),)
    assert 0 <= found.score <= 1


def convert(folder, *arguments):
    """Convert the cabinet, without modifiers and exports, which other tests are about."""
    example = Path(__file__).parents[1] / "examples" / "cabinet.glb"
    stages = ["--set", "modify=[]", "--set", "export=[]", "--quiet", "--out", str(folder)]
    return run(["convert", str(example), "--recipe", "simart", *stages, *arguments])


def test_convert_with_recipe_simart_leaves_a_recording(model, tmp_path, capfd):
    changes = [f"segmenter.options.model='{model}'", "segmenter.options.max_parts=2", "seed=1"]
    sets = [word for change in changes for word in ("--set", change)]
    assert convert(tmp_path / "out", *sets, "--text", "a cabinet") == 0, capfd.readouterr().err
    recording = next((tmp_path / "out").glob("*.rrd"))
    assert {"/evidence/picture_shown", "/evidence/prompt", "/evidence/answer"} <= paths_in(recording)
    assert "This object is a cabinet." in text(recording, "/evidence/prompt")
    assert "chosen by the model" in text(recording, "/evidence/tokens")
    shown = views(recording)
    assert {"evidence/prompt", "evidence/tokens", "evidence/parts_said"} <= shown["TextDocument"]
    assert "evidence/picture_shown" in shown["2D"]


def test_the_key_is_in_no_file_of_a_run(truth, tmp_path, monkeypatch, capfd):
    monkeypatch.setenv("SIMART_API_KEY", "sk-very-secret-0123456789")
    with serving(status(401, b"unknown key sk-very-secret-0123456789")) as server:
        options = f"{{endpoint = '{server.url}', endpoint_model = 'simart'}}"
        assert convert(tmp_path / "out", "--set", f"segmenter.options={options}") == 1
    assert server.asked[0][1]["Authorization"] == "Bearer sk-very-secret-0123456789"
    files = [path for path in (tmp_path / "out").rglob("*") if path.is_file()]
    assert {path.name for path in files} >= {"error.txt"}
    assert not [path for path in files if b"very-secret" in path.read_bytes()]
    told = capfd.readouterr().err
    assert "HTTP 401" in told
    assert "very-secret" not in told


def test_a_password_in_the_url_is_refused_before_it_is_written_anywhere(tmp_path, capfd):
    assert convert(tmp_path / "out", "--set", "segmenter.options.endpoint='http://me:word@host/v1'") == 2
    assert "word@" not in capfd.readouterr().err
    assert not (tmp_path / "out").exists()
