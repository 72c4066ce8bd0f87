"""Each test of a contract finds the mistake that it is there for, and lets a correct stage pass."""

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from pydantic import Field

import simart_kit as sk
from simart_kit.arrays import frozen_floats
from simart_kit.beside import Beside
from simart_kit.testing import fakes, meshes
from simart_kit.testing.contracts import (
    ExporterContract,
    JointPredictorContract,
    ModifierContract,
    SegmenterContract,
    StageContract,
)
from simart_kit.testing.export_text import complaints

CABINET = meshes.cabinet_asset()
HINTS = CABINET.joints
GUESSES = tuple(sk.PartGuess(part.name) for part in CABINET.parts)


def keeps(
    contract: type[StageContract], stage: type[Any], test: str, *arguments: Any, **attributes: Any
) -> None:
    """Run one test of a contract on a stage."""
    case = type("Case", (contract,), {"stage": stage, **attributes})()
    getattr(case, test)(*arguments)


class Unnamed(fakes.segmenter()):  # type: ignore[misc]
    name = "Not a name!"


class Silent(fakes.segmenter()):  # type: ignore[misc]
    class Options(sk.Options):
        count: int = 1


class Lenient(fakes.segmenter()):  # type: ignore[misc]
    class Options(sk.Options, extra="ignore"):
        """Takes anything."""


class Demanding(fakes.segmenter()):  # type: ignore[misc]
    class Options(sk.Options):
        count: int = Field(description="Number of parts; without a default.")


@pytest.mark.parametrize(
    ("stage", "test"),
    [
        (fakes.modifier(), "test_is_a_stage_of_its_kind"),
        (Unnamed, "test_name_can_be_written_in_a_recipe"),
        (Silent, "test_every_option_is_described"),
        (Lenient, "test_unknown_option_is_rejected"),
        (Demanding, "test_default_options_are_valid"),
    ],
)
def test_contract_finds_a_wrong_declaration(stage: type[Any], test: str) -> None:
    with pytest.raises((AssertionError, ValueError, pytest.fail.Exception)):
        keeps(SegmenterContract, stage, test)
    keeps(SegmenterContract, fakes.segmenter(), test)


class Scribbler(fakes.segmenter()):  # type: ignore[misc]
    def segment(self, mesh: sk.Mesh) -> sk.Segmentation:
        object.__setattr__(mesh, "vertices", mesh.vertices * 2)
        said: sk.Segmentation = super().segment(mesh)
        return said


def by_chance() -> Callable[[sk.Mesh], Any]:
    rng = np.random.default_rng(0)
    return lambda mesh: np.append([0, 1], rng.integers(0, 2, len(mesh.faces) - 2))


def by_absolute_height(mesh: sk.Mesh) -> Any:
    return (mesh.triangles[:, :, 2].mean(axis=1) > 0.3).astype(np.int32)


@pytest.mark.parametrize(
    ("stage", "test"),
    [
        (fakes.segmenter(lambda mesh: np.zeros(len(mesh.faces))), "test_labels_every_face"),
        (fakes.segmenter(lambda mesh: np.zeros(len(mesh.faces) - 1, int)), "test_labels_every_face"),
        (fakes.segmenter(lambda mesh: np.full(len(mesh.faces), 1)), "test_one_guess_for_every_label"),
        (fakes.segmenter(parts=GUESSES), "test_one_guess_for_every_label"),
        (fakes.segmenter(CABINET.face_part, GUESSES, [*HINTS, HINTS[0]]), "test_core_accepts_it"),
        (fakes.segmenter(CABINET.face_part, GUESSES), "test_works_on_a_single_box"),
        (fakes.segmenter(by_chance()), "test_same_answer_every_time"),
        (Scribbler, "test_leaves_the_mesh_alone"),
        (fakes.segmenter(by_absolute_height), "test_does_not_depend_on_place_and_size"),
    ],
)
def test_contract_finds_a_wrong_segmentation(stage: type[sk.Segmenter], test: str) -> None:
    with pytest.raises((AssertionError, ValueError, sk.SimartKitError)):
        keeps(SegmenterContract, stage, test)
    keeps(SegmenterContract, fakes.segmenter(), test)


def test_segmenter_may_depend_on_place_and_size_when_it_says_so() -> None:
    with pytest.raises(pytest.skip.Exception):
        keeps(
            SegmenterContract,
            fakes.segmenter(by_absolute_height),
            "test_does_not_depend_on_place_and_size",
            invariant=False,
        )


