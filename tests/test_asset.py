"""Asset, Part, Joint and Limits: what they refuse, and how they are asked for their pieces."""

from collections.abc import Callable
from dataclasses import FrozenInstanceError, replace
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import simart_kit as sk
from simart_kit.asset import NAME_PATTERN, clean_name, unique_names
from simart_kit.errors import BadInputError
from simart_kit.testing.meshes import boxes_mesh, cabinet_asset, chain_asset, static_asset

HINGE = sk.Joint("hinge", "revolute", "a", "b", limits=sk.Limits(0.0, 1.0))
MOUNT = sk.Joint("mount", "fixed", "a", "b")


def row(*joints: sk.Joint, names: str = "abc") -> sk.Asset:
    """Boxes in a row, a part each."""
    mesh = boxes_mesh([((2.0 * i, 0.0, 0.0), (2.0 * i + 1, 1.0, 1.0)) for i in range(len(names))])
    parts = tuple(sk.Part(name) for name in names)
    return sk.Asset("row", mesh, np.repeat(range(len(names)), 12), parts, joints)


def mount(parent: str, child: str) -> sk.Joint:
    return sk.Joint(f"{parent}_{child}", "fixed", parent, child)


@pytest.mark.parametrize(
    ("lower", "upper"),
    [(0.1, 1.0), (-1.0, -0.1), (1.0, -1.0), (float("nan"), 1.0), (-1.0, float("nan")), (-np.inf, 0.0)],
)
def test_limits_are_finite_and_include_rest(lower: float, upper: float) -> None:
    with pytest.raises(BadInputError, match="need finite lower <= 0 <= upper"):
        sk.Limits(lower, upper)


def test_limits_may_close_on_rest() -> None:
    assert sk.Limits(0.0, 0.0).upper == 0.0


@pytest.mark.parametrize(
    ("change", "said"),
    [
        ({"name": "Left Hinge"}, "name 'Left Hinge' must start with a letter"),
        ({"name": ""}, "name '' must start with a letter"),
        ({"kind": "screw"}, "kind 'screw' is not one of fixed, revolute, continuous, prismatic, ball, free"),
        ({"origin": (0.0, float("inf"), 0.0)}, "origin .* is not finite"),
        ({"axis": (0.0, 0.0, 2.0)}, "is not a unit vector"),
        ({"axis": (0.0, 0.0, 0.0)}, "is not a unit vector"),
        ({"axis": (float("nan"), 0.0, 1.0)}, "is not a unit vector"),
        ({"limits": None}, "a revolute joint needs limits"),
        ({"kind": "continuous"}, "a continuous joint takes no limits"),
        ({"kind": "fixed"}, "a fixed joint takes no limits"),
        ({"damping": -0.1}, "damping -0.1 must be a finite number >= 0"),
        ({"friction": float("nan")}, "friction nan must be"),
        ({"effort": float("inf")}, "effort inf must be"),
        ({"velocity": -1.0}, "velocity -1.0 must be"),
        ({"confidence": 1.2}, "confidence 1.2 must lie in 0..1"),
        ({"confidence": float("nan")}, "confidence nan must lie in 0..1"),
    ],
)
def test_a_wrong_joint_is_refused_in_one_line(change: dict[str, Any], said: str) -> None:
    with pytest.raises(BadInputError, match=said) as caught:
        replace(HINGE, **change)
    assert "\n" not in str(caught.value)
    assert str(caught.value).startswith(f"joint '{change.get('name', 'hinge')}'")


@pytest.mark.parametrize(
    ("kind", "moves", "turns"),
    [
        ("fixed", False, False),
        ("revolute", True, True),
        ("continuous", True, True),
        ("prismatic", True, False),
        ("ball", True, False),
        ("free", True, False),
    ],
)
def test_what_moves_and_what_turns(kind: Any, moves: bool, turns: bool) -> None:
    limits = sk.Limits(0.0, 1.0) if kind in ("revolute", "prismatic") else None
    joint = sk.Joint("j", kind, "a", "b", limits=limits)
    assert (joint.moves, joint.turns) == (moves, turns)


@pytest.mark.parametrize("name", ["Door", "2nd", "_x", "a b", "tür", "door\n", "a-b"])
def test_part_names_are_fit_for_every_format(name: str) -> None:
    with pytest.raises(BadInputError, match="must start with a letter"):
        sk.Part(name)


