"""Reads USD, USDA, USDC and USDZ: the meshes that a renderer would show, at the stage's earliest time.

Up axis and unit are the stage's (USD's defaults: +y, centimetre). Layers and textures must lie in the file's
folder or in the package.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from simart_kit import BadInputError, Mesh, hookimpl
from simart_kit.findings import Finding, library
from simart_kit.mesh import UpAxis

from .folder import inside
from .guards import check_zip, reading
from .materials import Palette
from .pieces import bounded, joined
from .usd_materials import Looks
from .usd_mesh import mesh_piece
from .usd_scene import shown_meshes

KINDS = ("usd", "usda", "usdc", "usdz")
UP: dict[str, UpAxis] = {"Y": "+y", "Z": "+z"}


@hookimpl
def load_mesh(path: Path) -> Mesh | None:
    """Read a USD file."""
    kind = path.suffix.lower().lstrip(".")
    if kind not in KINDS:
        return None
    with reading(path, kind.upper()):
        if kind == "usdz":
            check_zip(path)
        with _diagnostics() as said:
            return _load(path, said)


def _load(path: Path, said: Callable[[], list[str]]) -> Mesh:
    from pxr import Usd, UsdGeom

    root = path.parent.resolve()
    _check_layers(path, root)
    stage = Usd.Stage.Open(str(path))
    for layer in stage.GetUsedLayers():
        if layer.realPath and not on_disk(root, layer.realPath):
            raise BadInputError(
                f"it reads layer {layer.identifier}, which is outside its folder: copy it there"
            )
    looks = Looks(root, Palette())
    skipped: set[str] = set()
    pieces = bounded(
        mesh_piece(prim, looks, node).moved(matrix)
        for node, (prim, matrix) in enumerate(shown_meshes(stage, skipped))
    )
    warnings = [f"{kind} prims are left out: only meshes are read" for kind in sorted(skipped)]
    warnings += [*looks.warnings, *looks.palette.warnings, *said()]
    up, metres = UP[UsdGeom.GetStageUpAxis(stage)], UsdGeom.GetStageMetersPerUnit(stage)
    return joined(pieces, looks.palette.materials, up, metres, nodes=True, warnings=warnings)


def on_disk(root: Path, name: str) -> Path | None:
    """The file, or the package that holds it, below `root`; None for any other place."""
    from pxr import Ar

    while Ar.IsPackageRelativePath(name):
        name = Ar.SplitPackageRelativePathOuter(name)[0]
    return inside(root, name)


def _check_layers(path: Path, root: Path) -> None:
    """Follow sublayers, references and payloads before USD does, and refuse one that leaves the folder."""
    from pxr import Sdf

    waiting, seen = [Sdf.Layer.FindOrOpen(str(path))], {str(path)}
    if waiting[0] is None:
        raise BadInputError("not a USD layer; check it, or export it again")
    while waiting:
        layer = waiting.pop()
        for name in layer.GetCompositionAssetDependencies():
            target = Sdf.ComputeAssetPathRelativeToLayer(layer, name)
            if not on_disk(root, target):
                raise BadInputError(f"it refers to '{name}', which is not in its folder: copy it there")
            if target not in seen:
                seen.add(target)
                waiting.append(_opened(target, name))


def _opened(target: str, name: str) -> Any:
    from pxr import Sdf

    layer = Sdf.Layer.FindOrOpen(target)
    if layer is None:
        raise BadInputError(f"it refers to '{name}', which is not a USD layer")
    return layer


def plain(commentary: str) -> str:
    """One line of what USD says, without its namespaces."""
    return " ".join(re.sub(r"pxrInternal\w*__::", "", commentary).split())


@contextmanager
def _diagnostics() -> Iterator[Callable[[], list[str]]]:
    """Hold back USD's warnings, which it would print, and make its errors one line.

    Yields a function that takes what was said so far.
    """
    from pxr import Tf, UsdUtils

    delegate = UsdUtils.CoalescingDiagnosticDelegate()

    def said() -> list[str]:
        return list(dict.fromkeys(plain(d.commentary) for d in delegate.TakeUncoalescedDiagnostics()))

    try:
        yield said
    except Tf.ErrorException as error:
        raise BadInputError(
            f"not readable as USD: {plain(error.args[0].commentary)}; export it again"
        ) from error
    finally:
        said()


@hookimpl
def diagnose() -> list[Finding]:
    """OpenUSD's libraries; other formats are read without."""
    return [library("usd-core", stages=())]