class Counter(fakes.joint_predictor()):  # type: ignore[misc]
    calls = 0

    def predict(self, mesh: sk.Mesh, segmentation: sk.Segmentation) -> tuple[sk.Joint, ...]:
        Counter.calls += 1
        return (replace(HINTS[0], confidence=1 / Counter.calls),)


class Renamer(fakes.joint_predictor()):  # type: ignore[misc]
    def predict(self, mesh: sk.Mesh, segmentation: sk.Segmentation) -> tuple[sk.Joint, ...]:
        object.__setattr__(segmentation, "parts", segmentation.parts[::-1])
        return ()


@pytest.mark.parametrize(
    ("stage", "test"),
    [
        (fakes.joint_predictor([replace(HINTS[0], child="lid")]), "test_joins_known_parts"),
        (fakes.joint_predictor([*HINTS, replace(HINTS[0], name="again")]), "test_joints_are_a_tree"),
        (fakes.joint_predictor(HINTS), "test_works_on_a_single_part"),
        (Counter, "test_same_answer_every_time"),
        (Renamer, "test_leaves_its_inputs_alone"),
    ],
)
def test_contract_finds_wrong_joints(stage: type[sk.JointPredictor], test: str) -> None:
    with pytest.raises((AssertionError, sk.SimartKitError)):
        keeps(JointPredictorContract, stage, test)
    keeps(JointPredictorContract, fakes.joint_predictor(), test)


def without_last_face(asset: sk.Asset) -> sk.Asset:
    return replace(
        asset,
        mesh=replace(asset.mesh, faces=asset.mesh.faces[:-1], face_material=asset.mesh.face_material[:-1]),
        face_part=asset.face_part[:-1],
    )


def loosened(asset: sk.Asset) -> sk.Asset:
    free = (replace(joint, kind="continuous", limits=None) for joint in asset.joints)
    return replace(asset, joints=tuple(free))


def drifting() -> Callable[[sk.Asset], sk.Asset]:
    rng = np.random.default_rng(0)
    return lambda asset: replace(asset, asset_from_source=frozen_floats(np.eye(4) * rng.random()))


def in_place(asset: sk.Asset) -> sk.Asset:
    object.__setattr__(asset, "floating", True)
    return asset


@pytest.mark.parametrize(
    ("change", "test"),
    [
        (without_last_face, "test_keeps_faces_and_labels"),
        (lambda asset: None, "test_keeps_faces_and_labels"),
        (drifting(), "test_same_answer_every_time"),
        (in_place, "test_leaves_the_asset_alone"),
        (lambda asset: asset.part("door") and asset, "test_static_object_stays_static"),
        (lambda asset: asset.joint("door_hinge") and asset, "test_works_on_a_chain_of_joints"),
        (loosened, "test_works_when_nothing_moves"),
    ],
)
def test_contract_finds_a_wrong_modifier(change: Callable[[sk.Asset], sk.Asset], test: str) -> None:
    with pytest.raises((AssertionError, sk.SimartKitError)):
        keeps(ModifierContract, fakes.modifier(change), test)
    keeps(ModifierContract, fakes.modifier(), test)


class Unequal(fakes.modifier()):  # type: ignore[misc]
    def modify_beside(self, asset: sk.Asset, beside: Beside) -> sk.Asset:
        return loosened(asset)


def test_contract_finds_a_modifier_that_makes_another_asset_with_help() -> None:
    with pytest.raises(AssertionError, match="modify_beside"):
        keeps(ModifierContract, Unequal, "test_help_changes_nothing")
    keeps(ModifierContract, fakes.modifier(), "test_help_changes_nothing")


class Hasty(fakes.modifier()):  # type: ignore[misc]
    def begun(self, asset: sk.Asset, beside: Beside) -> sk.Modifier:
        made: sk.Modifier = fakes.modifier(lambda other: loosened(asset))()
        return made