@pytest.mark.parametrize(
    ("make", "said"),
    [
        (lambda: replace(row(names="a"), name="No Name"), "asset: name 'No Name'"),
        (
            lambda: replace(row(names="a"), face_part=np.zeros(11, dtype=int)),
            r"shape \(11,\), expected \(12",
        ),
        (
            lambda: replace(row(names="a"), face_part=np.ones(12, dtype=int)),
            r"uses ids \[1\], expected each",
        ),
        (lambda: replace(row(names="a"), face_part=-np.arange(12) % 2 - 1), r"uses ids \[-1, 0\]"),
        (lambda: row(mount("a", "b"), names="aa"), "part name used twice: a"),
        (lambda: row(mount("a", "b"), replace(mount("a", "c"), name="a_b")), "joint name used twice: a_b"),
        (lambda: row(mount("a", "b"), mount("c", "b")), "joint child name used twice: b"),
        (lambda: row(mount("a", "b"), mount("a", "d")), "joint 'a_d' names part 'd': parts are a, b, c"),
        (lambda: row(mount("d", "b"), mount("a", "c")), "joint 'd_b' names part 'd'"),
        (lambda: row(mount("a", "b")), "needs one root part, found a, c"),
        (lambda: row(names="ab"), "needs one root part, found a, b"),
        (lambda: row(mount("a", "b"), mount("b", "a"), names="ab"), "found none .the joints form a loop"),
        (lambda: row(mount("b", "c"), mount("c", "b")), "the joints form a loop through part '[bc]'"),
        (lambda: row(mount("b", "b"), names="ab"), "the joints form a loop through part 'b'"),
    ],
)
def test_a_wrong_asset_is_refused(make: Callable[[], sk.Asset], said: str) -> None:
    with pytest.raises(BadInputError, match=said):
        make()


def test_joints_may_stand_in_any_order() -> None:
    assert row(mount("b", "c"), mount("a", "b")).root.name == "a"
    assert row(mount("b", "a"), mount("c", "b")).root.name == "c"


def test_pieces_by_name_and_the_names_that_exist() -> None:
    asset = cabinet_asset()
    assert asset.part("door") is asset.parts[1]
    assert asset.part_index("drawer") == 2
    assert asset.joint("door_hinge") is asset.joints[0]
    assert asset.joint_to("drawer") is asset.joints[1]
    assert asset.joint_to("body") is None
    with pytest.raises(BadInputError, match="no part 'flap': parts are body, door, drawer"):
        asset.part("flap")
    with pytest.raises(BadInputError, match="no joint 'flap': joints are door_hinge, drawer_slide"):
        asset.joint("flap")
    with pytest.raises(BadInputError, match="no joint 'flap': joints are none"):
        static_asset().joint("flap")


def test_copies_leave_the_original_alone() -> None:
    asset = chain_asset()
    heavy = sk.Part("post", material=sk.Material("steel", 7850.0))
    stiff = replace(asset.joint("arm_hinge"), damping=1.0)
    changed = asset.with_parts({"post": heavy}).with_joints({"arm_hinge": stiff})
    noted = changed.with_notes("mass", "warning", ["guessed", "doubtful"])
    assert [p.material.name for p in noted.parts] == ["wood", "steel", "wood"]
    assert [j.damping for j in noted.joints] == [1.0, 0.0]
    assert [(n.stage, n.level, n.text) for n in noted.notes] == [
        ("mass", "warning", "guessed"),
        ("mass", "warning", "doubtful"),
    ]
    assert asset.part("post").material.name == "wood"
    assert asset.joint("arm_hinge").damping == 0.0
    assert asset.notes == changed.notes == ()


def test_values_cannot_be_changed() -> None:
    labels = np.repeat([0, 1, 2], [60, 24, 24])
    asset = replace(cabinet_asset(), face_part=labels)
    labels[:] = 0
    assert asset.face_part.max() == 2
    for array in (asset.face_part, asset.asset_from_source, asset.parts[0].collision[0].vertices):
        with pytest.raises(ValueError, match="read-only"):
            array[0] = 1
    with pytest.raises(FrozenInstanceError):
        asset.name = "other"  # type: ignore[misc]


def test_posed_frames_by_name() -> None:
    posed = cabinet_asset().at({"drawer_slide": 0.2})
    np.testing.assert_allclose(posed["drawer"][:3, 3], (0.0, -0.4, 0.65))
    np.testing.assert_allclose(posed["body"], np.eye(4))


@pytest.mark.parametrize(
    ("text", "name"),
    [
        ("Left Door", "left_door"),
        ("  --Tür 2--", "tur_2"),
        ("2nd drawer", "part_2nd_drawer"),
        ("", "part"),
        ("???", "part"),
        ("World", "part_world"),
        ("door", "door"),
    ],
)
def test_names_are_cleaned(text: str, name: str) -> None:
    assert clean_name(text) == name


def test_another_fallback() -> None:
    assert clean_name("%", "asset") == "asset"
    assert clean_name("7", "asset") == "asset_7"


@given(st.text(max_size=12))
@settings(max_examples=60, deadline=None)
def test_any_text_gives_a_name(text: str) -> None:
    assert NAME_PATTERN.fullmatch(clean_name(text))
    assert clean_name(clean_name(text)) == clean_name(text)


def test_repeated_names_are_numbered() -> None:
    assert unique_names(["door", "door", "lid", "door"]) == ["door", "door_2", "lid", "door_3"]
    assert unique_names(["door", "door_2", "door"]) == ["door", "door_2", "door_3"]


@given(st.lists(st.sampled_from(["a", "a_2", "a_3", "b"]), max_size=8))
@settings(max_examples=60, deadline=None)
def test_numbered_names_are_unique_and_first_uses_stay(names: list[str]) -> None:
    result = unique_names(names)
    assert len(set(result)) == len(names)
    assert all(new.startswith(old) for old, new in zip(names, result, strict=True))
    assert not names or result[0] == names[0]
