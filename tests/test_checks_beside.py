"""Checks that drive one joint after the other: of many joints they are run by another process."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from simart_kit_plugins.modifiers.collision import Collision
from simart_kit_plugins.modifiers.mass import Mass

from simart_kit import Asset, Check, CheckResult, Joint, Limits, Part, Subject
from simart_kit.beside import Beside
from simart_kit.checks import run_checks
from simart_kit.checks.push import Push
from simart_kit.checks.simulation import Simulation
from simart_kit.checks.travel import Travel
from simart_kit.errors import BadInputError, StageError
from simart_kit.recipe import build_checks, load_recipe
from simart_kit.testing import fakes
from simart_kit.testing.fingerprint import fingerprint
from simart_kit.testing.meshes import boxes_mesh

from .checks_cases import BUILT_IN, subject_in
from .test_checks import ORDER, plugins_with


@pytest.fixture
def helper(monkeypatch: pytest.MonkeyPatch) -> Iterator[Beside]:
    monkeypatch.setattr("simart_kit.beside.usable_cores", lambda: 2)
    with Beside() as one:
        yield one


def drawers(count: int) -> Asset:
    """Boxes in a row behind a board, which slide apart from it, ready to be simulated."""
    row = [((0.3 * k, -0.4, 0.0), (0.3 * k + 0.2, -0.02, 0.2)) for k in range(count)]
    mesh = boxes_mesh([((0, 0, 0), (0.3 * count, 0.05, 0.4)), *row])
    names = [f"drawer_{k}" for k in range(count)]
    joints = [
        Joint(
            f"{name}_slide", "prismatic", "body", name, axis=(0, -1, 0), limits=Limits(0, 0.2), friction=0.5
        )
        for name in names
    ]
    labels = np.repeat(np.arange(count + 1), 12).astype(np.int32)
    parts = tuple(Part(name) for name in ("body", *names))
    return Collision().modify(Mass().modify(Asset("drawers", mesh, labels, parts, tuple(joints))))


def all_checks() -> list[tuple[Check, object]]:
    return build_checks(load_recipe("default", BUILT_IN), BUILT_IN)


def driven(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """Names of the driving checks that this process runs from now on."""
    ran: list[str] = []
    for stage in (Travel, Push):
        check = stage.check

        def listening(self: Check, subject: Subject, check=check) -> CheckResult:
            ran.append(self.name)
            return check(self, subject)

        monkeypatch.setattr(stage, "check", listening)
    return ran


@pytest.mark.parametrize(("count", "here"), [(7, True), (8, False)], ids=["few", "many"])
def test_verdicts_are_the_same_and_in_order(
    count: int, here: bool, helper: Beside, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    subject = subject_in(tmp_path, drawers(count), "mjcf")
    alone = run_checks(all_checks(), Subject(subject.files, subject.asset))
    ran = driven(monkeypatch)
    helped = run_checks(all_checks(), subject, helper)
    assert [result.table() for result in helped] == [result.table() for result in alone]
    assert tuple(result.name for result in helped) == ORDER
    assert [result.text for result in helped if not result.passed] == []
    # The other one is run here where this process is through with the rest before its turn.
    assert ("travel" in ran) is here


def test_with_nobody_to_help_the_files_are_read_once(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    read, of_file = list[Path](), Simulation.of_file

    def listening(path: Path) -> Simulation:
        read.append(path)
        return of_file(path)

    monkeypatch.setattr(Simulation, "of_file", listening)
    subject = subject_in(tmp_path, drawers(8), "mjcf")
    run_checks([pair for pair in all_checks() if pair[0].drives], subject)
    assert read == [subject.files["mjcf"]]


def test_files_that_do_not_load_are_told_once(helper: Beside, tmp_path: Path) -> None:
    damaged = tmp_path / "drawers.xml"
    damaged.write_text("<mujoco><body")
    subject = Subject({"mjcf": damaged}, drawers(8))
    chosen = [pair for pair in all_checks() if pair[0].name in ("travel", "push")]
    helped, alone = run_checks(chosen, subject, helper), run_checks(chosen, subject.bare())
    assert helped == alone
    assert "drawers.xml" in helped[0].text
    assert helped[1].text == "cannot be judged, see travel"


@pytest.mark.parametrize("error", [RuntimeError("no idea"), BadInputError("box.xml is damaged")])
def test_a_check_of_a_plugin_that_fails_is_told_as_ever(error: Exception, helper: Beside) -> None:
    driving = fakes.check(error=error)
    driving.drives = True
    checks, subject = plugins_with(driving), Subject({}, drawers(8))
    if isinstance(error, BadInputError):
        (result,) = run_checks(checks, subject, helper)
        assert (result.passed, result.text) == (False, "box.xml is damaged")
    else:
        with pytest.raises(StageError, match=r"check 'fake'.*no idea"):
            run_checks(checks, subject, helper)


def test_what_is_sent_is_without_what_was_worked_out(tmp_path: Path) -> None:
    subject = subject_in(tmp_path, drawers(2), "mjcf")
    assert subject.simulation.model.njnt == 2
    sent = subject.bare()
    assert set(vars(sent)) == {"files", "asset"}
    assert sent.asset is not None
    assert fingerprint(sent.asset) == fingerprint(subject.asset)
    assert (subject.moving, Subject().moving) == (2, 0)
