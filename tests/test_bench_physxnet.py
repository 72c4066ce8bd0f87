"""PhysXNet objects as truth: groups become links, and every type of motion its joint."""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from simart_kit.bench.articulation import Link, LinkJoint
from simart_kit.bench.formats.physxnet import PhysXNet
from simart_kit.errors import BadInputError

from .bench_objects import box

HINGE = [0, 1, 0, -0.5, 0, 0.25, 0, 0.5]  # about +Y through (-0.5, 0, 0.25), to 0.5 pi
# Of a bottle, glass and label stand, a lid swings on the glass, and a cap on the lid turns and slides.
GROUPS: dict[str, Any] = {
    "0": [0, 1],
    "1": [[2], "0", HINGE, "C"],
    "2": [[3, 4], "1", [0, 1, 0, 0.1, 0, 0.2, -1, 1, 0, 1, 0, 0.1, 0, 0.2, 0, 0.05], "CB"],
}
NAMES = ["glass", "label", "lid", "cap", "seal"]


def table(groups: dict[str, Any], **changed: Any) -> dict[str, Any]:
    """The JSON of a bottle; entries can be replaced, or left out with None."""
    parts = [
        {"label": label, "name": name, "material": "Glass", "density": "2.5 g/cm^3", "priority_rank": 1}
        for label, name in enumerate(NAMES)
    ]
    whole = {
        "object_name": "Bottle",
        "category": "Bottle",
        "dimension": "8*20*4",
        "parts": parts,
        "group_info": groups,
    } | changed
    return {name: value for name, value in whole.items() if value is not None}


def write_object(root: Path, groups: dict[str, Any] = GROUPS, name: str = "77", **changed: Any) -> Path:
    """An object of five boxes on top of each other, 0.2 high each: box -0.5..0.5 in y; returns its JSON."""
    path = root / "finaljson" / f"{name}.json"
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(json.dumps(table(groups, **changed)))
    folder = root / "partseg" / name / "objs"
    folder.mkdir(parents=True)
    for label in range(5):
        corners, faces = box((-0.2, 0.2 * label - 0.5, -0.1), (0.2, 0.2 * label - 0.3, 0.1))
        text = [f"v {x!r} {y!r} {z!r}" for x, y, z in corners.tolist()]
        text += [f"f {a + 1} {b + 1} {c + 1}" for a, b, c in faces.tolist()]
        (folder / f"{label}.obj").write_text("\n".join(text))
    return path


def read_group(root: Path, numbers: object, letters: str) -> Link:
    """The link of a lid that moves so."""
    groups = {"0": [0, 1, 3, 4], "1": [[2], "0", numbers, letters]}
    return PhysXNet().read(write_object(root, groups)).articulation.links[1]


def test_objects_are_found_by_their_ids(tmp_path: Path) -> None:
    paths = {name: write_object(tmp_path, name=name) for name in ("9", "10")}
    reader = PhysXNet()
    assert list(reader.find(tmp_path).items()) == [("10", paths["10"]), ("9", paths["9"])]
    assert reader.find(paths["9"]) == {"9": paths["9"]}
    assert reader.find(tmp_path / "partseg") == {}
    (tmp_path / "other.json").write_text("{}")
    assert reader.find(tmp_path / "other.json") == {}


def test_groups_become_links(tmp_path: Path) -> None:
    truth = PhysXNet().read(write_object(tmp_path))
    found = truth.articulation
    assert (truth.name, truth.category, truth.up, truth.notes) == ("77", "Bottle", "+y", ())
    assert [link.name for link in found.links] == ["glass", "lid", "cap"]
    assert [link.parent for link in found.links] == [-1, 0, 1]
    # 12 faces a part: glass and label, lid, cap and seal.
    assert np.bincount(found.labels).tolist() == [24, 12, 24]
    np.testing.assert_allclose(found.bounds, [[-0.2, -0.5, -0.1], [0.2, 0.5, 0.1]])
    heights = [found.triangles[found.labels == link][..., 1].mean() for link in range(3)]
    assert heights == pytest.approx([-0.3, 0.0, 0.3])  # of boxes 0 and 1, 2, 3 and 4


