"""Descriptions of parts: many for one part, and none that fits two."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import pytest
from simart_kit_plugins.simart.dataset.color_words import color_word
from simart_kit_plugins.simart.dataset.describing import chosen, clear_phrases
from simart_kit_plugins.simart.dataset.generated import GeneratedJob
from simart_kit_plugins.simart.dataset.kinds import kind_named
from simart_kit_plugins.simart.dataset.part_facts import PartFacts, part_facts, plain_words
from simart_kit_plugins.simart.dataset.source_object import PartWords, SourceObject

from simart_kit.asset import Joint

from .dataset_objects import chest, drawers


def texts(made: SourceObject, colors: bool = False) -> list[set[str]]:
    """For each part, all texts that mean it alone."""
    return [{phrase.text for phrase in clear} for clear in clear_phrases(part_facts(made), colors)]


def facts(label: str, color: str = "", material: str = "", name: str = "") -> PartFacts:
    """A part of which only words are known."""
    words = PartWords(frozenset([material]) - {""}, tuple(filter(None, [color])))
    joint = Joint("j", "fixed", "a", "b")
    return PartFacts(label, name, (0.5, 0.5, 0.5), joint, 0, material, words)


def words(parts: Sequence[PartFacts], colors: bool = True) -> list[set[str]]:
    return [{phrase.text for phrase in clear} for clear in clear_phrases(parts, colors)]


def test_parts_that_are_one_of_a_kind_are_called_by_it() -> None:
    body, drawer, knob = texts(chest())
    assert {"the body", "the part that stays still"} <= body
    assert {"the drawer", "the part that slides", "the part that slides back and forth"} <= drawer
    assert {"the knob", "the part that swings on a hinge", "the knob on the drawer"} <= knob


def test_like_parts_are_told_by_their_places_and_never_by_what_they_share() -> None:
    body, *fronts = texts(drawers([(0.2, 0.8), (0.8, 0.8), (0.2, 0.2), (0.8, 0.2)]))
    assert "the body" in body
    assert [
        f & {"the drawer", "the part that slides", "the left drawer", "the top drawer"} for f in fronts
    ] == [set()] * 4
    for front, (x, z) in zip(
        fronts, [("left", "upper"), ("right", "upper"), ("left", "lower"), ("right", "lower")], strict=True
    ):
        assert front == {f"the {z} {x} drawer"}


def test_parts_in_a_row_are_counted_from_both_ends() -> None:
    _, low, middle, high = texts(drawers([(0.5, 0.2), (0.5, 0.5), (0.5, 0.8)]))
    assert low == {"the bottom drawer"}
    assert middle == {
        "the middle drawer",
        "the second drawer from the top",
        "the second drawer from the bottom",
    }
    assert high == {"the top drawer"}


def test_parts_at_nearly_one_place_have_no_description() -> None:
    assert texts(drawers([(0.5, 0.5), (0.51, 0.5)]))[1:] == [set(), set()]


def test_a_name_that_contradicts_the_viewer_s_sides_is_not_used() -> None:
    _, left, right = texts(drawers([(0.2, 0.5), (0.8, 0.5)], ["right_drawer", "left_drawer"]))
    assert left == {"the left drawer"}
    assert right == {"the right drawer"}


def test_a_label_that_another_part_s_name_mentions_is_not_enough() -> None:
    lid, button = words([facts("lid"), facts("button", name="lid button")])
    assert "the lid" not in lid
    assert {"the button", "the lid button"} <= button


def test_colours_and_materials_must_be_of_one_part_and_are_for_those_who_see_them() -> None:
    parts = [facts("lid", "red", "steel"), facts("knob", "white", "steel"), facts("knob", "blue", "glass")]
    lid, white, blue = words(parts)
    assert {"the red part", "the red lid", "the steel lid"} <= lid
    assert {"the white knob", "the steel knob"} <= white
    assert {"the blue part", "the glass knob", "the part made of glass"} <= blue
    assert not any("part made of steel" in text for one in (lid, white, blue) for text in one)
    assert not any("red" in text for text in words(parts, colors=False)[0])


def test_texts_of_the_data_are_used_where_they_differ() -> None:
    def told(text: str) -> PartFacts:
        return PartFacts("", "", (0.5,) * 3, None, None, "", PartWords(texts=(text,)))

    one, two, three = words(
        [told("It holds water"), told("It bears the weight"), told("It bears the weight")]
    )
    assert "It holds water" in one
    assert "It bears the weight" not in two | three


def test_no_description_of_generated_objects_is_shared() -> None:
    for category in ("cabinet", "piano", "bicycle", "keyboard", "stove"):
        made = GeneratedJob(category, 1, 0).make()
        found = [" ".join(sorted(text.split())) for one in texts(made, colors=True) for text in one]
        assert len(found) == len(set(found)) > 0


def test_chosen_texts_vary_with_the_dice_and_go_by_different_things() -> None:
    clear = clear_phrases(part_facts(chest()), colors=False)[1]
    picks = {chosen(clear, 2, np.random.default_rng(seed)) for seed in range(20)}
    assert len(picks) > 5
    kind = {phrase.text: phrase.kind for phrase in clear}
    for pair in picks:
        assert len({kind.get(text) or kind[f"the {text}"] for text in pair}) == 2
    assert chosen((), 2, np.random.default_rng(0)) == ()


@pytest.mark.parametrize(
    ("name", "expected"),
    [("link_3", ""), ("UpperLeft-Drawer_02", "upperleft drawer"), ("drawer_link", "drawer"), ("x1", "")],
)
def test_names_lose_numbers_and_words_that_say_nothing(name: str, expected: str) -> None:
    assert plain_words(name) == expected


@pytest.mark.parametrize(
    ("name", "expected"), [("door right glass", "door"), ("tray mid sprinkler", ""), ("gizmo", ""), ("", "")]
)
def test_a_kind_is_taken_from_a_name_only_where_it_is_sure(name: str, expected: str) -> None:
    assert kind_named(name) == expected


@pytest.mark.parametrize(
    ("color", "expected"),
    [
        ((255, 255, 255), "white"),
        ((10, 10, 10), "black"),
        ((128, 128, 128), "grey"),
        ((200, 20, 20), "red"),
        ((120, 75, 40), "brown"),
        ((240, 220, 40), "yellow"),
        ((40, 160, 60), "green"),
        ((30, 60, 200), "blue"),
    ],
)
def test_colours_have_everyday_names(color: tuple[int, int, int], expected: str) -> None:
    assert color_word(color) == expected
