"""Running exporters: each gets a fresh folder, and its result is checked before anybody sees it."""

from __future__ import annotations

import json
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from pydantic import ValidationError

from .asset import Asset
from .asset_io import ASSET_FILE, load_asset
from .output import PROVENANCE, commit, hashes, staging
from .plugins import Plugins, Registration
from .provenance import file_hash, write_json
from .recipe import Recipe, Use, build
from .runner import Runner
from .stages import Exporter


@dataclass(frozen=True)
class Exported:
    """What an exporter wrote.

    Attributes:
        main: the format's main file.
        unsupported: what the format cannot express, a sentence each.
        kept: what was in the way and is kept under another name, a sentence each.
    """

    main: Path
    unsupported: tuple[str, ...] = ()
    kept: tuple[str, ...] = ()


def export_all(
    runner: Runner, plugins: Plugins, recipe: Recipe, asset: Asset
) -> tuple[dict[str, Path], dict[str, tuple[str, ...]]]:
    """Run the recipe's exporters into `run.folder/NAME`.

    Returns:
        The main file by exporter, and what each could not express.
    """
    mains, unsupported = {}, {}
    for use in recipe.export:
        stage, registration = build(use, Exporter, plugins, recipe.seed)
        directory = runner.run.folder / registration.name
        exported = runner.stage("export", registration, export_one, asset, stage, directory)
        mains[registration.name] = exported.main
        unsupported[registration.name] = exported.unsupported
    return mains, unsupported


def export_one(asset: Asset, exporter: Exporter, directory: Path) -> Exported:
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
    return Exported(main, tuple(exporter.unsupported(asset)))


def export_folder(folder: str | Path, exporter: str, plugins: Plugins | None = None) -> Exported:
    """Write one more format of an asset that was converted before, and perhaps edited since.

    Nothing runs again: the asset comes from the folder's asset.json and parts.npz. The exporter's options are
    those of the run that made the folder, or the defaults.

    Args:
        folder: output folder of a conversion.
        exporter: registered name of the format.
        plugins: the default loads all installed ones.

    Raises:
        BadInputError: the folder holds no asset, or an edited field of it is wrong; the message names it.
        UnknownPluginError, RecipeError: there is no such format, or the earlier run's options do not fit it.
        StageError: the exporter failed; the folder is as it was.
    """
    folder, plugins = Path(folder), plugins or Plugins()
    asset = load_asset(folder)
    record = _record(folder)
    use, seed = _earlier_use(record, exporter)
    stage, registration = build(use, Exporter, plugins, seed)
    with staging(folder) as work:
        try:
            exported = export_one(asset, stage, work / exporter)
        except (Exception, SystemExit) as cause:
            raise registration.failure(cause) from cause
        write_json(work / PROVENANCE, _with_export(record, work, folder, registration))
        kept = commit(work, folder)
    return replace(exported, main=folder / exported.main.relative_to(work), kept=kept)


def _record(folder: Path) -> dict[str, Any]:
    """The folder's provenance; empty when there is none or it cannot be read."""
    try:
        record = json.loads((folder / PROVENANCE).read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return {}
    return record if isinstance(record, dict) else {}


def _earlier_use(record: dict[str, Any], exporter: str) -> tuple[Use, int]:
    """How the run that made the folder used this exporter, and its seed."""
    try:
        recipe = Recipe.model_validate_json(json.dumps(record.get("recipe")))
    except ValidationError:
        return Use(use=exporter), 0
    return next((use for use in recipe.export if use.use == exporter), Use(use=exporter)), recipe.seed


def _with_export(record: dict[str, Any], work: Path, folder: Path, made: Registration) -> dict[str, Any]:
    """The record with this export's hashes instead of those of an earlier one, and what it was made from."""
    others = {
        name: text for name, text in _table(record, "outputs").items() if Path(name).parts[0] != made.name
    }
    entry = {
        "asset_sha256": file_hash(folder / ASSET_FILE),
        "plugin": made.owner.plugin,
        "distribution": made.owner.distribution,
        "version": made.owner.version,
    }
    exports = {**_table(record, "exports"), made.name: entry}
    return {**record, "outputs": others | hashes(work), "exports": exports}


def _table(record: dict[str, Any], key: str) -> dict[str, Any]:
    value = record.get(key)
    return value if isinstance(value, dict) else {}
