"""Checks `files` and `lint`: folders that can be moved, and files that make sense."""

from __future__ import annotations

import shutil
from collections.abc import Callable
from pathlib import Path

import pytest

from simart_kit import Subject

from .checks_cases import cabinet, judged, mjcf, subject_in


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> Subject:
    return subject_in(tmp_path_factory.mktemp("made"), cabinet(), "urdf", "mjcf", "usd")


@pytest.fixture
def copied(made: Subject, tmp_path: Path) -> Subject:
    """The same files to be damaged."""
    files = {}
    for kind, path in made.files.items():
        shutil.copytree(path.parent, tmp_path / kind)
        files[kind] = tmp_path / kind / path.name
    return Subject(files, made.asset)


def first_mesh(subject: Subject) -> Path:
    return sorted((subject.files["urdf"].parent / "meshes").glob("*.obj"))[0]


def lose(subject: Subject) -> str:
    mesh = first_mesh(subject)
    mesh.unlink()
    return f"'meshes/{mesh.name}' does not exist"


def empty(subject: Subject) -> str:
    mesh = first_mesh(subject)
    mesh.write_text("")
    return f"urdf: meshes/{mesh.name} is empty"


def link(subject: Subject) -> str:
    mesh = first_mesh(subject)
    moved = mesh.parent.parent.parent / "elsewhere.obj"
    mesh.rename(moved)
    mesh.symlink_to(moved)
    return f"urdf: meshes/{mesh.name} is a link"


def name_absolutely(subject: Subject) -> str:
    mesh, path = first_mesh(subject), subject.files["urdf"]
    path.write_text(path.read_text().replace(f"meshes/{mesh.name}", f"/models/{mesh.name}"))
    return f"'/models/{mesh.name}' is absolute"


def name_outside(subject: Subject) -> str:
    mesh, path = first_mesh(subject), subject.files["urdf"]
    mesh.rename(mesh.parent.parent.parent / mesh.name)
    path.write_text(path.read_text().replace(f"meshes/{mesh.name}", f"../{mesh.name}"))
    return f"'../{mesh.name}' is outside the asset's folder"


def put_a_blank(subject: Subject) -> str:
    (subject.files["mjcf"].parent / "read me.txt").write_text("hello")
    return "mjcf: 'read me.txt' has characters that some loaders cannot read"


def drop_the_main_file(subject: Subject) -> str:
    subject.files["usd"].unlink()
    return "usd: cabinet.usda is missing"


DAMAGES = (lose, empty, link, name_absolutely, name_outside, put_a_blank, drop_the_main_file)


class TestFiles:
    def test_what_the_exporters_write_is_clean(self, made: Subject) -> None:
        result = judged("files", made)
        assert result.passed
        assert result.evidence == {"formats": {"urdf": [], "mjcf": [], "usd": []}}

    @pytest.mark.parametrize("damage", DAMAGES, ids=lambda damage: damage.__name__)
    def test_it_bites(self, damage: Callable[[Subject], str], copied: Subject) -> None:
        told = damage(copied)
        result = judged("files", copied)
        assert not result.passed
        assert told in result.text
        kind = "mjcf" if damage is put_a_blank else "usd" if damage is drop_the_main_file else "urdf"
        assert [k for k, texts in result.evidence["formats"].items() if texts] == [kind]

    def test_of_a_single_file_its_neighbours_are_not_judged(self, tmp_path: Path) -> None:
        subject = mjcf(tmp_path, '<body name="b"><geom type="box" size="1 1 1"/></body>')
        (tmp_path / "my holiday pictures.txt").write_text("")
        assert judged("files", subject).passed


class TestLint:
    def test_what_the_exporters_write_has_no_error(self, made: Subject) -> None:
        result = judged("lint", made)
        assert result.text == "no error in urdf, mjcf, usd"
        assert result.evidence == {"errors": [], "warnings": []}

    def test_an_axis_that_is_not_of_length_one(self, copied: Subject) -> None:
        path = copied.files["urdf"]
        text = path.read_text()
        assert text.count('xyz="0 0 1"') == 1
        path.write_text(text.replace('xyz="0 0 1"', 'xyz="0 0 2"'))
        result = judged("lint", copied)
        assert not result.passed
        assert "door_hinge" in result.text
        assert len(result.evidence["errors"]) == 1

    def test_many_errors_are_counted(self, tmp_path: Path) -> None:
        links = "".join(f'<link name="l{n}"/>' for n in range(6))
        path = tmp_path / "bare.urdf"
        path.write_text(f'<robot name="bare">{links}</robot>')
        result = judged("lint", Subject({"urdf": path}))
        assert not result.passed
        assert f"and {len(result.evidence['errors']) - 3} more" in result.text

    def test_files_that_are_missing_are_told_by_the_other_check(self, copied: Subject) -> None:
        lose(copied)
        assert judged("lint", copied).passed

    def test_a_damaged_file(self, tmp_path: Path) -> None:
        path = tmp_path / "half.urdf"
        path.write_text('<robot name="half"><link')
        assert "[unreadable]" in judged("lint", Subject({"urdf": path})).text
