"""What a person sees on opening a recording: every stage at a glance, moving, nothing to click."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from simart_kit.arrays import FloatArray
from simart_kit.asset import Asset
from simart_kit.kinematics import rest_to_posed, span

from .evidence import EvidenceView, evidence_views
from .faults import fault_path, faults
from .history import History
from .sweep import Move, moves, shown_positions
from .tape import TIMELINE
from .text import readable

# From the target to the eye: in front of the object (-y), to its right and above.
_EYE = np.array([0.55, -1.0, 0.5]) / np.linalg.norm([0.55, -1.0, 0.5])
_EYE_DISTANCE = 1.05  # in diagonals of what is to be seen
_BACKGROUND = (38, 42, 48)


def blueprint(history: History, has_preview: bool) -> Any:
    """The layout for what this run has recorded."""
    import rerun.blueprint as rrb

    root = _failed(history) if history.failure is not None else _finished(history, has_preview)
    moving = history.asset is not None and bool(moves(history.asset))
    # A timeline that the file lacks makes the viewer complain.
    playing = rrb.TimePanel(state="collapsed", timeline=TIMELINE, play_state="playing", loop_mode="all")
    return rrb.Blueprint(
        root,
        rrb.BlueprintPanel(state="collapsed"),
        rrb.SelectionPanel(state="collapsed"),
        playing if moving else rrb.TimePanel(state="hidden"),
        auto_views=False,
        auto_layout=False,
    )


def _finished(history: History, has_preview: bool) -> Any:
    import rerun.blueprint as rrb

    stages = _stage_views(history)
    if has_preview:
        stages.append(rrb.Spatial2DView(origin="preview", name="Preview"))
    columns = 3 if len(stages) <= 6 else 4
    above = rrb.Horizontal(
        *_motion(history), rrb.Grid(*stages, grid_columns=columns), column_shares=[2, columns]
    )
    words = rrb.Tabs(*_documents(history))
    below = rrb.Horizontal(_text("report/summary", "Result"), *_plots(history), words, _timings())
    evidence = _evidence_views(history)
    if not evidence:
        return rrb.Vertical(above, below, row_shares=[3, 2])
    return rrb.Vertical(above, rrb.Horizontal(*evidence), below, row_shares=[6, 3, 3])


def _failed(history: History) -> Any:
    import rerun.blueprint as rrb

    words = rrb.Tabs(_text("report/summary", "So far"), *_documents(history), _timings())
    told = rrb.Vertical(_text("failure", "Why it failed"), words, row_shares=[3, 2])
    views = [*_motion(history), *_stage_views(history), *_evidence_views(history)]
    return rrb.Horizontal(told, rrb.Grid(*views, grid_columns=2), column_shares=[2, 3]) if views else told


def _motion(history: History) -> list[Any]:
    if history.asset is None:
        return []
    name = "Motion: every joint through its range" if moves(history.asset) else "Object: nothing moves"
    return [_view("asset", name, _reach(history.asset))]


def _stage_views(history: History) -> list[Any]:
    """A view a stage that has something to show, in the order of the run."""
    import rerun.blueprint as rrb

    if history.source is None:
        return []
    bounds = history.source.mesh.bounds
    views = [_view("source", "Source", bounds), _view("voxels", "Voxels", bounds)]
    if history.segmentation is not None:
        if history.segmentation.face_segment is not None:
            views.append(_view("segments", "Segments", bounds))
        views.append(_view("parts", "Parts", bounds, ["/parts/**", "/part_labels"]))
    asset = history.asset
    if history.steps:
        each = [_modifier_view(step.name, _reach(step.asset)) for step in history.steps]
        views += [rrb.Tabs(*each, name="Modifiers"), _text("report/modifiers", "Changes")]
    if asset is not None and any(part.collision for part in asset.parts):
        views.append(_view("collision", "Collision shapes", asset.mesh.bounds))
    if asset is not None and faults(history):
        tabs = [_view(fault_path(c), f"Failed: {c.name}", _reach(asset)) for c in faults(history)]
        views.append(rrb.Tabs(*tabs, name="Failed checks"))
    return views


def _evidence_views(history: History) -> list[Any]:
    """A view a piece of evidence for the parts; tabs where it is of several things, and for all words."""
    import rerun.blueprint as rrb

    if history.source is None or history.segmentation is None:
        return []
    bounds = history.source.mesh.bounds
    views = evidence_views(history.evidence)
    words = [_text(view.origin, view.name) for view in views if view.kind == "words"]
    seen = [_evidence_view(view, bounds) for view in views if view.kind != "words"]
    return [*seen, rrb.Tabs(*words, name="Words")] if words else seen


def _evidence_view(view: EvidenceView, bounds: FloatArray) -> Any:
    import rerun.blueprint as rrb

    if view.kind == "picture":
        return rrb.Spatial2DView(origin=view.origin, name=view.name)
    if not view.tabs:
        return _view(view.origin, view.name, bounds)
    # The viewer shows the names of tabs, but none of what holds them.
    names = [f"{view.name}: {view.tabs[0][1]}", *(name for _, name in view.tabs[1:])]
    tabs = [_view(origin, name, bounds) for (origin, _), name in zip(view.tabs, names, strict=True)]
    return rrb.Tabs(*tabs, name=view.name)


def _modifier_view(name: str, bounds: FloatArray) -> Any:
    origin = f"modifiers/{name}"
    return _view(origin, readable(f"After {name}"), bounds, ["$origin/**", "/parts/**"])


def _plots(history: History) -> list[Any]:
    """Joint positions over the sweep, degrees and metres apart."""
    import rerun.blueprint as rrb

    made = moves(history.asset) if history.asset is not None else ()
    turns = [move for move in made if move.joint.turns]
    slides = [move for move in made if not move.joint.turns]
    views = [
        _plot(group, name) for group, name in ((turns, "Turns [degrees]"), (slides, "Slides [m]")) if group
    ]
    return [rrb.Vertical(*views)] if views else []


def _plot(group: list[Move], name: str) -> Any:
    import rerun.blueprint as rrb

    shown = np.concatenate([shown_positions(move) for move in group])
    margin = 0.05 * float(np.ptp(shown))
    return rrb.TimeSeriesView(
        origin="/",
        contents=[f"/joint_positions/{move.joint.name}" for move in group],
        name=name,
        axis_y=rrb.ScalarAxis(range=(float(shown.min()) - margin, float(shown.max()) + margin)),
    )


def _documents(history: History) -> list[Any]:
    found = [("report/checks", "Checks")] if history.checks else []
    found.append(("report/recipe", "Recipe"))
    return [_text(origin, name) for origin, name in found]


def _timings() -> Any:
    """The chart over the table that names its bars."""
    import rerun.blueprint as rrb

    chart = rrb.BarChartView(
        origin="report/seconds", name="Seconds a stage", plot_legend=rrb.PlotLegend(visible=False)
    )
    return rrb.Vertical(chart, _text("report/timings", "Times"), name="Times")


def _text(origin: str, name: str) -> Any:
    import rerun.blueprint as rrb

    return rrb.TextDocumentView(origin=origin, name=name)


def _view(origin: str, name: str, bounds: FloatArray, contents: Sequence[str] = ("$origin/**",)) -> Any:
    """A 3D view whose eye sees all of (2, 3) bounds [m] from the front right."""
    import rerun.blueprint as rrb

    target = bounds.mean(axis=0)
    distance = _EYE_DISTANCE * float(np.linalg.norm(bounds[1] - bounds[0]))
    return rrb.Spatial3DView(
        origin=origin,
        contents=list(contents),
        name=name,
        background=_BACKGROUND,
        line_grid=False,
        eye_controls=rrb.EyeControls3D(
            kind=rrb.Eye3DKind.Orbital,
            position=target + distance * _EYE,
            look_target=target,
            eye_up=(0, 0, 1),
        ),
    )


def _reach(asset: Asset) -> FloatArray:
    """(2, 3) bounds of the asset at rest, with all joints at their lower and all at their upper end [m]."""
    corners = {p.name: _corners(asset, i) for i, p in enumerate(asset.parts)}
    moving = [j for j in asset.joints if span(j) != (0.0, 0.0)]
    points = [asset.mesh.bounds]
    for end in (0, 1):
        poses = rest_to_posed(asset, {j.name: span(j)[end] for j in moving})
        points += [corners[name] @ posed[:3, :3].T + posed[:3, 3] for name, posed in poses.items()]
    every = np.concatenate(points)
    return np.array([every.min(axis=0), every.max(axis=0)])


def _corners(asset: Asset, index: int) -> FloatArray:
    """(8, 3) corners of a part's bounding box [m]."""
    points = asset.mesh.vertices[asset.mesh.faces[asset.face_part == index].ravel()]
    ends = np.array([points.min(axis=0), points.max(axis=0)])
    return np.array([[ends[i, 0], ends[j, 1], ends[k, 2]] for i in (0, 1) for j in (0, 1) for k in (0, 1)])
