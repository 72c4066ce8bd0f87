"""Sim-readiness checks: one file each, every verdict with its evidence."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from ..asset import Asset


@dataclass(frozen=True)
class CheckResult:
    """One verdict.

    Attributes:
        name: of the check.
        passed: whether the asset holds.
        text: one line for people.
        evidence: numbers behind the verdict.
    """

    name: str
    passed: bool
    text: str
    evidence: dict[str, Any]

    def table(self) -> dict[str, Any]:
        """Plain values for report.json."""
        return {"name": self.name, "passed": self.passed, "text": self.text, "evidence": self.evidence}


Check = Callable[["Asset"], CheckResult]


def run_checks(asset: Asset) -> tuple[CheckResult, ...]:
    """All checks, in the order of the files' names."""
    from .collision import check_collision
    from .joints import check_joints
    from .mass import check_mass

    checks: tuple[Check, ...] = (check_collision, check_joints, check_mass)
    return tuple(check(asset) for check in checks)
