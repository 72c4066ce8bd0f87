"""What parts are made of, by what they are called and what the object is."""

from simart_kit_plugins.nano.config import NanoConfig
from simart_kit_plugins.nano.materials import material_of, usual_materials
from simart_kit_plugins.nano.network import NanoNetwork
from simart_kit_plugins.nano.weights import load_materials, save_network

from simart_kit.physics import MATERIALS


def test_a_part_is_made_of_what_such_parts_of_such_objects_are():
    known = {"fridge/door": "steel", "/door": "wood", "fridge/": "plastic", "/": "mdf"}
    assert material_of(known, "fridge", "door") == "steel"
    assert material_of(known, "wardrobe", "door") == "wood"
    assert material_of(known, "fridge", "ice tray") == "plastic"
    assert material_of(known, "wardrobe", "flap") == "mdf"
    assert material_of({}, "wardrobe", "flap") == "plastic"


def test_materials_are_counted_among_generated_objects():
    known = usual_materials(["washing_machine", "bed"], seed=3)
    assert set(known.values()) <= set(MATERIALS)
    assert {"washing_machine/", "bed/", "/"} <= set(known)
    assert known == usual_materials(["washing_machine", "bed"], seed=3)


def test_materials_are_kept_beside_the_weights(tmp_path):
    config = NanoConfig(channels=16, layers=1, heads=2, hidden=16, point_channels=8)
    save_network(NanoNetwork(config, 0), tmp_path / "a", {"/door": "glass"})
    save_network(NanoNetwork(config, 0), tmp_path / "b")
    assert load_materials(tmp_path / "a") == {"/door": "glass"}
    assert load_materials(tmp_path / "b") == {}
