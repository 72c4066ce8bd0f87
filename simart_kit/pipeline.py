"""convert(): from a source mesh to an articulated asset in every format of the recipe."""

from __future__ import annotations

import traceback
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from . import render
from .assemble import Articulation, articulation, assemble, checked
from .asset import Asset, clean_name
from .asset_io import save_asset
from .beside import Beside, begun_by, modify_by
from .checks import run_checks
from .checks.subject import Subject
from .errors import StageError
from .exports import export_all
from .loading import Source, read_source, source_path
from .mesh import Mesh, Note, UpAxis
from .output import PROVENANCE, commit, forget_failure, hashes, keep_failure, left_over, staging
from .physics_overrides import overridden
from .picturing import Picture, begun, finished
from .plugins import Plugins, Registration
from .provenance import provenance, write_json
from .recipe import Recipe, build, build_checks, check_extras, load_recipe
from .report import Report
from .runner import Run, Runner
from .spec.moving import with_joints
from .spec.protocols import prediction_by, segment_by
from .spec.reading import read_spec
from .spec.shaping import with_parts
from .spec.values import Spec
from .spec.verdicts import with_verdicts
from .stages import Check, JointPredictor, Modifier, Prediction, Segmentation, Segmenter
from .told_materials import as_told

# A process beside this one saves more than its start takes if it is there while a file of so many bytes is
# read, or for so many faces, where they are in files beside that one.
_LARGE, _MANY = 5_000, 5_000
# What observers are told that failed, by the kind of stage.
_STAGES = {
    "segmenter": "segment",
    "joint predictor": "joints",
    "modifier": "modify",
    "exporter": "export",
    "check": "check",
}


@dataclass(frozen=True)
class Result:
    """What a conversion leaves.

    Attributes:
        asset: the articulated asset.
        report: checks, decisions and warnings.
        paths: main files: "asset", "report", "provenance", "preview", "recording", and one an exporter.
        folder: the output folder.
    """

    asset: Asset
    report: Report
    paths: dict[str, Path]
    folder: Path


def convert(
    source: str | Path,
    recipe: str | Path = "default",
    *,
    out: str | Path | None = None,
    name: str | None = None,
    sets: Iterable[str] = (),
    up: UpAxis | None = None,
    unit: str | float | None = None,
    height: float | None = None,
    scale: float | None = None,
    floating: bool = False,
    spec: str | Path | Mapping[str, Any] | Spec | None = None,
    record: bool = True,
    plugins: Plugins | None = None,
) -> Result:
    """Turn a mesh file into an articulated asset.

    Args:
        source: mesh file; formats are those of the loaded plugins.
        recipe: a recipe's name, a TOML file, or the provenance.json of an earlier run.
        out: output folder; the default is `out/NAME`.
        name: of the asset; the default comes from the file's name.
        sets: recipe changes such as "segmenter.options.max_parts=8".
        up: the file's up axis, where the file does not say or says wrong.
        unit: the file's unit: "mm", "cm", "m", "in", "ft", or metres a unit.
        height: real height of the object [m].
        scale: factor on the size.
        floating: leave the base free instead of fixing it to the world.
        spec: what a person or a model states of what moves: a TOML or JSON file, or its values.
        record: write a rerun recording.
        plugins: the default loads all installed ones.

    Raises:
        BadInputError: the source or the spec cannot be used, or a stage lacks an extra; nothing is written.
        RecipeError, PluginError: the recipe cannot be run; nothing is written.
        StageError: a stage failed; `out/failed` keeps its input and the recording, the rest is as it was.
    """
    plugins = plugins or Plugins()
    path = source_path(source)
    name = clean_name(name or path.stem, "asset")
    resolved = load_recipe(recipe, plugins, [*sets, *_scale_sets(height, scale)])
    check_extras(resolved.uses(), plugins)
    judges = build_checks(resolved, plugins)
    wishes = None if spec is None else read_spec(spec)
    folder = Path(out) if out is not None else Path("out") / name
    with staging(folder) as work:
        runner = Runner(Run(name, path, resolved, work, record), plugins)
        with _failures_kept(runner, folder):
            runner.tell("run_started")
            with Beside(path.stat().st_size >= _LARGE) as beside:
                loaded = _load(runner, plugins, path, up, unit, beside)
                segmentation = _segment(runner, plugins, resolved, loaded, wishes, beside)
                asset = _articulate(runner, plugins, resolved, loaded, segmentation, name, floating, wishes)
                asset, picture = _modify(runner, plugins, resolved, asset, loaded.stated is not None, beside)
                asset = asset if wishes is None else with_verdicts(asset, wishes)
                report, mains = _write(runner, plugins, resolved, judges, asset, picture, beside)
        stated = wishes and wishes.table()
        arguments = {"name": name, "up": up, "unit": unit, "floating": floating, "spec": stated}
        return _finish(runner, plugins, loaded, report, mains, folder, arguments)


