from __future__ import annotations

import json

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from simart_kit_plugins.simart.answer.parsing import parse_answer, parse_grounding
from simart_kit_plugins.simart.answer.values import Motion, ObjectAnswer, PartAnswer
from simart_kit_plugins.simart.grammar.machine import Encoded, Machine
from simart_kit_plugins.simart.tokens import TokenGrid, VoxelTokens

from simart_kit.errors import BadInputError

from .grammar_models import GRID, grammar, random_answer


def voxels(*pairs: tuple[int, int]) -> VoxelTokens:
    index, code = np.array(pairs, dtype=np.int32).reshape(-1, 2).T
    return VoxelTokens(GRID, index, code)


ROOT = PartAnswer("fixed", voxels((3, 5), (9, 4095)), name="body")


def box(*parts: PartAnswer, name: str = "Box", scale: float = 40.0) -> ObjectAnswer:
    return ObjectAnswer(name, scale, (ROOT, *parts))


def replay(machine: Machine, encoded: Encoded) -> list[bool]:
    """Feed ids to a machine; gives which of them it had forced."""
    forced = []
    for token in encoded.ids.tolist():
        allowed = machine.allowed()
        assert token in allowed
        assert (len(allowed) == 1) == bool(machine.forced())
        forced.append(bool(machine.forced()))
        machine.advance(token)
    return forced


@pytest.mark.parametrize("merged", [True, False])
def test_an_answer_is_written_as_compact_json_in_fixed_order(merged: bool) -> None:
    door = PartAnswer(
        "revolute",
        voxels((9, 1)),
        name="left door",
        parent=0,
        motion=Motion((100, 138, 101), (100, 0, 0), (-54, 45)),
        material="plastic",
        density=1.2,
        youngs_modulus=2.5,
    )
    pair = grammar(merged)
    encoded = pair.encode_answer(box(door))
    assert pair.text(encoded.ids) == (
        '{"object_captions":{"name":"Box","scale":40.0},"parts_captions":{"0":{"name":"body","type":"fixed"},'
        '"1":{"name":"left door","type":"revolute","parent":"0","center":[100,138,101],"axis":[100,0,0],'
        '"limits":[-54,45],"material":"Plastic","density":"1.2 g/cm^3","Young\'s Modulus (GPa)":2.5}},'
        '"parts_voxels":{"0":"<voxel><xyz_3><mesh_5><voxel><xyz_9><mesh_4095>","1":"<voxel><xyz_9><mesh_1>"}}'
    )


@settings(max_examples=40, deadline=None)
@given(seed=st.integers(0, 2**32 - 1), merged=st.booleans())
def test_answers_come_back_through_text_and_through_the_machine(seed: int, merged: bool) -> None:
    rng = np.random.default_rng(seed)
    cells = np.sort(rng.choice(GRID.cells, rng.integers(1, 12), replace=False))
    answer = random_answer(rng, cells)
    pair = grammar(merged)
    encoded = pair.encode_answer(answer, allowed=cells)
    read = parse_answer(pair.text(encoded.ids), GRID, allowed=cells)
    assert pair.encode_answer(read, allowed=cells).ids.tolist() == encoded.ids.tolist()
    assert (read.name, read.scale, len(read.parts)) == (answer.name, answer.scale, len(answer.parts))
    for one, other in zip(read.parts, answer.parts, strict=True):
        assert one.voxels.text() == other.voxels.text()
        assert (one.name, one.type, one.parent, one.motion) == (
            other.name,
            other.type,
            other.parent,
            other.motion,
        )
        assert (one.material, one.density, one.youngs_modulus) == (
            other.material,
            other.density,
            other.youngs_modulus,
        )
    machine = pair.answer_machine(cells)
    assert replay(machine, encoded) == encoded.forced.tolist()
    assert machine.done


@settings(max_examples=30, deadline=None)
@given(seed=st.integers(0, 2**32 - 1), merged=st.booleans())
def test_whatever_a_machine_is_told_is_an_answer_that_parses(seed: int, merged: bool) -> None:
    rng = np.random.default_rng(seed)
    cells = np.sort(rng.choice(GRID.cells, rng.integers(1, 6), replace=False))
    pair = grammar(merged, max_parts=4)
    machine, ids = pair.answer_machine(cells), []
    while not machine.done:
        ids.append(int(rng.choice(machine.allowed())))
        machine.advance(ids[-1])
    answer = parse_answer(pair.text(ids), GRID, allowed=cells)
    assert 1 <= len(answer.parts) <= 4
    assert all(len(part.voxels.index) for part in answer.parts)
    for part in answer.parts:
        if part.motion and part.motion.limits:
            lower, upper = part.motion.limits
            assert lower <= 0 <= upper
            assert lower < upper


