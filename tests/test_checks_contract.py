"""What `CheckContract` finds in a check that does not keep it, and lets pass in one that does."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from simart_kit import Check, CheckResult, Subject
from simart_kit.testing import fakes
from simart_kit.testing.contracts import CheckContract, StageContract
from simart_kit.testing.meshes import static_asset

TESTS = [name for name in vars(CheckContract) if name.startswith("test_") and name not in vars(StageContract)]


def keeps(stage: type[Check], test: str, subject: Subject) -> None:
    """Run one test of the contract on a check."""
    case = type("Case", (CheckContract,), {"stage": stage})()
    getattr(case, test)(*([] if test == "test_nothing_to_judge_is_told" else [subject]))


def answering(answer: Callable[[Subject], Any]) -> type[Check]:
    class Answering(Check):
        """Answers what the test said."""

        name = "fake"

        def check(self, subject: Subject) -> CheckResult:
            result: CheckResult = answer(subject)
            return result

    return Answering


def told(evidence: dict[Any, Any]) -> CheckResult:
    return CheckResult("fake", True, "fine", evidence)


def scribble(subject: Subject) -> CheckResult:
    for path in subject.files.values():
        path.with_name("notes.txt").write_text("was here")
    return told({})


def by_chance() -> Callable[[Subject], CheckResult]:
    rng = np.random.default_rng(0)
    return lambda subject: told({"luck": rng.random()})


def crash(subject: Subject) -> CheckResult:
    if subject.asset is None:
        raise AttributeError("no asset")
    return told({})


WRONG: dict[str, tuple[Callable[[Subject], Any], str]] = {
    "no result": (lambda subject: True, "test_tells_a_verdict_in_one_line"),
    "another name": (lambda subject: CheckResult("other", True, "fine"), "test_tells_a_verdict_in_one_line"),
    "two lines": (
        lambda subject: CheckResult("fake", True, "fine\nor not"),
        "test_tells_a_verdict_in_one_line",
    ),
    "no words": (lambda subject: CheckResult("fake", True, ""), "test_tells_a_verdict_in_one_line"),
    "chance": (by_chance(), "test_same_verdict_every_time"),
    "a note left": (scribble, "test_leaves_the_subject_alone"),
    "NumPy's": (lambda subject: told({"mass": np.float32(1.0)}), "test_evidence_is_plain_json"),
    "an array": (lambda subject: told({"mass": np.ones(3)}), "test_evidence_is_plain_json"),
    "a number as key": (lambda subject: told({1: "one"}), "test_evidence_is_plain_json"),
    "a crash": (crash, "test_nothing_to_judge_is_told"),
}


@pytest.fixture
def subject(tmp_path: Path) -> Subject:
    (tmp_path / "made.txt").write_text("a box")
    return Subject({"text": tmp_path / "made.txt"}, static_asset())


@pytest.mark.parametrize("wrong", WRONG)
def test_contract_finds(wrong: str, subject: Subject) -> None:
    answer, test = WRONG[wrong]
    with pytest.raises((AssertionError, AttributeError, pytest.fail.Exception)):
        keeps(answering(answer), test, subject)


@pytest.mark.parametrize("test", TESTS)
def test_contract_lets_pass(test: str, subject: Subject) -> None:
    keeps(fakes.check(), test, subject)
    keeps(answering(lambda subject: told({"ratio": float("inf"), "rows": [1, 2.5, None]})), test, subject)
