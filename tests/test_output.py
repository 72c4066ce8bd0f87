"""The output folder: complete or untouched, and nothing of the user's lost."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

from simart_kit.errors import OutputError
from simart_kit.output import commit, forget_failure, hashes, keep_failure, staging


def write(folder: Path, **files: str) -> Path:
    """Files by name; two underscores stand for a slash, one for a dot."""
    for name, text in files.items():
        path = folder / name.replace("__", "/").replace("_", ".")
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    return folder


def contents(folder: Path) -> dict[str, str]:
    return {p.relative_to(folder).as_posix(): p.read_text() for p in folder.rglob("*") if p.is_file()}


def run(out: Path, **files: str) -> tuple[str, ...]:
    """What a run does: write aside with a record of the hashes, then commit."""
    with staging(out) as work:
        write(work, **files)
        (work / "provenance.json").write_text(json.dumps({"outputs": hashes(work)}))
        return commit(work, out)


def test_staging_is_inside_the_output_folder_and_gone_afterwards(tmp_path):
    out = tmp_path / "a" / "b"
    with staging(out) as work:
        assert work.parent == out
        assert work.stat().st_mode & 0o755 == 0o755
        write(work, x_txt="1")

    assert not (tmp_path / "a").exists()


def test_staging_is_gone_after_an_error_and_leaves_a_folder_that_was_there(tmp_path):
    write(tmp_path, mine_txt="mine")
    with pytest.raises(KeyboardInterrupt), staging(tmp_path):
        raise KeyboardInterrupt

    assert contents(tmp_path) == {"mine.txt": "mine"}
    assert [p.name for p in tmp_path.iterdir()] == ["mine.txt"]


def test_staging_removes_what_a_killed_run_left(tmp_path):
    write(tmp_path / ".simart-kit-dead", x_txt="1")
    with staging(tmp_path):
        assert not (tmp_path / ".simart-kit-dead").exists()


def test_a_folder_that_a_run_writes_to_is_closed_to_another(tmp_path):
    with staging(tmp_path) as work:
        with pytest.raises(OutputError, match="another run is writing to"), staging(tmp_path):
            pytest.fail("two runs write to one folder")
        assert work.is_dir()

    with staging(tmp_path):
        pass


def test_a_run_that_was_killed_does_not_keep_its_folder_closed(tmp_path):
    code = (
        "import os, pathlib, simart_kit.output as o; s = o.staging(pathlib.Path()); next(s.gen); os._exit(1)"
    )
    assert subprocess.run([sys.executable, "-c", code], cwd=tmp_path, check=False).returncode == 1
    assert list(tmp_path.glob(".simart-kit-*"))

    with staging(tmp_path) as work:
        assert list(tmp_path.iterdir()) == [work]


def test_a_name_that_no_folder_can_have_is_told(tmp_path):
    with pytest.raises(OutputError, match="name too long"), staging(tmp_path / ("x" * 300)):
        pytest.fail("there is no such folder")


@pytest.mark.parametrize("below", ["", "deep/er"])
def test_a_file_in_the_place_of_the_folder_is_told(tmp_path, below):
    write(tmp_path, out="mine")

    with pytest.raises(OutputError, match="choose another with --out"), staging(tmp_path / "out" / below):
        pytest.fail("must not get here")

    assert contents(tmp_path) == {"out": "mine"}


@pytest.mark.skipif(os.geteuid() == 0, reason="root may write everywhere")
def test_a_read_only_folder_is_told(tmp_path):
    tmp_path.chmod(0o500)
    try:
        with pytest.raises(OutputError, match="Permission denied"), staging(tmp_path / "out"):
            pytest.fail("must not get here")
    finally:
        tmp_path.chmod(0o700)


def test_the_next_run_replaces_what_the_last_one_wrote(tmp_path):
    run(tmp_path, asset_json="1", usd__a_usda="1", usd__old_png="1")

    assert run(tmp_path, asset_json="2", usd__a_usda="2") == ()

    left = contents(tmp_path)
    assert left.pop("provenance.json")
    assert left == {"asset.json": "2", "usd/a.usda": "2"}


def test_a_format_that_the_next_run_does_not_write_stays(tmp_path):
    run(tmp_path, asset_json="1", urdf__a_urdf="1")
    run(tmp_path, asset_json="2", usd__a_usda="2")

    assert contents(tmp_path)["urdf/a.urdf"] == "1"


def test_changed_added_and_foreign_files_are_kept_under_another_name(tmp_path):
    write(tmp_path, preview_png="holiday")
    run(tmp_path, asset_json="1", usd__a_usda="1", mjcf__a_xml="1")
    write(tmp_path, asset_json="edited", usd__notes_txt="mine")

    kept = run(tmp_path, asset_json="2", usd__a_usda="2", mjcf__a_xml="2", preview_png="2")

    left = contents(tmp_path)
    assert left["asset.json"] == left["usd/a.usda"] == left["preview.png"] == "2"
    assert left["asset.json.bak1"] == "edited"
    assert (left["usd.bak1/a.usda"], left["usd.bak1/notes.txt"]) == ("1", "mine")
    assert left["preview.png.bak1"] == "holiday"
    assert sorted(text.split()[0] for text in kept) == ["asset.json", "preview.png", "usd"]


def test_every_backup_has_its_own_name(tmp_path):
    for text in "abc":
        run(tmp_path, asset_json="1")
        write(tmp_path, asset_json=text)
    run(tmp_path, asset_json="1")

    left = contents(tmp_path)
    assert [left[f"asset.json.bak{n}"] for n in (1, 2, 3)] == ["a", "b", "c"]


@pytest.mark.parametrize("record", ["", "[]", '{"outputs": 3}', '{"outputs": ["asset.json"]}'])
def test_with_a_damaged_record_nothing_counts_as_ours(tmp_path, record):
    run(tmp_path, asset_json="1")
    write(tmp_path, provenance_json=record)

    run(tmp_path, asset_json="2")

    left = contents(tmp_path)
    assert (left["asset.json"], left["asset.json.bak1"], left["provenance.json.bak1"]) == ("2", "1", record)


def test_a_link_in_the_way_is_told_before_anything_moves(tmp_path):
    out, elsewhere = tmp_path / "out", write(tmp_path / "elsewhere", a_usda="mine")
    run(out, asset_json="1")
    (out / "usd").symlink_to(elsewhere)
    before = contents(out)

    with pytest.raises(OutputError, match="symbolic link"):
        run(out, asset_json="2", usd__a_usda="2")

    assert contents(out) == before
    assert contents(elsewhere) == {"a.usda": "mine"}


def test_a_failure_replaces_the_last_one_and_goes_with_the_next_success(tmp_path):
    for text in ("first", "second"):
        with staging(tmp_path) as work:
            keep_failure(write(work / "failed", error_txt=text), tmp_path)
    assert contents(tmp_path) == {"failed/error.txt": "second"}

    forget_failure(tmp_path)

    assert contents(tmp_path) == {}


def test_a_folder_of_the_users_called_failed_is_kept(tmp_path):
    write(tmp_path / "failed", exams_txt="mine")
    forget_failure(tmp_path)
    with staging(tmp_path) as work:
        keep_failure(write(work / "failed", error_txt="ours"), tmp_path)

    assert contents(tmp_path) == {"failed/error.txt": "ours", "failed.bak1/exams.txt": "mine"}
