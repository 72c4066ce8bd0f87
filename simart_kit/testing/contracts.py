"""What every stage must keep: subclass a contract and the whole test file of a plugin is written.

from simart_kit.testing.contracts import SegmenterContract

class TestMine(SegmenterContract):
    stage = Mine
"""

from __future__ import annotations

import json
import re
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any, ClassVar

import numpy as np
import pytest
from pydantic import ValidationError

from ..arrays import IntArray
from ..assemble import assemble, checked
from ..asset import Asset, Joint
from ..beside import Beside, EarlyModifier, HelpedModifier, begun_by, modify_by
from ..checks import CheckResult
from ..checks.subject import Subject
from ..errors import BadInputError
from ..mesh import Mesh
from ..recipe import read_options
from ..spec.protocols import HelpedSegmenter, segment_by
from ..stages import Check, Exporter, JointPredictor, Modifier, PartGuess, Segmentation, Segmenter, Stage
from . import meshes
from .export_text import complaints
from .fingerprint import fingerprint, folder_fingerprint
from .readers import reader


class StageContract:
    """What holds for all kinds of stage.

    Attributes:
        stage: the class under test.
        options: its options where the defaults do not do, as a recipe would give them.
        kind: what it must be a subclass of; set by the contracts below.
    """

    stage: ClassVar[type[Stage]]
    options: ClassVar[Mapping[str, Any]] = {}
    kind: ClassVar[type[Stage]] = Stage

    def make(self) -> Any:
        """A new stage; its generators start from seed 0."""
        return self.stage(read_options(self.stage, self.options), seed=0)

    def test_is_a_stage_of_its_kind(self) -> None:
        assert issubclass(self.stage, self.kind), (
            f"{self.stage.__name__} is no simart_kit.{self.kind.__name__}"
        )

    def test_name_can_be_written_in_a_recipe(self) -> None:
        name = getattr(self.stage, "name", None)
        assert isinstance(name, str), f"{self.stage.__name__} needs a class attribute `name`"
        assert re.fullmatch(r"[a-z][a-z0-9_-]*", name), (
            f"name '{name}': use a-z, 0-9, _ and -, from a letter on"
        )

    def test_default_options_are_valid(self) -> None:
        self.stage.Options()

    def test_default_options_can_be_stored(self) -> None:
        options = self.stage.Options()
        again = self.stage.Options.model_validate_json(options.model_dump_json())
        assert again == options, "options must survive the way through provenance.json"

    def test_unknown_option_is_rejected(self) -> None:
        with pytest.raises(ValidationError):
            read_options(self.stage, {**self.options, "no_such_option": 1})

    def test_every_option_is_described(self) -> None:
        fields = self.stage.Options.model_fields
        silent = [name for name, field in fields.items() if not (field.description or "").strip()]
        assert not silent, f"give these options a description with their unit: {', '.join(silent)}"

    def test_options_cannot_be_changed(self) -> None:
        assert self.stage.Options.model_config.get("frozen"), "derive Options from simart_kit.Options"


