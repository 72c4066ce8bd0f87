"""`geometric` finds the same however a mesh is turned, scaled, ordered or linked."""

import numpy as np
import pytest

from simart_kit.mesh import Mesh
from simart_kit.testing.meshes import boxes_mesh

from .furniture import BOARD, OPENING, turned, turning
from .test_geometric import Found, found

# How deep in a panel its hinge is depends on points drawn from the surface: half a board's thickness.
DEPTH = 0.5 * BOARD + 0.001


def assert_same_joints(before: Found, after: Found, degrees: float = 0.0, factor: float = 1.0) -> None:
    """The same parts with the same joints, turned about the vertical and scaled; names may differ."""
    turn = turning(degrees)[:3, :3]
    assert len(after.joints) == len(before.joints) > 0
    for old in before.joints:
        (new,) = [j for j in after.joints if np.array_equal(after.faces(j.child), before.faces(old.child))]
        assert new.kind == old.kind
        np.testing.assert_allclose(new.axis, turn @ old.axis, atol=1e-6)
        np.testing.assert_allclose(np.array(new.origin) / factor, turn @ old.origin, atol=DEPTH)
        if old.limits is not None and new.limits is not None:
            unit = factor if old.kind == "prismatic" else 1.0
            assert new.limits.upper / unit == pytest.approx(old.limits.upper, rel=1e-3)


class TestInvariance:
    @pytest.mark.parametrize("name", [n for n in OPENING if n != "chest"])
    @pytest.mark.parametrize(("degrees", "factor"), [(90.0, 1.0), (180.0, 0.01), (270.0, 1.0), (37.0, 100.0)])
    def test_turned_and_scaled(self, name: str, degrees: float, factor: float) -> None:
        mesh = boxes_mesh(OPENING[name])
        assert_same_joints(found(mesh), found(turned(mesh, degrees, factor)), degrees, factor)

    @pytest.mark.parametrize("factor", [0.001, 100.0])
    def test_a_scaled_chest(self, factor: float) -> None:
        mesh = boxes_mesh(OPENING["chest"])
        assert_same_joints(found(mesh), found(turned(mesh, 0.0, factor)), 0.0, factor)

    @pytest.mark.parametrize("name", OPENING)
    def test_split_vertices(self, name: str) -> None:
        mesh = boxes_mesh(OPENING[name])
        split = Mesh(mesh.triangles.reshape(-1, 3), np.arange(3 * len(mesh.faces)).reshape(-1, 3))
        assert_same_joints(found(mesh), found(split))

    @pytest.mark.parametrize("name", ["cabinet", "sideboard", "dresser"])
    def test_the_order_of_faces(self, name: str) -> None:
        mesh = boxes_mesh(OPENING[name])
        order = np.random.default_rng(5).permutation(len(mesh.faces))
        before, after = found(mesh), found(Mesh(mesh.vertices, mesh.faces[order]))
        assert after.kinds == before.kinds
        for joint in before.joints:
            np.testing.assert_array_equal(np.sort(order[after.faces(joint.child)]), before.faces(joint.child))
            np.testing.assert_allclose(after.joint(joint.child).axis, joint.axis, atol=1e-6)
            np.testing.assert_allclose(after.joint(joint.child).origin, joint.origin, atol=DEPTH)

    @pytest.mark.parametrize("name", ["cabinet", "sideboard", "oven"])
    def test_faces_that_are_there_twice(self, name: str) -> None:
        mesh = boxes_mesh(OPENING[name])
        before = found(mesh)
        after = found(Mesh(mesh.vertices, np.concatenate([mesh.faces, mesh.faces[:, ::-1]])))
        assert after.kinds == before.kinds
        for joint in before.joints:
            first = before.faces(joint.child)
            np.testing.assert_array_equal(
                after.faces(joint.child), np.concatenate([first, first + len(mesh.faces)])
            )
            np.testing.assert_allclose(after.joint(joint.child).axis, joint.axis, atol=1e-6)
            np.testing.assert_allclose(after.joint(joint.child).origin, joint.origin, atol=DEPTH)

    def test_faces_without_area_that_link_pieces(self) -> None:
        """As strips of triangles leave them: from the body to the door, and from the door to the drawer."""
        mesh = boxes_mesh(OPENING["sideboard"])
        body, door, front = mesh.faces[0, 0], mesh.faces[72, 0], mesh.faces[96, 0]
        links = [[body, body, door], [door, front, front]]
        before, after = found(mesh), found(Mesh(mesh.vertices, np.concatenate([mesh.faces, links])))
        assert after.kinds == before.kinds
        for joint in before.joints:
            faces = after.faces(joint.child)
            np.testing.assert_array_equal(faces[faces < len(mesh.faces)], before.faces(joint.child))
            np.testing.assert_allclose(after.joint(joint.child).axis, joint.axis, atol=1e-6)
            np.testing.assert_allclose(after.joint(joint.child).origin, joint.origin, atol=DEPTH)

    def test_two_runs_agree_to_the_bit(self) -> None:
        one, two = (found(OPENING["sideboard"]) for _ in range(2))
        assert one.joints == two.joints
        np.testing.assert_array_equal(one.segmentation.face_part, two.segmentation.face_part)
