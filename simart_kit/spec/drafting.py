"""A first spec from a run, to edit: parts with their pieces, joints and limits, and a numbered picture."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import TypeVar

import numpy as np

from ..assemble import assemble, checked
from ..asset import Asset, Joint, clean_name
from ..drawing.numbered import numbered_png
from ..loading import Source, read_source, source_path
from ..mesh import Mesh, UpAxis
from ..plugins import Plugins, Registration
from ..recipe import Recipe, build, check_extras, load_recipe
from ..stages import JointPredictor, Modifier, Segmentation, Segmenter
from ..timeout import time_limit
from .moving import axis_words, same_limits
from .pieces import pieces_of, whole_pieces
from .places import part_places
from .values import PartSpec, Spec
from .writing import spec_text

T = TypeVar("T")


@dataclass(frozen=True, eq=False)
class Draft:
    """A first spec.

    Attributes:
        spec: what the run found, as statements; a run with it finds the same.
        limits: by part, limits that other parts shorten, and which are left out of the spec.
        picture: PNG of the object with its parts, and with its pieces, numbered.
    """

    spec: Spec
    limits: dict[str, tuple[float, float]]
    picture: bytes

    def text(self, path: Path, source: Path, recipe: str) -> str:
        """The text of a file, JSON or TOML by the file's name; TOML tells what may be changed."""
        if path.suffix.lower() == ".json":
            return json.dumps(self.spec.table(), indent=1, ensure_ascii=False) + "\n"
        return spec_text(self.spec, self.limits, path.with_suffix(".png").name, source.name, recipe)


def draft(
    source: str | Path,
    recipe: str | Path = "default",
    *,
    sets: Iterable[str] = (),
    up: UpAxis | None = None,
    unit: str | float | None = None,
    plugins: Plugins | None = None,
) -> Draft:
    """Find parts and joints as `convert` would, and state them as a spec. Nothing is written.

    Args:
        source: mesh file.
        recipe: as of `convert`.
        sets: changes of the recipe.
        up: the file's up axis, where the file does not say or says wrong.
        unit: the file's unit.
        plugins: the default loads all installed ones.

    Raises:
        BadInputError: the source cannot be used.
        RecipeError, PluginError: the recipe cannot be run.
        StageError: a stage failed.
    """
    plugins = plugins or Plugins()
    path = source_path(source)
    resolved = load_recipe(recipe, plugins, sets)
    check_extras(resolved.uses(), plugins)
    loaded = read_source(path, plugins, up, unit)
    segmentation = _segmented(loaded, resolved, plugins)
    joints = _joints(loaded, segmentation, resolved, plugins)
    name = clean_name(path.stem, "asset")
    asset = assemble(name, loaded.mesh, segmentation, joints, loaded.asset_from_source)
    finished = _modified(asset, resolved, plugins, loaded.stated is not None)
    return drafted(segmentation, loaded.mesh, asset, finished)


def drafted(segmentation: Segmentation, given: Mesh, asset: Asset, finished: Asset) -> Draft:
    """A spec of what a run found.

    Args:
        segmentation: of the run.
        given: the mesh that the segmenter was given.
        asset: before the first modifier.
        finished: after the last one: limits that it has no more are left out.
    """
    pieces = pieces_of(segmentation, given)
    labels = [part.label or part.name for part in asset.parts]
    places = part_places(asset.mesh, asset.face_part, labels)
    parts, shortened = [], {}
    for index, part in enumerate(asset.parts):
        joint = asset.joint_to(part.name)
        limits = None if joint is None else _stated(joint)
        if joint is not None and limits is not None and not _kept(joint, finished):
            shortened[part.name], limits = limits, None
        root = joint is None
        stated = PartSpec(
            name=part.name,
            label=part.label or None,
            pieces=None if root else whole_pieces(pieces, asset.face_part == index),
            root=root,
            parent=joint.parent if joint else None,
            joint=joint.kind if joint else None,
            axis=axis_words(joint, places[index]) if joint else None,
            limits=limits,
        )
        parts.append(stated)
    spec = Spec(schema=1, numbered=int(pieces.max()) + 1, only=True, parts=tuple(parts))
    rows = {
        "parts, by their order in the file": asset.face_part,
        "pieces, by the numbers that parts are made of": pieces,
    }
    return Draft(spec, shortened, numbered_png(asset.mesh, rows))


def _stated(joint: Joint) -> tuple[float, float] | None:
    """The limits of a joint as a spec has them [degrees | m]."""
    if joint.limits is None:
        return None
    values = np.array([joint.limits.lower, joint.limits.upper])
    lower, upper = np.round(np.degrees(values) if joint.turns else values, 4) + 0.0
    return float(lower), float(upper)


def _kept(joint: Joint, finished: Asset) -> bool:
    """Whether a finished asset has the limits that were predicted."""
    after = finished.joint_to(joint.child)
    if joint.limits is None or after is None or after.limits is None:
        return False
    scale = finished.scale.factor if joint.kind == "prismatic" else 1.0
    return same_limits(after.limits, (joint.limits.lower, joint.limits.upper), scale)


def _segmented(loaded: Source, recipe: Recipe, plugins: Plugins) -> Segmentation:
    if loaded.stated is not None:
        return loaded.stated
    stage, registration = build(recipe.segmenter, Segmenter, plugins, recipe.seed)
    return _called(registration, recipe, lambda: checked(stage.segment(loaded.mesh), loaded.mesh))


def _joints(
    loaded: Source, segmentation: Segmentation, recipe: Recipe, plugins: Plugins
) -> tuple[Joint, ...]:
    if loaded.stated is not None:
        return loaded.stated.joints or ()
    stage, registration = build(recipe.joints, JointPredictor, plugins, recipe.seed)
    mesh = segmentation.mesh_of(loaded.mesh)
    return _called(registration, recipe, lambda: stage.predict(mesh, segmentation))


def _modified(asset: Asset, recipe: Recipe, plugins: Plugins, stated: bool) -> Asset:
    for use in recipe.modify:
        stage, registration = build(use, Modifier, plugins, recipe.seed)
        if not (stated and stage.corrects_joints):
            asset = _called(registration, recipe, _modification(stage, asset))
    return asset


def _modification(stage: Modifier, asset: Asset) -> Callable[[], Asset]:
    return lambda: stage.modify(asset)


def _called(registration: Registration, recipe: Recipe, function: Callable[[], T]) -> T:
    try:
        with time_limit(recipe.stage_timeout):
            return function()
    except (Exception, SystemExit) as cause:
        raise registration.failure(cause) from cause
