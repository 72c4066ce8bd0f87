"""Protocols and formats in words, as the documentation prints them."""

from __future__ import annotations

import re

import pytest

from simart_kit.bench.describe import explained, formats_text, protocols_text, untwinned
from simart_kit.bench.formats import prediction_formats, truth_formats
from simart_kit.bench.protocols import Metric, protocols

METRICS = (
    Metric("axis", "Axis", "lower", "angle of a|b.", unit="rad"),
    Metric("axis_matched", "Axis, matched", "lower", "angle; matched parts only", unit="rad"),
    Metric("f1_matched", "F1", "higher", "of something"),
)


def section(name: str) -> str:
    """What is told of a protocol."""
    return protocols_text().partition(f"### `{name}`")[2].partition("\n### ")[0]


def rows(text: str) -> list[list[str]]:
    """Cells of all tables in a text; a bar with a backslash is a character."""
    return [re.split(r"(?<!\\)\|", line)[1:-1] for line in text.splitlines() if line.startswith("|")]


def test_a_metric_is_left_out_where_it_repeats_another_over_matched_parts():
    assert [metric.key for metric in untwinned(METRICS)] == ["axis", "f1_matched"]


def test_a_metric_is_explained_in_a_sentence():
    assert explained(METRICS[0]) == "Angle of a|b; lower is better."
    assert explained(Metric("n", "N", "", "number of joints.")) == "Number of joints."


@pytest.mark.parametrize("name", protocols())
def test_every_metric_has_a_row_of_its_own_or_is_told_beside_its_twin(name):
    metrics = protocols()[name].metrics
    table = rows(section(name))[2:]
    assert {len(cells) for cells in table} == {4}
    keys = [re.findall("`([^`]*)`", cells[0]) for cells in table]
    expanded = [key for first, *ends in keys for key in (first, *(first + end[1:] for end in ends))]
    assert sorted(expanded) == sorted(metric.key for metric in metrics)


def test_titles_carry_their_unit():
    titles = {cells[0].split()[0]: cells[1].strip() for cells in rows(section("simart"))}
    assert titles["`axis`"] == "Axis [rad]"
    assert titles["`iou`"] == "IoU"


@pytest.mark.parametrize(
    ("name", "sentence"),
    [
        ("simart", "`type_matched` is `type` over matched parts only"),
        ("particulate", "`rest_per_part_avg_chamfer_nopunish` is `rest_per_part_avg_chamfer` over matched"),
    ],
)
def test_twins_are_told_in_a_sentence(name, sentence):
    assert sentence in section(name)


def test_protocols_without_twins_say_nothing_of_them():
    assert "come twice" not in section("s2o")


@pytest.mark.parametrize("name", protocols())
def test_flaws_and_departures_are_listed(name):
    told = section(name)
    assert "Known flaws and departures, kept as they are:" in told
    assert all(f"- {flaw}\n" in told for flaw in protocols()[name].flaws)


def test_no_format_can_break_its_row_or_vanish_as_a_tag():
    table = rows(formats_text())
    assert len(table) == len(truth_formats()) + len(prediction_formats()) + 4  # two heads, two rulers
    assert {len(cells) for cells in table} == {2}
    assert r"\<mujoco>" in formats_text()
    assert not re.search(r"(?<!\\)\*", formats_text())
