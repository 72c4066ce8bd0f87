"""What a check must keep."""

from __future__ import annotations

import json

import pytest

from ...checks import CheckResult
from ...checks.subject import Subject
from ...errors import BadInputError
from ...stages import Check
from .. import meshes
from ..fingerprint import fingerprint, folder_fingerprint
from .stages import StageContract


class CheckContract(StageContract):
    """For Checks."""

    kind = Check

    @pytest.fixture(params=["cabinet", "chain", "static"])
    def subject(self, request: pytest.FixtureRequest) -> Subject:
        """What is judged: by default assets without files; write some where the check reads them."""
        return Subject({}, getattr(meshes, f"{request.param}_asset")())

    def test_tells_a_verdict_in_one_line(self, subject: Subject) -> None:
        result = self.make().check(subject)
        assert isinstance(result, CheckResult), f"check() returned {type(result).__name__}"
        assert result.name == self.stage.name, f"the result is named '{result.name}', not '{self.stage.name}'"
        assert isinstance(result.passed, bool), f"passed is a {type(result.passed).__name__}, expected a bool"
        assert result.text, "tell what was found"
        assert "\n" not in result.text, "tell it in one line"

    def test_same_verdict_every_time(self, subject: Subject) -> None:
        again = Subject(subject.files, subject.asset)
        one, two = (self.make().check(each).table() for each in (subject, again))
        assert one == two, (
            "two runs must write the same report: leave times out, start generators from a seed"
        )

    def test_leaves_the_subject_alone(self, subject: Subject) -> None:
        folders = {path.parent for path in subject.files.values()}
        before = fingerprint(subject.asset), [folder_fingerprint(folder) for folder in sorted(folders)]
        self.make().check(subject)
        after = fingerprint(subject.asset), [folder_fingerprint(folder) for folder in sorted(folders)]
        assert after == before, "check() changed what it judges"

    def test_evidence_is_plain_json(self, subject: Subject) -> None:
        table = self.make().check(subject).table()
        try:
            text = json.dumps(table, allow_nan=False)
        except TypeError as error:
            pytest.fail(f"evidence goes into report.json: {error}; turn NumPy's values into Python's")
        assert json.loads(text) == table, "keys of evidence must be text"

    def test_nothing_to_judge_is_told(self) -> None:
        try:
            result = self.make().check(Subject())
        except BadInputError as error:
            assert str(error)  # noqa: PT017  either answer will do
        else:
            assert result.text
