"""The testing kit: fakes do what they are told, fixtures run recipes, nothing heavy is imported."""

import subprocess
import sys
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import simart_kit as sk
from simart_kit import hookspecs
from simart_kit.doctor import examine
from simart_kit.findings import Finding
from simart_kit.testing import fakes, meshes
from simart_kit.testing.fingerprint import fingerprint
from simart_kit.testing.pytest_plugin import RunRecipe

CABINET = meshes.cabinet_asset()
GUESSES = tuple(sk.PartGuess(part.name) for part in CABINET.parts)
RECIPE = {
    "schema": 1,
    "segmenter": {"use": "fake"},
    "joints": {"use": "fake"},
    "modify": [{"use": "fake"}],
    "export": [{"use": "fake"}],
}


def hook_names() -> set[str]:
    return {name for name, value in vars(hookspecs).items() if hasattr(value, "simart_kit_spec")}


def test_fingerprint_sees_every_bit() -> None:
    mesh = meshes.cabinet_mesh()
    nudged = mesh.vertices.copy()
    nudged[7, 2] = np.nextafter(nudged[7, 2], 9)
    assert fingerprint(mesh) == fingerprint(meshes.cabinet_mesh())
    assert fingerprint(mesh) != fingerprint(replace(mesh, vertices=nudged))
    assert fingerprint(CABINET) != fingerprint(replace(CABINET, floating=True))
    assert fingerprint(("a", "b")) != fingerprint(("ab",))


class Nosy(fakes.FakeObserver):
    """Implements every hook and remembers which were called."""

    def __init__(self, recipe: Path) -> None:
        super().__init__()
        self.called: set[str] = set()
        self.recipe = recipe

    @sk.hookimpl
    def register_segmenters(self, register: hookspecs.Register) -> None:
        self.called.add("register_segmenters")
        register(fakes.segmenter(CABINET.face_part, GUESSES))
        register(fakes.segmenter(error=RuntimeError("no idea"), name="broken"))

    @sk.hookimpl
    def register_checks(self, register: hookspecs.Register) -> None:
        self.called.add("register_checks")
        register(fakes.check(text="a nosy verdict"))

    @sk.hookimpl
    def register_joint_predictors(self, register: hookspecs.Register) -> None:
        self.called.add("register_joint_predictors")
        register(fakes.joint_predictor(CABINET.joints))

    @sk.hookimpl
    def register_modifiers(self, register: hookspecs.Register) -> None:
        self.called.add("register_modifiers")
        register(fakes.modifier(lambda asset: replace(asset, floating=True)))

    @sk.hookimpl
    def register_exporters(self, register: hookspecs.Register) -> None:
        self.called.add("register_exporters")
        register(fakes.exporter({"deep/model.txt": "a cabinet\n"}, unsupported=["No shapes."]))

    @sk.hookimpl
    def register_recipes(self, register: hookspecs.RegisterRecipe) -> None:
        self.called.add("register_recipes")
        register("of_a_plugin", self.recipe)

    @sk.hookimpl
    def register_commands(self, register: hookspecs.RegisterCommand) -> None:
        self.called.add("register_commands")
        register("nosy", "nosy:main", "Look at everything.")

    @sk.hookimpl
    def diagnose(self) -> list[Finding]:
        self.called.add("diagnose")
        return [Finding("glasses", "missing", remedy="look closer")]

    @sk.hookimpl
    def load_mesh(self, path: Path) -> sk.Mesh | None:
        self.called.add("load_mesh")
        return meshes.cabinet_mesh() if path.suffix == ".nosy" else None


def test_every_hook_is_called_and_its_answer_used(tmp_path: Path, simart_plugins: sk.Plugins) -> None:
    recipe = tmp_path / "mine.toml"
    recipe.write_text(
        'schema = 1\n[segmenter]\nuse = "fake"\n[joints]\nuse = "fake"\n'
        '[[modify]]\nuse = "fake"\n[[export]]\nuse = "fake"\n'
    )
    source = tmp_path / "thing.nosy"
    source.write_text("something")
    nosy = Nosy(recipe)
    simart_plugins.register(nosy)

    result = sk.convert(source, "of_a_plugin", out=tmp_path / "out", plugins=simart_plugins, record=False)
    with pytest.raises(sk.StageError, match="no idea"):
        sk.convert(
            source,
            "of_a_plugin",
            out=tmp_path / "out",
            sets=["segmenter.use=broken"],
            plugins=simart_plugins,
            record=False,
        )

    found = [finding for told in examine(simart_plugins).plugins for finding in told.findings]
    assert [finding.remedy for finding in found if finding.subject == "glasses"] == ["look closer"]

    assert nosy.called | {event.hook for event in nosy.events} == hook_names()
    assert {joint.name for joint in result.asset.joints} == {"door_hinge", "drawer_slide"}
    assert result.asset.floating
    assert result.paths["fake"].read_text() == "a cabinet\n"
    assert result.report.unsupported == {"fake": ("No shapes.",)}
    assert result.report.checks[-1].text == "a nosy verdict"
    stages = [event.stage for event in nosy.events if event.hook == "stage_finished"]
    assert stages[:4] == ["load", "segment", "joints", "modify"]
    assert stages[-1] == "load", "the second run ends after loading"


