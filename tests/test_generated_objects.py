"""Generated objects: what each category promises, posing, files and the command."""

import json
import re

import numpy as np
import pytest
import trimesh
from simart_kit_plugins.nano.generate.catalogue import CATEGORIES
from simart_kit_plugins.nano.generate.category import Category, named
from simart_kit_plugins.nano.generate.data_set import generated, write_objects
from simart_kit_plugins.nano.generate.objects import (
    Body,
    GeneratedObject,
    Look,
    Surface,
    ball,
    free,
    hinge,
    root,
    slide,
    spin,
    surface,
)
from simart_kit_plugins.nano.generate.posing import ajar, posed
from simart_kit_plugins.shapes.dice import Dice
from simart_kit_plugins.shapes.primitives import between

from simart_kit.bench.formats.simart_bench import SimartBench
from simart_kit.cli.main import run
from simart_kit.errors import BadInputError

from .generated_contract import check

WOOD, STEEL = Look("wood", (200, 150, 100)), Look("steel", (90, 90, 95))


def wardrobe(dice=None):
    """A box of 1 x 0.5 x 2 m; a door hinged at its left front edge, a handle that turns on it, a drawer."""
    body = root([surface([between((0, 0, 0), (1, 0.5, 2))], WOOD)])
    door = surface([between((0, -0.02, 0.5), (1, 0, 2))], WOOD)
    handle = surface([between((0.9, -0.06, 1.2), (0.94, -0.02, 1.3))], STEEL)
    drawer = surface([between((0, -0.02, 0), (1, 0, 0.49))], WOOD)
    return [
        body,
        Body("door", "door", (door,), 0, hinge((0, 0, 0), (0, 0, -1), np.pi / 2)),
        Body("handle", "handle", (handle,), 1, hinge((0.92, -0.02, 1.25), (0, 1, 0), 0.5, -0.5)),
        Body("drawer", "drawer", (drawer,), 0, slide((0, -1, 0), 0.4)),
    ]


MADE = GeneratedObject("wardrobe", tuple(wardrobe()))


@pytest.mark.parametrize("category", CATEGORIES, ids=lambda category: category.name)
def test_a_category_keeps_what_all_promise(category):
    check(category)


def test_there_are_at_least_24_articulated_and_10_static_categories():
    names = [category.name for category in CATEGORIES]
    assert len(set(names)) == len(names)
    assert sum(category.moves for category in CATEGORIES) >= 24
    assert sum(not category.moves for category in CATEGORIES) >= 10


def test_an_opened_door_carries_its_handle_and_the_handles_axis():
    opened = posed(MADE, [0, np.pi / 2, 0.25, 0.1])
    low, high = opened.bodies[1].triangles.min((0, 1)), opened.bodies[1].triangles.max((0, 1))
    # Turned clockwise about the z axis through 0, what lay along +x lies along -y.
    assert np.allclose([low, high], [[-0.02, -1, 0.5], [0, 0, 2]], atol=1e-9)
    handle = opened.bodies[2].motion
    assert np.allclose(handle.axis, [1, 0, 0], atol=1e-9)
    assert np.allclose(handle.origin, [-0.02, -0.92, 1.25], atol=1e-9)
    assert (handle.lower, handle.upper) == pytest.approx((-0.75, 0.25))
    assert np.allclose(opened.bodies[3].triangles, MADE.bodies[3].triangles - [0, 0.1, 0])
    assert opened.bodies[0] is MADE.bodies[0]


def test_joints_posed_ajar_stay_between_their_limits_and_can_go_back():
    open_ = ajar(MADE, Dice(3), share=1.0)
    positions = []
    for body, before in zip(open_.bodies[1:], MADE.bodies[1:], strict=True):
        assert body.motion.lower <= 0 <= body.motion.upper
        positions.append(before.motion.lower - body.motion.lower)
    assert all(abs(position) > 1e-4 for position in positions)
    back = posed(open_, [0, *(-position for position in positions)])
    for body, before in zip(back.bodies, MADE.bodies, strict=True):
        assert np.allclose(body.triangles, before.triangles, atol=1e-9)
    assert ajar(MADE, Dice(3), share=0.0).bodies[1].motion.upper == MADE.bodies[1].motion.upper


def rack(made=MADE):
    """The same with a tray right behind the door, which slides out to where that is."""
    tray = surface([between((0.1, 0.01, 1.0), (0.9, 0.4, 1.1))], STEEL)
    bodies = (*made.bodies, Body("rack", "rack", (tray,), 0, slide((0, -1, 0), 0.3)))
    return GeneratedObject("wardrobe", bodies)


def test_a_rack_stays_behind_a_closed_door_and_comes_out_of_an_open_one():
    held = [ajar(rack(), Dice((3, k)), share=0.5) for k in range(40)]
    opened = [made.bodies[1].motion.upper < np.pi / 2 - 1e-9 for made in held]
    # The door's back is 1 cm before it.
    out = [made.bodies[4].motion.upper < 0.3 - 0.015 for made in held]
    assert not any(o for o, open_ in zip(out, opened, strict=True) if not open_)
    assert any(out)


