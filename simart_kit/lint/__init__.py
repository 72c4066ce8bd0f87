"""Lint of URDF, MJCF and USD: what makes no sense to a simulator, and public validators let pass."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from ..bench.mujoco_loading import is_urdf
from ..errors import BadInputError
from .findings import Finding
from .mjcf import lint_mjcf
from .rules import RULES, Rule, Severity
from .urdf import lint_urdf
from .usd import lint_usd

__all__ = ["LINTERS", "RULES", "Finding", "Rule", "Severity", "lint", "lint_mjcf", "lint_urdf", "lint_usd"]

# By suffix, lower case.
LINTERS: dict[str, Callable[[Path], tuple[Finding, ...]]] = {
    ".urdf": lint_urdf,
    ".xml": lint_mjcf,
    ".mjz": lint_mjcf,
    ".usd": lint_usd,
    ".usda": lint_usd,
    ".usdc": lint_usd,
    ".usdz": lint_usd,
}


def lint(path: Path) -> tuple[Finding, ...]:
    """Findings about a file, by its suffix; XML whose root is `<robot>` is taken as URDF.

    Raises:
        BadInputError: there is no such file, or no linter for its suffix.
    """
    linter = LINTERS.get(path.suffix.lower())
    if linter is None:
        raise BadInputError(f"{path}: cannot be linted: pick a file of {', '.join(LINTERS)}")
    if not path.is_file():
        raise BadInputError(f"{path}: no such file: check the path")
    return lint_urdf(path) if path.suffix.lower() == ".xml" and is_urdf(path) else linter(path)
