"""Check `lint`: each file makes sense by the rules of its format, also those that validators leave out."""

from __future__ import annotations

from ..stages import Check
from . import CheckResult
from .subject import Subject

_SHOWN = 3


class Lint(Check):
    """No error by the rules of docs/lint.md; warnings are listed."""

    name = "lint"

    def check(self, subject: Subject) -> CheckResult:
        """All findings but those about files, which have a check of their own."""
        found = [
            (kind, finding)
            for kind, findings in subject.findings.items()
            for finding in findings
            if not finding.rule.startswith("file-")
        ]
        errors = [f"{kind}: {finding}" for kind, finding in found if finding.severity == "error"]
        warnings = [f"{kind}: {finding}" for kind, finding in found if finding.severity == "warning"]
        more = [f"and {len(errors) - _SHOWN} more"] if len(errors) > _SHOWN else []
        sound = f"no error in {', '.join(subject.findings) or 'no format'}"
        if warnings:
            sound += f", {len(warnings)} warnings"
        text = "; ".join([*errors[:_SHOWN], *more]) or sound
        return CheckResult(self.name, not errors, text, {"errors": errors, "warnings": warnings})
