"""What parts are made of, by what they are called and what the object is, and what never moves."""

from simart_kit_plugins.nano.config import NanoConfig
from simart_kit_plugins.nano.knowledge import Knowledge, counted
from simart_kit_plugins.nano.network import NanoNetwork
from simart_kit_plugins.nano.weights import load_model, save_network

from simart_kit.physics import MATERIALS


def test_a_part_is_made_of_what_such_parts_of_such_objects_are():
    usual = {"fridge/door": "steel", "/door": "wood", "fridge/": "plastic", "/": "mdf"}
    known = Knowledge(materials=usual)
    assert known.material({"fridge": 1.0}, "door") == "steel"
    assert known.material({"wardrobe": 1.0}, "door") == "wood"
    assert known.material({"fridge": 1.0}, "ice tray") == "plastic"
    assert known.material({"wardrobe": 1.0}, "flap") == "mdf"
    assert Knowledge().material({"wardrobe": 1.0}, "flap") == "plastic"


def test_of_what_is_not_recognised_all_that_it_may_be_have_a_say():
    known = Knowledge(materials={"safe/": "steel", "wardrobe/": "wood", "desk/": "wood"})
    assert known.material({"safe": 0.4, "wardrobe": 0.35, "desk": 0.25}, "") == "wood"
    assert known.material({"safe": 0.6, "wardrobe": 0.2, "desk": 0.2}, "") == "steel"


def test_knowledge_is_counted_among_generated_objects():
    known = counted(["washing_machine", "bed"], seed=3)
    assert set(known.materials.values()) <= set(MATERIALS)
    assert {"washing_machine/", "bed/", "/"} <= set(known.materials)
    assert known.still == ("bed",)
    assert known == counted(["washing_machine", "bed"], seed=3)


def test_feet_and_eggs_do_not_say_what_a_thing_is_made_of():
    known = counted(["microwave", "fridge"], seed=3)
    assert known.material({"microwave": 1.0}, "") == "steel"  # its rubber feet have more triangles
    assert known.material({"fridge": 1.0}, "door") in ("steel", "plastic")


def test_knowledge_is_kept_beside_the_weights(tmp_path):
    config = NanoConfig(channels=16, layers=1, heads=2, hidden=16, point_channels=8)
    known = Knowledge(materials={"/door": "glass"}, still=("bed",))
    save_network(NanoNetwork(config, 0), tmp_path / "a", known)
    save_network(NanoNetwork(config, 0), tmp_path / "b")
    assert load_model(tmp_path / "a").known == known
    assert load_model(tmp_path / "b").known == Knowledge()
