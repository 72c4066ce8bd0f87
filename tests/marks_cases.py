"""A vision-language model that knows the truth about an object, and answers as it is asked to."""

from __future__ import annotations

import json
import re
from collections.abc import Callable, Sequence
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from pydantic import BaseModel
from simart_kit_plugins.marks import axis_sheet, sheets, views
from simart_kit_plugins.marks.lines import Line, Shape, shape_of, sliding_lines, turning_lines
from simart_kit_plugins.vlm import Question, Reply, Usage

from simart_kit.mesh import Mesh

from .vlm_server import Asked

Floats = NDArray[np.float64]
Ints = NDArray[np.integer[Any]]


def small_pictures(patch: pytest.MonkeyPatch) -> None:
    """Make pictures of a few pixels: no model of these tests looks at them, and they take longest."""
    for module in (sheets, axis_sheet):
        patch.setattr(module, "PANEL", 40)
    patch.setattr(sheets, "TILE", 32)
    patch.setattr(views, "_LOOK", 24)
    patch.setattr("simart_kit.drawing.preview.PANEL", (80, 64))


class Scripted:
    """Answers questions by functions, by the name of the answer that is wanted.

    Args:
        answers: from the question to a table, by the name of its answer model.
    """

    def __init__(self, answers: dict[str, Callable[[Question], dict[str, Any]]]) -> None:
        self.answers = answers
        self.asked: list[Question] = []

    def ask(self, question: Question) -> Reply:
        """The table that the function of this kind of answer gives, checked as a real one is."""
        self.asked.append(question)
        raw = json.dumps(self.answers[question.answer.__name__](question))
        value: BaseModel = question.answer.model_validate_json(raw)
        return Reply(value, Usage(1, 1000, 50), "scripted", raw)

    def heard(self, asked: Asked) -> str:
        """What it says to a question that came over HTTP: text of a JSON object."""
        schema = json.loads(asked.system.rpartition("\n")[2])
        answer = SimpleNamespace(model_json_schema=lambda: schema)
        question: Any = SimpleNamespace(text=asked.text, answer=answer)
        return json.dumps(self.answers[schema["title"]](question))


class Knowing(Scripted):
    """Knows the true parts and joints, but at first takes the worst line for those in `mistaken`.

    Args:
        mesh: that was asked about, in the canonical frame.
        piece: (F,) pieces that the pictures number.
        label: (F,) index of the true part of each face.
        parts: name, kind, parent's index (-1 for the body), axis and origin (None without) of each part.
    """

    def __init__(self, mesh: Mesh, piece: Ints, label: Ints, parts: Sequence[dict[str, Any]]) -> None:
        super().__init__({"ObjectAnswer": self._links, "AxisAnswer": self._letter})
        self._mesh, self._piece, self._parts = mesh, piece, parts
        table = np.zeros((int(piece.max()) + 1, len(parts)))
        np.add.at(table, (piece, label), mesh.face_areas)
        self.part_of_piece = table.argmax(axis=1)
        self.errors: dict[str, tuple[float, float]] = {}
        self.mistaken: set[str] = set()

    def _links(self, question: Question) -> dict[str, Any]:
        links = []
        for index, part in enumerate(self._parts):
            pieces = np.flatnonzero(self.part_of_piece == index).tolist()
            if not pieces and part["parent"] >= 0:
                continue
            parent = self._parts[part["parent"]]["name"] if part["parent"] >= 0 else ""
            links.append(
                {
                    "name": part["name"],
                    "label": part["name"],
                    "pieces": pieces,
                    "parent": parent,
                    "kind": part["kind"],
                    "material": "wood",
                    "confidence": 90,
                }
            )
        return {"category": "object", "longest_side_m": 1.0, "links": links}

    def _letter(self, question: Question) -> dict[str, Any]:
        """The letter of the line nearest to the true one."""
        found = re.search(r"The red link '([^']+)'", question.text)
        assert found
        index = next(i for i, part in enumerate(self._parts) if part["name"] == found[1])
        part = self._parts[index]
        mine = np.isin(self._piece, np.flatnonzero(self.part_of_piece == index))
        held = np.isin(self._piece, np.flatnonzero(self.part_of_piece == part["parent"]))
        shape = shape_of(self._mesh, mine, held)
        lines = sliding_lines(shape) if part["kind"] == "prismatic" else turning_lines(shape)
        offered = question.answer.model_json_schema()["properties"]["letter"]["enum"]
        lines = tuple(line for line in lines if line.letter in offered)
        errors = [_error(line, part, shape) for line in lines]
        worst = part["name"] in self.mistaken
        self.mistaken -= {part["name"]}
        costs = [20 * angle + off for angle, off in errors]
        best = int(np.argmax(costs) if worst else np.argmin(costs))
        self.errors[part["name"]] = errors[best]
        return {"letter": lines[best].letter, "confidence": 90}


def _error(line: Line, part: dict[str, Any], shape: Shape) -> tuple[float, float]:
    """Angle [rad], and distance of lines as a share of the diagonal (0 for slides)."""
    cosine = float(line.axis @ part["axis"])
    angle = float(np.arccos(np.clip(cosine if part["kind"] == "prismatic" else abs(cosine), -1, 1)))
    if part["kind"] == "prismatic":
        return angle, 0.0
    off = np.linalg.norm(np.cross(part["origin"] - line.origin, part["axis"])) / shape.diagonal
    return angle, float(off)
