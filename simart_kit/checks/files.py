"""Check `files`: each format is a folder of its own that can be moved anywhere."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING

from ..stages import Check
from . import CheckResult
from .subject import Subject

if TYPE_CHECKING:
    from ..lint import Finding

# What every file system and loader takes.
_NAME = re.compile(r"[A-Za-z0-9_.\-]+")


class Files(Check):
    """Files are regular, not empty, plainly named, and refer only to what is there, by relative paths."""

    name = "files"

    def check(self, subject: Subject) -> CheckResult:
        """All files beside and below each main file that was exported; of a single file, that one."""
        rows = {
            kind: [*_problems(path, subject.asset is not None), *_references(subject.findings.get(kind, ()))]
            for kind, path in subject.files.items()
        }
        wrong = [f"{kind}: {text}" for kind, texts in rows.items() for text in texts]
        text = "; ".join(wrong) or f"relative paths only, nothing missing: {', '.join(rows) or 'no format'}"
        return CheckResult(self.name, not wrong, text, {"formats": rows})


def _problems(main: Path, exported: bool) -> Iterator[str]:
    if not main.is_file():
        yield f"{main.name} is missing"
        return
    for path in sorted(main.parent.rglob("*")) if exported else [main]:
        relative = path.relative_to(main.parent).as_posix()
        if path.is_symlink():
            yield f"{relative} is a link"
        elif path.is_file() and path.stat().st_size == 0:
            yield f"{relative} is empty"
        elif not all(_NAME.fullmatch(part) for part in Path(relative).parts):
            yield f"'{relative}' has characters that some loaders cannot read"


def _references(findings: Iterable[Finding]) -> Iterator[str]:
    """What the linter says of files that the main file names."""
    for finding in findings:
        if finding.rule.startswith("file-") and finding.severity == "error":
            yield f"{finding.where}: {finding.text}"
