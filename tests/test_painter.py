"""The preview drawn beside other work: the same picture, and one in any case."""

from __future__ import annotations

import os
import sys
import time
from pathlib import Path

import pytest

from simart_kit.asset import Asset
from simart_kit.asset_io import save_asset
from simart_kit.drawing import painter
from simart_kit.drawing.painter import Painter
from simart_kit.drawing.preview import preview_png
from simart_kit.testing.meshes import cabinet_asset

MANY = 1_000_000


@pytest.fixture
def asset(tmp_path: Path) -> Asset:
    made = cabinet_asset()
    save_asset(made, tmp_path)
    return made


@pytest.fixture(autouse=True)
def _two_cores(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(painter, "usable_cores", lambda: 2)


def test_a_process_draws_the_same_picture(
    asset: Asset, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("simart_kit.render.write_preview", None)  # this process draws nothing
    with Painter(MANY) as beside:
        assert beside.begin(tmp_path)
        beside.finish(asset, tmp_path)
        assert (tmp_path / "preview.png").read_bytes() == preview_png(asset)


@pytest.mark.parametrize(
    "program",
    ["raise SystemExit(3)", "import sys; sys.stdin.read(); raise SystemExit(3)"],
    ids=["early", "late"],
)
def test_what_the_process_cannot_draw_is_drawn_here(asset: Asset, tmp_path: Path, program: str) -> None:
    with Painter(MANY, worker=(sys.executable, "-c", program)) as beside:
        assert beside.begin(tmp_path)
        beside.finish(asset, tmp_path)
    assert (tmp_path / "preview.png").read_bytes() == preview_png(asset)


def test_where_no_process_can_be_started_it_is_drawn_here(asset: Asset, tmp_path: Path) -> None:
    with Painter(MANY, worker=(str(tmp_path / "no such program"),)) as beside:
        assert not beside.begin(tmp_path)
        beside.finish(asset, tmp_path)
    assert (tmp_path / "preview.png").exists()


@pytest.mark.parametrize(
    ("faces", "alone", "cores"),
    [(100, False, 2), (MANY, True, 2), (MANY, False, 1)],
    ids=["few", "alone", "core"],
)
def test_a_small_mesh_a_recorded_run_and_a_single_core_need_no_process(
    asset: Asset, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, faces: int, alone: bool, cores: int
) -> None:
    monkeypatch.setattr(painter, "usable_cores", lambda: cores)
    monkeypatch.setattr("simart_kit.render.write_preview", lambda asset, path: path.write_bytes(b"picture"))
    with Painter(faces, alone=alone) as beside:
        assert not beside.begin(tmp_path)
        beside.finish(asset, tmp_path)
    assert (tmp_path / "preview.png").read_bytes() == b"picture"


def test_leaving_early_ends_the_process(tmp_path: Path) -> None:
    note = tmp_path / "note"
    program = (
        f"import os, time; print(os.getpid(), file=open({str(note)!r}, 'w', buffering=1)); time.sleep(60)"
    )
    with Painter(MANY, worker=(sys.executable, "-c", program)):
        while not note.exists() or not note.read_text():
            time.sleep(0.01)
    with pytest.raises(ProcessLookupError):
        os.kill(int(note.read_text()), 0)
