"""Runs told to a recorder through its hooks, and recordings read back with rerun's own reader."""

import hashlib
import json
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
from simart_kit_plugins.recorder import Recorder

from simart_kit.assemble import Articulation
from simart_kit.asset import Limits
from simart_kit.checks import CheckResult
from simart_kit.loading import Source
from simart_kit.recipe import Recipe
from simart_kit.report import Report
from simart_kit.runner import Run
from simart_kit.stages import PartGuess, Segmentation

CHECKS = (
    CheckResult("joints", True, "every joint moves its part", {}),
    CheckResult("mass", False, "the door is heavy for its size", {}),
)


def recipe():
    table = {
        "schema": 1,
        "segmenter": {"use": "geometric", "options": {"max_parts": 16}},
        "joints": {"use": "geometric"},
        "modify": [{"use": "snap"}],
        "export": [{"use": "usd"}],
    }
    return Recipe.model_validate_json(json.dumps(table))


def run_in(folder, name="cabinet", record=True):
    folder.mkdir(parents=True, exist_ok=True)
    return Run(name, Path("cabinet.glb"), recipe(), folder, record)


def source_of(asset):
    return Source(asset.mesh, asset.asset_from_source, "0" * 64)


def segmentation_of(asset):
    parts = tuple(PartGuess(p.name, p.label) for p in asset.parts)
    return Segmentation(asset.face_part, parts, face_segment=np.arange(len(asset.face_part)) // 12)


def before_snap(asset):
    """The asset as a predictor might leave it: hinges a little off, half the travel, no physics."""
    joints = tuple(
        replace(
            j,
            origin=(j.origin[0] + 0.02, *j.origin[1:]),
            limits=j.limits and Limits(j.limits.lower / 2, j.limits.upper / 2),
            confidence=0.75,
            evidence=("handle far from the hinge",),
        )
        for j in asset.joints
    )
    return replace(
        asset, joints=joints, parts=tuple(replace(p, mass=None, collision=()) for p in asset.parts)
    )


def told(asset, run, recorder, stages=("load", "segment", "joints", "modify", "check")):
    """Tell a recorder of a run that got so far."""
    values = {
        "load": ("glb", source_of(asset)),
        "segment": ("geometric", segmentation_of(asset)),
        "joints": ("geometric", Articulation(before_snap(asset))),
        "modify": ("snap", asset.with_notes("snap", "info", ["the hinge now lies on the edge"])),
        "check": ("checks", CHECKS),
    }
    recorder.run_started(run)
    for number, stage in enumerate(stages, start=1):
        recorder.stage_finished(run, stage, *values[stage], 0.25 * number)


def recorded(asset, folder):
    run, recorder = run_in(folder, asset.name), Recorder()
    told(asset, run, recorder)
    report = Report(run.name, asset, CHECKS, asset.notes, {"urdf": ("no ball joint",)}, ())
    recorder.run_finished(run, report)
    return folder / f"{run.name}.rrd"


def failed(asset, folder, stages, error):
    run, recorder = run_in(folder, asset.name), Recorder()
    told(asset, run, recorder, stages)
    recorder.run_failed(run, "modify", error)
    return folder / f"{run.name}.rrd"


def chunks(path):
    from rerun.chunk import RrdReader

    return RrdReader(path).stream().to_chunks()


def paths_in(path):
    return {chunk.entity_path for chunk in chunks(path)}


def values(path, entity, component):
    """The values of one component, a row each, and their times [s] (none when static)."""
    for chunk in chunks(path):
        batch = chunk.to_record_batch()
        if chunk.entity_path == entity and component in batch.schema.names:
            rows = batch.column(component).to_pylist()
            if chunk.is_static:
                return rows, None
            return rows, np.array(batch.column("sweep").cast("int64")) * 1e-9
    raise KeyError(f"{entity} has no {component}")


def text(path, entity):
    return values(path, entity, "TextDocument:text")[0][0][0]


def bars(path, entity):
    """Heights of a bar chart's bars."""
    return values(path, entity, "BarChart:values")[0][0][0]["buffer"]


def transforms(path, entity):
    """(T,) times and (T, 4, 4) transforms; rerun stores matrices by columns."""
    matrices, seconds = values(path, entity, "Transform3D:mat3x3")
    translations, _ = values(path, entity, "Transform3D:translation")
    result = np.tile(np.eye(4), (len(matrices), 1, 1))
    result[:, :3, :3] = np.array(matrices).reshape(-1, 3, 3).transpose(0, 2, 1)
    result[:, :3, 3] = np.array(translations).reshape(-1, 3)
    return seconds, result


def contents(path):
    """Entity, whether it is static, and a hash of its rows but for their random ids; sorted."""
    rows = []
    for chunk in chunks(path):
        batch = chunk.to_record_batch().drop_columns(["rerun.controls.RowId"]).replace_schema_metadata(None)
        data = hashlib.sha256(batch.serialize()).hexdigest()
        rows.append((chunk.entity_path, chunk.is_static, tuple(batch.schema.names), data))
    return sorted(rows)


def positions(path, joint):
    """(T,) times and (T,) joint positions as logged [degree | m]."""
    rows, seconds = values(path, f"/joint_positions/{joint}", "Scalars:scalars")
    return seconds, np.array(rows).ravel()


def rerun_rrd(*arguments):
    command = [sys.executable, "-m", "rerun", "rrd", *map(str, arguments)]
    done = subprocess.run(command, capture_output=True, text=True, timeout=60, check=False)
    return done.returncode, done.stdout + done.stderr


def views(path):
    """Origins of the views in the file's blueprint, by view class."""
    from rerun.chunk import RrdReader

    (entry,) = RrdReader(path).blueprints()
    found = {}
    for chunk in RrdReader(path).stream(store=entry).to_chunks():
        batch = chunk.to_record_batch()
        if "ViewBlueprint:class_identifier" in batch.schema.names:
            kind = batch.column("ViewBlueprint:class_identifier").to_pylist()[0][0]
            origin = batch.column("ViewBlueprint:space_origin").to_pylist()[0][0]
            found.setdefault(kind, set()).add(origin.strip("/"))
    return found