class SegmenterContract(StageContract):
    """For Segmenters.

    Attributes:
        invariant: whether moving and scaling a mesh leaves the partition as it is; set to False for a method
            that cannot promise it, such as a network on a fixed grid.
    """

    kind = Segmenter
    invariant: ClassVar[bool] = True

    def mesh(self) -> Mesh:
        """What is segmented: by default a cabinet with a door and a drawer."""
        return meshes.cabinet_mesh()

    def test_labels_every_face(self) -> None:
        mesh = self.mesh()
        result = self.make().segment(mesh)
        assert isinstance(result, Segmentation), f"segment() returned {type(result).__name__}"
        labels = result.face_part
        assert isinstance(labels, np.ndarray), f"face_part is a {type(labels).__name__}, expected an array"
        assert np.issubdtype(labels.dtype, np.integer), f"face_part has dtype {labels.dtype}, expected int32"
        faces = result.mesh_of(mesh).faces
        assert labels.shape == (len(faces),), f"face_part has shape {labels.shape}: one label a face"

    def test_one_guess_for_every_label(self) -> None:
        result = self.make().segment(self.mesh())
        used = np.unique(result.face_part).tolist()
        expected = list(range(len(result.parts)))
        assert used == expected, (
            f"face_part uses ids {used} for {len(result.parts)} guesses: number them from 0"
        )
        assert all(isinstance(guess, PartGuess) for guess in result.parts), "parts must hold PartGuess values"

    def test_core_accepts_it(self) -> None:
        mesh = self.mesh()
        segmentation = checked(self.make().segment(mesh), mesh)
        assemble("asset", mesh, segmentation, segmentation.joints or (), np.eye(4))

    def test_works_on_a_single_box(self) -> None:
        mesh = meshes.static_asset().mesh
        checked(self.make().segment(mesh), mesh)

    def test_same_answer_every_time(self) -> None:
        mesh, stage = self.mesh(), self.make()
        with Beside(isinstance(stage, HelpedSegmenter)) as another:
            one, two = stage.segment(mesh), segment_by(self.make(), mesh, None, another)
        assert fingerprint(one) == fingerprint(two), (
            "make generators with numpy.random.default_rng(self.seed), and give the same with help"
        )

    def test_leaves_the_mesh_alone(self) -> None:
        mesh = self.mesh()
        before = fingerprint(mesh)
        self.make().segment(mesh)
        assert fingerprint(mesh) == before, "segment() changed its mesh"

    def test_does_not_depend_on_place_and_size(self) -> None:
        if not self.invariant:
            pytest.skip("the class says invariant = False")
        mesh = self.mesh()
        moved_from_mesh = np.diag([1.7, 1.7, 1.7, 1.0])
        moved_from_mesh[:3, 3] = (0.4, -0.7, 0.3)
        at_rest = self.make().segment(mesh).face_part
        moved = self.make().segment(mesh.transformed(moved_from_mesh)).face_part
        assert np.array_equal(_first_seen(at_rest), _first_seen(moved)), "the partition changed"


class JointPredictorContract(StageContract):
    """For JointPredictors."""

    kind = JointPredictor

    def mesh(self) -> Mesh:
        """The object: by default a cabinet with a door and a drawer."""
        return meshes.cabinet_mesh()

    def segmentation(self) -> Segmentation:
        """Its parts, with joint hints."""
        return _segmentation(meshes.cabinet_asset())

    def test_joins_known_parts(self) -> None:
        segmentation = self.segmentation()
        joints = self.make().predict(self.mesh(), segmentation)
        assert isinstance(joints, tuple), f"predict() returned {type(joints).__name__}, expected a tuple"
        assert all(isinstance(joint, Joint) for joint in joints), "predict() must return Joint values"
        known = {part.name for part in segmentation.parts}
        unknown = {end for j in joints for end in (j.parent, j.child)} - known
        assert not unknown, f"joints name parts that do not exist: {', '.join(sorted(unknown))}"

    def test_axes_are_unit_vectors(self) -> None:
        for joint in self.make().predict(self.mesh(), self.segmentation()):
            assert np.isclose(np.linalg.norm(joint.axis), 1.0, atol=1e-6), (
                f"axis of {joint.name}: {joint.axis}"
            )

    def test_joints_are_a_tree(self) -> None:
        mesh, segmentation = self.mesh(), self.segmentation()
        joints = self.make().predict(mesh, segmentation)
        assemble("asset", mesh, segmentation, joints, np.eye(4))

    def test_works_on_a_single_part(self) -> None:
        asset = meshes.static_asset()
        assert self.make().predict(asset.mesh, _segmentation(asset)) == (), "a single part has no joint"

    def test_same_answer_every_time(self) -> None:
        mesh, segmentation = self.mesh(), self.segmentation()
        one, two = (self.make().predict(mesh, segmentation) for _ in range(2))
        assert fingerprint(one) == fingerprint(two), (
            "make generators with numpy.random.default_rng(self.seed)"
        )

    def test_leaves_its_inputs_alone(self) -> None:
        mesh, segmentation = self.mesh(), self.segmentation()
        before = fingerprint((mesh, segmentation))
        self.make().predict(mesh, segmentation)
        assert fingerprint((mesh, segmentation)) == before, "predict() changed its inputs"