def test_run_recipe_converts_a_mesh_in_memory(
    run_recipe: RunRecipe, cabinet_mesh: sk.Mesh, cabinet_asset: sk.Asset, simart_plugins: sk.Plugins
) -> None:
    simart_plugins.register(
        fakes.plugin(
            fakes.segmenter(cabinet_asset.face_part, GUESSES),
            fakes.joint_predictor(cabinet_asset.joints),
            fakes.modifier(),
            fakes.exporter(),
        )
    )
    first = run_recipe(cabinet_mesh, RECIPE, simart_plugins)
    second = run_recipe(cabinet_mesh, {**RECIPE, "export": []}, simart_plugins)
    assert first.folder != second.folder
    assert "fake" in first.paths
    assert "fake" not in second.paths
    assert [j.name for j in first.asset.joints] == [j.name for j in cabinet_asset.joints]


def test_run_recipe_takes_a_file_and_built_in_plugins(run_recipe: RunRecipe) -> None:
    example = Path(__file__).resolve().parents[1] / "examples" / "cabinet.glb"
    result = run_recipe(example, {"extends": "default", "modify": [], "export": []})
    assert len(result.asset.mesh.faces) > 1000


@pytest.mark.parametrize(
    ("kind", "fake"),
    [
        ("segmenter", fakes.segmenter),
        ("joint_predictor", fakes.joint_predictor),
        ("modifier", fakes.modifier),
        ("exporter", fakes.exporter),
    ],
)
def test_fake_stage_raises_what_it_is_told(
    kind: str,
    fake: Callable[..., type[Any]],
    run_recipe: RunRecipe,
    cabinet_mesh: sk.Mesh,
    simart_plugins: sk.Plugins,
) -> None:
    stages: dict[str, Any] = {
        "segmenter": fakes.segmenter(),
        "joint_predictor": fakes.joint_predictor(),
        "modifier": fakes.modifier(),
        "exporter": fakes.exporter(),
    }
    observer = fakes.FakeObserver()
    simart_plugins.register(fakes.plugin(**stages | {kind: fake(error=OSError("disk on fire"))}))
    simart_plugins.register(observer)
    with pytest.raises(sk.StageError, match=f"{kind.replace('_', ' ')} 'fake' failed.*disk on fire"):
        run_recipe(cabinet_mesh, RECIPE, simart_plugins)
    assert observer.events[-1].hook == "run_failed"


def test_failing_observer_is_noted_and_the_run_goes_on(
    run_recipe: RunRecipe, cabinet_mesh: sk.Mesh, simart_plugins: sk.Plugins
) -> None:
    observer = fakes.FakeObserver(error=ValueError("cannot look"))
    simart_plugins.register(
        fakes.plugin(fakes.segmenter(), fakes.joint_predictor(), fakes.modifier(), fakes.exporter())
    )
    simart_plugins.register(observer)
    result = run_recipe(cabinet_mesh, RECIPE, simart_plugins)
    assert "cannot look" in " ".join(result.report.warnings)
    assert observer.events[-1].hook == "run_finished"


def test_pytest_plugin_imports_nothing_but_pytest() -> None:
    code = (
        "import sys, pytest; before = set(sys.modules); import simart_kit.testing.pytest_plugin; "
        "print(*sorted({m.split('.')[0] for m in set(sys.modules) - before}))"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    heavy = {"torch", "pxr", "mujoco", "rerun", "trimesh", "scipy", "PIL", "embreex", "yourdfpy"}
    assert not heavy & set(done.stdout.split())


def test_contracts_import_nothing_heavy() -> None:
    code = "import sys, simart_kit.testing.contracts; print(*sys.modules)"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    heavy = {"torch", "pxr", "mujoco", "rerun", "trimesh", "scipy", "PIL", "embreex", "yourdfpy"}
    assert not heavy & set(done.stdout.split())
