"""Lint of USD tells of each seeded defect by exactly its rule, and of nothing in good files."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest
from pxr import Usd, UsdUtils
from simart_kit_exporters.usd import Usd as UsdExporter

import simart_kit as sk
from simart_kit import BadInputError
from simart_kit.lint import lint, lint_usd

from .lint_cases import assert_told, export, good_asset, rules, rules_of, seeded_usd
from .lint_usd_defects import DEFECTS, with_primitives, without_physics
from .real_objects import DATA
from .usd_cases import ASSETS


@pytest.fixture(scope="module")
def good(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("lint")
    (folder / "outside.png").write_bytes(b"")
    (folder / "outside.usda").write_text("#usda 1.0\n")
    return export(UsdExporter, good_asset(), folder / "usd")


@pytest.mark.parametrize("name", DEFECTS)
def test_defect_is_told_by_its_rule(name: str, good: Path) -> None:
    rule, defect = DEFECTS[name]
    assert_told(lint_usd(seeded_usd(good, name, defect)), rule)


def test_every_rule_on_usd_has_a_defect() -> None:
    assert {rule for rule, _ in DEFECTS.values()} | {"unreadable"} == rules_of("usd")


@pytest.mark.parametrize("name", ["chain", "kinds", "floating"])
def test_good_assets_have_no_findings(name: str, tmp_path: Path) -> None:
    assert lint(export(UsdExporter, ASSETS[name], tmp_path / "usd")) == ()


def test_good_file_has_no_findings(good: Path) -> None:
    assert lint(good) == ()


@pytest.mark.slow
@pytest.mark.parametrize("name", ["example", "jsk_fridge", "bigym_dishwasher"])
def test_exports_of_real_objects_have_no_errors(name: str, converted: Callable[[str], sk.Result]) -> None:
    if name != "example" and not DATA.is_dir():
        pytest.skip("no real objects at ../shared/data")
    paths = converted(name).paths
    assert {"usd", "urdf", "mjcf"} <= set(paths)
    found = [finding for form in ("usd", "urdf", "mjcf") for finding in lint(paths[form])]
    assert [str(finding) for finding in found if finding.severity == "error"] == []


def test_primitives_and_schemas_of_simulators_are_accepted(good: Path) -> None:
    assert lint(seeded_usd(good, "primitives", with_primitives)) == ()


@pytest.mark.parametrize("text", ["", "no USD", '#usda 1.0\ndef Xform "a" {'])
def test_damaged_file_is_a_finding(text: str, tmp_path: Path) -> None:
    path = tmp_path / "damaged.usda"
    path.write_text(text)
    assert rules(lint(path)) == {"unreadable"}


@pytest.mark.parametrize(("up", "expected"), [("Y", set()), ("Z", {"up-axis"})])
def test_package_for_ar_needs_no_physics_and_is_y_up(up: str, expected: set[str], tmp_path: Path) -> None:
    stage = Usd.Stage.CreateNew(str(tmp_path / "thing.usda"))
    without_physics(stage, up)
    stage.Save()
    assert UsdUtils.CreateNewUsdzPackage(str(tmp_path / "thing.usda"), str(tmp_path / "thing.usdz"))
    assert rules(lint(tmp_path / "thing.usdz")) == expected


def test_finding_names_the_prim(good: Path) -> None:
    (found,) = lint_usd(seeded_usd(good, "named", DEFECTS["mass_negative"][1]))
    assert (found.where.rpartition("/")[2], found.severity) == ("door", "error")


def test_other_files_are_refused(tmp_path: Path) -> None:
    (tmp_path / "a.glb").write_bytes(b"")
    with pytest.raises(BadInputError, match=r"a\.glb: cannot be linted: pick a file of \.urdf, \.xml, \.mjz"):
        lint(tmp_path / "a.glb")
    with pytest.raises(BadInputError, match=r"none\.usda: no such file"):
        lint(tmp_path / "none.usda")