def _load(
    runner: Runner, plugins: Plugins, path: Path, up: UpAxis | None, unit: str | float | None, beside: Beside
) -> Source:
    loaded = runner.call("load", path.suffix.lstrip(".").lower(), read_source, path, plugins, up, unit)
    if len(loaded.mesh.faces) >= _MANY:
        beside.start()
    return loaded


def _segment(
    runner: Runner, plugins: Plugins, recipe: Recipe, loaded: Source, spec: Spec | None, beside: Beside
) -> Segmentation:
    def segmented(mesh: Mesh) -> Segmentation:
        return checked(segment_by(stage, mesh, spec, beside), mesh)

    if loaded.stated is not None:
        found = runner.call("segment", "stated", lambda stated: stated, loaded.stated)
    else:
        stage, registration = build(recipe.segmenter, Segmenter, plugins, recipe.seed)
        found = runner.stage("segment", registration, segmented, loaded.mesh)
    if spec is not None:
        found = runner.call("spec", "parts", with_parts, found, loaded.mesh, spec)
    return as_told(found, loaded.mesh)


def _articulate(
    runner: Runner,
    plugins: Plugins,
    recipe: Recipe,
    loaded: Source,
    segmentation: Segmentation,
    name: str,
    floating: bool,
    spec: Spec | None,
) -> Asset:
    def assembled(said: Prediction) -> Articulation:
        joints = said.joints if spec is None else with_joints(said.joints, segmentation, loaded.mesh, spec)
        asset = assemble(name, loaded.mesh, segmentation, joints, loaded.asset_from_source, floating)
        return articulation(overridden(asset, recipe.physics), said)

    if loaded.stated is not None:
        return runner.call("joints", "stated", assembled, Prediction(segmentation.joints or ())).asset
    stage, registration = build(recipe.joints, JointPredictor, plugins, recipe.seed)

    def predicted(segmentation: Segmentation) -> Articulation:
        return assembled(prediction_by(stage, segmentation.mesh_of(loaded.mesh), segmentation, spec))

    return runner.stage("joints", registration, predicted, segmentation).asset


def _modify(
    runner: Runner, plugins: Plugins, recipe: Recipe, asset: Asset, stated: bool, beside: Beside
) -> tuple[Asset, Picture | None]:
    """The asset, and its picture, begun before the last stage of those that leave joints as they are."""
    picture, kept, ahead = None, [], False
    stages = [(use.use, *build(use, Modifier, plugins, recipe.seed)) for use in recipe.modify]
    leaving = sum(not stage.corrects_joints for _, stage, _ in stages)
    while stages:
        use, stage, registration = stages.pop(0)
        leaving -= not stage.corrects_joints
        if stated and stage.corrects_joints:
            kept.append(use)
            continue
        if stage.corrects_joints and not ahead:
            # Another process may begin these while others correct joints.
            stages = [(u, runner.attempt("modify", r, _begun, asset, s, beside), r) for u, s, r in stages]
            ahead = True
        elif not stage.corrects_joints and not leaving and beside.helps:
            picture = begun(asset, _preview(runner), beside)
        asset = runner.stage("modify", registration, _modified, asset, stage, beside)
    text = f"the file states its joints, so they are left as they are by {', '.join(kept)}"
    return asset.with_notes("load", "info", [text] if kept else []), picture


