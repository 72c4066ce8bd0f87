"""Parts and joints in the files of other systems, written in their formats, come back on the mesh."""

from __future__ import annotations

import json
import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import trimesh
from simart_kit_plugins.adapters import AnymeshFiles, ParticulateFiles, TruthFiles

from simart_kit.arrays import FloatArray
from simart_kit.assemble import checked
from simart_kit.asset import Joint, Limits
from simart_kit.bench.articulation import Articulation, Link, LinkJoint
from simart_kit.bench.cases import Truth
from simart_kit.bench.importing import write_case
from simart_kit.errors import BadInputError
from simart_kit.loading import read_source
from simart_kit.mesh import Mesh, UpAxis, canonical, z_up_from
from simart_kit.plugins import Plugins
from simart_kit.stages import Segmentation, Segmenter

from .bench_objects import AREAS, cabinet
from .bench_predictions import write_anymesh, write_particulate, write_urdf
from .real_objects import DATA, needs_data

NAMES = ["body", "door_left", "door_right", "drawer"]
Write = Callable[[Path, str, Articulation], None]


def source(up: UpAxis = "+y", metres: float = 1.0) -> tuple[Mesh, Articulation]:
    """The cabinet as a run has it, and as its file with this up axis says."""
    turn = np.eye(4)
    turn[:3, :3] = z_up_from(up).T @ z_up_from("+y")
    file = cabinet().transformed(turn)
    mesh, _ = canonical(Mesh(file.vertices, file.faces, up=up, metres_per_unit=metres))
    return mesh, file


def read(stage: type[Segmenter], file: Path, mesh: Mesh, **options: Any) -> Segmentation:
    found = stage(stage.Options(file=str(file), **options)).segment(mesh)
    return checked(found, mesh)


def assert_is_the_cabinet(found: Segmentation, scale: float = 1.0, names: list[str] | None = None) -> None:
    """Labels, and joints by hand: (x, y, z) with +Y up is (x, 0.01 - z, y), for the box is centred."""
    assert [part.name for part in found.parts] == (names or NAMES)
    np.testing.assert_array_equal(found.face_part, np.repeat([0, 1, 2, 3], 12))
    left, right, slide = joints_by_child(found, names or NAMES)
    for joint, x in ((left, -0.5), (right, 0.5)):
        assert joint.kind == "revolute"
        np.testing.assert_allclose(joint.axis, (0, 0, 1), atol=1e-6)
        np.testing.assert_allclose(np.array(joint.origin)[:2], scale * np.array([x, -0.24]), atol=1e-5)
    assert slide.kind == "prismatic"
    np.testing.assert_allclose(slide.axis, (0, -1, 0), atol=1e-6)


def assert_limits(found: Segmentation, scale: float = 1.0, names: list[str] | None = None) -> None:
    limits = [joint.limits for joint in joints_by_child(found, names or NAMES)]
    expected = [(-math.pi / 2, 0), (0, math.pi / 2), (0, 0.3 * scale)]
    for one, (lower, upper) in zip(limits, expected, strict=True):
        assert one is not None
        assert (one.lower, one.upper) == (pytest.approx(lower, abs=1e-6), pytest.approx(upper, abs=1e-6))


def joints_by_child(found: Segmentation, names: list[str]) -> tuple[Joint, Joint, Joint]:
    assert found.joints is not None
    by_child = {joint.child: joint for joint in found.joints}
    assert {joint.parent for joint in found.joints} == {names[0]}
    left, right, slide = (by_child[name] for name in names[1:])
    return left, right, slide


@pytest.mark.parametrize("metres", [1.0, 0.01])
def test_particulate_is_laid_onto_the_mesh(metres: float, tmp_path: Path) -> None:
    mesh, file = source(metres=metres)
    write_particulate(tmp_path, "run", file)
    found = read(ParticulateFiles, tmp_path / "run", mesh)
    names = ["part_0", "part_1", "part_2", "part_3"]
    assert_is_the_cabinet(found, metres, names)
    assert_limits(found, metres, names)
    assert any("the up axis of its source is +y" in note.text for note in found.notes)


def test_particulate_is_told_what_was_up(tmp_path: Path) -> None:
    mesh, file = source()
    write_particulate(tmp_path, "run", file)
    with pytest.raises(BadInputError, match="not of this mesh: its box differs"):
        read(ParticulateFiles, tmp_path / "run" / "pred.npz", mesh, up="+z")


@pytest.mark.parametrize("up", ["+y", "+z", "-y", "+x"])
def test_anymesh_is_laid_onto_the_mesh_whatever_was_up(up: UpAxis, tmp_path: Path) -> None:
    mesh, file = source(up, metres=2.0)
    write_anymesh(tmp_path, "run", file)
    found = read(AnymeshFiles, tmp_path / "run" / "mobility.json", mesh)
    assert_is_the_cabinet(found, 2.0)
    # Its files have no limits: a quarter turn, or half of the depth, 0.52 units of 2 m, either way.
    left, _, slide = joints_by_child(found, NAMES)
    assert left.limits == Limits(-math.pi / 2, math.pi / 2)
    assert slide.limits is not None
    assert slide.limits.upper == pytest.approx(0.52)
    assert sum("no limits are given" in note.text for note in found.notes) == 3


