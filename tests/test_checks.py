"""All checks together: sound objects pass them in every format, and verdicts are told as they should be."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from simart_kit import Check, CheckResult, Options, Plugins, Subject
from simart_kit.asset import Asset
from simart_kit.checks import Fault, run_checks
from simart_kit.errors import BadInputError, RecipeError, StageError
from simart_kit.plugins import Registration
from simart_kit.recipe import Recipe, build_checks, load_recipe
from simart_kit.testing import fakes

from .checks_cases import BUILT_IN, NAMES, SOUND, judged, subject_in

ORDER = (
    *("files", "lint", "agreement", "mass", "collision", "joints", "penetration", "sweep", "travel"),
    *("settle", "gravity", "push", "energy", "timestep", "realtime"),
)


@pytest.fixture(params=SOUND)
def sound(request: pytest.FixtureRequest) -> Asset:
    return SOUND[request.param]()


def recipe_with(checks: dict[str, object]) -> Recipe:
    given = load_recipe("default", BUILT_IN)
    return given.model_copy(update={"checks": checks})


def all_verdicts(subject: Subject) -> tuple[CheckResult, ...]:
    return run_checks(build_checks(load_recipe("default", BUILT_IN), BUILT_IN), subject)


def test_the_checks_run_from_what_is_written_to_how_it_behaves() -> None:
    assert NAMES == ORDER


def test_sound_objects_pass_in_every_format_and_without_any(sound: Asset, tmp_path: Path) -> None:
    made = subject_in(tmp_path, sound, "urdf", "mjcf", "usd", "usdz", "glb")
    alone = [Subject({kind: path}) for kind, path in made.simulated.items()]
    for subject in (made, Subject({}, sound), *alone):
        results = all_verdicts(subject)
        assert tuple(r.name for r in results) == ORDER
        assert [r.text for r in results if not r.passed] == []


def test_files_for_looking_at_are_simulated_by_their_asset(sound: Asset, tmp_path: Path) -> None:
    subject = subject_in(tmp_path, sound, "usdz", "glb")
    assert subject.simulated == {}
    assert set(subject.simulation.mechanism.body) == {part.name for part in sound.parts}
    assert all(result.passed for result in all_verdicts(subject))


def test_what_is_simulated_is_the_first_of_mjcf_urdf_and_usd(tmp_path: Path) -> None:
    """Bodies of one asset, of which each file has lost another part, tell which was taken."""
    asset = SOUND["static"]()
    others = {kind: replace(asset, parts=(replace(asset.parts[0], name=kind),)) for kind in ("urdf", "usd")}
    files = {kind: subject_in(tmp_path, other, kind).files[kind] for kind, other in others.items()}
    assert set(Subject(files, asset).simulation.mechanism.body) == {"urdf"}
    assert set(Subject({"usd": files["usd"]}, asset).simulation.mechanism.body) == {"usd"}
    assert set(Subject({}, asset).simulation.mechanism.body) == {"body"}


def test_nothing_to_check_is_said_once() -> None:
    results = {result.name: result for result in all_verdicts(Subject())}
    assert results["files"].passed
    assert "nothing to check: give" in results["agreement"].text
    assert results["mass"].text == "cannot be judged, see agreement"
    assert not any(result.passed for name, result in results.items() if name not in ("files", "lint"))


class TestVerdicts:
    def test_plain_values_have_no_infinite_number(self) -> None:
        evidence = {"drift": float("nan"), "rows": [{"ratio": float("inf")}, (1, 2.5)], "told": "yes"}
        fault = Fault({"hinge": 0.5}, (1.0, 2.0, 3.0), 0.004, "door in body")
        table = CheckResult("mine", False, "no", evidence, fault).table()
        assert json.loads(json.dumps(table, allow_nan=False)) == table
        assert table["evidence"] == {"drift": None, "rows": [{"ratio": None}, [1, 2.5]], "told": "yes"}
        assert table["fault"]["point"] == [1.0, 2.0, 3.0]
        assert "fault" not in CheckResult("mine", True, "yes").table()

    def test_bad_input_is_a_failed_check_and_its_reason_is_told_once(self) -> None:
        damaged = BadInputError("box.xml is damaged")
        made = plugins_with(fakes.check(error=damaged, name="one"), fakes.check(error=damaged, name="two"))
        one, two = run_checks(made, Subject())
        assert (one.passed, one.text) == (False, "box.xml is damaged")
        assert (two.passed, two.text) == (False, "cannot be judged, see one")

    def test_any_other_error_names_the_plugin(self) -> None:
        with pytest.raises(StageError, match=r"check 'fake'.*no idea") as caught:
            run_checks(plugins_with(fakes.check(error=RuntimeError("no idea"))), Subject())
        assert isinstance(caught.value.__cause__, RuntimeError)


def plugins_with(*checks: type[Check]) -> list[tuple[Check, Registration]]:
    plugins = Plugins(installed=False, strict=True)
    for check in checks:
        plugins.register(fakes.plugin(check=check))
    names = {check.name for check in checks}
    return [pair for pair in build_checks(load_recipe("default", plugins), plugins) if pair[0].name in names]


class TestRecipe:
    def test_thresholds_reach_the_check(self) -> None:
        made = {
            check.name: check for check, _ in build_checks(recipe_with({"settle": {"tilt": 5.0}}), BUILT_IN)
        }
        assert made["settle"].options.tilt == 5.0  # type: ignore[attr-defined]

    def test_false_leaves_a_check_out(self) -> None:
        made = [check.name for check, _ in build_checks(recipe_with({"sweep": False}), BUILT_IN)]
        assert made == [name for name in ORDER if name != "sweep"]

    def test_a_resolved_recipe_spells_thresholds_out_and_repeats_them(self, tmp_path: Path) -> None:
        path = tmp_path / "mine.toml"
        path.write_text(
            'schema = 1\nextends = "urdf"\n[checks]\nsweep = false\n[checks.settle]\nspeed = 0.01\n'
        )
        recipe = load_recipe(str(path), BUILT_IN)
        assert recipe.checks["sweep"] is False
        settle = recipe.checks["settle"]
        assert settle == {"height": 0.02, "seconds": 3.0, "speed": 0.01, "tilt": 1.0} | {
            "sink": 0.005,
            "stands": 5.0,
        }
        (tmp_path / "provenance.json").write_text(json.dumps({"recipe": recipe.table()}))
        assert load_recipe(str(tmp_path / "provenance.json"), BUILT_IN) == recipe

    @pytest.mark.parametrize(
        ("line", "told"),
        [
            ("sette.tilt=5", "unknown check 'sette': known are agreement, collision, energy"),
            ("settle.tild=5", "tild: no such key (got 5), known are height, seconds, speed, tilt, sink"),
            ("settle.tilt=-5", "tilt"),
            ("settle=true", "settle"),
        ],
    )
    def test_mistakes_are_told_with_what_there_is(self, line: str, told: str) -> None:
        with pytest.raises(RecipeError) as caught:
            load_recipe("default", BUILT_IN, [f"checks.{line}"])
        assert told in str(caught.value)

    def test_a_check_of_a_plugin_runs_after_the_built_in_ones(self) -> None:
        plugins = Plugins(installed=False, strict=True)
        plugins.register(fakes.plugin(check=Color))
        recipe = load_recipe("default", plugins, ["checks.color.shade=0.5"])
        check, registration = build_checks(recipe, plugins)[-1]
        assert (check.name, check.options.shade) == ("color", 0.5)  # type: ignore[attr-defined]
        (result,) = run_checks([(check, registration)], Subject({}, SOUND["static"]()))
        assert result.text == "paler than 0.5"


class Color(Check):
    """Judges by the looks."""

    name = "color"

    class Options(Options):
        shade: float = 1.0

    options: Options

    def check(self, subject: Subject) -> CheckResult:
        return CheckResult(self.name, True, f"paler than {self.options.shade:g}")  # type: ignore[attr-defined]


def test_checks_answer_the_same_for_a_chair_placed_elsewhere() -> None:
    """Where an object stands in its frame changes no verdict."""
    asset = SOUND["cabinet"]()
    away = np.array([3.0, -2.0, 1.0])
    parts = {}
    for part in asset.parts:
        assert part.mass is not None
        x, y, z = (float(v) for v in np.array(part.mass.center) + away)
        shapes = tuple(replace(shape, vertices=shape.vertices + away) for shape in part.collision)
        parts[part.name] = replace(part, mass=replace(part.mass, center=(x, y, z)), collision=shapes)
    joints = {}
    for joint in asset.joints:
        x, y, z = (float(v) for v in np.array(joint.origin) + away)
        joints[joint.name] = replace(joint, origin=(x, y, z))
    mesh = replace(asset.mesh, vertices=asset.mesh.vertices + away)
    moved = replace(asset, mesh=mesh).with_parts(parts).with_joints(joints)
    for name in ("sweep", "settle", "push", "travel"):
        assert judged(name, Subject({}, moved)).passed, name