def test_the_size_comes_from_the_longest_side(tmp_path: Path) -> None:
    # 20 cm over a longest side of 1.
    assert PhysXNet().read(write_object(tmp_path)).metres_per_unit == pytest.approx(0.2)


@pytest.mark.parametrize("dimension", [None, "large", "8*20", "8*-20*4", "nan*1*1", 12])
def test_without_a_size_there_is_a_note(tmp_path: Path, dimension: object) -> None:
    truth = PhysXNet().read(write_object(tmp_path, dimension=dimension))
    assert truth.metres_per_unit is None
    assert any("no size" in note for note in truth.notes)


@pytest.mark.parametrize(
    ("letters", "numbers", "expected"),
    [
        ("A", [], LinkJoint("free", name="group 1")),
        ("E", [], LinkJoint("fixed", name="group 1")),
        ("B", [0, 0, 2, 1, 2, 3, 0, 0.3], LinkJoint("prismatic", (0, 0, 1), (1, 2, 3), 0, 0.3, "group 1")),
        ("C", HINGE, LinkJoint("revolute", (0, 1, 0), (-0.5, 0, 0.25), 0, math.pi / 2, "group 1")),
        (
            "C",
            [[0, 1, 0], [-0.5, 0, 0.25], [0.25, 0.5]],  # nested, and rest lies outside
            LinkJoint("revolute", (0, 1, 0), (-0.5, 0, 0.25), math.pi / 4, math.pi / 2, "group 1"),
        ),
        ("D", HINGE, LinkJoint("ball", origin=(-0.5, 0, 0.25), name="group 1")),
    ],
)
def test_each_type_is_its_joint(tmp_path: Path, letters: str, numbers: object, expected: LinkJoint) -> None:
    link = read_group(tmp_path, numbers, letters)
    assert link.joint == expected
    assert link.also == ()


def test_a_group_that_needs_no_numbers_may_have_none(tmp_path: Path) -> None:
    groups = {"0": [0, 1, 3], "1": [[2], "0", "A"], "2": [[4], "1", "E"]}
    found = PhysXNet().read(write_object(tmp_path, groups)).articulation
    assert [link.joint.kind for link in found.links] == ["fixed", "free", "fixed"]


@pytest.mark.parametrize("point", [[0.1, 0, 0.2], []])
def test_what_turns_and_slides_is_right_as_either(tmp_path: Path, point: list[float]) -> None:
    link = read_group(tmp_path, [0, 1, 0, 0.1, 0, 0.2, -1, 1, 0, 0, 1, *point, 0, 0.05], "CB")
    assert link.joint == LinkJoint("continuous", (0, 1, 0), (0.1, 0, 0.2), -math.pi, math.pi, "group 1")
    # A slide without a point of its own has that of the turn.
    assert link.also == (LinkJoint("prismatic", (0, 0, 1), (0.1, 0, 0.2), 0, 0.05, "group 1"),)


def test_links_are_in_the_order_of_numbers(tmp_path: Path) -> None:
    groups = {"10": [[3], "2", HINGE, "C"], "0": [0, 1, 4], "2": [[2], "0", HINGE, "C"]}
    found = PhysXNet().read(write_object(tmp_path, groups)).articulation
    assert [link.name for link in found.links] == ["glass", "lid", "cap"]
    assert [link.parent for link in found.links] == [-1, 0, 1]


def test_parts_of_no_group_join_the_base(tmp_path: Path) -> None:
    truth = PhysXNet().read(write_object(tmp_path, {"0": [0], "1": [[2], "0", HINGE, "C"]}))
    assert np.bincount(truth.articulation.labels).tolist() == [48, 12]
    assert truth.notes == ("parts in no group, taken for part of the base: 1, 3, 4",)


