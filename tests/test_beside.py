"""A second core: functions called in another process, and here where it cannot."""

from __future__ import annotations

import operator
import os
import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np
import pytest
from simart_kit_plugins.modifiers.collision import Collision
from simart_kit_plugins.modifiers.sweep import Sweep
from simart_kit_plugins.nano.asking import said_by
from simart_kit_plugins.nano.segmenter import Nano

import simart_kit as sk
from simart_kit import beside
from simart_kit.asset_io import save_asset
from simart_kit.beside import ALONE, Beside, modify_by
from simart_kit.drawing.preview import preview_png
from simart_kit.render import write_preview
from simart_kit.spec.protocols import segment_by
from simart_kit.testing.meshes import cabinet_asset, chain_asset


@pytest.fixture(autouse=True)
def _two_cores(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(beside, "usable_cores", lambda: 2)


@pytest.fixture(scope="module")
def helper() -> Iterator[Beside]:
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(beside, "usable_cores", lambda: 2)
        with Beside() as one:
            yield one


def test_another_process_calls_what_it_is_asked_for_in_order(helper: Beside) -> None:
    answers = [helper.ask(os.getpid), helper.ask(operator.add, 2, 3), helper.ask(os.getpid)]
    there, total, again = (answer.result() for answer in answers)
    assert there == again != os.getpid()
    assert total == 5


def test_arrays_come_back_as_they_are(helper: Beside) -> None:
    sent = np.random.default_rng(0).normal(size=(50_000, 3))
    np.testing.assert_array_equal(helper.ask(np.negative, sent).result(), -sent)


def test_what_is_asked_goes_on_while_this_process_does(helper: Beside) -> None:
    helper.ask(os.getpid).result()  # it has begun
    start = time.perf_counter()
    later = helper.ask(time.sleep, 1.0)
    assert time.perf_counter() - start < 0.8
    later.result()
    assert time.perf_counter() - start >= 1.0


class TestWhatIsNotWantedSoon:
    def test_is_called_behind_what_is_asked_for_next(self, helper: Beside) -> None:
        late = helper.ask_behind(time.monotonic)
        assert not late.runs
        assert helper.ask(time.monotonic).result() < late.result()

    def test_is_called_there_once_that_is_done(self, helper: Beside) -> None:
        late = helper.ask_behind(os.getpid)
        assert late.result() == os.getpid()  # nothing else was asked for
        late, there = helper.ask_behind(os.getpid), helper.ask(os.getpid).result()
        assert late.result() == there != os.getpid()

    def test_keeps_nobody_waiting_while_it_goes_on(self, helper: Beside) -> None:
        late = helper.ask_behind(time.sleep, 1.0)
        there = helper.ask(os.getpid).result()
        assert late.runs
        assert helper.ask(os.getpid).result() == os.getpid()
        assert late.runs
        late.result()
        assert helper.ask(os.getpid).result() == there


class TestWhatWaitsForSomethingElse:
    def test_is_done_here_if_it_is_wanted_before_its_turn(self, helper: Beside) -> None:
        first = helper.ask(time.sleep, 1.0)
        second, third = helper.ask(os.getpid), helper.ask(os.getpid)
        assert second.result() == second.result() == os.getpid()
        assert first.runs
        first.result()
        assert third.result() == helper.ask(os.getpid).result() != os.getpid()

    def test_and_is_not_wanted_soon_begins_when_it_is_told_to(self, helper: Beside) -> None:
        late = helper.ask_behind(os.getpid)
        helper.go_on()
        assert late.result() == helper.ask(os.getpid).result() != os.getpid()

    def test_is_not_begun_there_once_it_was_done_here(self, helper: Beside) -> None:
        late = helper.ask_behind(os.getpid)
        assert late.result() == os.getpid()
        helper.go_on()
        assert not late.runs
        assert late.result() == os.getpid()


def test_what_a_function_prints_is_no_answer(helper: Beside) -> None:
    assert helper.ask(print, "hello").result() is None
    assert helper.ask(operator.add, 1, 1).result() == 2


def test_a_function_of_the_caller_alone_is_called_here(helper: Beside) -> None:
    assert helper.ask(lambda: os.getpid()).result() == os.getpid()


def test_what_a_function_raises_is_raised_here_and_the_next_ones_are_called_here() -> None:
    with Beside() as one:
        assert one.helps
        wrong, right = one.ask(operator.truediv, 1, 0), one.ask(os.getpid)
        with pytest.raises(ZeroDivisionError):
            wrong.result()
        assert right.result() == os.getpid()


@pytest.mark.parametrize(
    "program",
    ["raise SystemExit(3)", "import sys; sys.stdin.read(1); raise SystemExit(3)", "print('no pickle')"],
    ids=["early", "late", "garbage"],
)
def test_what_the_process_cannot_do_is_done_here(program: str) -> None:
    with Beside(worker=(sys.executable, "-c", program)) as one:
        assert one.ask(os.getpid).result() == os.getpid()
        assert one.ask(operator.add, 1, 1).result() == 2


def test_where_no_process_can_be_started_all_is_done_here(tmp_path: Path) -> None:
    with Beside(worker=(str(tmp_path / "no such program"),)) as one:
        assert not one.helps
        assert one.ask(os.getpid).result() == os.getpid()


@pytest.mark.parametrize(("wanted", "cores"), [(False, 2), (True, 1)], ids=["not wanted", "one core"])
def test_a_single_core_has_no_process(monkeypatch: pytest.MonkeyPatch, wanted: bool, cores: int) -> None:
    monkeypatch.setattr(beside, "usable_cores", lambda: cores)
    with Beside(wanted) as one:
        assert not one.helps
        assert one.ask(os.getpid).result() == os.getpid()


def test_a_process_may_be_started_later() -> None:
    with Beside(False) as one:
        assert one.ask(os.getpid).result() == os.getpid()
        one.start()
        there = one.ask(os.getpid).result()
        one.start()
        assert one.ask(os.getpid).result() == there != os.getpid()


def test_leaving_early_ends_the_process(tmp_path: Path) -> None:
    note = tmp_path / "note"
    program = (
        f"import os, time; print(os.getpid(), file=open({str(note)!r}, 'w', buffering=1)); time.sleep(60)"
    )
    with Beside(worker=(sys.executable, "-c", program)) as one:
        one.ask(os.getpid)
        while not note.exists() or not note.read_text():
            time.sleep(0.01)
    with pytest.raises(ProcessLookupError):
        os.kill(int(note.read_text()), 0)


class TestWhatIsLeftToIt:
    def test_a_preview_is_the_same_picture(self, helper: Beside, tmp_path: Path) -> None:
        asset = cabinet_asset()
        helper.ask(write_preview, asset, tmp_path / "preview.png").result()
        assert (tmp_path / "preview.png").read_bytes() == preview_png(asset)

    @pytest.mark.parametrize("stage", [Collision(), Sweep()], ids=lambda stage: stage.name)
    @pytest.mark.parametrize("made", [cabinet_asset, chain_asset], ids=["cabinet", "chain"])
    def test_modifiers_make_the_same_of_an_asset(
        self,
        helper: Beside,
        stage: sk.Modifier,
        made: Callable[[], sk.Asset],
        monkeypatch: pytest.MonkeyPatch,
        tmp_path: Path,
    ) -> None:
        asked = []
        ask = helper.ask

        def listening(function, *args, **kwargs):
            asked.append(function)
            return ask(function, *args, **kwargs)

        monkeypatch.setattr(helper, "ask", listening)
        helped, alone = modify_by(stage, made(), helper), stage.modify(made())
        assert len(asked) > 0
        save_asset(helped, tmp_path / "helped")
        save_asset(alone, tmp_path / "alone")
        for name in ("asset.json", "parts.npz"):
            assert (tmp_path / "helped" / name).read_bytes() == (tmp_path / "alone" / name).read_bytes()

    def test_a_segmenter_finds_the_same_in_an_object(
        self, helper: Beside, monkeypatch: pytest.MonkeyPatch
    ) -> None:
        asked: list[object] = []
        ask = helper.ask
        monkeypatch.setattr(helper, "ask", lambda *args: asked.append(args[0]) or ask(*args))
        mesh = cabinet_asset().mesh
        helped, alone = (segment_by(Nano(), mesh, None, one) for one in (helper, ALONE))
        assert asked == [said_by]
        assert np.array_equal(helped.face_part, alone.face_part)
        assert (helped.joints, helped.notes) == (alone.joints, alone.notes)
        assert alone.joints

    def test_a_modifier_that_takes_no_help_is_asked_as_always(self, helper: Beside) -> None:
        class Remark(sk.Modifier):
            name = "remark"

            def modify(self, asset: sk.Asset) -> sk.Asset:
                return asset.with_notes("remark", "info", ["seen"])

        assert modify_by(Remark(), cabinet_asset(), helper).notes[-1].text == "seen"
        assert modify_by(Remark(), cabinet_asset(), ALONE).notes[-1].text == "seen"
