"""Parts that numbers tell apart come in the order of these, with the same faces and joints."""

import numpy as np
from simart_kit_plugins.geometric.naming import in_order
from simart_kit_plugins.geometric.segmenter import Geometric

import simart_kit as sk
from simart_kit.testing.meshes import boxes_mesh

from .furniture import BOARD, carcass, drawer

NAMES = ("body", "drawer_10", "left_door", "drawer_2", "drawer_1", "right_door", "wheel_2", "wheel_1")


def faces_by_name(found: sk.Segmentation) -> dict[str, list[int]]:
    return {p.name: np.flatnonzero(found.face_part == i).tolist() for i, p in enumerate(found.parts)}


def segmentation(joints: tuple[sk.Joint, ...] | None) -> sk.Segmentation:
    guesses = tuple(sk.PartGuess(name, label=name.split("_")[0]) for name in NAMES)
    return sk.Segmentation(
        np.repeat(np.arange(8, dtype=np.int32), [1, 2, 3, 4, 5, 6, 7, 8]), guesses, joints=joints
    )


def test_numbers_ascend_and_all_else_stays_in_place() -> None:
    found = segmentation(None)
    done = in_order(found)
    assert [p.name for p in done.parts] == [
        *("body", "drawer_1", "left_door", "drawer_2", "drawer_10", "right_door", "wheel_1", "wheel_2")
    ]
    assert faces_by_name(done) == faces_by_name(found)
    assert {p.name: p.label for p in done.parts} == {p.name: p.label for p in found.parts}
    assert done.joints is None


def test_joints_follow_their_parts_and_are_the_same() -> None:
    joints = tuple(
        sk.Joint(
            f"{name}_slide", "prismatic", "body", name, axis=(0.0, -1.0, 0.0), limits=sk.Limits(0.0, 0.1)
        )
        for name in NAMES[1:]
    )
    done = in_order(segmentation(joints))
    assert done.joints is not None
    assert [joint.child for joint in done.joints] == [p.name for p in done.parts[1:]]
    assert set(done.joints) == set(joints)


def test_drawers_of_a_column_come_from_the_top_down() -> None:
    high = 0.3
    boxes = carcass((-0.3, 0.3), (-0.25, 0.25), (0.0, 3 * high))
    inner = (-0.3 + BOARD + 0.003, 0.3 - BOARD - 0.003)
    for z, lower in ((0.0, 0.0), (2 * high, 0.04), (high, 0.02)):  # the lowest is the largest
        boxes += drawer(inner, -0.25, 0.2, (z + BOARD + 0.003 + lower, z + high - BOARD - 0.003))
    mesh = boxes_mesh(boxes)
    found = Geometric().segment(mesh)
    assert [p.name for p in found.parts] == ["body", "drawer_1", "drawer_2", "drawer_3"]
    tops = [mesh.vertices[mesh.faces[found.face_part == k], 2].max() for k in (1, 2, 3)]
    assert tops == sorted(tops, reverse=True)