def test_grounding_is_voxels_and_the_end() -> None:
    pair = grammar()
    cells = np.array([2, 9, 40])
    encoded = pair.encode_grounding(voxels((9, 7), (40, 8)), allowed=cells)
    assert pair.text(encoded.ids) == "<voxel><xyz_9><mesh_7><voxel><xyz_40><mesh_8>"
    # Only the first <voxel> and, behind the last cell of the input, the end are no choice.
    assert encoded.forced.tolist() == [True, False, False, False, True, False, True]
    machine = pair.grounding_machine(cells)
    assert replay(machine, encoded) == encoded.forced.tolist()
    assert machine.done
    assert parse_grounding(pair.text(encoded.ids), GRID).code.tolist() == [7, 8]


def test_voxels_rise_within_the_input_and_carry_codes_above_zero() -> None:
    pair = grammar()
    first_cell, first_code = pair.vocabulary.first_coordinate, pair.vocabulary.first_code
    machine = pair.grounding_machine(np.array([40, 2, 9]))
    assert machine.forced() == (pair.vocabulary.first_id,)
    machine.advance(pair.vocabulary.first_id)
    assert (machine.allowed() - first_cell).tolist() == [2, 9, 40]
    machine.advance(first_cell + 9)
    assert (machine.allowed() - first_code).tolist() == list(range(1, 4096))
    with pytest.raises(ValueError, match="not allowed"):
        machine.advance(first_code)
    machine.advance(first_code + 77)
    machine.advance(pair.vocabulary.first_id)
    machine.advance(first_cell + 40)
    machine.advance(first_code + 1)
    assert pair.text(machine.forced()) == ""
    assert len(machine.forced()) == 1


def test_what_does_not_fit_is_rounded() -> None:
    slide = PartAnswer(
        "prismatic",
        voxels((9, 1)),
        name="a  b",
        parent=0,
        motion=Motion((0, 0, 0), (0, 0, 1), (5, 30)),
        material="oak",
        density=7.856,
        youngs_modulus=0.00001,
    )
    still = PartAnswer(
        "revolute", voxels((9, 1)), parent=1, motion=Motion((0, 0, 0), (1, 0, 0), (0, 0)), density=400.0
    )
    pair = grammar()
    table = json.loads(pair.text(pair.encode_answer(box(slide, still, scale=0.01)).ids))
    assert table["object_captions"]["scale"] == 0.1
    first, second = table["parts_captions"]["1"], table["parts_captions"]["2"]
    assert (first["name"], first["limits"], first["material"]) == ("a b", [0, 30], "Wood")
    assert (first["density"], first["Young's Modulus (GPa)"]) == ("7.86 g/cm^3", 0.0001)
    assert (second["name"], second["limits"], second["density"]) == ("", [0, 1], "99.99 g/cm^3")
    assert "material" not in second


@pytest.mark.parametrize(
    ("answer", "message"),
    [
        (
            box(*[PartAnswer("fixed", voxels((9, 1)), parent=0)] * 16),
            "17 parts, but the grammar writes at most 16",
        ),
        (box(PartAnswer("fixed", voxels(), parent=0)), "part 1 of the answer has no voxels"),
        (box(PartAnswer("fixed", voxels((10, 1)), parent=0)), "part 1 of the answer has cell 10"),
    ],
)
def test_answers_that_cannot_be_written_are_refused(answer: ObjectAnswer, message: str) -> None:
    with pytest.raises(BadInputError, match=message):
        grammar().encode_answer(answer, allowed=np.array([3, 9]))


def test_an_input_without_cells_is_refused() -> None:
    with pytest.raises(BadInputError, match="no voxel tokens"):
        grammar().answer_machine(np.array([], dtype=np.int32))


def test_voxels_of_another_grid_are_refused() -> None:
    other = VoxelTokens(TokenGrid((16, 8, 8), 8192), np.array([1]), np.array([1]))
    with pytest.raises(BadInputError, match="is in TokenGrid"):
        grammar().encode_grounding(other)
