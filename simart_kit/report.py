"""The report of a run: what was found, decided, checked and lost. Written as report.json."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from .asset import Asset
from .checks import CheckResult
from .mesh import Note


@dataclass(frozen=True)
class Report:
    """Everything a person or a script asks after a run.

    Attributes:
        name: the asset's.
        asset: what was made.
        checks: sim-readiness, with evidence.
        notes: decisions and warnings of all stages, in order.
        unsupported: what an export could not express, by exporter.
        seconds: wall time of each stage, in order: (stage, name, seconds).
    """

    name: str
    asset: Asset
    checks: tuple[CheckResult, ...]
    notes: tuple[Note, ...]
    unsupported: dict[str, tuple[str, ...]]
    seconds: tuple[tuple[str, str, float], ...]

    @property
    def passed(self) -> bool:
        """Whether no check failed."""
        return all(c.passed for c in self.checks)

    @property
    def warnings(self) -> tuple[str, ...]:
        """The texts of all warnings."""
        return tuple(f"{n.stage}: {n.text}" for n in self.notes if n.level == "warning")

    @property
    def summary(self) -> str:
        """One line: how many parts move, and how."""
        moving = [j for j in self.asset.joints if j.moves]
        if not moving:
            parts, held = len(self.asset.parts), [j.name for j in self.asset.joints if j.flags]
            told = f"; held fixed, see their flags: {', '.join(held)}" if held else ""
            return f"static: nothing moves ({parts} part{'s' if parts > 1 else ''}, 0 joints{told})"
        kinds = ", ".join(f"{j.child} ({j.kind})" for j in moving)
        return f"{len(self.asset.parts)} parts, {len(moving)} joints: {kinds}"

    def table(self) -> dict[str, Any]:
        """Plain values for report.json; times are left out, so that two runs are the same to the byte."""
        asset = self.asset
        return {
            "name": self.name,
            "summary": self.summary,
            "static": not any(j.moves for j in asset.joints),
            "passed": self.passed,
            "size": [round(float(v), 6) for v in asset.mesh.bounds[1] - asset.mesh.bounds[0]],
            "scale": {"factor": asset.scale.factor, "reason": asset.scale.reason},
            "parts": [_part_row(asset, index) for index in range(len(asset.parts))],
            "joints": [
                {
                    "name": j.name,
                    "kind": j.kind,
                    "parent": j.parent,
                    "child": j.child,
                    "confidence": j.confidence,
                    "evidence": list(j.evidence),
                    "flags": list(j.flags),
                }
                for j in asset.joints
            ],
            "checks": [c.table() for c in self.checks],
            "warnings": list(self.warnings),
            "notes": [f"{n.stage}: {n.text}" for n in self.notes if n.level == "info"],
            "unsupported": {name: list(texts) for name, texts in self.unsupported.items()},
        }


def _part_row(asset: Asset, index: int) -> dict[str, Any]:
    part = asset.parts[index]
    return {
        "name": part.name,
        "label": part.label,
        "faces": int((asset.face_part == index).sum()),
        "material": part.material.name,
        "mass": part.mass.mass if part.mass else None,
        "mass_method": part.mass.method if part.mass else None,
        "collision_shapes": len(part.collision),
    }
