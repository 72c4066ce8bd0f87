"""Fixtures for tests of plugins; installed with simart-kit, nothing to switch on.

Everything but pytest is imported inside the fixtures: suites that never use them pay nothing.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Protocol

import pytest

if TYPE_CHECKING:
    from collections.abc import Mapping
    from pathlib import Path

    from ..asset import Asset
    from ..mesh import Mesh
    from ..pipeline import Result
    from ..plugins import Plugins


class RunRecipe(Protocol):
    """Converts a mesh: `run_recipe(mesh, {"extends": "default", ...}, plugins)`."""

    def __call__(
        self,
        mesh: Mesh | Path,
        recipe: Mapping[str, Any],
        plugins: Plugins | None = None,
        record: bool = False,
    ) -> Result:
        """Run it.

        Args:
            mesh: a Mesh in any frame that it names, or a file.
            recipe: a recipe as a table; it may extend a packaged one.
            plugins: the default is the `simart_plugins` fixture.
            record: write a rerun recording too.
        """


@pytest.fixture
def simart_plugins() -> Plugins:
    """Built-in plugins only, whatever is installed; the first one that cannot be loaded raises."""
    from ..plugins import Plugins

    return Plugins(installed=False, strict=True)


@pytest.fixture
def cabinet_mesh() -> Mesh:
    """A textured cabinet of nine boxes: body (faces 0-59), door with handle (60-83), drawer (84-107)."""
    from .meshes import cabinet_mesh

    return cabinet_mesh()


@pytest.fixture
def cabinet_asset() -> Asset:
    """The same cabinet with a hinged door and a sliding drawer, masses and collision shapes."""
    from .meshes import cabinet_asset

    return cabinet_asset()


@pytest.fixture
def run_recipe(tmp_path: Path, request: pytest.FixtureRequest) -> RunRecipe:
    """Converts a mesh by a recipe given as a table; the output is in a folder of its own under `tmp_path`."""
    import json
    from pathlib import Path

    from ..pipeline import convert
    from . import fakes

    def run(
        mesh: Mesh | Path, recipe: Mapping[str, Any], plugins: Plugins | None = None, record: bool = False
    ) -> Result:
        plugins = plugins or request.getfixturevalue("simart_plugins")
        folder = tmp_path / f"run_{sum(p.name.startswith('run_') for p in tmp_path.iterdir()) + 1}"
        folder.mkdir()
        if not isinstance(mesh, Path):
            source = folder / "asset.mesh_in_memory"
            source.write_text("the mesh is handed over by a plugin", encoding="utf-8")
            plugins.register(fakes.plugin(meshes={source: mesh}))
            mesh = source
        # The recipe reader takes JSON from the provenance file of an earlier run.
        table = folder / "recipe.json"
        table.write_text(json.dumps({"recipe": dict(recipe)}), encoding="utf-8")
        return convert(mesh, table, out=folder / "out", plugins=plugins, record=record)

    return run
