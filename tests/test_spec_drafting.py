"""`simart-kit spec`: a first spec and its picture; unedited it changes nothing, edited it is kept to."""

import io
import json
import tomllib

import numpy as np
import pytest
from PIL import Image

from simart_kit.asset import Joint, Limits
from simart_kit.cli.main import run
from simart_kit.drawing.numbered import numbered_png, spots
from simart_kit.plugins import Plugins
from simart_kit.spec.drafting import draft
from simart_kit.spec.reading import read_spec
from simart_kit.spec.values import PartSpec, Spec
from simart_kit.spec.writing import spec_text
from simart_kit.testing.meshes import boxes_mesh

from .real_objects import EXAMPLE
from .spec_cases import Given, converted, cupboard, told

SETS = ("export=[]", 'modify=[{use="sweep"}]')


@pytest.fixture(autouse=True)
def without_picture(monkeypatch):
    monkeypatch.setattr("simart_kit.render.write_preview", lambda asset, path: path)


@pytest.fixture
def cheap(monkeypatch):
    """No picture of numbers: these tests read the text."""
    monkeypatch.setattr("simart_kit.spec.drafting.numbered_png", lambda mesh, rows: b"picture")


def drafted(folder, path, recipe="geometric"):
    plugins = Plugins(installed=False)
    plugins.register(Given(boxes_mesh(cupboard())))
    source = folder / "cupboard.fake"
    source.write_text("fake")
    found = draft(source, recipe, sets=SETS, plugins=plugins)
    path.write_text(found.text(path, source, recipe))
    return found


@pytest.mark.parametrize("name", ["a.toml", "a.json"])
def test_unedited_it_gives_the_same_asset(tmp_path, cheap, name):
    found = drafted(tmp_path, tmp_path / name)
    assert read_spec(tmp_path / name) == found.spec

    plain = converted(tmp_path, None, cupboard()).asset
    kept = converted(tmp_path, tmp_path / name, cupboard())

    assert kept.asset.joints == plain.joints
    assert [(p.name, p.label, p.material) for p in kept.asset.parts] == [
        (p.name, p.label, p.material) for p in plain.parts
    ]
    assert np.array_equal(kept.asset.face_part, plain.face_part)
    assert set(told(kept).values()) == {"honoured"}


def test_it_says_what_was_found(tmp_path, cheap):
    spec = drafted(tmp_path, tmp_path / "a.toml").spec
    assert spec.only
    assert [part.name for part in spec.parts if part.root] == ["body"]
    stated = {part.name: (part.joint, part.axis, part.parent) for part in spec.parts if not part.root}
    assert stated == {
        "left_door": ("revolute", "left edge", "body"),
        "right_door": ("revolute", "right edge", "body"),
        "left_drawer": ("prismatic", "front", "body"),
        "right_drawer": ("prismatic", "front", "body"),
    }


def test_edits_are_kept_to(tmp_path, cheap):
    path = tmp_path / "a.json"
    drafted(tmp_path, path)
    table = json.loads(path.read_text())
    by_name = {part["name"]: part for part in table["parts"]}
    by_name["left_door"] |= {"name": "flap", "axis": "bottom edge", "limits": [0, 60]}
    by_name["right_door"] |= {"joint": "fixed"}
    for key in ("axis", "limits"):
        del by_name["right_door"][key]
    by_name["left_drawer"]["pieces"] += by_name["right_drawer"]["pieces"]
    table["parts"] = [part for name, part in by_name.items() if name != "right_drawer"]
    path.write_text(json.dumps(table))

    asset = converted(tmp_path, path, cupboard()).asset

    assert {part.name for part in asset.parts} == {"body", "flap", "right_door", "left_drawer"}
    flap = asset.joint_to("flap")
    assert np.abs(flap.axis) == pytest.approx([1, 0, 0])
    assert (flap.origin[2], flap.limits.upper) == pytest.approx((0.002, np.pi / 3))
    assert asset.joint_to("right_door").kind == "fixed"
    drawers = asset.mesh.triangles[asset.face_part == asset.part_index("left_drawer")]
    assert np.ptp(drawers[..., 0]) == pytest.approx(0.896)