def write_gt(folder: Path, name: str, file: Articulation) -> None:
    write_case(Truth(name, file, up="+y"), folder / name)


def write_partnet(folder: Path, name: str, file: Articulation) -> None:
    """As SAPIEN hands it out: link_N in the URDF is the entry of id N."""
    links = tuple(Link(f"link_{i}", k.parent, k.joint) for i, k in enumerate(file.links))
    write_urdf(folder, name, Articulation(name, file.vertices, file.faces, file.labels, links))
    (folder / name / f"{name}.urdf").rename(folder / name / "mobility.urdf")
    table = [{"id": i, "name": link.label, "joint": "hinge"} for i, link in enumerate(file.links)]
    (folder / name / "mobility_v2.json").write_text(json.dumps(table))


def write_physxnet(folder: Path, name: str, file: Articulation) -> None:
    """finaljson/NAME.json with an OBJ a part, turns divided by pi; the cabinet's longest side is 1."""
    objs = folder / "partseg" / name / "objs"
    objs.mkdir(parents=True)
    (folder / "finaljson").mkdir()
    groups: dict[str, Any] = {"0": [0]}
    for index, link in enumerate(file.links):
        trimesh.Trimesh(file.vertices, file.faces[file.labels == index], process=False).export(
            objs / f"{index}.obj"
        )
        if link.parent < 0:
            continue
        assert link.joint.axis is not None
        assert link.joint.origin is not None
        turns = link.joint.kind == "revolute"
        limits = np.array([link.joint.lower, link.joint.upper]) / (math.pi if turns else 1)
        numbers = [*link.joint.axis, *link.joint.origin, *limits.tolist()]
        groups[str(index)] = [[index], "0", numbers, "C" if turns else "B"]
    parts = [{"label": i, "name": link.name} for i, link in enumerate(file.links)]
    table = {"category": "cabinet", "dimension": "100*50*100", "parts": parts, "group_info": groups}
    (folder / "finaljson" / f"{name}.json").write_text(json.dumps(table))


@pytest.mark.parametrize(
    ("write", "names"),
    [
        (write_gt, NAMES),
        (write_physxnet, NAMES),
        (write_partnet, ["link_0", "link_1", "link_2", "link_3"]),
    ],
)
def test_what_a_data_set_states_is_laid_onto_the_mesh(write: Write, names: list[str], tmp_path: Path) -> None:
    mesh, file = source(metres=3.0)
    write(tmp_path, "thing", file)
    found = read(TruthFiles, tmp_path, mesh)
    assert_is_the_cabinet(found, 3.0, names)
    assert_limits(found, 3.0, names)
    assert [part.label for part in found.parts[1:]] == (
        ["door", "door", "drawer"] if write is not write_physxnet else NAMES[1:]
    )


def test_physxnet_is_a_source_by_itself(tmp_path: Path) -> None:
    write_physxnet(tmp_path, "7", cabinet())
    loaded = read_source(tmp_path / "finaljson" / "7.json", Plugins(installed=False))
    assert loaded.stated is not None
    np.testing.assert_allclose(np.ptp(loaded.mesh.bounds, axis=0), (1.0, 0.52, 1.0), atol=1e-9)
    assert_is_the_cabinet(loaded.stated)
    assert_limits(loaded.stated)
    (tmp_path / "partseg" / "7" / "objs" / "2.obj").unlink()
    with pytest.raises(BadInputError, match="no such mesh file"):
        read_source(tmp_path / "finaljson" / "7.json", Plugins(installed=False))


def test_an_object_of_several_is_chosen_by_name(tmp_path: Path) -> None:
    mesh, file = source()
    for name in ("one", "two"):
        write_gt(tmp_path, name, file)
    with pytest.raises(
        BadInputError, match=r"has 2 objects: choose with --set segmenter\.options\.object=NAME"
    ):
        read(TruthFiles, tmp_path, mesh)
    with pytest.raises(BadInputError, match="no object 'three'"):
        read(TruthFiles, tmp_path, mesh, object="three")
    assert_is_the_cabinet(read(TruthFiles, tmp_path, mesh, object="two"))


def test_parts_are_found_on_another_triangulation(tmp_path: Path) -> None:
    _, file = source()
    write_gt(tmp_path, "thing", file)
    finer = trimesh.Trimesh(file.vertices, file.faces, process=False).subdivide().subdivide()
    mesh, _ = canonical(Mesh(finer.vertices, finer.faces, up="+y"))
    found = read(TruthFiles, tmp_path, mesh)
    areas = np.bincount(found.face_part, mesh.face_areas)
    # Fronts touch the body: which of two faces at one place is whose is told by the way that they face.
    np.testing.assert_allclose(areas, AREAS, rtol=1e-6)


