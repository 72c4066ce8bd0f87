"""Objects of any format written as SIMART-Bench objects, and read back."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import trimesh

from simart_kit.bench import importing
from simart_kit.bench.articulation import Articulation, Link, LinkJoint
from simart_kit.bench.cases import Truth
from simart_kit.bench.formats import TruthFormat
from simart_kit.bench.formats.simart_bench import SimartBench
from simart_kit.bench.importing import import_cases, write_case
from simart_kit.errors import BadInputError, OutputError
from simart_kit.loading import read_source
from simart_kit.plugins import Plugins

from .bench_objects import DOOR_LEFT, DRAWER, block, cabinet, fan, truth, with_joint, with_link
from .real_objects import DATA, needs_data


def read_back(known: Truth, folder: Path) -> Truth:
    write_case(known, folder)
    return SimartBench().read(folder)


def assert_same(read: Articulation, known: Articulation) -> None:
    np.testing.assert_allclose(read.triangles, known.triangles, atol=1e-6 * known.diagonal)
    np.testing.assert_array_equal(read.labels, known.labels)
    assert read.links == known.links


@pytest.mark.parametrize("known", [cabinet(), fan(), block()], ids=lambda known: known.name)
def test_what_is_written_is_read_back(tmp_path: Path, known: Articulation) -> None:
    read = read_back(truth(known, "thing"), tmp_path / known.name)
    assert_same(read.articulation, known)
    assert (read.name, read.category, read.up, read.metres_per_unit) == (known.name, "thing", "+y", 1.0)
    assert read.notes == ()


def test_further_joints_units_and_faces_of_no_part_are_kept(tmp_path: Path) -> None:
    known = cabinet()
    door = replace(known.links[DOOR_LEFT], also=(LinkJoint("ball", origin=(0, 1, 2)), LinkJoint("free")))
    known = with_link(known, DOOR_LEFT, door)
    known = replace(known, labels=np.where(known.labels == 2, -1, known.labels), name="it")
    # The right door has no face then, and is left out when it is read.
    read = read_back(replace(truth(known), metres_per_unit=None), tmp_path / "it")
    assert read.metres_per_unit is None
    assert read.articulation.links == (known.links[0], known.links[1], known.links[3])
    np.testing.assert_array_equal(read.articulation.labels < 0, known.labels < 0)
    inches = read_back(replace(truth(fan()), metres_per_unit=0.0254), tmp_path / "fan")
    assert inches.metres_per_unit == 0.0254


def test_random_soup_keeps_its_faces_for_every_loader(tmp_path: Path) -> None:
    rng = np.random.default_rng(0)
    # Faces in no order, some twice or without area, and vertices that none uses: loaders like to tidy up.
    faces = rng.integers(40, size=(300, 3))
    soup = Articulation(
        "soup", rng.normal(size=(50, 3)), np.vstack([faces, faces[:20]]), rng.integers(2, size=320),
        (Link("a"), Link("b", 0, LinkJoint("prismatic", (0, 1, 0), (0, 0, 0), -1.0, 1.0))),
    )  # fmt: skip
    write_case(truth(soup), tmp_path / "soup")
    path = tmp_path / "soup" / "input.glb"
    plain = trimesh.load(path, process=False, force="mesh")
    np.testing.assert_allclose(plain.triangles, soup.triangles, atol=1e-6)
    source = read_source(path, Plugins())
    back = np.linalg.inv(source.asset_from_source)
    ours = source.mesh.triangles @ back[:3, :3].T + back[:3, 3]
    np.testing.assert_allclose(ours, soup.triangles, atol=1e-6)
    assert_same(SimartBench().read(tmp_path / "soup").articulation, soup)


def test_an_object_of_z_up_is_turned_with_its_joints(tmp_path: Path) -> None:
    hinge = LinkJoint("revolute", (0, 0, 1), (0.5, 0.25, 0.4), 0.0, 1.0)
    slide = LinkJoint("prismatic", (0, -1, 0), (0.0, -0.25, 0.875), 0.0, 0.3)
    known = with_joint(with_joint(cabinet(), DOOR_LEFT, hinge), DRAWER, slide)
    read = read_back(replace(truth(known), up="+z"), tmp_path / "cabinet")
    # Up becomes +Y and a front at -Y becomes +Z: (x, y, z) -> (x, z, -y).
    x, y, z = known.triangles.transpose(2, 0, 1)
    np.testing.assert_allclose(read.articulation.triangles, np.stack([x, z, -y], axis=-1), atol=1e-6)
    turned = [read.articulation.links[i].joint for i in (DOOR_LEFT, DRAWER)]
    assert turned[0] == LinkJoint("revolute", (0, 1, 0), (0.5, 0.4, -0.25), 0.0, 1.0)
    assert turned[1] == LinkJoint("prismatic", (0, 0, 1), (0.0, 0.875, 0.25), 0.0, 0.3)
    assert read.up == "+y"


def test_writing_twice_gives_the_same_bytes(tmp_path: Path) -> None:
    for name in ("a", "b"):
        write_case(truth(cabinet()), tmp_path / name)
    for file in ("input.glb", "gt.npz", "gt.json"):
        assert (tmp_path / "a" / file).read_bytes() == (tmp_path / "b" / file).read_bytes()


@pytest.mark.parametrize(
    ("known", "told"),
    [
        (Articulation("dots", np.eye(3), np.zeros((0, 3)), [0, 0, 0], (Link("a"),)), "is a point cloud"),
        (with_joint(cabinet(), 1, LinkJoint("unknown")), "'door_left': a truth has to say how it moves"),
        (
            with_joint(cabinet(), 1, LinkJoint("prismatic", (1, 0, 0), None, 2.0, 1.0)),
            "'door_left': its lower limit 2.0 is above the upper, 1.0",
        ),
    ],
    ids=["cloud", "unknown", "reversed"],
)
def test_what_the_format_cannot_hold_is_refused_and_leaves_nothing(
    tmp_path: Path, known: Articulation, told: str
) -> None:
    with pytest.raises(BadInputError, match=told):
        write_case(truth(known), tmp_path / "it")
    assert not (tmp_path / "it").exists()


# --- whole data sets --------------------------------------------------------------------------------------


@pytest.fixture
def only_simart_bench(monkeypatch: pytest.MonkeyPatch) -> None:
    """Look for no other format: this is about what is made of what was found."""

    def found(root: Path) -> dict[str, tuple[TruthFormat, Path]]:
        reader = SimartBench()
        return {name: (reader, path) for name, path in reader.find(root).items()}

    monkeypatch.setattr(importing, "find_truths", found)


@pytest.mark.usefixtures("only_simart_bench")
def test_a_damaged_object_is_told_and_the_others_are_written(tmp_path: Path) -> None:
    for known in (block(), cabinet(), fan()):
        write_case(truth(known), tmp_path / "in" / known.name)
    (tmp_path / "in" / "cabinet" / "gt.npz").write_bytes(b"nothing")
    told: list[tuple[str, str]] = []
    done = import_cases(tmp_path / "in", tmp_path / "out", lambda name, text: told.append((name, text)))
    assert done.written == ("block", "fan")
    assert list(done.skipped) == ["cabinet"]
    assert told[0] == ("block", "written: 12 faces, 1 part, 0 moving")
    assert told[1][0] == "cabinet"
    assert told[1][1].startswith("skipped: ")
    assert "gt.npz" in told[1][1]
    assert sorted(path.name for path in (tmp_path / "out").iterdir()) == ["block", "fan"]
    assert_same(SimartBench().read(tmp_path / "out" / "fan").articulation, fan())


@pytest.mark.usefixtures("only_simart_bench")
def test_nothing_is_overwritten(tmp_path: Path) -> None:
    for known in (block(), fan()):
        write_case(truth(known), tmp_path / "in" / known.name)
    (tmp_path / "out" / "fan").mkdir(parents=True)
    with pytest.raises(BadInputError, match=r"out/fan exists: remove it"):
        import_cases(tmp_path / "in", tmp_path / "out", lambda name, text: None)
    assert [path.name for path in (tmp_path / "out").iterdir()] == ["fan"]
    assert not list((tmp_path / "out" / "fan").iterdir())


@pytest.mark.usefixtures("only_simart_bench")
def test_a_file_in_the_place_of_the_output_is_told(tmp_path: Path) -> None:
    write_case(truth(block()), tmp_path / "in" / "block")
    (tmp_path / "out").write_text("")
    with pytest.raises(OutputError, match="it is a file"):
        import_cases(tmp_path / "in", tmp_path / "out", lambda name, text: None)


@needs_data
@pytest.mark.parametrize("name", ["bigym_dishwasher", "painted_wooden_cabinet", "jsk_fridge"])
def test_a_real_object_survives(tmp_path: Path, name: str) -> None:
    known = SimartBench().read(DATA / name)
    read = read_back(known, tmp_path / name)
    np.testing.assert_allclose(read.articulation.triangles, known.articulation.triangles, atol=1e-6)
    np.testing.assert_array_equal(read.articulation.labels, known.articulation.labels)
    for mine, true in zip(read.articulation.links, known.articulation.links, strict=True):
        assert (mine.name, mine.parent, mine.joint.kind) == (true.name, true.parent, true.joint.kind)
        assert mine.joint.axis == pytest.approx(true.joint.axis)
        assert math.dist(mine.joint.origin or (0, 0, 0), true.joint.origin or (0, 0, 0)) < 1e-9