class ModifierContract(StageContract):
    """For Modifiers."""

    kind = Modifier

    def asset(self) -> Asset:
        """What is modified: by default a cabinet with a door and a drawer, without masses and shapes."""
        return meshes.cabinet_asset(physics=False)

    def test_keeps_faces_and_labels(self) -> None:
        asset = self.asset()
        result = self.make().modify(asset)
        assert isinstance(result, Asset), f"modify() returned {type(result).__name__}, expected an Asset"
        assert np.array_equal(result.mesh.faces, asset.mesh.faces), "modify() changed the faces"
        assert len(result.face_part) == len(asset.face_part), "one label a face"

    def test_same_answer_every_time(self) -> None:
        asset = self.asset()
        one, two = self.make().modify(asset), self.make().modify(asset)
        assert fingerprint(one) == fingerprint(two), (
            "make generators with numpy.random.default_rng(self.seed)"
        )

    def test_help_changes_nothing(self) -> None:
        stage = self.make()
        with Beside(isinstance(stage, HelpedModifier)) as another:
            helped = modify_by(stage, self.asset(), another)
        assert fingerprint(helped) == fingerprint(stage.modify(self.asset())), "modify_beside() gives another"

    def test_an_early_start_changes_nothing(self) -> None:
        stage, asset, another = self.make(), self.asset(), meshes.chain_asset()
        with Beside(isinstance(stage, EarlyModifier)) as beside:
            begun = begun_by(stage, asset, beside)
            early = [fingerprint(modify_by(begun, one, beside)) for one in (asset, another)]
        assert early == [fingerprint(stage.modify(one)) for one in (asset, another)], "begun() gives another"

    def test_leaves_the_asset_alone(self) -> None:
        asset = self.asset()
        before = fingerprint(asset)
        self.make().modify(asset)
        assert fingerprint(asset) == before, "modify() changed its input"

    def test_works_on_a_finished_asset(self) -> None:
        self._modify(meshes.cabinet_asset())

    def test_works_on_a_chain_of_joints(self) -> None:
        self._modify(meshes.chain_asset())

    def test_static_object_stays_static(self) -> None:
        assert self._modify(meshes.static_asset()).joints == ()

    def test_works_when_nothing_moves(self) -> None:
        asset = meshes.cabinet_asset()
        stuck = tuple(replace(joint, kind="fixed", limits=None) for joint in asset.joints)
        result = self._modify(replace(asset, joints=stuck))
        assert not any(joint.moves for joint in result.joints), "modify() made fixed joints move"

    def _modify(self, asset: Asset) -> Asset:
        result = self.make().modify(asset)
        assert isinstance(result, Asset), f"modify() returned {type(result).__name__}, expected an Asset"
        assert len(result.face_part) == len(asset.face_part), "one label a face"
        return result


class ExporterContract(StageContract):
    """For Exporters."""

    kind = Exporter

    @pytest.fixture(params=["cabinet", "chain", "static"])
    def asset(self, request: pytest.FixtureRequest) -> Asset:
        """Textured parts with a hinge and a slide; slanted axes in a chain; one part that nothing moves."""
        made: Asset = getattr(meshes, f"{request.param}_asset")()
        return made

    def export(self, asset: Asset, directory: Path) -> Path:
        """Export into a fresh directory, as the core does; the main file."""
        directory.mkdir(parents=True)
        main = self.make().export(asset, directory)
        assert isinstance(main, Path), f"export() returned {type(main).__name__}, expected a Path"
        assert main.is_file(), f"export() returned {main}, which is no file"
        assert main.resolve().is_relative_to(directory.resolve()), f"{main} is outside the directory"
        return main

    def moving_joints(self, main: Path) -> int | None:
        """How many joints an independent reader finds; None skips the comparison.

        Override it for a format that `simart_kit.testing.readers` does not know.
        """
        read = reader(main)
        return None if read is None else read(main)

    def test_main_file_is_in_the_directory(self, asset: Asset, tmp_path: Path) -> None:
        self.export(asset, tmp_path / "made")

    def test_same_bytes_every_time(self, asset: Asset, tmp_path: Path) -> None:
        one = self.export(asset, tmp_path / "one")
        two = self.export(asset, tmp_path / "another" / "place")
        assert one.name == two.name
        first, second = folder_fingerprint(one.parent), folder_fingerprint(two.parent)
        differ = sorted(name for name in first.keys() | second.keys() if first.get(name) != second.get(name))
        assert not differ, f"these files differ between two exports: {', '.join(differ)}"

    def test_names_no_place_and_no_time(self, asset: Asset, tmp_path: Path) -> None:
        directory = tmp_path / "made"
        self.export(asset, directory)
        found = complaints(directory, forbidden=(str(tmp_path), str(Path.cwd())))
        assert not found, "\n".join(found)

    def test_writes_nothing_elsewhere(
        self, asset: Asset, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
    ) -> None:
        work = tmp_path / "work"
        work.mkdir()
        monkeypatch.chdir(work)
        self.export(asset, tmp_path / "made")
        assert {path.name for path in tmp_path.iterdir()} == {"work", "made"}
        assert list(work.iterdir()) == [], "export() wrote into the working directory"

    def test_leaves_the_asset_alone(self, asset: Asset, tmp_path: Path) -> None:
        before = fingerprint(asset)
        exporter = self.make()
        exporter.export(asset, tmp_path)
        exporter.unsupported(asset)
        assert fingerprint(asset) == before, "export() changed its input"

    def test_another_reader_finds_the_joints(self, asset: Asset, tmp_path: Path) -> None:
        found = self.moving_joints(self.export(asset, tmp_path / "made"))
        if found is None:
            pytest.skip("no independent reader for this format: override moving_joints()")
        assert found == sum(joint.moves for joint in asset.joints)

    def test_tells_what_it_cannot_express(self, asset: Asset) -> None:
        told = self.make().unsupported(asset)
        assert isinstance(told, tuple), f"unsupported() returned {type(told).__name__}, expected a tuple"
        assert all(isinstance(text, str) and text for text in told), "unsupported() must return sentences"