def _begun(asset: Asset, modifier: Modifier, beside: Beside) -> Modifier:
    return begun_by(modifier, asset, beside)


def _preview(runner: Runner) -> Path:
    return runner.run.folder.resolve() / "preview.png"


def _modified(asset: Asset, modifier: Modifier, beside: Beside) -> Asset:
    result = modify_by(modifier, asset, beside)
    if not isinstance(result, Asset):
        raise TypeError(f"modify() returned {type(result).__name__}, expected an Asset")
    return result


def _write(
    runner: Runner,
    plugins: Plugins,
    recipe: Recipe,
    judges: Sequence[tuple[Check, Registration]],
    asset: Asset,
    picture: Picture | None,
    beside: Beside,
) -> tuple[Report, dict[str, Path]]:
    work = runner.run.folder
    save_asset(asset, work)
    if beside.helps:
        drawn = finished(picture, asset, _preview(runner), beside)
        runner.begin("preview", "preview", drawn.written.result)
    else:
        runner.call("preview", "preview", render.write_preview, asset, _preview(runner))
    mains, unsupported = export_all(runner, plugins, recipe, asset)
    checks = runner.call("check", "checks", run_checks, judges, Subject(mains, asset), beside)
    runner.settle()
    report = Report(runner.run.name, asset, checks, asset.notes + runner.notes, unsupported, runner.seconds)
    runner.tell("run_finished", report=report)
    write_json(work / "report.json", report.table())
    return report, mains


def _finish(
    runner: Runner,
    plugins: Plugins,
    loaded: Source,
    report: Report,
    mains: dict[str, Path],
    folder: Path,
    arguments: dict[str, Any],
) -> Result:
    run = runner.run
    earlier = left_over(run.folder, folder)
    record = provenance(
        source=run.source,
        source_hash=loaded.sha256,
        recipe=run.recipe,
        used=runner.used,
        failures=plugins.failures,
        outputs=hashes(run.folder),
        earlier_outputs=earlier,
        seconds=runner.seconds,
        usage=runner.usage,
        arguments=arguments,
    )
    write_json(run.folder / PROVENANCE, record)
    outputs = _outputs(run, mains)
    kept = commit(run.folder, folder)
    forget_failure(folder)
    stale = [f"{name} is of an earlier run" for name in sorted({Path(n).parts[0] for n in earlier})]
    notes = report.notes + tuple(Note("output", "warning", text) for text in [*kept, *stale])
    paths = {key: folder / main.relative_to(run.folder) for key, main in outputs.items()}
    return Result(report.asset, replace(report, notes=notes), paths, folder)


def _outputs(run: Run, mains: dict[str, Path]) -> dict[str, Path]:
    files = {
        "asset": "asset.json",
        "report": "report.json",
        "provenance": PROVENANCE,
        "preview": "preview.png",
        "recording": f"{run.name}.rrd",
    }
    beside = {key: run.folder / name for key, name in files.items()}
    return mains | {key: path for key, path in beside.items() if path.exists()}


@contextmanager
def _failures_kept(runner: Runner, folder: Path) -> Iterator[None]:
    """Keep the recording, the failed stage's input and the traceback of a run that a stage ends."""
    try:
        yield
    except StageError as error:
        runner.failed(_STAGES[error.kind], error)  # of a stage that could not be made, nobody was told yet
        kept = runner.run.folder / "failed"
        kept.mkdir(exist_ok=True)
        (kept / "error.txt").write_text(traceback.format_exc(), encoding="utf-8")
        recording = runner.run.folder / f"{runner.run.name}.rrd"
        if recording.exists():
            recording.replace(kept / recording.name)
        saved = "its input and the traceback are" if any(kept.glob("input*")) else "the traceback is"
        keep_failure(kept, folder)
        error.add_note(f"{saved} in {folder / 'failed'}")
        raise


def _scale_sets(height: float | None, scale: float | None) -> list[str]:
    values = {"height": height, "factor": scale}
    return [f"modify.scale.options.{key}={value}" for key, value in values.items() if value is not None]
