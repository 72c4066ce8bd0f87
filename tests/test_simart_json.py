"""Exporter `simart-json`: what it writes is read back by the recipe `simart` as the same object."""

import json
import math
import sys
from dataclasses import replace

import numpy as np
import pytest
from simart_kit_plugins.simart.answer.parsing import parse_answer
from simart_kit_plugins.simart.answer.units import guesses_of, joints_of
from simart_kit_plugins.simart.codec import object_frame
from simart_kit_plugins.simart.json_exporter import SimartJson
from simart_kit_plugins.simart.segmenter import Simart
from simart_kit_plugins.simart.tokens import TokenGrid

from simart_kit import Plugins
from simart_kit.asset import Asset, Joint, Limits, Part
from simart_kit.errors import BadInputError
from simart_kit.recipe import Use, check_extras, read_options
from simart_kit.testing.meshes import boxes_mesh, cabinet_asset, chain_asset, static_asset

from .endpoint_cases import completion, serving
from .token_models import use_dictionary

KINDS = ("ball", "free", "fixed", "continuous")


@pytest.fixture(autouse=True)
def codec(tmp_path, monkeypatch):
    """A voxel model that loses nothing counts as the shipped one."""
    monkeypatch.setenv("no_proxy", "*")
    monkeypatch.delenv("SIMART_API_KEY", raising=False)
    return use_dictionary(monkeypatch, tmp_path / "codec")


def written(asset, folder):
    return SimartJson().export(asset, folder).read_text()


def with_door(**changes):
    """The cabinet with another joint at its door."""
    asset = cabinet_asset()
    return asset.with_joints({"door_hinge": replace(asset.joint("door_hinge"), **changes)})


def every_kind():
    """A box of 0.5 m that carries four small ones by a joint of each kind without limits."""
    places = [0.0, 0.12, 0.24, 0.36]
    bounds = [((x, 0.0, 0.4), (x + 0.1, 0.1, 0.45)) for x in places]
    mesh = boxes_mesh([((0.0, 0.0, 0.0), (0.5, 0.3, 0.39)), *bounds])
    parts = tuple(Part(name) for name in ("body", *KINDS))
    joints = tuple(
        Joint(f"{kind}_joint", kind, "body", kind, (x + 0.03, 0.07, 0.4))
        for kind, x in zip(KINDS, places, strict=True)
    )
    return Asset("kinds", mesh, np.repeat(range(5), 12), parts, joints)


def read(text, asset):
    """The joints that a text says of an asset's mesh."""
    answer = parse_answer(text, TokenGrid())
    names = [guess.name for guess in guesses_of(answer)]
    return joints_of(answer, names, object_frame(asset.mesh))[0]


def ends(joint, towards):
    """Limits about an axis that points as another does."""
    lower, upper = joint.limits.lower, joint.limits.upper
    return (lower, upper) if np.dot(joint.axis, towards) > 0 else (-upper, -lower)


def assert_same_joints(heard, asset):
    """Kinds and parents are the asset's, and places, axes and limits as near as half a step of the form."""
    side = np.ptp(asset.mesh.bounds, axis=0).max()
    assert {joint.child for joint in heard} == {joint.child for joint in asset.joints}
    for found in heard:
        joint = asset.joint_to(found.child)
        assert (found.kind, found.parent) == (joint.kind, joint.parent)
        if joint.kind not in ("fixed", "free"):
            apart = np.subtract(found.origin, joint.origin)
            assert np.abs(apart).max() <= side / 400 + 1e-9
            assert abs(np.dot(found.axis, joint.axis)) > math.cos(math.radians(0.42))
        if joint.limits:
            step = side / 100 if joint.kind == "prismatic" else math.pi / 100
            assert ends(found, joint.axis) == pytest.approx(ends(joint, joint.axis), abs=step / 2 + 1e-9)


def test_a_model_that_says_it_means_the_same_parts_and_joints(tmp_path):
    asset = cabinet_asset()

    with serving(completion(written(asset, tmp_path))) as server:
        options = {"endpoint": server.url, "endpoint_model": "simart", "endpoint_timeout": 20}
        found = Simart(read_options(Simart, options)).segment(asset.mesh)

    # Its own order: the root, then what it carries.
    order = [asset.part_index(part.name) for part in found.parts]
    assert sorted(order) == [0, 1, 2]
    assert np.array_equal(np.array(order)[found.face_part], asset.face_part)
    assert_same_joints(found.joints, asset)