class CheckContract(StageContract):
    """For Checks."""

    kind = Check

    @pytest.fixture(params=["cabinet", "chain", "static"])
    def subject(self, request: pytest.FixtureRequest) -> Subject:
        """What is judged: by default assets without files; write some where the check reads them."""
        return Subject({}, getattr(meshes, f"{request.param}_asset")())

    def test_tells_a_verdict_in_one_line(self, subject: Subject) -> None:
        result = self.make().check(subject)
        assert isinstance(result, CheckResult), f"check() returned {type(result).__name__}"
        assert result.name == self.stage.name, f"the result is named '{result.name}', not '{self.stage.name}'"
        assert isinstance(result.passed, bool), f"passed is a {type(result.passed).__name__}, expected a bool"
        assert result.text, "tell what was found"
        assert "\n" not in result.text, "tell it in one line"

    def test_same_verdict_every_time(self, subject: Subject) -> None:
        again = Subject(subject.files, subject.asset)
        one, two = (self.make().check(each).table() for each in (subject, again))
        assert one == two, (
            "two runs must write the same report: leave times out, start generators from a seed"
        )

    def test_leaves_the_subject_alone(self, subject: Subject) -> None:
        folders = {path.parent for path in subject.files.values()}
        before = fingerprint(subject.asset), [folder_fingerprint(folder) for folder in sorted(folders)]
        self.make().check(subject)
        after = fingerprint(subject.asset), [folder_fingerprint(folder) for folder in sorted(folders)]
        assert after == before, "check() changed what it judges"

    def test_evidence_is_plain_json(self, subject: Subject) -> None:
        table = self.make().check(subject).table()
        try:
            text = json.dumps(table, allow_nan=False)
        except TypeError as error:
            pytest.fail(f"evidence goes into report.json: {error}; turn NumPy's values into Python's")
        assert json.loads(text) == table, "keys of evidence must be text"

    def test_nothing_to_judge_is_told(self) -> None:
        try:
            result = self.make().check(Subject())
        except BadInputError as error:
            assert str(error)  # noqa: PT017  either answer will do
        else:
            assert result.text


def _segmentation(asset: Asset) -> Segmentation:
    """What a perfect segmenter says of an asset."""
    parts = tuple(PartGuess(part.name, label=part.label) for part in asset.parts)
    return Segmentation(asset.face_part, parts, joints=asset.joints)


def _first_seen(labels: IntArray) -> IntArray:
    """(F,) labels numbered in the order in which they first appear."""
    _, first, inverse = np.unique(labels, return_index=True, return_inverse=True)
    rank: IntArray = np.argsort(np.argsort(first))
    return rank[inverse]
