"""One more export of a converted folder, after a person edited the asset in it."""

import json
from pathlib import Path

import pytest

import simart_kit as sk
from simart_kit.asset_io import save_asset
from simart_kit.errors import BadInputError, RecipeError, StageError, UnknownPluginError
from simart_kit.exports import export_folder
from simart_kit.output import hashes
from simart_kit.plugins import Plugins
from simart_kit.testing.meshes import cabinet_asset


class Text(sk.Exporter):
    """The range of each joint as text."""

    name = "fake_text"

    class Options(sk.Options):
        greeting: str = "hello"

    options: Options

    def export(self, asset: sk.Asset, directory: Path) -> Path:
        if asset.joints[0].confidence == 0.0:
            (directory / "half.txt").write_text("half")
            raise RuntimeError("I do not trust this")
        main = directory / "main.txt"
        lines = [f"{j.name} {j.limits.lower:g} {j.limits.upper:g}\n" for j in asset.joints if j.limits]
        main.write_text("".join([self.options.greeting, "\n", *lines]))
        return main

    def unsupported(self, asset: sk.Asset) -> tuple[str, ...]:
        return ("text has no shape",)


class Fakes:
    @sk.hookimpl
    def register_exporters(self, register):
        register(Text)


@pytest.fixture
def plugins() -> Plugins:
    plugins = Plugins(installed=False)
    plugins.register(Fakes())
    return plugins


@pytest.fixture
def folder(tmp_path) -> Path:
    save_asset(cabinet_asset(), tmp_path)
    record = {"schema": 1, "outputs": hashes(tmp_path)}
    (tmp_path / "provenance.json").write_text(json.dumps(record))
    return tmp_path


def edit(folder: Path, change) -> None:
    table = json.loads((folder / "asset.json").read_text())
    change(table)
    (folder / "asset.json").write_text(json.dumps(table))


def set_recipe(folder: Path, options: dict) -> None:
    recipe = {
        "schema": 1,
        "segmenter": {"use": "gone"},
        "joints": {"use": "gone"},
        "export": [{"use": "fake_text", "options": options}],
    }
    record = json.loads((folder / "provenance.json").read_text())
    (folder / "provenance.json").write_text(json.dumps(record | {"recipe": recipe}))


def test_an_edited_joint_reaches_the_export(folder, plugins):
    edit(folder, lambda table: table["joints"][0]["limits"].update(lower=-1.25))

    exported = export_folder(folder, "fake_text", plugins)

    assert exported.main == folder / "fake_text" / "main.txt"
    assert exported.main.read_text() == "hello\ndoor_hinge -1.25 0\ndrawer_slide 0 0.3\n"
    assert exported.unsupported == ("text has no shape",)


def test_the_record_tells_what_the_export_was_made_from(folder, plugins):
    export_folder(folder, "fake_text", plugins)

    record = json.loads((folder / "provenance.json").read_text())
    actual = hashes(folder)
    assert record["outputs"] == actual
    assert record["exports"]["fake_text"]["asset_sha256"] == actual["asset.json"]


@pytest.mark.parametrize(
    ("change", "field"),
    [
        (lambda t: t["joints"][0]["limits"].update(upper="wide"), "joints.0.limits.upper"),
        (lambda t: t["joints"][1].update(kind="sliding"), "joints.1.kind"),
        (lambda t: t["joints"][1].update(speed=3), "joints.1.speed"),
        (lambda t: t["joints"][0].update(parent="hull"), "joint 'door_hinge' names part 'hull'"),
        (lambda t: t["joints"][0].update(axis=[0, 0, 2]), "joint 'door_hinge': axis"),
        (lambda t: t["parts"][2]["mass"].update(mass=-1), "parts.2.mass.mass"),
    ],
)
def test_a_wrong_edit_is_told_with_its_field_and_nothing_is_written(folder, plugins, change, field):
    edit(folder, change)
    before = hashes(folder)

    with pytest.raises(BadInputError) as caught:
        export_folder(folder, "fake_text", plugins)

    assert field in str(caught.value)
    assert hashes(folder) == before


def test_a_failing_exporter_is_named_and_the_folder_stays_as_it_was(folder, plugins):
    export_folder(folder, "fake_text", plugins)
    edit(folder, lambda table: table["joints"][0].update(confidence=0.0))
    before = hashes(folder)

    with pytest.raises(StageError, match=r"exporter 'fake_text' failed .*I do not trust this"):
        export_folder(folder, "fake_text", plugins)

    assert hashes(folder) == before
    assert sorted(p.name for p in folder.iterdir()) == [
        "asset.json",
        "fake_text",
        "parts.npz",
        "provenance.json",
    ]


def test_a_second_export_replaces_the_first_but_keeps_what_a_person_changed(folder, plugins):
    export_folder(folder, "fake_text", plugins)
    assert export_folder(folder, "fake_text", plugins).kept == ()

    (folder / "fake_text" / "main.txt").write_text("mine")
    exported = export_folder(folder, "fake_text", plugins)

    assert len(exported.kept) == 1
    assert (folder / "fake_text.bak1" / "main.txt").read_text() == "mine"
    assert exported.main.read_text().startswith("hello")


def test_the_options_of_the_run_that_made_the_folder_are_used_again(folder, plugins):
    set_recipe(folder, {"greeting": "ahoy"})

    assert export_folder(folder, "fake_text", plugins).main.read_text().startswith("ahoy\n")


def test_options_that_no_longer_fit_are_told(folder, plugins):
    set_recipe(folder, {"farewell": "bye"})

    with pytest.raises(RecipeError, match=r"farewell.*known are greeting"):
        export_folder(folder, "fake_text", plugins)


def test_a_folder_without_a_record_can_be_exported(folder, plugins):
    (folder / "provenance.json").unlink()

    assert export_folder(folder, "fake_text", plugins).main.is_file()


def test_an_unknown_format_names_those_that_exist(folder, plugins):
    with pytest.raises(UnknownPluginError, match=r"unknown exporter 'fbx': known are .*fake_text"):
        export_folder(folder, "fbx", plugins)


def test_a_folder_without_an_asset_is_told(tmp_path, plugins):
    with pytest.raises(BadInputError, match=r"has no asset\.json"):
        export_folder(tmp_path, "fake_text", plugins)
