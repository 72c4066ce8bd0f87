"""Sim-readiness checks: one file each, every verdict with its evidence."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from ..arrays import Vec3
from ..errors import BadInputError

if TYPE_CHECKING:
    from ..plugins import Registration
    from ..stages import Check
    from .subject import Subject


@dataclass(frozen=True)
class Fault:
    """Where a check failed, to be drawn.

    Attributes:
        positions: of joints, by name [rad | m]; those left out are at rest.
        point: (3,) deepest contact, in the asset frame [m].
        depth: how deep it is [m]; 0 where nothing overlaps.
        text: what is seen there, such as "door in cabinet".
    """

    positions: dict[str, float]
    point: Vec3
    depth: float
    text: str


@dataclass(frozen=True)
class CheckResult:
    """One verdict.

    Attributes:
        name: of the check.
        passed: whether the object holds.
        text: one line for people.
        evidence: numbers behind the verdict.
        fault: where it failed, if that is a place.
    """

    name: str
    passed: bool
    text: str
    evidence: dict[str, Any] = field(default_factory=dict)
    fault: Fault | None = None

    def table(self) -> dict[str, Any]:
        """Plain values for report.json; numbers that are not finite, which JSON has not, are null."""
        row = {"name": self.name, "passed": self.passed, "text": self.text, "evidence": self.evidence}
        found: dict[str, Any] = _plain(row | ({"fault": vars(self.fault)} if self.fault else {}))
        return found


def run_checks(checks: Iterable[tuple[Check, Registration]], subject: Subject) -> tuple[CheckResult, ...]:
    """All verdicts, in order; files that cannot be read or simulated fail the checks that need them.

    Args:
        checks: each with where it came from, as `recipe.build_checks` makes them.
        subject: what is checked.

    Raises:
        StageError: a check raised anything else; its plugin is named.
    """
    results, told = [], dict[str, str]()
    for check, registration in checks:
        try:
            results.append(_verdict(check, registration, subject))
        except BadInputError as error:
            first = told.setdefault(str(error), check.name)
            text = str(error) if first == check.name else f"cannot be judged, see {first}"
            results.append(CheckResult(check.name, False, text))
    return tuple(results)


def _verdict(check: Check, registration: Registration, subject: Subject) -> CheckResult:
    import mujoco

    from ..bench.mujoco_loading import one_line, quiet_mujoco

    try:
        with quiet_mujoco():
            return check.check(subject)
    except mujoco.FatalError as error:
        raise BadInputError(f"MuJoCo gave up: {one_line(error)}") from error
    except BadInputError:
        raise
    except Exception as cause:
        raise registration.failure(cause) from cause


def _plain(value: Any) -> Any:
    if isinstance(value, Mapping):
        return {key: _plain(entry) for key, entry in value.items()}
    if isinstance(value, list | tuple):
        return [_plain(entry) for entry in value]
    return None if isinstance(value, float) and not math.isfinite(value) else value