def test_wheels_turn_balls_turn_and_free_lids_stay():
    motions = (spin((0.5, 0.25, 1), (0, 1, 0)), ball((0.5, 0.25, 1)), free())
    cube = surface([between((0.4, 0.2, 0.9), (0.6, 0.3, 1.1))], STEEL)
    bodies = [Body(f"part_{k}", "part", (cube,), 0, motion) for k, motion in enumerate(motions)]
    turned = posed(GeneratedObject("toy", (wardrobe()[0], *bodies)), [0, np.pi / 4, np.pi / 2, 9.0])
    sizes = [np.ptp(body.triangles.reshape(-1, 3), axis=0) for body in turned.bodies[1:]]
    assert np.allclose(sizes[0], [0.2 * np.sqrt(2), 0.1, 0.2 * np.sqrt(2)])
    assert np.allclose(sizes[1], [0.1, 0.2, 0.2])
    assert np.array_equal(turned.bodies[3].triangles, bodies[2].triangles)


def test_a_folder_holds_a_textured_mesh_and_the_truth_that_the_bench_reads(tmp_path):
    folders = write_objects([Category("wardrobe", wardrobe)], 2, 0, tmp_path / "out", open_share=0)
    assert [folder.name for folder in folders] == ["wardrobe_0000", "wardrobe_0001"]
    truth = SimartBench().read(folders[0])
    assert truth.category == "wardrobe"
    links = {link.name: link for link in truth.articulation.links}
    assert list(links) == ["body", "door", "handle", "drawer"]
    # +Z up, front -Y in ours is +Y up, front +Z in the file.
    assert links["door"].joint.axis == pytest.approx((0, -1, 0))
    assert links["handle"].joint.origin == pytest.approx((0.92, 1.25, 0.02))
    assert links["handle"].parent == 1
    assert (links["drawer"].joint.kind, links["drawer"].joint.axis) == ("prismatic", pytest.approx((0, 0, 1)))
    assert links["drawer"].joint.upper == pytest.approx(0.4)
    mesh = trimesh.load(folders[0] / "input.glb", process=False, force="mesh")
    assert np.allclose(mesh.bounds, [[0, 0, -0.5], [1, 2, 0.06]])
    assert mesh.visual.uv.min() > 0
    assert mesh.visual.uv.max() < 1
    labels = np.load(folders[0] / "gt.npz")["face_part"]
    assert np.bincount(labels).tolist() == [12, 12, 12, 12]
    # The handle's faces are at the handle's place, and steel is where the texture is grey.
    middles = mesh.triangles[labels == 2].mean(axis=1)
    assert (np.abs(middles - [0.92, 1.25, 0.04]) < [0.021, 0.051, 0.021]).all()
    colors = mesh.visual.to_color().vertex_colors[mesh.faces[labels == 2]].reshape(-1, 4)[:, :3].astype(int)
    assert np.abs(colors - STEEL.color).max() < 10
    table = json.loads((folders[0] / "gt.json").read_text())
    assert [part["material"] for part in table["parts"]] == ["wood", "wood", "steel", "wood"]
    assert table["licence"] == "CC0-1.0"


def test_a_body_is_of_what_most_of_its_surface_is_of_however_many_triangles_the_rest_has():
    board = np.array([[[0.0, 0, 0], [1, 0, 0], [0, 1, 0]]])
    eggs = np.tile(0.01 * board, (50, 1, 1))
    body = Body("door", "door", (Surface(eggs, STEEL), Surface(board, WOOD), Surface(eggs, STEEL)))
    assert body.material == "wood"


def test_an_object_depends_on_its_seed_and_number_alone(tmp_path):
    category = CATEGORIES[0]
    one = generated(category, 4, 2)
    assert np.array_equal(one.bodies[0].triangles, generated(category, 4, 2).bodies[0].triangles)
    few = write_objects([category], 3, 4, tmp_path / "a")
    many = write_objects(CATEGORIES[:2], 4, 4, tmp_path / "b")
    for name in ("input.glb", "gt.npz", "gt.json"):
        assert (few[2] / name).read_bytes() == (many[2] / name).read_bytes()


def test_the_command_writes_objects_and_leaves_what_is_there(tmp_path, capfd, monkeypatch):
    monkeypatch.chdir(tmp_path)
    name = CATEGORIES[0].name
    assert run(["generate", name, "out", "-n", "2", "--json"]) == 0
    assert json.loads(capfd.readouterr().out)["objects"] == [f"out/{name}_0000", f"out/{name}_0001"]
    before = (tmp_path / "out" / f"{name}_0001" / "gt.json").read_bytes()
    assert run(["generate", name, "out", "-n", "3", "--seed", "1"]) == 2
    assert f"out/{name}_0000 is there already: choose another folder" in capfd.readouterr().err
    assert (tmp_path / "out" / f"{name}_0001" / "gt.json").read_bytes() == before
    assert len(list((tmp_path / "out").iterdir())) == 2


def test_a_mistake_is_one_line_and_writes_nothing(tmp_path, capfd, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert run(["generate", "unicorn", "out"]) == 2
    (line,) = re.findall(r"^error: .*$", capfd.readouterr().err, re.MULTILINE)
    assert "unknown category 'unicorn': use all, or one of " in line
    assert CATEGORIES[0].name in line
    assert run(["generate", "motion_controler", "out"]) == 2
    assert "unknown category 'motion_controler': did you mean motion_controller? " in capfd.readouterr().err
    (tmp_path / "file").write_text("mine")
    assert run(["generate", CATEGORIES[0].name, "file"]) != 0
    assert (tmp_path / "file").read_text() == "mine"
    assert not (tmp_path / "out").exists()
    with pytest.raises(BadInputError):
        named("", CATEGORIES)
