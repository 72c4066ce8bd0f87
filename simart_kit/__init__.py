"""simart-kit: turn a static 3D mesh into a simulation-ready articulated asset.

>>> import simart_kit as sk
>>> result = sk.convert("cabinet.glb", recipe="usd")
>>> result.asset, result.report, result.paths
"""

from __future__ import annotations

import importlib
from importlib.metadata import version
from typing import TYPE_CHECKING

from .hookspecs import hookimpl
from .stages import Check, Exporter, JointPredictor, Modifier, Options, PartGuess, Segmentation, Segmenter

if TYPE_CHECKING:
    from .asset import Asset, ConvexMesh, Joint, Limits, MassProperties, Material, Part, Scale
    from .asset_io import load_asset, save_asset
    from .checks import CheckResult
    from .checks.subject import Subject
    from .errors import (
        AmbiguousPluginError,
        BadInputError,
        OutputError,
        PluginError,
        RecipeError,
        SimartKitError,
        StageError,
        UnknownPluginError,
    )
    from .grounding import Candidate, Grounded, Grounding, ground
    from .mesh import Image, Mesh, Note, VisualMaterial
    from .pipeline import Result, convert
    from .plugins import Plugins
    from .primitives import Primitive
    from .report import Report
    from .runner import Run

__version__ = version("simart-kit")

# Loaded on first use: `import simart_kit` and the command line's help stay quick.
_HOMES = {
    "asset": ("Asset", "ConvexMesh", "Joint", "Limits", "MassProperties", "Material", "Part", "Scale"),
    "asset_io": ("load_asset", "save_asset"),
    "checks": ("CheckResult",),
    "checks.subject": ("Subject",),
    "errors": (
        "AmbiguousPluginError",
        "BadInputError",
        "OutputError",
        "PluginError",
        "RecipeError",
        "SimartKitError",
        "StageError",
        "UnknownPluginError",
    ),
    "grounding": ("Candidate", "Grounded", "Grounding", "ground"),
    "mesh": ("Image", "Mesh", "Note", "VisualMaterial"),
    "pipeline": ("Result", "convert"),
    "plugins": ("Plugins",),
    "primitives": ("Primitive",),
    "report": ("Report",),
    "runner": ("Run",),
}
_HOME = {name: module for module, names in _HOMES.items() for name in names}

__all__ = [
    "AmbiguousPluginError",
    "Asset",
    "BadInputError",
    "Candidate",
    "Check",
    "CheckResult",
    "ConvexMesh",
    "Exporter",
    "Grounded",
    "Grounding",
    "Image",
    "Joint",
    "JointPredictor",
    "Limits",
    "MassProperties",
    "Material",
    "Mesh",
    "Modifier",
    "Note",
    "Options",
    "OutputError",
    "Part",
    "PartGuess",
    "PluginError",
    "Plugins",
    "Primitive",
    "RecipeError",
    "Report",
    "Result",
    "Run",
    "Scale",
    "Segmentation",
    "Segmenter",
    "SimartKitError",
    "StageError",
    "Subject",
    "UnknownPluginError",
    "VisualMaterial",
    "convert",
    "ground",
    "hookimpl",
    "load_asset",
    "save_asset",
]


def __getattr__(name: str) -> object:
    if name not in _HOME:
        raise AttributeError(f"module 'simart_kit' has no attribute '{name}'")
    return getattr(importlib.import_module(f"simart_kit.{_HOME[name]}"), name)
