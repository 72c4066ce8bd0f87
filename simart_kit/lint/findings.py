"""What the linter says: one finding for each breach of a rule."""

from __future__ import annotations

from dataclasses import dataclass, field

from .rules import RULES, Severity


@dataclass(frozen=True)
class Finding:
    """One breach of a rule.

    Attributes:
        rule: id of the rule, a key of `RULES`.
        where: prim path, or name of the link, joint, body or file; "" for the file as a whole.
        text: one line: what is wrong, and what to do about it.
        severity: that of the rule.
    """

    rule: str
    where: str
    text: str
    severity: Severity = field(init=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "severity", RULES[self.rule].severity)

    def __str__(self) -> str:
        place = f"{self.where}: " if self.where else ""
        return f"{self.severity}: {place}{self.text} [{self.rule}]"
