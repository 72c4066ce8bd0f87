"""PartNet-Mobility: a bottle with a lid that slides and turns, and a cabinet, in its layout."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

from simart_kit.bench.formats.partnet_mobility import PartNetMobility
from simart_kit.bench.formats.urdf import UrdfTruth
from simart_kit.errors import BadInputError

from .bench_objects import box

TURN = 'rpy="1.570796326794897 0 -1.570796326794897"'


def write_box(path: Path, lower: tuple[float, float, float], upper: tuple[float, float, float]) -> None:
    vertices, faces = box(lower, upper)
    lines = [f"v {x} {y} {z}" for x, y, z in vertices] + [f"f {a} {b} {c}" for a, b, c in faces + 1]
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text("mtllib a.mtl\n" + "\n".join(lines) + "\n")


def visual(file: str, origin: str) -> str:
    mesh = f'<geometry><mesh filename="textured_objs/{file}"/></geometry>'
    return f'<visual name="x-1"><origin xyz="{origin}"/>{mesh}</visual>'


def joint(number: int, kind: str, parent: str, child: str, inner: str) -> str:
    ends = f'<child link="{child}"/><parent link="{parent}"/>'
    return f'<joint name="joint_{number}" type="{kind}">{inner}{ends}</joint>'


def entry(number: int, parent: int, word: str, name: str) -> dict[str, object]:
    parts = [{"id": number + 5, "name": name, "children": []}]
    return {"id": number, "parent": parent, "joint": word, "name": name, "parts": parts, "jointData": {}}


def write_object(folder: Path, category: str, entries: list[dict[str, object]], links: str) -> Path:
    (folder / "mobility_v2.json").write_text(json.dumps(entries))
    (folder / "mobility.urdf").write_text(f'<robot name="partnet_x"><link name="base"/>{links}</robot>')
    (folder / "meta.json").write_text(json.dumps({"model_id": "x", "model_cat": category}))
    return folder


def cabinet(folder: Path) -> Path:
    """A body (y up, front +z) with a door whose hinge stands at x = 0.4, z = 0.3."""
    write_box(folder / "textured_objs" / "original-1.obj", (-0.5, 0.0, -0.3), (0.5, 1.0, 0.2))
    write_box(folder / "textured_objs" / "original-2.obj", (-0.4, 0.1, 0.2), (0.4, 0.9, 0.3))
    links = (
        f'<link name="link_0">{visual("original-2.obj", "-0.4 0 -0.3")}</link>'
        + joint(
            0,
            "revolute",
            "link_1",
            "link_0",
            '<origin xyz="0.4 0 0.3"/><axis xyz="0 -1 0"/><limit lower="0" upper="1.5"/>',
        )
        + f'<link name="link_1">{visual("original-1.obj", "0 0 0")}</link>'
        + joint(1, "fixed", "base", "link_1", f'<origin {TURN} xyz="0 0 0"/>')
    )
    entries = [entry(0, 1, "hinge", "door"), entry(1, -1, "heavy", "cabinet_body")]
    return write_object(folder, "StorageFurniture", entries, links)


def bottle(folder: Path) -> Path:
    write_box(folder / "textured_objs" / "original-2.obj", (-0.1, 0.8, -0.1), (0.1, 1.0, 0.1))
    write_box(folder / "textured_objs" / "original-3.obj", (-0.2, 0.0, -0.2), (0.2, 0.8, 0.2))
    links = (
        f'<link name="link_0">{visual("original-2.obj", "0 0 0")}</link>'
        + joint(0, "continuous", "link_0_helper", "link_0", '<origin xyz="0 0 0"/><axis xyz="0 1 0"/>')
        + f'<link name="link_1">{visual("original-3.obj", "0 0 0")}</link>'
        + joint(1, "fixed", "base", "link_1", f'<origin {TURN} xyz="0 0 0"/>')
        + '<link name="link_0_helper"/>'
        + joint(
            2, "prismatic", "link_1", "link_0_helper", '<axis xyz="0 1 0"/><limit lower="0" upper="0.2"/>'
        )
    )
    return write_object(folder, "Bottle", [entry(0, 1, "slider", "lid"), entry(1, -1, "free", "body")], links)


def test_a_cabinet_is_read_upright_with_its_names(tmp_path: Path) -> None:
    truth = PartNetMobility().read(cabinet(tmp_path / "45001"))
    assert (truth.name, truth.category, truth.up, truth.metres_per_unit) == (
        "45001",
        "StorageFurniture",
        "+z",
        None,
    )
    found = truth.articulation
    assert [(k.name, k.label, k.parent) for k in found.links] == [
        ("base", "", -1),
        ("link_0", "door", 2),
        ("link_1", "cabinet_body", 0),
    ]
    # The turn takes (x, y, z) to (x, -z, y) by the roll, and that to (-z, -x, y) by the yaw.
    door = found.links[1].joint
    assert (door.kind, door.lower, door.upper) == ("revolute", 0.0, 1.5)
    np.testing.assert_allclose(door.axis, (0, 0, -1), atol=1e-12)
    np.testing.assert_allclose(door.origin, (-0.3, -0.4, 0.0), atol=1e-12)
    # All of it: x -0.5..0.5, y 0..1, z -0.3..0.3 before the turn.
    np.testing.assert_allclose(found.bounds, [(-0.3, -0.5, 0), (0.3, 0.5, 1)], atol=1e-12)
    corners = found.triangles[found.labels == 1].reshape(-1, 3)
    np.testing.assert_allclose(corners.min(axis=0), (-0.3, -0.4, 0.1), atol=1e-12)
    np.testing.assert_allclose(corners.max(axis=0), (-0.2, 0.4, 0.9), atol=1e-12)
    rigid = found.rigid()
    assert [(k.name, k.parent) for k in rigid.links] == [("base", -1), ("link_0", 0)]
    assert len(rigid.moving) == 1


def test_a_lid_that_slides_and_turns_is_one_part(tmp_path: Path) -> None:
    found = PartNetMobility().read(bottle(tmp_path / "3763")).articulation
    (moving,) = found.moving
    lid = found.links[moving]
    assert (lid.name, lid.label, found.links[lid.parent].name) == ("link_0", "lid", "link_1")
    assert (lid.joint.kind, lid.joint.upper) == ("prismatic", 0.2)
    assert [j.kind for j in lid.also] == ["continuous"]
    np.testing.assert_allclose([lid.joint.axis, lid.also[0].axis], [(0, 0, 1)] * 2, atol=1e-12)


def test_folders_are_found_by_their_numbers_and_only_by_this_reader(tmp_path: Path) -> None:
    expected = {
        "45001": cabinet(tmp_path / "data" / "45001"),
        "3763": bottle(tmp_path / "data" / "Bottle" / "3763"),
    }
    assert PartNetMobility().find(tmp_path) == expected
    assert PartNetMobility().find(expected["3763"]) == {"3763": expected["3763"]}
    assert PartNetMobility().find(tmp_path / "data" / "45001" / "meta.json") == {}
    assert UrdfTruth().find(tmp_path) == {}


def test_the_category_may_be_missing(tmp_path: Path) -> None:
    folder = cabinet(tmp_path / "1")
    (folder / "meta.json").unlink()
    assert PartNetMobility().read(folder).category == ""


@pytest.mark.parametrize(
    ("file", "text", "words"),
    [
        ("mobility.urdf", None, "has no mobility.urdf, which holds the shapes"),
        ("mobility.urdf", "<robot><li", "no well-formed XML"),
        ("mobility_v2.json", '[{"id": 0', "no JSON"),
        ("mobility_v2.json", "{}", "should be a list of links"),
        ("mobility_v2.json", '[{"id": "0"}]', "each with an id"),
        ("mobility_v2.json", '[{"id": 0, "name": 3}]', "link 0 has no name"),
        ("meta.json", "[]", "model_cat"),
        ("meta.json", "\x00", "no JSON"),
        ("textured_objs/original-2.obj", None, "no such mesh file"),
        ("textured_objs/original-2.obj", "v 0 0", "fewer than three numbers"),
    ],
)
def test_a_damaged_object_is_named_with_what_is_wrong(
    file: str, text: str | None, words: str, tmp_path: Path
) -> None:
    folder = cabinet(tmp_path / "45001")
    (folder / file).unlink()
    if text is not None:
        (folder / file).write_text(text)
    with pytest.raises(BadInputError, match="45001") as caught:
        PartNetMobility().read(folder)
    assert words in str(caught.value)
    assert "\n" not in str(caught.value)


def test_there_is_one_variant(tmp_path: Path) -> None:
    with pytest.raises(BadInputError, match="no variant"):
        PartNetMobility().read(cabinet(tmp_path / "1"), "fused")