def test_limits_that_others_shorten_are_a_remark(tmp_path, monkeypatch, cheap):
    def long(self, mesh, segmentation, spec=None):
        drawer = Joint("slide", "prismatic", "body", "left_drawer", (0, 0, 0), (1, 0, 0), Limits(0, 0.4))
        return (drawer,)

    monkeypatch.setattr("simart_kit_plugins.geometric.predictor.GeometricJoints._predicted", long)
    found = drafted(tmp_path, tmp_path / "a.toml")
    assert found.limits == {"left_drawer": (0.0, 0.4)}
    text = (tmp_path / "a.toml").read_text()
    assert "# limits = [0.0, 0.4]  # m; others are in the way before that" in text
    part = next(p for p in tomllib.loads(text)["parts"] if p["name"] == "left_drawer")
    assert "limits" not in part


def test_command_writes_spec_and_picture_and_convert_takes_it(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr("simart_kit.drawing.numbered.SIZE", 100)
    assert run(["spec", str(EXAMPLE), "-r", "geometric", "--set", "modify=[]"]) == 0
    rows = capsys.readouterr().out.splitlines()
    assert rows[0].split() == ["part", "name", "joint", "axis", "pieces"]
    assert any(row.split()[1:5] == ["left_door", "revolute", "left", "edge"] for row in rows)
    with Image.open(tmp_path / "cabinet.spec.png") as picture:
        assert picture.size[0] == 2 * 100

    assert run(["spec", str(EXAMPLE), "-r", "geometric"]) == 2
    assert "cabinet.spec.toml is there already" in capsys.readouterr().err
    words = ["--spec", "cabinet.spec.toml", "--set", "export=[]", "--set", "modify=[]", "--no-record", "-v"]
    assert run(["convert", str(EXAMPLE), "-r", "geometric", *words]) == 0
    assert "spec: parts.left_door.axis = left edge: honoured" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("out", "said"), [("a.yaml", "a .toml or .json file"), ("no/a.toml", "there is no folder no")]
)
def test_where_it_cannot_be_written_is_told_first(tmp_path, monkeypatch, capsys, out, said):
    monkeypatch.chdir(tmp_path)
    assert run(["spec", str(EXAMPLE), "--out", out]) == 2
    assert said in capsys.readouterr().err


def test_numbers_stand_in_the_middle_of_their_regions():
    labels = np.full((40, 60), -1)
    labels[5:35, 10:40] = 3
    labels[0:4, 50:54] = 7  # too small for a number
    found = spots(labels)
    assert list(found) == [3]
    assert np.abs(np.array(found[3]) - [24.5, 19.5]).max() <= 1


def test_picture_has_a_row_of_two_views_for_each_labelling(monkeypatch):
    monkeypatch.setattr("simart_kit.drawing.numbered.SIZE", 100)
    mesh = boxes_mesh([((0, 0, 0), (1, 1, 1)), ((2, 0, 0), (3, 1, 1))])
    parts = np.repeat([0, 1], 12)
    picture = Image.open(io.BytesIO(numbered_png(mesh, {"parts": parts, "pieces": parts})))
    assert picture.size[0] == 2 * 100
    assert picture.size[1] > 2 * 100
    # Blue is the second colour, grey the first: both are there.
    pixels = np.asarray(picture.convert("RGB")).reshape(-1, 3).astype(int)
    assert (pixels[:, 2] - pixels[:, 0] > 60).mean() > 0.02


def test_text_reads_back_whatever_labels_hold_and_its_examples_are_right():
    parts = (
        PartSpec(name="a", label='a "q"\x7f\n\\ü', pieces=(1, 2), joint="revolute", limits=(-1.5, 90.0)),
        PartSpec(name="b", root=True),
    )
    spec = Spec(schema=1, numbered=3, only=True, parts=parts)

    text = spec_text(spec, {"b": (0.0, 1.0)}, "mine.png", "mine.glb", "nano")

    assert read_spec(tomllib.loads(text)) == spec
    kinds = read_spec(tomllib.loads(text.replace("# kinds.", "kinds."))).kinds
    assert (kinds["door"].count, kinds["drawer"].count) == (2, 0)
