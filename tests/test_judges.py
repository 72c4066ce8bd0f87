"""The light judges find nothing wrong with what we write, and all that is put in on purpose."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterable
from pathlib import Path

import pytest

import simart_kit as sk
from simart_kit.asset import Asset
from simart_kit.asset_io import save_asset
from simart_kit.exports import export_folder
from simart_kit.testing.meshes import chain_asset, static_asset

from .export_cases import primitives_asset
from .judges import asking
from .judges.__main__ import ask, main
from .judges.asking import verdicts
from .judges.panel import HERE, JUDGES, Judge
from .judges.seeding import DEFECTS, seeded

Folders = dict[str, Path]
LIGHT = [judge for judge in JUDGES if judge.light]


def written(assets: Iterable[tuple[str, Asset]], home: Path, formats: Iterable[str]) -> Folders:
    """Output folders of assets by name."""
    plugins, folders = sk.Plugins(installed=False), {}
    for name, asset in assets:
        folders[name] = home / name
        save_asset(asset, folders[name])
        for form in formats:
            export_folder(folders[name], form, plugins)
    return folders


@pytest.fixture(scope="module")
def robots(tmp_path_factory: pytest.TempPathFactory) -> Folders:
    """URDF of an asset with two joints in a row, and of one without."""
    assets = {"chain": chain_asset(), "static": static_asset()}
    return written(assets.items(), tmp_path_factory.mktemp("robots"), ["urdf"])


@pytest.mark.slow
def test_light_judges_see_every_defect_and_find_none_in_what_we_write(
    converted: Callable[[str], sk.Result], tmp_path: Path
) -> None:
    made = {"chain": chain_asset(), "shapes": primitives_asset(), "static": static_asset()}
    assets = {"example": converted("example").asset, **made}
    folders = written(assets.items(), tmp_path, {judge.format for judge in LIGHT})
    hearings = [ask(judge, folders, folders["shapes"], tmp_path) for judge in LIGHT]
    errors = {(h.judge, name): v.errors for h in hearings for name, v in h.verdicts.items()}
    assert errors == {(judge.name, name): () for judge in LIGHT for name in folders}
    assert {h.judge: h.missed for h in hearings} == {judge.name: () for judge in LIGHT}
    assert not any(h.failed for h in hearings)


def test_the_table_names_object_judge_and_defect(
    robots: Folders, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    broken = seeded(robots["chain"], "urdf", "collider", tmp_path)
    options = ["judges", "--judges", "mujoco-urdf", str(broken), str(robots["static"])]
    monkeypatch.setattr(sys, "argv", options)
    assert main() == 1
    lines = capsys.readouterr().out.splitlines()
    assert [line.split() for line in lines[1:3]] == [["chain", "1"], ["static", "."]]
    assert any("2 files    1 errors" in line for line in lines)
    assert "  1 x 'base' has 0 collision shapes, 1 were written [chain]" in lines


def test_no_error_is_success(
    robots: Folders, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(sys, "argv", ["judges", "--judges", "mujoco-urdf", str(robots["static"])])
    assert main() == 0
    assert "0 errors" in capsys.readouterr().out


def test_an_unknown_judge_is_refused_with_those_that_there_are(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(sys, "argv", ["judges", "--judges", "mujoko"])
    assert main() == 2
    assert "no mujoko: there are mujoco-urdf, yourdfpy" in capsys.readouterr().err


def fake(script: Path, text: str) -> Judge:
    """A judge that is a few lines of Python; `asset` is the object and `say` writes its reading."""
    start = (
        "import json, os, sys",
        "jobs = json.load(open(sys.argv[1], encoding='utf-8'))",
        "def say(asset, *errors):",
        "    print(json.dumps({'asset': asset, 'errors': errors, 'seconds': 0}), flush=True)",
        "for asset in [job['asset'] for job in jobs]:",
    )
    script.write_text("\n".join([*start, f"    {text}"]), encoding="utf-8")
    return Judge("fake", "urdf", str(script), ())


def test_a_file_that_ends_the_judge_is_named_and_the_others_are_judged(
    robots: Folders, tmp_path: Path
) -> None:
    judge = fake(tmp_path / "judge.py", "say(asset) if asset == 'static' else os._exit(3)")
    found = verdicts(judge, robots, tmp_path)
    assert {name: verdict.errors for name, verdict in found.items()} == {
        "chain": ("exit code 3: ",),
        "static": (),
    }


def test_a_heavy_judge_is_asked_again_when_the_file_has_changed(
    robots: Folders, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    folder = seeded(robots["chain"], "urdf", "mass", tmp_path)
    count = f"open({str(tmp_path / 'asked')!r}, 'a').write('x')"
    script = fake(tmp_path / "judge.py", f"{count}; say(asset, 'wrong')").script
    monkeypatch.setattr(asking, "command", lambda judge, build: [sys.executable, script])
    heavy = Judge("fake", "urdf", script, (), "apt")
    for _ in range(2):
        assert verdicts(heavy, {"chain": folder}, tmp_path)["chain"].errors == ("wrong",)
    assert (tmp_path / "asked").read_text() == "x"
    DEFECTS["urdf"]["axis"](folder / "urdf" / "chain.urdf")
    assert verdicts(heavy, {"chain": folder}, tmp_path)["chain"].errors == ("wrong",)
    assert (tmp_path / "asked").read_text() == "xx"


def test_a_judge_that_only_an_administrator_can_install_is_not_asked_and_says_so(
    robots: Folders, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("shutil.which", lambda name: None)
    monkeypatch.setattr("os.geteuid", lambda: 1000)
    (judge,) = [judge for judge in JUDGES if judge.home == "apt"]
    hearing = ask(judge, robots, None, tmp_path)
    assert hearing.absent == "not asked: no check_urdf: apt-get install liburdfdom-tools"
    assert not hearing.verdicts
    assert not hearing.failed


def test_every_judge_has_a_script_pinned_requirements_and_defects_to_see() -> None:
    for judge in JUDGES:
        assert judge.script_path.exists(), judge.name
        assert judge.sees, judge.name
        assert set(judge.sees) <= set(DEFECTS[judge.format]), judge.name
        assert judge.light or judge.home in ("apt", "npm") or judge.requirements, judge.name
    for path in (HERE / "requirements").glob("*.txt"):
        lines = path.read_text(encoding="utf-8").splitlines()
        assert all("==" in line for line in lines if not line.startswith("#")), path.name
