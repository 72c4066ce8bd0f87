"""Writing a recording: the table of contents."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from simart_kit.arrays import FloatArray
from simart_kit.asset import Asset
from simart_kit.colors import part_color
from simart_kit.loading import Source
from simart_kit.mesh import Mesh
from simart_kit.normals import with_normals

from . import documents
from .blueprint import blueprint
from .colors import BEFORE
from .evidence import log_evidence
from .faults import faults, log_fault
from .history import History
from .joints import log_joint, log_lines
from .shapes import log_collision, log_parts, log_segments, log_textured, log_voxels
from .sweep import log_sweep
from .tape import Tape, recording
from .text import readable


def write_recording(history: History, path: Path, preview: Path) -> None:
    """Write what a run did, so far as it went; `preview` is shown if the file exists."""
    layout = blueprint(history, preview.exists())
    with recording(path, history.name, history.recipe, layout) as tape:
        if history.source is not None:
            _log_object(tape, history, history.source)
        _log_words(tape, history)
        if preview.exists():
            _log_preview(tape, preview)


def _log_object(tape: Tape, history: History, source: Source) -> None:
    mesh = with_normals(source.mesh)
    _log_stages(tape, history, source, mesh)
    _log_modifiers(tape, history, source)
    if history.asset is not None:
        shaded = _shaded(history.asset, _labelled(history, source, mesh), source)
        _log_asset(tape, history.asset, shaded)
        log_collision(tape, history.asset)
        for check in faults(history):
            log_fault(tape, check, history.asset, shaded)


def _log_stages(tape: Tape, history: History, source: Source, mesh: Mesh) -> None:
    """Source, voxels, segments, parts and how they were found, in the frame of the loaded mesh."""
    log_textured(tape, "source", mesh, {"mesh": np.arange(len(mesh.faces), dtype=np.int32)})
    log_voxels(tape, mesh)
    segmentation = history.segmentation
    if segmentation is not None:
        labelled = _labelled(history, source, mesh)
        log_parts(tape, labelled, segmentation)
        if segmentation.face_segment is not None:
            log_segments(tape, labelled, segmentation.face_segment)
        log_evidence(tape, segmentation.mesh_of(source.mesh), labelled, history.evidence)


def _labelled(history: History, source: Source, shaded: Mesh) -> Mesh:
    """The mesh that the labels are of, with normals: the loaded one, `shaded`, unless faces were cut."""
    segmentation = history.segmentation
    cut = source.mesh if segmentation is None else segmentation.mesh_of(source.mesh)
    return shaded if cut is source.mesh else with_normals(cut)


def _log_modifiers(tape: Tape, history: History, source: Source) -> None:
    """The joints before (grey) and after each modifier; the view puts them over the parts."""
    import rerun as rr

    before = history.predicted
    for step in history.steps:
        assert before is not None
        path = f"modifiers/{step.name}"
        loaded_T_step = _loaded_from_asset(source, step.asset)
        tape.static(path, rr.Transform3D(translation=loaded_T_step[:3, 3], mat3x3=loaded_T_step[:3, :3]))
        for joint in step.asset.joints:
            if joint.moves:
                color = part_color(step.asset.part_index(joint.child))
                log_joint(tape, f"{path}/after/{joint.name}", step.asset, joint, color, labelled=False)
        for joint in (j for j in before.joints if j not in step.asset.joints):
            if joint.moves:
                log_lines(tape, f"{path}/before/{joint.name}", before, joint, BEFORE)
        before = step.asset


def _log_asset(tape: Tape, asset: Asset, mesh: Mesh) -> None:
    """The asset as it ended up: textured parts and joints that move over the sweep; the mesh has normals."""
    groups = {p.name: np.flatnonzero(asset.face_part == i) for i, p in enumerate(asset.parts)}
    log_textured(tape, "asset/parts", mesh, groups)
    for joint in asset.joints:
        if joint.moves:
            log_joint(
                tape, f"asset/joints/{joint.name}", asset, joint, part_color(asset.part_index(joint.child))
            )
    log_sweep(tape, asset, "asset/parts", "asset/joints", "joint_positions")


def _log_words(tape: Tape, history: History) -> None:
    import rerun as rr

    texts = {
        "report/summary": documents.summary(history),
        "report/checks": documents.checks(history),
        "report/modifiers": documents.modifiers(history),
        "report/timings": documents.timings(history.events),
        "report/recipe": documents.recipe(history.recipe),
    }
    if history.failure is not None:
        texts["failure"] = documents.failure_text(history.failure, history.events)
    for path, text in texts.items():
        tape.static(path, rr.TextDocument(readable(text), media_type="text/markdown"))
    seconds = [event.seconds for event in history.events]
    if seconds:
        tape.static("report/seconds", rr.BarChart(seconds, abscissa=np.arange(1, len(seconds) + 1)))


def _log_preview(tape: Tape, preview: Path) -> None:
    import rerun as rr

    tape.static("preview", rr.EncodedImage(contents=preview.read_bytes(), media_type="image/png"))


def _loaded_from_asset(source: Source, asset: Asset) -> FloatArray:
    """(4, 4) back to the frame of the loaded mesh, for modifiers may have changed the size."""
    return np.asarray(source.asset_from_source @ np.linalg.inv(asset.asset_from_source))


def _shaded(asset: Asset, loaded: Mesh, source: Source) -> Mesh:
    """The asset's mesh with the normals of the loaded one, unless a modifier changed more than the size."""
    asset_T_loaded = np.asarray(np.linalg.inv(_loaded_from_asset(source, asset)), dtype=np.float64)
    moved = loaded.transformed(asset_T_loaded)
    same = len(moved.faces) == len(asset.mesh.faces) and np.allclose(moved.triangles, asset.mesh.triangles)
    return moved if same else with_normals(asset.mesh)
