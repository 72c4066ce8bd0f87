"""Readers of SIMART-Bench truths, and of the output of conversions."""

from __future__ import annotations

import json
import math
import shutil
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import trimesh

import simart_kit as sk
from simart_kit.asset import Asset, Joint, Limits, Part
from simart_kit.asset_io import save_asset
from simart_kit.bench.articulation import Link, LinkJoint
from simart_kit.bench.formats.output_folder import OutputFolder
from simart_kit.bench.formats.simart_bench import SimartBench, without_hidden
from simart_kit.bench.importing import write_case
from simart_kit.errors import BadInputError
from simart_kit.mesh import Mesh

from .bench_objects import BODY, DRAWER, cabinet, fan, of_boxes, truth
from .real_objects import DATA, EXAMPLE, needs_data

CABINET = truth(cabinet(), "cabinet")


@pytest.fixture
def case(tmp_path: Path) -> Path:
    """The cabinet as a SIMART-Bench folder."""
    write_case(CABINET, tmp_path / "data" / "cabinet")
    return tmp_path / "data" / "cabinet"


def edit(path: Path, change: Callable[[dict[str, Any]], object]) -> None:
    """Change a JSON file in place."""
    table = json.loads(path.read_text())
    change(table)
    path.write_text(json.dumps(table))


# --- finding truths ---------------------------------------------------------------------------------------


def test_objects_are_found_at_any_depth_and_by_the_path_itself(case: Path) -> None:
    root = case.parent
    shutil.copytree(case, root / "kitchen" / "fridge")
    reader = SimartBench()
    assert reader.find(root) == {"cabinet": case, "fridge": root / "kitchen" / "fridge"}
    assert reader.find(case) == {"cabinet": case}
    assert reader.find(case / "gt.json") == {"cabinet": case}


def test_objects_of_one_name_are_told_apart_by_their_folders(case: Path) -> None:
    root = case.parent
    shutil.copytree(case, root / "b" / "cabinet")
    shutil.copytree(case, root / "c" / "cabinet")
    (root / ".draft").mkdir()
    shutil.copytree(case, root / ".draft" / "hidden")
    found = SimartBench().find(root)
    assert found == {
        "b_cabinet": root / "b" / "cabinet",
        "c_cabinet": root / "c" / "cabinet",
        "cabinet": case,
    }


def test_linked_objects_are_found_and_a_link_to_above_ends(case: Path) -> None:
    links = case.parent.parent / "links"
    links.mkdir()
    (links / "mine").symlink_to(case, target_is_directory=True)
    (links / "up").symlink_to(links, target_is_directory=True)
    assert SimartBench().find(links) == {"mine": links / "mine"}


def test_the_shipped_example_is_an_object_of_files_side_by_side() -> None:
    found = SimartBench().find(EXAMPLE.parent)
    assert list(found) == ["cabinet"] == list(SimartBench().find(EXAMPLE))
    read = SimartBench().read(found["cabinet"])
    mesh = trimesh.load(EXAMPLE, process=False, force="mesh")
    with np.load(EXAMPLE.with_suffix(".gt.npz")) as stored:
        np.testing.assert_array_equal(read.articulation.labels, stored["face_part"])  # ids are 0..4 in order
    np.testing.assert_array_equal(read.articulation.triangles, mesh.triangles)
    assert read.mesh == EXAMPLE
    with pytest.raises(BadInputError, match=r"no mesh 'fused': its variants are input"):
        SimartBench().read(found["cabinet"], "fused")


def test_a_folder_without_objects_has_none(tmp_path: Path) -> None:
    (tmp_path / "x.glb").write_bytes(b"")
    assert SimartBench().find(tmp_path) == {}
    assert SimartBench().find(tmp_path / "x.glb") == {}


# --- reading truths ---------------------------------------------------------------------------------------


def test_ids_need_not_count_from_0_and_axes_need_no_length(case: Path) -> None:
    def change(table: dict[str, Any]) -> None:
        for part in table["parts"]:
            part["id"] = part["id"] * 10 + 7
            part["parent"] = 7 if part["parent"] == 0 else -1
        table["parts"][DRAWER]["joint"]["axis"] = [0, 0, 5]
        table["frame"]["up"] = "+Z"

    edit(case / "gt.json", change)
    labels = CABINET.articulation.labels * 10 + 7
    np.savez(case / "gt.npz", face_part=np.where(labels == 7, -1, labels))
    read = SimartBench().read(case)
    expected = np.where(CABINET.articulation.labels == BODY, -1, CABINET.articulation.labels)
    np.testing.assert_array_equal(read.articulation.labels, expected)
    assert [link.parent for link in read.articulation.links] == [-1, 0, 0, 0]
    assert read.articulation.links[DRAWER].joint.axis == (0.0, 0.0, 1.0)
    assert read.up == "+z"


