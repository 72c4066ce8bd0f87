"""`[physics]` of a recipe: materials and parts that a person states."""

from __future__ import annotations

from typing import Any

import pytest
from pydantic import ValidationError
from simart_kit_plugins.modifiers.mass import Mass

import simart_kit as sk
from simart_kit.materials import MATERIALS
from simart_kit.physics_overrides import PhysicsTable, overridden
from simart_kit.testing.meshes import cabinet_asset


def changed(table: dict[str, Any]) -> sk.Asset:
    return overridden(cabinet_asset(physics=False), PhysicsTable.model_validate(table))


def texts(asset: sk.Asset, level: str) -> list[str]:
    return [n.text for n in asset.notes if (n.stage, n.level) == ("physics", level)]


def refusal(table: dict[str, Any]) -> str:
    with pytest.raises(ValidationError) as caught:
        PhysicsTable.model_validate(table)
    return "; ".join(error["msg"] for error in caught.value.errors())


def test_nothing_stated_changes_nothing() -> None:
    asset = cabinet_asset()
    assert overridden(asset, PhysicsTable()) is asset


def test_a_material_of_the_table_changes_everywhere_and_keeps_the_rest() -> None:
    asset = changed({"materials": {"wood": {"density": 450.0}}})
    for part in asset.parts:
        assert part.material.density == 450.0
        assert part.material.friction == MATERIALS["wood"].friction
        assert part.material.youngs_modulus == MATERIALS["wood"].youngs_modulus
    assert len(texts(asset, "info")) == 3


def test_a_new_material_for_one_part() -> None:
    asset = changed(
        {
            "materials": {"walnut": {"density": 640.0, "friction": 0.4, "youngs_modulus": 11.6e9}},
            "parts": {"door": {"material": "walnut"}},
        }
    )
    door = asset.part("door").material
    assert (door.name, door.density, door.friction, door.youngs_modulus) == ("walnut", 640.0, 0.4, 11.6e9)
    assert asset.part("body").material.name == "wood"
    (told,) = texts(asset, "info")
    assert told.startswith("door: walnut, 640 kg/m3, friction 0.4")


def test_patterns_apply_in_order_and_the_later_one_wins() -> None:
    asset = changed(
        {"parts": {"d*": {"material": "steel", "friction": 0.3}, "drawer": {"density": 5000.0, "mass": 4.5}}}
    )
    door, drawer = asset.part("door"), asset.part("drawer")
    assert (door.material.name, door.material.density, door.material.friction) == ("steel", 7850.0, 0.3)
    assert (drawer.material.name, drawer.material.density, drawer.material.friction) == ("steel", 5000.0, 0.3)
    assert (door.stated_mass, drawer.stated_mass) == (None, 4.5)
    assert asset.part("body").material == cabinet_asset(physics=False).part("body").material


def test_a_stated_mass_is_what_the_part_weighs_then() -> None:
    asset = Mass().modify(changed({"parts": {"door": {"mass": 4.5}}}))
    mass = asset.part("door").mass
    assert mass is not None
    assert mass.mass == 4.5


def test_a_pattern_without_a_part_is_told_with_the_parts_there_are() -> None:
    asset = changed({"parts": {"flap_*": {"mass": 1.0}}})
    assert texts(asset, "warning") == ["no part matches 'flap_*': parts are body, door, drawer"]
    assert texts(asset, "info") == []


def test_unknown_materials_are_refused_with_alternatives() -> None:
    told = refusal({"parts": {"door": {"material": "steal"}, "body": {"material": "zzz"}}})
    assert "part 'door': unknown material 'steal', did you mean 'steel'?" in told
    assert "part 'body': unknown material 'zzz': known are aluminium" in told


def test_a_new_material_needs_a_density() -> None:
    assert "material 'walnut' is new and needs a density" in refusal(
        {"materials": {"walnut": {"friction": 0.4}}}
    )


@pytest.mark.parametrize(
    "wrong",
    [
        {"materials": {"wood": {"density": 0.0}}},
        {"materials": {"wood": {"density": float("inf")}}},
        {"materials": {"wood": {"restitution": 1.5}}},
        {"materials": {"wood": {"youngs_modulus": -1.0}}},
        {"parts": {"door": {"mass": -2.0}}},
        {"parts": {"door": {"friction": -0.1}}},
        {"parts": {"door": {"weight": 2.0}}},
        {"part": {}},
    ],
)
def test_senseless_values_are_refused(wrong: dict[str, Any]) -> None:
    assert refusal(wrong)