@pytest.mark.parametrize("asset", [chain_asset(), static_asset()], ids=lambda asset: asset.name)
def test_what_is_written_says_the_same_joints(tmp_path, asset):
    joints = read(written(asset, tmp_path), asset)
    assert_same_joints(joints, asset)


def test_joints_of_every_kind_come_back(tmp_path):
    asset = every_kind()
    text = written(asset, tmp_path)

    told = {part["name"]: part for part in json.loads(text)["parts_captions"].values()}
    motions = {name: sorted(part.keys() & {"center", "axis", "limits"}) for name, part in told.items()}
    assert {name: part["type"] for name, part in told.items()} == {
        "body": "fixed",
        "ball": "hinge",
        "free": "free",
        "fixed": "fixed",
        "continuous": "revolute",
    }
    assert (motions["ball"], motions["continuous"]) == (["center"], ["axis", "center", "limits"])
    assert_same_joints(read(text, asset), asset)


def test_materials_are_the_assets_and_not_those_of_the_table(tmp_path):
    asset = cabinet_asset()
    light = replace(asset.part("door").material, density=123.0, youngs_modulus=2e9)
    asset = asset.with_parts({"door": replace(asset.part("door"), material=light)})

    table = json.loads(written(asset, tmp_path))
    parts = table["parts_captions"]

    assert table["object_captions"] == {"name": "cabinet", "scale": 80.0}
    assert [parts[number]["material"] for number in "012"] == ["Wood"] * 3
    assert [parts[number]["density"] for number in "01"] == ["0.6 g/cm^3", "0.123 g/cm^3"]
    assert parts["1"]["Young's Modulus (GPa)"] == 2.0


@pytest.mark.parametrize(
    ("changes", "told"),
    [
        ({}, None),
        ({"kind": "fixed", "limits": None}, None),
        ({"kind": "continuous", "limits": None}, None),
        ({"kind": "ball", "limits": None}, "a center alone"),
        ({"kind": "free", "limits": None}, "sits is not said"),
        ({"limits": Limits(-4.0, 4.0)}, "no ends"),
        ({"limits": Limits(-7.0, 0.0)}, "no ends"),
        ({"limits": Limits(-0.001, 0.0)}, "nearest that can be said"),
        ({"kind": "prismatic", "limits": Limits(0.0, 0.9)}, "nearest that can be said"),
        ({"kind": "prismatic", "limits": Limits(0.0, 0.79), "origin": (3.0, 0.0, 0.0)}, None),
        ({"origin": (-0.275, -0.19, 7.0)}, None),  # on the same axis
        ({"origin": (3.0, 0.0, 0.0)}, "pass the object's cube"),
        ({"axis": (0.6, -0.8, 0.0)}, "numbers below 0"),
        ({"axis": (-0.6, -0.8, 0.0)}, None),  # the sign goes into the limits
    ],
)
def test_what_the_form_cannot_say_is_told(changes, told):
    lost = SimartJson().unsupported(with_door(**changes))
    named = [text for text in lost if text.endswith(": door_hinge")]
    assert [told in text for text in named] == ([True] if told else [])
    assert "0.004 m apart" in " ".join(lost)


def test_names_and_a_free_object_are_told_where_they_are_lost():
    asset = cabinet_asset()
    root = replace(asset.root, name="b" * 49)
    joints = tuple(replace(joint, parent=root.name) for joint in asset.joints)
    asset = replace(asset, parts=(root, *asset.parts[1:]), joints=joints, floating=True)
    lost = SimartJson().unsupported(asset)
    assert f"names are shortened: {root.name}" in lost
    assert any("object is free" in text for text in lost)
    assert not any("whole" in text for text in SimartJson().unsupported(static_asset()))


def test_without_torch_a_recipe_with_it_is_refused(monkeypatch):
    monkeypatch.setitem(sys.modules, "torch", None)
    with pytest.raises(BadInputError) as refused:
        check_extras([("exporter", Use(use="simart-json"))], Plugins(installed=False))
    assert str(refused.value) == "exporter 'simart-json' needs torch: pip install 'simart-kit[torch]'"
