"""What a conversion found and left, as text for people or one JSON document."""

from __future__ import annotations

import json
import math
import shlex
import shutil
import sys
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from ..asset import Asset, Joint
    from ..checks import CheckResult
    from ..pipeline import Result

# Result's names for its files, where people have a better word.
_WORDS = {"preview": "picture"}


def document(result: Result) -> dict[str, Any]:
    """Plain values: the report, the files and the times."""
    return {
        "ok": True,
        "folder": str(result.folder),
        "files": {key: str(path) for key, path in result.paths.items()},
        "report": result.report.table(),
        "seconds": [{"stage": s, "name": n, "seconds": round(t, 4)} for s, n, t in result.report.seconds],
    }


def text(result: Result, verbose: bool = False) -> str:
    """Lines for people: what was found, a verdict a check, warnings, and where everything is."""
    report = result.report
    lines = [f"{report.name}: {report.summary}", f"  {_size(result.asset)}"]
    lines += [f"  {row}" for row in joint_rows(result.asset)]
    lines += [f"  {verdict(check)}" for check in report.checks]
    if verbose:
        lines += [f"  {n.stage}: {n.text}" for n in report.notes if n.level == "info"]
    lines += [f"  warning: {warning}" for warning in report.warnings]
    lines += [f"  {row}" for row in _lost(report.unsupported, verbose)]
    lines.append(f"files in {result.folder}:")
    lines += [f"  {_WORDS.get(key, key):<10} {path}" for key, path in result.paths.items()]
    if "recording" in result.paths:
        lines.append(f"look at it: {_program()} inspect {shlex.quote(str(result.folder))}")
    return "\n".join(lines)


def _lost(unsupported: Mapping[str, Sequence[str]], verbose: bool) -> list[str]:
    """What formats could not express: all of it, or where to read it, since most runs say the same."""
    rows = [f"{name}: {text}" for name, texts in unsupported.items() for text in texts]
    if verbose or not rows:
        return rows
    names = ", ".join(name for name, texts in unsupported.items() if texts)
    return [
        f"note: {len(rows)} thing(s) that {names} cannot express are told in report.json, or here with -v"
    ]


def joint_rows(asset: Asset) -> Iterator[str]:
    """A line a joint that moves: what, how, how far, and how sure that is."""
    for joint in asset.joints:
        if joint.moves:
            flags = f"  flagged: {'; '.join(joint.flags)}" if joint.flags else ""
            sure = f"confidence {joint.confidence:.0%}"
            yield f"{joint.child:<20} {joint.kind:<10} {travel(joint)} on {joint.parent}, {sure}{flags}"


def travel(joint: Joint) -> str:
    """The range of a joint, in degrees or metres."""
    if joint.limits is None:
        return "without limits"
    lower, upper = joint.limits.lower, joint.limits.upper
    if joint.turns:
        return f"{math.degrees(lower):.0f} .. {math.degrees(upper):.0f} deg"
    return f"{lower:.3f} .. {upper:.3f} m"


def verdict(check: CheckResult) -> str:
    """One line a check."""
    return f"{'ok  ' if check.passed else 'FAIL'}  {check.name}: {check.text}"


def evidence(check: CheckResult) -> str:
    """The numbers behind a verdict, a line for each of its entries."""
    rows = [f"        {key}: {json.dumps(value)}" for key, value in check.evidence.items()]
    return "\n".join(rows)


def _program() -> str:
    """The command's name, or the path that it was called by where the shell does not find the name."""
    called = Path(sys.argv[0])
    return str(called) if called.name == "simart-kit" and not shutil.which(called.name) else "simart-kit"


def _size(asset: Asset) -> str:
    x, y, z = asset.mesh.bounds[1] - asset.mesh.bounds[0]
    return f"{x:.3f} x {y:.3f} x {z:.3f} m (width, depth, height); {asset.scale.reason}"
