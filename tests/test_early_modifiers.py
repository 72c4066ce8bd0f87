"""Modifiers that begin while others still correct joints: when, on what, and whose mistake it is."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator
from copy import copy
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from simart_kit_plugins.modifiers.collision import Collision

import simart_kit as sk
from simart_kit.beside import ALONE, Beside, begun_by, modify_by
from simart_kit.decompose import Budget, Decomposition, Surface, decompose_surface
from simart_kit.errors import StageError
from simart_kit.testing import fakes
from simart_kit.testing.fingerprint import fingerprint
from simart_kit.testing.meshes import boxes_mesh, cabinet_asset

from .test_wheels import cart, rim
from .workshop import RECIPE, Workshop


@pytest.fixture
def shop(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Workshop:
    monkeypatch.setattr("simart_kit.render.write_preview", lambda asset, path: path.write_bytes(b"picture"))
    monkeypatch.setattr("simart_kit.beside.usable_cores", lambda: 2)
    monkeypatch.setattr("simart_kit.pipeline._MANY", 0)
    return Workshop(tmp_path)


@pytest.fixture
def helper(monkeypatch: pytest.MonkeyPatch) -> Iterator[Beside]:
    monkeypatch.setattr("simart_kit.beside.usable_cores", lambda: 2)
    with Beside() as one:
        yield one


class Eager(sk.Modifier):
    """Tells what happens to it."""

    heard: list[str]

    def modify(self, asset: sk.Asset) -> sk.Asset:
        self.heard.append(f"{self.name} made")
        return asset

    def begun(self, asset: sk.Asset, beside: Beside) -> Eager:
        self.heard.append(f"{self.name} begun after {asset.notes[-1].text}")
        return copy(self)


def ran(shop: Workshop, *names: str, begin_fails: bool = False) -> list[str]:
    """What the modifiers of a recipe tell; those called `joint*` correct joints, `size*` change the asset."""
    heard: list[str] = []
    plugins = []
    for name in names:
        eager = type("Named", (Eager,), {"name": name, "heard": heard, "corrects_joints": "joint" in name})
        if name.startswith("size"):
            eager = fakes.modifier(lambda asset: asset.with_notes("size", "info", ["sized"]), name=name)
        if begin_fails:
            eager.begun = lambda self, asset, beside: 1 / 0  # type: ignore[attr-defined]
        plugins.append(fakes.plugin(modifier=eager))
    uses = "".join(f'[[modify]]\nuse = "{name}"\n' for name in names)
    shop.recipe.write_text(RECIPE.replace('[[modify]]\nuse = "fake_note"\n', uses))
    shop.run(observers=tuple(plugins))
    return heard


def test_what_comes_after_the_first_that_corrects_joints_begins_before_it_and_once(shop: Workshop) -> None:
    assert ran(shop, "first", "size", "joints", "joints_again", "shapes") == [
        "first made",
        "joints_again begun after sized",
        "shapes begun after sized",
        "joints made",
        "joints_again made",
        "shapes made",
    ]


def test_nothing_begins_early_where_no_joint_is_corrected(shop: Workshop) -> None:
    assert ran(shop, "size", "shapes") == ["shapes made"]


def test_nothing_begins_early_on_one_core(shop: Workshop, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("simart_kit.beside.usable_cores", lambda: 1)
    assert ran(shop, "joints", "shapes") == ["joints made", "shapes made"]


def test_one_that_cannot_begin_is_named(shop: Workshop) -> None:
    with pytest.raises(StageError, match=r"modifier 'shapes' failed .*ZeroDivisionError"):
        ran(shop, "joints", "shapes", begin_fails=True)
    assert [joint.name for joint in sk.load_asset(shop.out / "failed" / "input").joints] == [
        "door_hinge",
        "drawer_slide",
    ]


def tower(boxes: int = 9) -> sk.Asset:
    """Boxes one above the other with gaps, the topmost of which slides up."""
    mesh = boxes_mesh([((0, 0, 2 * i), (1, 1 + i % 2, 2 * i + 1)) for i in range(boxes)])
    slide = sk.Joint("slide", "prismatic", "body", "top", axis=(0, 0, 1), limits=sk.Limits(0, 0.5))
    labels = np.repeat([0, 1], [12 * (boxes - 1), 12]).astype(np.int32)
    return sk.Asset("tower", mesh, labels, (sk.Part("body"), sk.Part("top")), (slide,))


def _relabelled() -> tuple[sk.Asset, sk.Asset]:
    asset = tower()
    labels = np.array(asset.face_part)
    labels[-24:] = 1
    return replace(asset, face_part=labels), asset


def _widened() -> tuple[sk.Asset, sk.Asset]:
    asset = tower()
    return asset, replace(asset, mesh=asset.mesh.transformed(np.diag([1.5, 1.0, 1.0, 1.0])))


def _rolling() -> tuple[sk.Asset, sk.Asset]:
    asset = cart(rim(), kind="fixed")  # the rim has most of the faces
    return asset, asset.with_joints({"spin": replace(asset.joint("spin"), kind="continuous")})


class TestCollision:
    def begun(self, asset: sk.Asset, helper: Beside) -> sk.Modifier:
        begun = begun_by(Collision(), asset, helper)
        helper.ask(os.getpid).result()  # it answers in order
        return begun

    @pytest.mark.parametrize(
        ("made", "started", "faces"),
        [(tower, False, [96]), (tower, True, [12]), (lambda: tower(3), True, [24])],
        ids=["on time", "early", "no need"],
    )
    def test_makes_what_another_process_did_not_begin(
        self,
        made: Callable[[], sk.Asset],
        started: bool,
        faces: list[int],
        helper: Beside,
        monkeypatch: pytest.MonkeyPatch,
    ) -> None:
        here: list[int] = []

        def listening(surface: Surface, budget: Budget) -> Decomposition:
            here.append(len(surface.faces))
            return decompose_surface(surface, budget)

        asset = made()
        stage = self.begun(asset, helper) if started else Collision()
        monkeypatch.setattr("simart_kit_plugins.modifiers.shaping.decompose_surface", listening)
        higher = replace(asset.joint("slide"), limits=sk.Limits(0, 1))
        modify_by(stage, asset.with_joints({"slide": higher}), helper)
        assert here == faces

    @pytest.mark.parametrize("made", [_relabelled, _widened, _rolling])
    def test_takes_nothing_of_other_surfaces_or_parts(
        self, made: Callable[[], tuple[sk.Asset, sk.Asset]], helper: Beside
    ) -> None:
        asset, changed = made()
        stage = self.begun(asset, helper)
        assert fingerprint(modify_by(stage, changed, helper)) == fingerprint(Collision().modify(changed))

    def test_is_itself_where_nobody_helps(self) -> None:
        stage = Collision()
        assert begun_by(stage, cabinet_asset(), ALONE) is stage
