"""Lint of USD: the stage, its physics, meshes, looks and files.

USD opens whatever layers refer to. So references are followed first; with a bad one, a stage is not opened.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import numpy as np

from ..errors import BadInputError
from .findings import Finding
from .usd_articulation import articulation_findings
from .usd_bodies import body_findings
from .usd_colliders import collider_findings
from .usd_files import asset_findings, layer_findings
from .usd_joints import joint_findings
from .usd_looks import look_findings
from .usd_meshes import mesh_findings
from .usd_numbers import number_findings, type_findings
from .usd_scene import UsdScene
from .usd_stage import stage_findings

_AR_SUFFIX = ".usdz"


def lint_usd(path: Path) -> tuple[Finding, ...]:
    """Findings about a USD file.

    A `.usdz` without physics is taken for one made for AR, where rules on physics do not apply.
    """
    from pxr import Tf

    with _silent():
        try:
            return tuple(_findings(path))
        except (Tf.ErrorException, BadInputError) as error:
            return (Finding("unreadable", path.name, f"USD cannot read it: {_said(error)}"),)


def _findings(path: Path) -> Iterator[Finding]:
    from pxr import Usd

    found = tuple(layer_findings(path))
    yield from found
    if found:
        return
    stage = Usd.Stage.Open(str(path))
    for error in stage.GetCompositionErrors():
        yield Finding("composition", str(error.rootSite.path), f"{' '.join(str(error).split())}")
    scene = UsdScene(stage)
    mistyped = tuple(type_findings(scene))
    yield from mistyped
    if mistyped:  # the other rules compute with values of the right types
        return
    physical = scene.has_physics or path.suffix.lower() != _AR_SUFFIX
    yield from stage_findings(scene, physical)
    yield from number_findings(scene)
    if physical:
        yield from body_findings(scene)
        yield from collider_findings(scene)
        yield from joint_findings(scene)
        yield from articulation_findings(scene)
    yield from mesh_findings(scene)
    yield from look_findings(scene)
    yield from asset_findings(scene, path)


def _said(error: Exception) -> str:
    """What an error of USD says, in one line; it quotes bytes of damaged files."""
    try:
        text = str(error)
    except UnicodeDecodeError as bytes_of_it:
        text = bytes_of_it.object.decode(errors="replace")
    return " ".join(re.sub(r"pxrInternal\w*__::", "", text).split())


@contextmanager
def _silent() -> Iterator[None]:
    """Keep USD from printing warnings to stderr: what they are about is in the findings."""
    from pxr import UsdUtils

    delegate = UsdUtils.CoalescingDiagnosticDelegate()
    try:
        with np.errstate(all="ignore"):
            yield
    finally:
        delegate.TakeUncoalescedDiagnostics()
