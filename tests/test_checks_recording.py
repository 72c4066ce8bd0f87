"""A recording shows a failed check: the parts as they stood, and a mark where it failed."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from simart_kit_plugins.recorder import Recorder

from simart_kit import CheckResult, Subject
from simart_kit.assemble import Articulation
from simart_kit.asset import Asset
from simart_kit.checks import Fault
from simart_kit.kinematics import rest_to_posed
from simart_kit.report import Report

from .checks_cases import cabinet, judged
from .recordings import before_snap, paths_in, run_in, segmentation_of, source_of, transforms, values, views


def recorded(asset: Asset, checks: tuple[CheckResult, ...], folder: Path) -> Path:
    """The recording of a run that ended with these verdicts."""
    run, recorder = run_in(folder, asset.name), Recorder()
    recorder.run_started(run)
    for stage, name, value in (
        ("load", "glb", source_of(asset)),
        ("segment", "geometric", segmentation_of(asset)),
        ("joints", "geometric", Articulation(before_snap(asset))),
        ("modify", "snap", asset),
        ("check", "checks", checks),
    ):
        recorder.stage_finished(run, stage, name, value, 0.1)
    recorder.run_finished(run, Report(run.name, asset, checks, (), {}, ()))
    return folder / f"{run.name}.rrd"


@pytest.fixture(scope="module")
def asset() -> Asset:
    """A cabinet whose drawer opens backwards."""
    slide = replace(cabinet().joint("drawer_slide"), axis=(0.0, 1.0, 0.0))
    return cabinet().with_joints({"drawer_slide": slide})


@pytest.fixture(scope="module")
def failed(asset: Asset) -> CheckResult:
    return judged("sweep", Subject({}, asset))


@pytest.fixture(scope="module")
def path(asset: Asset, failed: CheckResult, tmp_path_factory: pytest.TempPathFactory) -> Path:
    passed = judged("mass", Subject({}, asset))
    return recorded(asset, (passed, failed), tmp_path_factory.mktemp("faults"))


def test_parts_stand_where_they_stood(asset: Asset, failed: CheckResult, path: Path) -> None:
    assert failed.fault is not None
    expected = rest_to_posed(asset, failed.fault.positions)
    for part, posed_T_rest in expected.items():
        times, found = transforms(path, f"/faults/sweep/{part}")
        assert times is None
        np.testing.assert_allclose(found, [posed_T_rest], atol=1e-6)
    # The drawer is drawn where it is deepest: 0.2175 m backwards.
    np.testing.assert_allclose(expected["drawer"][:3, 3], (0.0, 0.2175, 0.0), atol=1e-9)


def test_the_place_is_marked_and_named(failed: CheckResult, path: Path) -> None:
    assert failed.fault is not None
    (point,), _ = values(path, "/faults/sweep/where", "Points3D:positions")
    np.testing.assert_allclose(point, [failed.fault.point], atol=1e-6)
    (label,), _ = values(path, "/faults/sweep/where", "Points3D:labels")
    assert label[0].startswith("body in drawer, 18")
    assert label[0].endswith(" mm deep")


def test_it_has_a_view_of_its_own(path: Path) -> None:
    assert "faults/sweep" in views(path)["3D"]


def test_checks_that_passed_or_failed_nowhere_draw_nothing(asset: Asset, tmp_path: Path) -> None:
    fault = Fault({}, (0.0, 0.0, 0.0), 0.001, "a scratch")
    checks = (CheckResult("mine", True, "fine", fault=fault), CheckResult("other", False, "too heavy"))
    assert not any("faults" in entity for entity in paths_in(recorded(asset, checks, tmp_path)))


def test_positions_of_joints_that_only_the_file_has_are_left_out(asset: Asset, tmp_path: Path) -> None:
    fault = Fault({"renamed": 0.4, "drawer_slide": 0.1}, (0.0, 0.0, 0.0), 0.0, "stuck")
    shown = recorded(asset, (CheckResult("push", False, "stuck", fault=fault),), tmp_path)
    _, found = transforms(shown, "/faults/push/drawer")
    np.testing.assert_allclose(found[0][:3, 3], (0.0, 0.1, 0.0), atol=1e-6)
    (label,), _ = values(shown, "/faults/push/where", "Points3D:labels")
    assert label == ["stuck"]
