"""The material table: every number has a source and is what handbooks allow."""

from __future__ import annotations

import math

import pytest

from simart_kit.asset import Material
from simart_kit.materials import DEFAULT_MATERIAL, MATERIALS, SOURCES, TABLE, Entry, build_of

WANTED = {"wood", "mdf", "glass", "steel", "aluminium", "plastic", "ceramic", "rubber", "fabric"}


def test_names_are_unique_and_common_materials_are_there() -> None:
    names = [entry.material.name for entry in TABLE]
    assert sorted(set(names)) == sorted(names) == sorted(MATERIALS)
    assert set(names) >= WANTED
    assert DEFAULT_MATERIAL in names


@pytest.mark.parametrize("entry", TABLE, ids=lambda entry: entry.material.name)
def test_values_are_possible_and_have_sources(entry: Entry) -> None:
    material, build = entry.material, entry.build
    assert 10 < material.density < 20_000
    assert 0.1 <= material.friction <= 1.2
    assert 0 <= material.restitution < 1
    assert 1e4 < material.youngs_modulus < 1.2e12
    assert set(entry.sources) <= set(SOURCES)
    # Walls twice as thick as the usual ones fill what is just too thick to be solid: no jump upwards.
    assert 2 * build.wall <= build.solid_up_to


@pytest.mark.parametrize(
    ("name", "kilograms", "product"),
    [
        ("wood", (7, 12), "a furniture board per square metre"),
        ("steel", (5, 12), "sheet metal per square metre"),
        ("glass", (10, 15), "a pane per square metre"),
        ("plastic", (2, 4), "a plastic shell per square metre"),
    ],
)
def test_walls_weigh_what_such_products_do(name: str, kilograms: tuple[float, float], product: str) -> None:
    weight = MATERIALS[name].density * build_of(MATERIALS[name]).wall
    assert kilograms[0] <= weight <= kilograms[1], product


def test_every_source_is_used() -> None:
    used = {source for entry in TABLE for source in entry.sources}
    assert set(SOURCES) - used == {"PF"}  # of the estimate of restitutions


def test_a_changed_material_is_built_as_before_and_an_unknown_one_like_wood() -> None:
    assert build_of(Material("steel", 7700.0)) == build_of(MATERIALS["steel"])
    assert build_of(Material("pine", 450.0)) == build_of(MATERIALS["wood"])


def test_density_times_speed_of_sound_squared_is_the_modulus() -> None:
    """Sound in rods of steel, aluminium and glass runs at about 5.1 km/s."""
    for name in ("steel", "aluminium", "glass"):
        material = MATERIALS[name]
        assert math.sqrt(material.youngs_modulus / material.density) == pytest.approx(5100, rel=0.05)
