"""A picture that is begun before all is known: kept where it still shows the object, else drawn again."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from simart_kit_plugins.modifiers.collision import Collision
from simart_kit_plugins.modifiers.mass import Mass

import simart_kit as sk
from simart_kit.beside import ALONE, Beside
from simart_kit.drawing.preview import preview_png
from simart_kit.picturing import begun, finished
from simart_kit.testing.meshes import cabinet_asset


@pytest.fixture
def helper(monkeypatch: pytest.MonkeyPatch) -> Iterator[Beside]:
    monkeypatch.setattr("simart_kit.beside.usable_cores", lambda: 2)
    with Beside() as one:
        yield one


def test_shapes_and_masses_are_not_in_it(helper: Beside, tmp_path: Path) -> None:
    asset, path = cabinet_asset(textured=False), tmp_path / "preview.png"
    picture = begun(asset, path, helper)
    heavy = Collision().modify_beside(Mass().modify(asset), helper)  # which asks for shapes there
    assert picture.written.runs
    assert finished(picture, heavy, path, helper) is picture
    assert picture.written.result().read_bytes() == preview_png(heavy)


def _opened_less(asset: sk.Asset) -> sk.Asset:
    moving = next(joint for joint in asset.joints if joint.moves)
    assert moving.limits is not None
    half = replace(moving.limits, lower=moving.limits.lower / 2, upper=moving.limits.upper / 2)
    return asset.with_joints({moving.name: replace(moving, limits=half)})


def _renamed(asset: sk.Asset) -> sk.Asset:
    return replace(asset, name="cupboard")


def _wider(asset: sk.Asset) -> sk.Asset:
    return replace(asset, mesh=asset.mesh.transformed(np.diag([1.5, 1.0, 1.0, 1.0])))


@pytest.mark.parametrize("change", [_opened_less, _renamed, _wider])
def test_what_it_would_show_otherwise_is_drawn_again(
    change: Callable[[sk.Asset], sk.Asset], helper: Beside, tmp_path: Path
) -> None:
    asset, path = cabinet_asset(textured=False), tmp_path / "preview.png"
    picture, changed = begun(asset, path, helper), change(asset)
    again = finished(picture, changed, path, helper)
    assert again.written.result().read_bytes() == preview_png(changed) != preview_png(asset)


def test_without_another_process_it_is_drawn_when_it_is_wanted(tmp_path: Path) -> None:
    asset, path = cabinet_asset(textured=False), tmp_path / "preview.png"
    picture = finished(begun(asset, path, ALONE), asset, path, ALONE)
    assert not path.exists()
    assert picture.written.result().read_bytes() == preview_png(asset)
