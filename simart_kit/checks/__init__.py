"""Sim-readiness checks: one file each, every verdict with its evidence."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field
from functools import partial
from typing import TYPE_CHECKING, Any

from ..arrays import Vec3
from ..beside import ALONE, Beside
from ..errors import BadInputError

if TYPE_CHECKING:
    from ..plugins import Registration
    from ..stages import Check
    from .subject import Subject

_MANY = 8  # moving joints from which on it takes longer to drive them than to read the files once more


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


def run_checks(
    checks: Iterable[tuple[Check, Registration]], subject: Subject, beside: Beside = ALONE
) -> tuple[CheckResult, ...]:
    """All verdicts, in order; files that cannot be read or simulated fail the checks that need them.

    Args:
        checks: each with where it came from, as `recipe.build_checks` makes them.
        subject: what is checked.
        beside: who runs those that drive joints one after the other, of an object of many.

    Raises:
        StageError: a check raised anything else; its plugin is named.
    """
    given, told, outcomes = list(checks), dict[str, str](), dict[str, CheckResult | BadInputError]()
    many = beside.helps and subject.moving >= _MANY
    asked = {c.name: beside.ask(judged, c, subject.bare()) for c, _ in given if many and c.drives}
    for check, registration in sorted(given, key=lambda pair: pair[0].name in asked):
        later = asked.get(check.name)
        outcomes[check.name] = _outcome(
            later.result if later else partial(judged, check, subject), registration
        )
    results = []
    for check, _ in given:
        found = outcomes[check.name]
        if isinstance(found, BadInputError):
            first = told.setdefault(str(found), check.name)
            text = str(found) if first == check.name else f"cannot be judged, see {first}"
            found = CheckResult(check.name, False, text)
        results.append(found)
    return tuple(results)


def judged(check: Check, subject: Subject) -> CheckResult:
    """The verdict of one check, with MuJoCo's own words kept from the terminal."""
    from ..bench.mujoco_loading import quiet_mujoco

    with quiet_mujoco():
        return check.check(subject)


def _outcome(verdict: Callable[[], CheckResult], registration: Registration) -> CheckResult | BadInputError:
    """The verdict, or why there can be none."""
    import mujoco

    from ..bench.mujoco_loading import one_line

    try:
        return verdict()
    except mujoco.FatalError as error:
        return BadInputError(f"MuJoCo gave up: {one_line(error)}")
    except BadInputError as error:
        return error
    except Exception as cause:
        raise registration.failure(cause) from cause


def _plain(value: Any) -> Any:
    if isinstance(value, Mapping):
        return {key: _plain(entry) for key, entry in value.items()}
    if isinstance(value, list | tuple):
        return [_plain(entry) for entry in value]
    return None if isinstance(value, float) and not math.isfinite(value) else value