def test_a_variant_has_its_own_labels_or_those_of_the_input(case: Path) -> None:
    shutil.copy(case / "input.glb", case / "input_tex.glb")
    whole = CABINET.articulation
    half = trimesh.Trimesh(whole.vertices, whole.faces[:24], process=False)  # body and left door
    half.export(case / "fused.glb")
    np.savez(case / "fused.npz", face_part=whole.labels[:24])
    assert len(SimartBench().read(case, "input_tex").articulation.faces) == 48
    fused = SimartBench().read(case, "fused")
    assert [link.name for link in fused.articulation.links] == ["body", "door_left"]
    assert len(fused.notes) == 2
    assert "'drawer' has no face in fused.glb" in fused.notes[1]
    with pytest.raises(BadInputError, match="no mesh 'other': its variants are fused, input, input_tex"):
        SimartBench().read(case, "other")


def test_a_file_of_another_format_serves_as_the_mesh(case: Path) -> None:
    (case / "input.glb").unlink()
    trimesh.Trimesh(CABINET.articulation.vertices, CABINET.articulation.faces, process=False).export(
        case / "input.ply"
    )
    read = SimartBench().read(case)
    assert read.mesh == case / "input.ply"
    np.testing.assert_allclose(read.articulation.triangles, CABINET.articulation.triangles, atol=1e-6)


def test_what_a_hidden_part_carries_hangs_on_its_parent() -> None:
    whole = fan()
    labels = np.where(whole.labels == 1, -1, whole.labels)  # the blade, which carries the weight
    seen, hidden = without_hidden(replace(whole, labels=labels))
    assert hidden == ("blade",)
    assert [(link.name, link.parent) for link in seen.links] == [("post", -1), ("weight", 0)]
    assert np.bincount(seen.labels + 1).tolist() == [12, 12, 12]  # none, post, weight


def test_a_part_that_only_shows_by_its_handle_is_not_hidden() -> None:
    door = LinkJoint("revolute", (0, 1, 0), (0, 0, 0), 0.0, 1.0)
    links = (Link("body"), Link("frame", 0, door), Link("handle", 1))
    boxed = of_boxes("x", [(link, (0, 0, i), (1, 1, i + 1)) for i, link in enumerate(links)])
    handle_only = replace(boxed, labels=np.where(boxed.labels == 1, 0, boxed.labels))
    assert without_hidden(handle_only) == (handle_only, ())
    none = replace(boxed, labels=np.zeros(36, dtype=int))
    assert [link.name for link in without_hidden(none)[0].links] == ["body"]


@needs_data
def test_real_objects_are_read_in_every_variant() -> None:
    found = SimartBench().find(DATA)
    assert "bigym_dishwasher" in found
    assert "polyhaven" not in found
    path = found["bigym_dishwasher"]
    # Counted in gt.json, `faces` and `fused_faces`: the two trays and the sprinkler are hidden in the skin.
    assert [len(SimartBench().read(path, v).articulation.faces) for v in ("input", "fused")] == [
        28188,
        129552,
    ]
    assert len(SimartBench().read(path).articulation.moving) == 4
    assert len(SimartBench().read(path, "fused").notes) == 3


FAULTS: dict[str, tuple[Callable[[dict[str, Any]], object], str]] = {
    "reversed": (
        lambda t: t["parts"][DRAWER]["joint"].update(lower=0.4),
        r"part 'drawer'.*lower limit 0.4 is above",
    ),
    "no axis": (lambda t: t["parts"][1]["joint"].pop("axis"), r"part 'door_left'.*needs an axis"),
    "NaN": (lambda t: t["parts"][1]["joint"].update(axis=[0, math.nan, 0]), r"part 'door_left'\.joint\.axis"),
    "zero axis": (
        lambda t: t["parts"][1]["joint"].update(axis=[0, 0, 0]),
        r"part 'door_left'.*needs a length",
    ),
    "kind": (lambda t: t["parts"][2]["joint"].update(type="wobbly"), r"part 'door_right'\.joint\.type"),
    "unsaid": (lambda t: t["parts"][2]["joint"].update(type="unknown"), r"part 'door_right'.*how it moves"),
    "one limit": (lambda t: t["parts"][3]["joint"].pop("upper"), r"part 'drawer'.*limits is missing"),
    "parent": (lambda t: t["parts"][3].update(parent=9), r"part 'drawer'.*no parent with id 9"),
    "loop": (lambda t: (t["parts"][1].update(parent=2), t["parts"][2].update(parent=1)), "form a loop"),
    "twice": (lambda t: t["parts"][3].update(id=2), "part id 2 is used twice"),
    "no parts": (lambda t: t.update(parts=[]), "parts"),
    "up": (lambda t: t["frame"].update(up="skyward"), r"frame\.up"),
    "nameless": (lambda t: t["parts"][1].pop("name"), r"part 1\.name: Field required"),
}


@pytest.mark.parametrize("fault", FAULTS)
def test_a_wrong_table_is_told_with_file_and_part(case: Path, fault: str) -> None:
    change, told = FAULTS[fault]
    edit(case / "gt.json", change)
    with pytest.raises(BadInputError, match=told) as error:
        SimartBench().read(case)
    assert str(case / "gt.json") in str(error.value)