def test_contract_finds_a_modifier_that_makes_another_asset_if_it_begins_early(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr("simart_kit.beside.usable_cores", lambda: 2)
    with pytest.raises(AssertionError, match="begun"):
        keeps(ModifierContract, Hasty, "test_an_early_start_changes_nothing")
    keeps(ModifierContract, fakes.modifier(), "test_an_early_start_changes_nothing")


class Litterer(fakes.exporter()):  # type: ignore[misc]
    def export(self, asset: sk.Asset, directory: Path) -> Path:
        (directory.parent / "notes.txt").write_text("left behind")
        main: Path = super().export(asset, directory)
        return main


class Placed(fakes.exporter()):  # type: ignore[misc]
    def export(self, asset: sk.Asset, directory: Path) -> Path:
        main: Path = super().export(asset, directory)
        main.write_text(str(main))
        return main


@pytest.mark.parametrize(
    ("stage", "test"),
    [
        (fakes.exporter(main="missing.txt"), "test_main_file_is_in_the_directory"),
        (fakes.exporter(main=Path(__file__)), "test_main_file_is_in_the_directory"),
        (Placed, "test_same_bytes_every_time"),
        (Placed, "test_names_no_place_and_no_time"),
        (fakes.exporter({"a.obj": "mtllib ../a.mtl\n"}), "test_names_no_place_and_no_time"),
        (fakes.exporter({"a.txt": "made 2024-05-06\n"}), "test_names_no_place_and_no_time"),
    ],
)
def test_contract_finds_a_wrong_export(stage: type[sk.Exporter], test: str, tmp_path: Path) -> None:
    with pytest.raises(AssertionError):
        keeps(ExporterContract, stage, test, CABINET, tmp_path / "wrong")
    keeps(ExporterContract, fakes.exporter(), test, CABINET, tmp_path / "right")


def test_contract_finds_files_written_elsewhere(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    for stage, folder in ((Litterer, tmp_path / "wrong"), (fakes.exporter(), tmp_path / "right")):
        folder.mkdir()
        if stage is Litterer:
            with pytest.raises(AssertionError):
                keeps(ExporterContract, stage, "test_writes_nothing_elsewhere", CABINET, folder, monkeypatch)
        else:
            keeps(ExporterContract, stage, "test_writes_nothing_elsewhere", CABINET, folder, monkeypatch)


URDF = (
    '<robot name="r"><link name="a"/><link name="b"/>'
    '<joint name="j" type="{}"><parent link="a"/><child link="b"/></joint></robot>'
)
MJCF = '<mujoco><worldbody><body><geom size="1"/>{}</body></worldbody></mujoco>'
USDA = '#usda 1.0\ndef Xform "a" {{\n    def {} "j" {{}}\n}}\n'


@pytest.mark.parametrize(
    ("file", "text", "still", "moving"),
    [
        ("r.urdf", URDF, "fixed", "continuous"),
        ("r.xml", MJCF, "", "<joint/>"),
        ("r.xml", MJCF, "<freejoint/>", '<joint type="slide"/>'),
        ("r.usda", USDA, "PhysicsFixedJoint", "PhysicsRevoluteJoint"),
    ],
)
def test_contract_counts_joints_with_another_reader(
    file: str, text: str, still: str, moving: str, tmp_path: Path
) -> None:
    asset = replace(CABINET, joints=(HINTS[0], replace(HINTS[1], kind="fixed", limits=None)))
    test = "test_another_reader_finds_the_joints"
    keeps(ExporterContract, fakes.exporter({file: text.format(moving)}), test, asset, tmp_path / "right")
    with pytest.raises(AssertionError):
        keeps(ExporterContract, fakes.exporter({file: text.format(still)}), test, asset, tmp_path / "wrong")


def test_contract_asks_for_a_reader_of_an_unknown_format(tmp_path: Path) -> None:
    with pytest.raises(pytest.skip.Exception, match="moving_joints"):
        keeps(
            ExporterContract,
            fakes.exporter(),
            "test_another_reader_finds_the_joints",
            CABINET,
            tmp_path / "a",
        )


@pytest.mark.parametrize(
    "text",
    [
        '<mesh filename="/data/door.obj"/>',
        '<mesh filename="package://cabinet/../door.obj"/>',
        '<mesh file="file:///data/door.obj"/>',
        "map_Kd C:\\textures\\wood.png",
        "map_Kd -s 1 1 1 ../wood.png",
        "asset inputs:file = @/textures/wood.png@",
        "saved at 12:34:56",
    ],
)
def test_text_that_ties_an_export_to_a_place_or_a_time_is_found(text: str, tmp_path: Path) -> None:
    (tmp_path / "model.txt").write_text(text)
    assert len(complaints(tmp_path, ())) == 1


@pytest.mark.parametrize(
    "text",
    [
        '<mesh filename="package://cabinet/meshes/door.obj"/>',
        "mtllib door.mtl\nmap_Kd textures/wood.png\nv 0.52 -0.3 1e-05",
        "asset inputs:file = @./textures/wood.png@\nrel material:binding = </root/Looks/wood>",
        '<compiler meshdir="meshes"/>',
    ],
)
def test_text_that_stays_in_its_folder_is_fine(text: str, tmp_path: Path) -> None:
    (tmp_path / "model.txt").write_text(text)
    assert complaints(tmp_path, ()) == []
