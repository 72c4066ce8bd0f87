"""Running exporters: each gets a fresh folder, and its result is checked before anybody sees it."""

from __future__ import annotations

from pathlib import Path

from .asset import Asset
from .plugins import Plugins
from .recipe import Recipe, build
from .runner import Runner
from .stages import Exporter


def export_all(
    runner: Runner, plugins: Plugins, recipe: Recipe, asset: Asset
) -> tuple[dict[str, Path], dict[str, tuple[str, ...]]]:
    """Run the recipe's exporters into `run.folder/NAME`.

    Returns:
        The main file by exporter, and what each could not express.
    """
    mains, unsupported = {}, {}
    for use in recipe.export:
        stage, registration = build(use, "exporter", plugins, recipe.seed)
        assert isinstance(stage, Exporter)
        directory = runner.run.folder / registration.name
        mains[registration.name] = runner.stage("export", registration, export_one, asset, stage, directory)
        unsupported[registration.name] = stage.unsupported(asset)
    return mains, unsupported


def export_one(asset: Asset, exporter: Exporter, directory: Path) -> Path:
    """Run one exporter in a fresh directory; raises ValueError when it returns no file of that directory."""
    directory.mkdir(parents=True)
    main = exporter.export(asset, directory)
    if (
        not isinstance(main, Path)
        or not main.is_file()
        or not main.resolve().is_relative_to(directory.resolve())
    ):
        raise ValueError(
            f"export() returned {main!r}, expected the path of a file in the directory it was given"
        )
    return main
