"""Importing one plugin: a module of ours, an entry point, or a Python file."""

from __future__ import annotations

import hashlib
import importlib
import importlib.util
import sys
from importlib.metadata import EntryPoint
from pathlib import Path
from types import ModuleType
from typing import Any


def import_plugin(source: str | EntryPoint | Path) -> Any:
    """The plugin object: a module, or what an entry point or `module:attribute` names.

    Raises:
        FileNotFoundError, ImportError: there is none; besides whatever its code raises.
    """
    if isinstance(source, EntryPoint):
        return source.load()
    if isinstance(source, Path):
        return _import_file(source)
    module, _, attribute = source.partition(":")
    loaded = importlib.import_module(module)
    return getattr(loaded, attribute) if attribute else loaded


def _import_file(path: Path) -> ModuleType:
    if not path.is_file():
        raise FileNotFoundError(f"no plugin file {path}")
    digest = hashlib.sha256(str(path.resolve()).encode()).hexdigest()[:8]
    name = f"simart_kit_file_{path.stem}_{digest}"
    spec = importlib.util.spec_from_file_location(name, path)
    if spec is None or spec.loader is None:
        raise ImportError(f"{path} is not a Python file")
    module = importlib.util.module_from_spec(spec)
    # Dataclasses and pydantic look postponed annotations up through sys.modules.
    sys.modules[name] = module
    try:
        spec.loader.exec_module(module)
    except BaseException:
        del sys.modules[name]
        raise
    return module
