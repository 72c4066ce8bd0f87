"""What several test files share."""

from __future__ import annotations

import signal
from collections.abc import Callable
from functools import cache
from pathlib import Path

import pytest

import simart_kit as sk

from .once import made_once
from .real_objects import ANY_SPEED, source


def pytest_configure() -> None:
    """Let Ctrl-C reach the processes of tests: what a script puts in the background ignores it."""
    if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:
        signal.signal(signal.SIGINT, signal.default_int_handler)


@pytest.fixture(scope="session")
def converted(tmp_path_factory: pytest.TempPathFactory) -> Callable[[str], sk.Result]:
    """Convert an object of `real_objects` by its name, once; the example with its picture and recording."""

    @cache
    def convert(name: str) -> sk.Result:
        example = name == "example"

        def make(folder: Path) -> sk.Result:
            with pytest.MonkeyPatch.context() as patch:
                if not example:  # pictures take longest
                    patch.setattr("simart_kit.render.write_preview", lambda asset, path: path)
                file, out = source(name), folder / name
                return sk.convert(file, "geometric", out=out, sets=ANY_SPEED, record=example)

        return made_once(tmp_path_factory, f"converted_{name}", make)

    return convert


@pytest.fixture
def write(tmp_path: Path) -> Callable[[str, str], Path]:
    """Write a text file below the test's folder; returns its path."""

    def write(name: str, text: str) -> Path:
        path = tmp_path / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
        return path

    return write
