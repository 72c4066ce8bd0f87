"""Solids of their own on a body that is one fused skin: what moves is they, and nothing of the body."""

import numpy as np
import pytest
import trimesh
from simart_kit_plugins.geometric.predictor import GeometricJoints
from simart_kit_plugins.geometric.segmenter import Geometric

from simart_kit.mesh import Mesh

Solids = dict[str, trimesh.Trimesh]


def disc(radius: float, front: float, back: float, inner: float = 0.0) -> trimesh.Trimesh:
    """A disc, or a ring, whose axis is along y [m]."""
    deep = back - front
    made = (
        trimesh.creation.annulus(inner, radius, deep, sections=48)
        if inner
        else trimesh.creation.cylinder(radius, deep, sections=48)
    )
    made.apply_transform(trimesh.transformations.rotation_matrix(np.pi / 2, (1, 0, 0)))
    return made.apply_translation((0.0, (front + back) / 2, 0.45))


def washing_machine() -> Solids:
    """A body with a drum and a shoulder around it, before which a rim stands with two panes in it."""
    box = trimesh.creation.box(bounds=((-0.3, -0.3, 0.0), (0.3, 0.3, 0.85)))
    body = trimesh.boolean.difference([box, disc(0.2, -0.35, -0.29), disc(0.17, -0.35, 0.2)])
    return {
        "body": body,
        "rim": disc(0.197, -0.32, -0.288, inner=0.12),
        "inner pane": disc(0.12, -0.3, -0.298),
        "outer pane": disc(0.12, -0.318, -0.316),
    }


@pytest.fixture(scope="module")
def washer() -> tuple[Mesh, list[str]]:
    solids = washing_machine()
    whole = trimesh.util.concatenate(list(solids.values()))
    names = [name for name, solid in solids.items() for _ in solid.faces]
    return Mesh(whole.vertices, whole.faces), names


def test_a_round_door_takes_its_panes_along_and_nothing_of_the_body(washer: tuple[Mesh, list[str]]) -> None:
    mesh, names = washer
    found = Geometric().segment(mesh)
    assert any("of a fused surface" in note.text for note in found.notes)
    assert [guess.label for guess in found.parts] == ["body", "door"]
    moving = {name for name, part in zip(names, found.face_part, strict=True) if part}
    assert moving == {"rim", "inner pane", "outer pane"}
    (joint,) = GeometricJoints().predict(mesh, found)
    assert joint.kind == "revolute"
    assert np.abs(joint.axis) == pytest.approx([0, 0, 1])
