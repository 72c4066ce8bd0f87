"""What an answer says of materials means a row of the material table."""

import pytest
from simart_kit_plugins.simart.answer.choices import choose_material, material_of, material_text
from simart_kit_plugins.simart.answer.values import NAME_PATTERN

from simart_kit.materials import DEFAULT_MATERIAL, MATERIALS


@pytest.mark.parametrize("name", MATERIALS)
def test_every_row_is_read_as_it_is_written(name):
    text = material_text(name)
    assert NAME_PATTERN.fullmatch(text)
    assert choose_material(text, None).material == name
    assert choose_material(text.upper(), 1.0).by == "name"


@pytest.mark.parametrize(
    ("text", "material"),
    [
        ("Plastic", "plastic"),
        ("MDF", "mdf"),
        ("medium-density fiberboard", "mdf"),
        ("Stainless Steel", "steel"),
        ("steel, brushed", "steel"),
        ("Cast Iron", "steel"),
        ("Aluminum Alloy", "aluminium"),
        ("Tempered Glass", "glass"),
        ("ABS", "plastic"),
        ("ABS Plastics", "plastic"),
        ("solid oak", "wood"),
        ("Ceramics", "ceramic"),
        ("Polyurethane Foam", "foam"),
        ("Metal", "steel"),
        ("metals", "steel"),
    ],
)
def test_names_synonyms_and_kinds(text, material):
    assert material_of(text, None) == material


def test_density_tells_which_metal():
    assert material_of("Metal", 7.8) == "steel"
    assert material_of("Metal", 2.7) == "aluminium"
    assert material_of("Metal", 8.5) == "brass"
    # Named ones are what they are called, whatever their density.
    assert material_of("Steel", 2.7) == "steel"


def test_density_tells_where_no_name_does():
    choice = choose_material("Unobtainium", 2.7)
    assert (choice.material, choice.by) == ("aluminium", "density")
    # By ratio: 0.12 is 3 times foam's 0.04, and fabric's 0.3 is 2.5 times that.
    assert material_of("", 0.12) == "fabric"
    assert material_of("", 0.001) == "foam"


def test_nothing_known_gives_the_default():
    for text in ("", "Unobtainium", "glassy"):
        choice = choose_material(text, None)
        assert (choice.material, choice.by) == (DEFAULT_MATERIAL, "default")
