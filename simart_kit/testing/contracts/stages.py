"""What holds for stages of all kinds."""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import Any, ClassVar

import pytest
from pydantic import ValidationError

from ...recipe import read_options
from ...stages import Stage


class StageContract:
    """What holds for all kinds of stage.

    Attributes:
        stage: the class under test.
        options: its options where the defaults do not do, as a recipe would give them.
        kind: what it must be a subclass of; set by the contract of each kind.
    """

    stage: ClassVar[type[Stage]]
    options: ClassVar[Mapping[str, Any]] = {}
    kind: ClassVar[type[Stage]] = Stage

    def make(self) -> Any:
        """A new stage; its generators start from seed 0."""
        return self.stage(read_options(self.stage, self.options), seed=0)

    def test_is_a_stage_of_its_kind(self) -> None:
        assert issubclass(self.stage, self.kind), (
            f"{self.stage.__name__} is no simart_kit.{self.kind.__name__}"
        )

    def test_name_can_be_written_in_a_recipe(self) -> None:
        name = getattr(self.stage, "name", None)
        assert isinstance(name, str), f"{self.stage.__name__} needs a class attribute `name`"
        assert re.fullmatch(r"[a-z][a-z0-9_-]*", name), (
            f"name '{name}': use a-z, 0-9, _ and -, from a letter on"
        )

    def test_default_options_are_valid(self) -> None:
        self.stage.Options()

    def test_default_options_can_be_stored(self) -> None:
        options = self.stage.Options()
        again = self.stage.Options.model_validate_json(options.model_dump_json())
        assert again == options, "options must survive the way through provenance.json"

    def test_unknown_option_is_rejected(self) -> None:
        with pytest.raises(ValidationError):
            read_options(self.stage, {**self.options, "no_such_option": 1})

    def test_every_option_is_described(self) -> None:
        fields = self.stage.Options.model_fields
        silent = [name for name, field in fields.items() if not (field.description or "").strip()]
        assert not silent, f"give these options a description with their unit: {', '.join(silent)}"

    def test_options_cannot_be_changed(self) -> None:
        assert self.stage.Options.model_config.get("frozen"), "derive Options from simart_kit.Options"