def test_labels_that_do_not_fit_are_told_with_both_numbers(case: Path) -> None:
    np.savez(case / "gt.npz", face_part=np.zeros(47, dtype=int))
    with pytest.raises(BadInputError, match=r"gt.npz labels 47 faces, but input.glb has 48"):
        SimartBench().read(case)
    np.savez(case / "gt.npz", face_part=np.full(48, 4))
    with pytest.raises(BadInputError, match=r"gt.npz: labels 4 are no part's id: ids are \[0, 1, 2, 3\]"):
        SimartBench().read(case)
    np.savez(case / "gt.npz", other=np.zeros(48))
    with pytest.raises(BadInputError, match=r"gt.npz: it has no array 'face_part', but 'other'"):
        SimartBench().read(case)


@pytest.mark.parametrize("name", ["gt.json", "gt.npz"])
def test_a_missing_file_is_named(case: Path, name: str) -> None:
    (case / name).unlink()
    with pytest.raises(BadInputError, match=f"no such file: .*{name}"):
        SimartBench().read(case)


# --- this program's own output ----------------------------------------------------------------------------


def small_asset() -> Asset:
    """A flap on a base, of two triangles; the source was in millimetres, +Y up, and stood 100 to the left."""
    mesh = Mesh([[0, 0, 0], [1, 0, 0], [0, 0, 1], [0, -1, 0]], [[0, 1, 2], [0, 3, 1]])
    # (x, y, z) mm -> (x + 100, -z, y) / 1000 m
    asset_from_source = np.array([[1e-3, 0, 0, 0.1], [0, 0, -1e-3, 0], [0, 1e-3, 0, 0], [0, 0, 0, 1]])
    slide = Joint("slide", "prismatic", "base", "flap", (0.0, -1.0, 0.0), (0, -1, 0), Limits(0.0, 0.25))
    parts = (Part("base"), Part("flap", "flap"))
    return Asset(
        "my_flap", mesh, np.array([0, 1]), parts, (replace(slide, confidence=0.5),), asset_from_source
    )


@pytest.mark.parametrize("place", ["flap", "flap/output", "objects/flap/output"])
def test_output_is_found_where_runs_and_people_put_it(tmp_path: Path, place: str) -> None:
    save_asset(small_asset(), tmp_path / place)
    assert OutputFolder().find(tmp_path, "flap") == tmp_path / place
    assert OutputFolder().find(tmp_path, "other") is None


def test_a_folder_that_is_the_output_serves_its_own_object_only(tmp_path: Path) -> None:
    save_asset(small_asset(), tmp_path)
    assert OutputFolder().find(tmp_path, "My Flap") == tmp_path
    assert OutputFolder().find(tmp_path, "flap") is None


def test_output_is_read_in_the_frame_and_unit_of_the_source(tmp_path: Path) -> None:
    save_asset(small_asset(), tmp_path)
    (tmp_path / "urdf").mkdir()
    (tmp_path / "urdf" / "a.urdf").write_text("")
    read = OutputFolder().read(tmp_path, CABINET)
    # The way back: (x, y, z) m -> (1000 x - 100, 1000 z, -1000 y) mm.
    expected = [[-100, 0, 0], [900, 0, 0], [-100, 1000, 0], [-100, 0, 1000]]
    np.testing.assert_allclose(read.articulation.vertices, expected, atol=1e-9)
    flap = read.articulation.links[1]
    assert (flap.parent, flap.label, flap.confidence) == (0, "flap", 0.5)
    assert flap.joint.axis == pytest.approx((0, 0, 1))
    assert flap.joint.origin == pytest.approx((-100, 0, 1000))
    assert (flap.joint.lower, flap.joint.upper) == pytest.approx((0, 250))
    assert read.simulator_file == tmp_path / "urdf" / "a.urdf"
    (tmp_path / "mjcf").mkdir()
    (tmp_path / "mjcf" / "a.xml").write_text("")
    assert OutputFolder().read(tmp_path, CABINET).simulator_file == tmp_path / "mjcf" / "a.xml"


def test_output_in_a_frame_without_a_way_back_is_refused(tmp_path: Path) -> None:
    save_asset(small_asset(), tmp_path)
    for rows in (np.zeros((4, 4)), np.diag([1.0, 2.0, 1.0, 1.0]), np.diag([-1.0, 1.0, 1.0, 1.0])):
        edit(tmp_path / "asset.json", lambda t, rows=rows: t.update(asset_from_source=rows.tolist()))
        with pytest.raises(BadInputError, match=r"asset.json: asset_from_source is more than a rotation"):
            OutputFolder().read(tmp_path, CABINET)


def test_a_conversion_read_back_lies_on_its_source(case: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("simart_kit.render.write_preview", lambda asset, path: path)
    out = case.parent / "cabinet_out"
    sk.convert(case / "input.glb", out=out)
    read = OutputFolder().read(out, CABINET)
    np.testing.assert_allclose(read.articulation.triangles, CABINET.articulation.triangles, atol=1e-6)
