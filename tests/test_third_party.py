"""A distribution of somebody else: built, installed into a folder, found, used, hidden, and broken."""

import json
import os
import subprocess
import sys
from pathlib import Path
from textwrap import dedent

import pytest

from simart_kit.testing.meshes import box

pytestmark = pytest.mark.slow

FILES = {
    "pyproject.toml": """
        [build-system]
        requires = ["hatchling"]
        build-backend = "hatchling.build"

        [project]
        name = "acme-simart"
        version = "2.5"

        [project.entry-points.simart_kit]
        acme = "acme_simart.plugin"
        acme_broken = "acme_simart.broken"

        [tool.hatch.build.targets.wheel]
        packages = ["acme_simart"]
        """,
    "acme_simart/__init__.py": "",
    "acme_simart/plugin.py": """
        from pathlib import Path

        import numpy as np
        from pydantic import Field

        import simart_kit as sk


        class Halves(sk.Segmenter):
            name = "halves"

            class Options(sk.Options):
                at: float = Field(default=0.5, ge=0, le=1, description="Height of the cut, of the whole.")

            options: Options

            def segment(self, mesh):
                height = mesh.triangles[:, :, 2].mean(axis=1)
                cut = height.min() + self.options.at * np.ptp(height)
                return sk.Segmentation(
                    (height > cut).astype(np.int32), (sk.PartGuess("lower"), sk.PartGuess("upper"))
                )


        class PartList(sk.Exporter):
            name = "part_list"

            def export(self, asset, directory):
                main = directory / "parts.txt"
                main.write_text("\\n".join(part.name for part in asset.parts), encoding="utf-8")
                return main


        @sk.hookimpl
        def register_segmenters(register):
            register(Halves)


        @sk.hookimpl
        def register_exporters(register):
            register(PartList)


        @sk.hookimpl
        def register_recipes(register):
            register("acme", Path(__file__).parent / "acme.toml")
        """,
    "acme_simart/acme.toml": """
        schema = 1
        extends = "default"
        description = "Two halves, listed."

        [segmenter]
        use = "halves"
        options = { at = 0.25 }

        [[export]]
        use = "part_list"
        """,
    "acme_simart/broken.py": "import a_module_that_nobody_has\n",
}


@pytest.fixture(scope="module")
def site(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with acme-simart installed, from a wheel built of its source tree."""
    source, site = tmp_path_factory.mktemp("acme"), tmp_path_factory.mktemp("site")
    for name, text in FILES.items():
        (source / name).parent.mkdir(exist_ok=True)
        (source / name).write_text(dedent(text), encoding="utf-8")
    pip = [sys.executable, "-m", "pip", "--disable-pip-version-check", "install", "--quiet", "--no-index"]
    options = ["--no-deps", "--no-build-isolation", "--target", str(site), str(source)]
    done = subprocess.run([*pip, *options], capture_output=True, text=True, timeout=120)
    assert done.returncode == 0, done.stderr
    return site


@pytest.fixture
def mesh(tmp_path: Path) -> Path:
    """A box as an OBJ file."""
    vertices, faces = box((0, 0, 0), (0.4, 0.6, 0.3))
    lines = ["v {} {} {}".format(*v) for v in vertices] + ["f {} {} {}".format(*f) for f in faces + 1]
    path = tmp_path / "box.obj"
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")
    return path


def simart_kit(site: Path, *arguments: str | Path, **variables: str) -> subprocess.CompletedProcess[str]:
    """Run the command line with the folder on the path."""
    kept = {key: value for key, value in os.environ.items() if not key.startswith("SIMART_")}
    environment = {**kept, "PYTHONPATH": str(site), **variables}
    command = [sys.executable, "-m", "simart_kit", *map(str, arguments)]
    return subprocess.run(command, capture_output=True, text=True, timeout=120, env=environment)


def test_installed_plugin_is_listed_with_its_distribution(site: Path) -> None:
    done = simart_kit(site, "plugins", "list", "--json")
    assert done.returncode == 0, done.stderr
    ours = {
        (row["kind"], row["name"], row["plugin"], row["version"])
        for row in json.loads(done.stdout)["stages"]
        if row["distribution"] == "acme-simart"
    }
    assert ours == {
        ("segmenter", "halves", "acme", "2.5"),
        ("exporter", "part_list", "acme", "2.5"),
        ("recipe", "acme", "acme", "2.5"),
    }


def test_its_recipe_runs_its_stages(site: Path, mesh: Path, tmp_path: Path) -> None:
    out = tmp_path / "out"
    done = simart_kit(site, "convert", mesh, "--recipe", "acme", "--out", out, "--no-record")
    assert done.returncode == 0, done.stderr
    assert (out / "part_list" / "parts.txt").read_text() == "lower\nupper"
    record = json.loads((out / "provenance.json").read_text())
    assert record["recipe"]["segmenter"] == {"use": "halves", "options": {"at": 0.25}}
    assert "acme-simart" in json.dumps(record), "the provenance names the distribution"


def test_option_mistake_in_its_recipe_is_told(site: Path, mesh: Path, tmp_path: Path) -> None:
    change = "segmenter.options.at=2.0"
    done = simart_kit(site, "convert", mesh, "--recipe", "acme", "--set", change, "--out", tmp_path / "out")
    assert done.returncode == 2
    assert "segmenter.options.at" in done.stderr
    assert not (tmp_path / "out").exists()


def test_empty_filter_hides_it(site: Path, mesh: Path, tmp_path: Path) -> None:
    done = simart_kit(site, "plugins", "list", SIMART_LOAD_PLUGINS="")
    assert done.returncode == 0
    assert "acme" not in done.stdout
    change = "segmenter.use=halves"
    done = simart_kit(
        site, "convert", mesh, "--set", change, "--out", tmp_path / "out", SIMART_LOAD_PLUGINS=""
    )
    assert done.returncode == 2
    assert "unknown segmenter 'halves'" in done.stderr


def test_filter_picks_a_plugin_by_its_entry_point(site: Path) -> None:
    done = simart_kit(site, "plugins", "list", "--check", SIMART_LOAD_PLUGINS="acme")
    assert done.returncode == 0, "the broken one was not asked for"
    assert "halves" in done.stdout


def test_broken_plugin_is_shown_and_harms_nobody(site: Path, mesh: Path, tmp_path: Path) -> None:
    done = simart_kit(site, "plugins", "list")
    assert done.returncode == 0
    failed = [line for line in done.stdout.splitlines() if line.startswith("FAILED")]
    assert len(failed) == 1
    assert "acme_broken during import" in failed[0]
    assert "a_module_that_nobody_has" in failed[0]
    assert simart_kit(site, "plugins", "list", "--check").returncode == 1
    done = simart_kit(site, "convert", mesh, "--set", "segmenter.use=missing", "--out", tmp_path / "out")
    assert done.returncode == 2
    assert "a_module_that_nobody_has" in done.stderr, "it may be the one that was asked for"


def test_strict_mode_raises_for_the_broken_plugin(site: Path) -> None:
    done = simart_kit(site, "plugins", "list", SIMART_STRICT_PLUGINS="1")
    assert done.returncode == 2
    assert len(done.stderr.splitlines()) == 1
    assert "acme_broken during import" in done.stderr
