"""Verdicts for people: a table of objects and judges, then what is wrong."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass

from .comparing import Verdict

SHOWN = 3  # objects named for an error that many have
LINES, WIDTH = 20, 300  # errors of a judge that are printed, and characters of each


@dataclass(frozen=True)
class Hearing:
    """What one judge said.

    Attributes:
        judge: its name.
        verdicts: by object; one without a file for the judge has none.
        missed: defects put in on purpose that it did not object to.
        absent: why the judge was not asked, or "".
        broken: whether it should have been asked all the same.
    """

    judge: str
    verdicts: Mapping[str, Verdict]
    missed: tuple[str, ...] = ()
    absent: str = ""
    broken: bool = False

    @property
    def errors(self) -> int:
        """Of all objects."""
        return sum(len(verdict.errors) for verdict in self.verdicts.values())

    @property
    def failed(self) -> bool:
        """Whether somebody has to look into it."""
        return self.broken or bool(self.missed) or self.errors > 0


def report(hearings: list[Hearing], names: list[str]) -> str:
    """Everything as text: errors by object and judge, a line a judge, and the errors themselves."""
    lines = [*_grid(hearings, names), "", *_summary(hearings)]
    for hearing in hearings:
        lines += _told(hearing)
    return "\n".join(lines)


def _grid(hearings: list[Hearing], names: list[str]) -> list[str]:
    """A row an object; columns are numbered, for names of judges are long."""
    width = max([len(name) for name in names] + [6])
    head = f"{'errors':{width}}" + "".join(f"{number:>4}" for number in range(1, len(hearings) + 1))
    rows = [f"{name:{width}}" + "".join(f"{_cell(h, name):>4}" for h in hearings) for name in names]
    return [head, *rows]


def _cell(hearing: Hearing, name: str) -> str:
    verdict = hearing.verdicts.get(name)
    return "-" if verdict is None else str(len(verdict.errors) or ".")


def _summary(hearings: list[Hearing]) -> list[str]:
    lines = []
    for number, hearing in enumerate(hearings, 1):
        found = hearing.verdicts.values()
        poses = [v.pose_error for v in found if v.pose_error is not None]
        pose = f"poses within {max(poses):.0e}" if poses else ""
        seconds = sum(v.seconds for v in found)
        blind = f"  does not see: {', '.join(hearing.missed)}" if hearing.missed else ""
        said = (
            hearing.absent
            or f"{len(found):3} files {hearing.errors:4} errors {seconds:6.1f} s  {pose}{blind}"
        )
        lines.append(f"{number:3} {hearing.judge:16} {said}".rstrip())
    return lines


def _told(hearing: Hearing) -> list[str]:
    """The errors, those that differ in their numbers only together, with the objects that have them."""
    kinds: dict[str, list[tuple[str, str]]] = {}
    for name, verdict in hearing.verdicts.items():
        for text in verdict.errors:
            kinds.setdefault(re.sub(r"\d+", "0", text), []).append((name, text))
    lines = [f"  {len(found)} x {_short(found[0][1])} [{_some([*dict(found)])}]" for found in kinds.values()]
    if len(lines) > LINES:
        lines[LINES:] = [f"  and {len(lines) - LINES} kinds more"]
    return ["", f"{hearing.judge}:", *lines] if lines else []


def _some(names: list[str]) -> str:
    more = f" and {len(names) - SHOWN} more" if len(names) > SHOWN else ""
    return ", ".join(names[:SHOWN]) + more


def _short(text: str) -> str:
    line = " ".join(text.split())
    return line if len(line) <= WIDTH else f"{line[: WIDTH - 3]}..."
