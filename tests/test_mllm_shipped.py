"""The language model that comes with the package, on objects that it never saw."""

import numpy as np
import pytest
from simart_kit_plugins.nano.generate.catalogue import CATEGORIES
from simart_kit_plugins.nano.generate.category import named
from simart_kit_plugins.nano.generate.data_set import generated
from simart_kit_plugins.simart.mllm.bundle import load_bundle
from simart_kit_plugins.simart.opening import shipped_folder
from simart_kit_plugins.simart.segmenter import Simart

from simart_kit import Mesh
from simart_kit.bench.grounding import score_grounding

# Of the categories that it was trained on, with a seed that it was not.
OBJECTS = (("scissors", 0), ("gate", 1), ("folding_chair", 0), ("pan_with_lid", 1))


def mesh_and_parts(category: str, number: int):
    made = generated(named(category, CATEGORIES), 4242, number)
    corners = np.concatenate([body.triangles for body in made.bodies]).reshape(-1, 3)
    part = np.repeat(np.arange(len(made.bodies)), [len(body.triangles) for body in made.bodies])
    return Mesh(corners, np.arange(len(corners)).reshape(-1, 3)), part


def test_its_files_are_small_and_of_the_shipped_voxel_model():
    folder = shipped_folder()
    assert max(path.stat().st_size for path in folder.iterdir()) < 16e6
    bundle = load_bundle(str(folder), device="cpu")
    assert bundle.settings.codec == bundle.codec.fingerprint
    weights = sum(parameter.numel() for parameter in bundle.model.parameters())
    card = (folder / "README.md").read_text(encoding="utf-8")
    assert f"{weights / 1e6:.2f} M weights" in card


def overlaps(mesh: Mesh, true, said) -> list[float]:
    """For each true part the greatest overlap, by area, with a part that was found."""
    areas = mesh.face_areas
    return [
        max(
            areas[(true == k) & (said == m)].sum() / areas[(true == k) | (said == m)].sum() for m in set(said)
        )
        for k in set(true)
    ]


@pytest.mark.slow
def test_parts_are_where_parts_are_and_move():
    found, whole, moving = [], [], 0
    for category, number in OBJECTS:
        mesh, true = mesh_and_parts(category, number)
        segmentation = Simart().segment(mesh)
        found += overlaps(mesh, true, segmentation.face_part)
        whole += overlaps(mesh, true, np.zeros_like(true))
        moving += any(joint.moves for joint in segmentation.joints)
    # Chance, and the best that leaves an object in one piece.
    assert np.mean(found) > np.mean(whole) + 0.1
    assert moving == len(OBJECTS)


@pytest.mark.slow
def test_a_described_part_is_found_better_than_by_taking_everything():
    mesh, true = mesh_and_parts("pan_with_lid", 1)
    grounded = Simart().ground(mesh, "the lid")
    lid = true == 1
    assert score_grounding(mesh, lid, grounded.faces).iou > score_grounding(mesh, lid, lid | ~lid).iou


@pytest.mark.slow
def test_the_same_object_is_answered_alike():
    mesh, _ = mesh_and_parts("scissors", 1)
    one, two = Simart().segment(mesh), Simart().segment(mesh)
    assert np.array_equal(one.face_part, two.face_part)
    assert one.joints == two.joints