def test_a_static_object_and_an_empty_base_are_read(tmp_path: Path) -> None:
    assert PhysXNet().read(write_object(tmp_path, {"0": [0, 1, 2, 3, 4]}, "1")).articulation.is_static
    moving = {"0": [], "1": [[0, 1, 2, 3, 4], "0", HINGE, "C"]}
    found = PhysXNet().read(write_object(tmp_path, moving, "2")).articulation
    assert [link.name for link in found.links] == ["base", "glass"]
    assert set(found.labels.tolist()) == {1}


@pytest.mark.parametrize(
    ("groups", "told"),
    [
        ({}, "group_info"),
        ({"1": [[0], "0", HINGE, "C"]}, "no list '0'"),
        (GROUPS | {"x": [[0], "0", HINGE, "C"]}, "no numbers: 1, 2, x"),
        (GROUPS | {"1": [[2], "0", HINGE, "F"]}, "type 'F': types are A, B, C, D, CB, E"),
        (GROUPS | {"1": [[2], "0"]}, "group 1 is not"),
        (GROUPS | {"1": [[2], "0", "C"]}, " 0 numbers"),
        (GROUPS | {"1": [[], "0", HINGE, "C"]}, "group 1 has no parts"),
        (GROUPS | {"1": [[2], "7", HINGE, "C"]}, "parent '7': groups are 0, 1, 2"),
        (GROUPS | {"1": [[2], "", HINGE, "C"]}, "parent ''"),
        (GROUPS | {"1": [[2], "2", HINGE, "C"]}, "loop"),
        (GROUPS | {"1": [[0], "0", HINGE, "C"]}, "part 0 is in two groups"),
        (GROUPS | {"1": [["lid"], "0", HINGE, "C"]}, "'lid' is no label"),
        (GROUPS | {"1": [2, "0", HINGE, "C"]}, "2 is no list of part labels"),
        (GROUPS | {"1": [[2], "0", HINGE[:7], "C"]}, "7 numbers"),
        (GROUPS | {"1": [[2], "0", HINGE, "CB"]}, "8 numbers"),
        (GROUPS | {"1": [[2], "0", [*HINGE[:6], 0.5, 0], "C"]}, "runs from 0.5 to 0"),
        (GROUPS | {"1": [[2], "0", [0, 0, 0, *HINGE[3:]], "C"]}, "axis"),
        (GROUPS | {"1": [[2], "0", [float("nan"), *HINGE[1:]], "C"]}, "nan is no finite number"),
        (GROUPS | {"1": [[2], "0", ["up", *HINGE[1:]], "C"]}, "'up' is no finite number"),
        (GROUPS | {"1": [[2], "0", None, "C"]}, "None is no finite number"),
        (GROUPS | {"1": [[2], "0", HINGE, ["C"]]}, "types are A"),
        (GROUPS | {"0": [0, 1, 9]}, r"objs/9\.obj"),
    ],
)
def test_a_damaged_object_is_refused_in_one_line(tmp_path: Path, groups: dict[str, Any], told: str) -> None:
    path = write_object(tmp_path, groups)
    with pytest.raises(BadInputError, match=told) as error:
        PhysXNet().read(path)
    assert "77" in str(error.value)
    assert "\n" not in str(error.value)


@pytest.mark.parametrize("text", ["", "{", "[1]", '{"parts": [1], "group_info": {"0": [0]}}', "[" * 10_000])
def test_a_damaged_table_is_refused(tmp_path: Path, text: str) -> None:
    path = write_object(tmp_path)
    path.write_text(text)
    with pytest.raises(BadInputError, match=r"77\.json"):
        PhysXNet().read(path)


def test_missing_or_damaged_meshes_and_unknown_variants_are_refused(tmp_path: Path) -> None:
    path = write_object(tmp_path)
    mesh = tmp_path / "partseg" / "77" / "objs" / "2.obj"
    mesh.write_text("v 0 0 0\nf 1 2 3\n")
    with pytest.raises(BadInputError, match=r"2\.obj"):
        PhysXNet().read(path)
    mesh.unlink()
    with pytest.raises(BadInputError, match=r"2\.obj"):
        PhysXNet().read(path)
    with pytest.raises(BadInputError, match="no variant 'fused'"):
        PhysXNet().read(path, "fused")
