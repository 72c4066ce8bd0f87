"""The weights that come with the package: what they are, and what they make of objects they never saw."""

import json
import re

import numpy as np
from simart_kit_plugins.nano.generate.catalogue import CATEGORIES, NAMELESS
from simart_kit_plugins.nano.generate.category import named
from simart_kit_plugins.nano.generate.data_set import generated
from simart_kit_plugins.nano.segmenter import Nano
from simart_kit_plugins.nano.stored_model import read_model, shipped_folder
from simart_kit_plugins.nano.training.plan import UNSEEN, TrainingPlan

from simart_kit import Mesh
from simart_kit.cli.main import run
from simart_kit.loading import read_source
from simart_kit.physics import MATERIALS
from simart_kit.plugins import Plugins
from simart_kit.testing.meshes import cabinet_asset

from .real_objects import EXAMPLE


def test_weights_are_small_and_of_the_network_that_training_makes_by_default():
    folder = shipped_folder()
    assert sum(path.stat().st_size for path in folder.iterdir()) < 16e6
    config = read_model(folder).config
    named_by_data = {"labels": config.labels, "categories": config.categories}
    assert config == TrainingPlan().network.model_copy(update=named_by_data)
    # What was kept aside to judge it on, it does not know; some are nothing in particular.
    assert set(config.categories) == {c.name for c in CATEGORIES} - {*UNSEEN, *NAMELESS}


def test_knowledge_beside_the_weights_is_of_their_categories():
    model = read_model(shipped_folder())
    known, config = model.known, model.config
    assert set(known.still) == {c.name for c in CATEGORIES if not c.moves} & set(config.categories)
    assert set(known.materials.values()) <= set(MATERIALS)


def test_the_model_card_tells_what_the_files_are():
    card = (shipped_folder() / "README.md").read_text(encoding="utf-8")
    weights = sum(array.size for array in read_model(shipped_folder()).weights.values())
    assert f"{weights / 1e6:.2f} M weights" in card
    plan = TrainingPlan()
    for number in (plan.objects, plan.steps):
        assert f"{number:,}" in card
    assert re.search(r"simart-kit train nano --run \S+", card)


def test_the_example_opens_as_it_should_and_twice_alike():
    mesh = read_source(EXAMPLE, Plugins()).mesh
    one, two = Nano().segment(mesh), Nano().segment(mesh)
    assert sorted(joint.kind for joint in one.joints) == ["prismatic", "prismatic", "revolute", "revolute"]
    assert np.array_equal(one.face_part, two.face_part)
    assert one.joints == two.joints


def mesh_of(made):
    corners = np.concatenate([body.triangles for body in made.bodies]).reshape(-1, 3)
    return Mesh(corners, np.arange(len(corners)).reshape(-1, 3))


def test_parts_that_geometry_alone_does_not_know_are_found():
    """Of office chairs of a seed that nobody trained on: most moving parts, by most of their area."""
    found = wanted = 0
    for number in range(2):
        made = generated(named("office_chair", CATEGORIES), 4242, number)
        mesh = mesh_of(made)
        part = np.repeat(np.arange(len(made.bodies)), [len(body.triangles) for body in made.bodies])
        said = Nano().segment(mesh).face_part
        for body in range(1, len(made.bodies)):
            true = part == body
            overlaps = [
                mesh.face_areas[true & (said == k)].sum() / mesh.face_areas[true | (said == k)].sum()
                for k in range(1, said.max() + 1)
            ]
            wanted += 1
            found += max(overlaps, default=0) >= 0.5
    assert found / wanted > 0.5


def test_most_still_things_stay_in_one_piece():
    still = [c for c in CATEGORIES if not c.moves][:4]
    moved = [c.name for c in still if Nano().segment(mesh_of(generated(c, 4242, 0))).joints]
    assert len(moved) <= 1, moved


def test_the_report_tells_what_it_was_taken_for(tmp_path, capfd):
    asset = cabinet_asset()
    lines = [f"v {x} {z} {-y}" for x, y, z in asset.mesh.vertices]
    lines += ["f " + " ".join(str(i + 1) for i in face) for face in asset.mesh.faces]
    (tmp_path / "a.obj").write_text("\n".join(lines), encoding="utf-8")
    words = [
        "convert",
        str(tmp_path / "a.obj"),
        "--out",
        str(tmp_path / "out"),
        "--no-record",
        "--set",
        "export=[]",
    ]
    assert run(words) == 0, capfd.readouterr().err
    report = json.loads((tmp_path / "out" / "report.json").read_text(encoding="utf-8"))
    assert "taken for a" in json.dumps(report)
