"""README.md says what is true: its code and its commands run, its tables list what there is."""

import io
import re
import shlex
import shutil
from contextlib import redirect_stdout
from pathlib import Path
from typing import get_args

import numpy as np
import pytest
from simart_kit_plugins.loaders import trimesh_loader, usd_loader

from simart_kit.asset import JointKind
from simart_kit.cli.main import FAILED, INTERRUPTED, READER_GONE, USAGE, run
from simart_kit.plugins import Plugins

ROOT = Path(__file__).resolve().parents[1]
TEXT = (ROOT / "README.md").read_text(encoding="utf-8")
PAGES = (ROOT / "README.md", ROOT / "examples" / "README.md", *sorted((ROOT / "docs").glob("*.md")))
IMAGES = sorted((ROOT / "docs" / "images").glob("*.png"))
# Opening a viewer needs a display.
COMMANDS = [
    line for line in re.findall(r"^    simart-kit (.+)$", TEXT, re.MULTILINE) if "inspect" not in line
]


@pytest.fixture
def home(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A working directory with the files that the page speaks of."""
    shutil.copy(ROOT / "examples" / "cabinet.glb", tmp_path)
    shutil.copytree(ROOT / "examples", tmp_path / "examples")
    monkeypatch.chdir(tmp_path)
    return tmp_path


def rows(title: str) -> list[list[str]]:
    """Cells of the table below a heading, without its head."""
    table = TEXT.split(f"### {title}\n", 1)[1].lstrip().split("\n\n", 1)[0]
    return [[cell.strip() for cell in line.strip("|").split("|")] for line in table.splitlines()[2:]]


def quoted(cell: str) -> list[str]:
    return re.findall(r"`\.?([\w-]+)`", cell)


@pytest.mark.slow
def test_python_block_does_what_its_comments_say(home: Path) -> None:
    (code,) = re.findall(r"^```python\n(.*?)^```", TEXT, re.MULTILINE | re.DOTALL)
    names: dict[str, object] = {}
    printed = io.StringIO()

    with redirect_stdout(printed):
        exec(compile(code, "README.md", "exec"), names)

    first, second, *_ = printed.getvalue().splitlines()
    assert first.startswith("5 parts, 4 joints: left_door (revolute), ")
    assert second == "out/cabinet/usd/cabinet.usda"
    door = names["world_T_part"]["left_door"]
    assert np.arccos((np.trace(door[:3, :3]) - 1) / 2) == pytest.approx(0.6)


@pytest.mark.slow
def test_commands_run_in_the_order_of_the_page(home: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    # Pictures of conversions have tests of their own.
    monkeypatch.setattr("simart_kit.render.write_preview", lambda asset, path: path)
    assert len(COMMANDS) >= 6
    for command in COMMANDS:
        words = shlex.split(command, comments=True)
        assert run([*words, "--no-record"] if words[0] == "convert" else words) == 0, command
    assert (home / "chest" / "usd" / "cabinet.usda").is_file()


def test_input_table_lists_every_format_with_its_up_axis() -> None:
    told = {suffix: cells[1] for cells in rows("Input") for suffix in quoted(cells[0])}
    assert set(told) == {*trimesh_loader.UP, *usd_loader.KINDS}
    for suffix, up in trimesh_loader.UP.items():
        assert up in told[suffix], suffix


def test_output_table_lists_every_exporter() -> None:
    plugins = Plugins(installed=False, strict=True)
    exporters = {r.name for r in plugins.registrations("exporter")}
    assert {quoted(cells[0])[0] for cells in rows("Output")} == exporters


def test_joint_table_lists_every_kind() -> None:
    assert [quoted(cells[0])[0] for cells in rows("Joints")] == list(get_args(JointKind))


def test_exit_codes_are_those_of_the_command_line() -> None:
    told = set(map(int, re.findall(r"^\| (\d+) \|", TEXT, re.MULTILINE)))
    assert told == {0, FAILED, USAGE, INTERRUPTED, READER_GONE}


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.relative_to(ROOT).as_posix())
def test_links_lead_somewhere(page: Path) -> None:
    links = re.findall(r"\]\(([^)#]+)", page.read_text(encoding="utf-8"))
    local = [link for link in links if "://" not in link]
    missing = [link for link in local if not (page.parent / link).exists()]
    # What the wheel is tested with is no whole checkout.
    elsewhere = () if (ROOT / "LICENSE").exists() else ("LICENSE", "CHANGELOG.md", "plugins/")
    assert [link for link in missing if not link.startswith(elsewhere)] == []


@pytest.mark.parametrize("image", IMAGES, ids=lambda image: image.name)
def test_pictures_are_shown_and_small(image: Path) -> None:
    assert f"(docs/images/{image.name})" in TEXT
    assert image.stat().st_size < 400_000