def test_a_joint_that_says_no_more_than_it_must_gets_a_place(tmp_path: Path) -> None:
    mesh, file = source()
    links = list(file.links)
    links[3] = Link("drawer", 0, LinkJoint("prismatic", (0, 0, 1), None, 0.2, 0.3))
    write_gt(tmp_path, "thing", Articulation("thing", file.vertices, file.faces, file.labels, tuple(links)))
    found = read(TruthFiles, tmp_path, mesh)
    *_, slide = joints_by_child(found, NAMES)
    np.testing.assert_allclose(slide.origin, (0, -0.25, 0.875), atol=1e-6)  # the middle of the drawer's box
    assert slide.limits is not None
    assert (slide.limits.lower, slide.limits.upper) == (0, pytest.approx(0.3))
    assert any("extended to it" in note.text for note in found.notes)


@pytest.mark.parametrize("stage", [ParticulateFiles, AnymeshFiles, TruthFiles])
def test_an_object_of_another_mesh_is_refused(stage: type[Segmenter], tmp_path: Path) -> None:
    mesh, file = source()
    write: Write = {ParticulateFiles: write_particulate, AnymeshFiles: write_anymesh, TruthFiles: write_gt}[
        stage
    ]
    squeezed: FloatArray = file.vertices * (1.0, 1.0, 0.5)
    write(tmp_path, "thing", Articulation("thing", squeezed, file.faces, file.labels, file.links))
    with pytest.raises(BadInputError, match="not of this mesh") as caught:
        read(stage, tmp_path / "thing", mesh)
    assert str(tmp_path / "thing") in str(caught.value)


@pytest.mark.parametrize(
    ("stage", "break_it", "told"),
    [
        (
            ParticulateFiles,
            lambda run: (run / "pred.npz").write_bytes(b"PK"),
            "cannot be read as an .npz archive",
        ),
        (ParticulateFiles, lambda run: (run / "pred.obj").unlink(), "no such mesh file"),
        (
            ParticulateFiles,
            lambda run: (run / "pred.npz").unlink(),
            r"should have one file \*.npz, it has none",
        ),
        (AnymeshFiles, lambda run: (run / "mobility.json").write_text("[{}]"), "part 0.id: Field required"),
        (AnymeshFiles, lambda run: (run / "mobility.json").unlink(), "has no mobility.json"),
        (AnymeshFiles, lambda run: (run / "mesh_parts" / "drawer.glb").unlink(), "has no mesh drawer.glb"),
        (TruthFiles, lambda run: (run / "gt.json").write_text("{"), "cannot be read as JSON"),
        (TruthFiles, lambda run: (run / "gt.npz").unlink(), "no such file"),
        (
            TruthFiles,
            lambda run: [file.unlink() for file in run.iterdir()],
            "holds no object with ground truth",
        ),
    ],
)
def test_damage_is_one_line_that_names_the_file(
    stage: type[Segmenter], break_it: Callable[[Path], object], told: str, tmp_path: Path
) -> None:
    mesh, file = source()
    write: Write = {ParticulateFiles: write_particulate, AnymeshFiles: write_anymesh, TruthFiles: write_gt}[
        stage
    ]
    write(tmp_path, "run", file)
    break_it(tmp_path / "run")
    with pytest.raises(BadInputError, match=told) as caught:
        read(stage, tmp_path / "run", mesh)
    assert str(tmp_path / "run") in str(caught.value)
    assert "\n" not in str(caught.value)


@needs_data
@pytest.mark.parametrize("name", ["jsk_fridge", "bigym_dishwasher"])
def test_a_real_object_gets_the_joints_of_its_truth(name: str) -> None:
    loaded = read_source(DATA / name / "input.glb", Plugins(installed=False))
    found = read(TruthFiles, DATA / name, loaded.mesh)
    rows = json.loads((DATA / name / "gt.json").read_text())["parts"]
    moving = [row["joint"] for row in rows if row["joint"]["type"] != "fixed"]
    assert found.joints is not None
    movers = [joint for joint in found.joints if joint.moves]
    assert len(movers) == len(moving)
    turn, shift = loaded.asset_from_source[:3, :3], loaded.asset_from_source[:3, 3]
    for joint, row in zip(movers, moving, strict=True):
        assert joint.kind == row["type"]
        np.testing.assert_allclose(joint.axis, turn @ row["axis"], atol=1e-5)
        np.testing.assert_allclose(joint.origin, turn @ row["origin"] + shift, atol=1e-5)
    with np.load(DATA / name / "gt.npz") as stored:
        labels = stored["face_part"]
    pairs = np.unique(np.column_stack([labels, found.face_part])[labels >= 0], axis=0)
    assert len(pairs) == len(found.parts) == len(np.unique(labels[labels >= 0]))
