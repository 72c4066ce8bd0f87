"""Proposals of geometry and network made one set, and votes from several sides."""

from dataclasses import replace

import numpy as np
import pytest
import torch
from simart_kit_plugins.nano.array_network import ArrayNetwork
from simart_kit_plugins.nano.cloud import Cloud
from simart_kit_plugins.nano.config import NanoConfig
from simart_kit_plugins.nano.evidence import COUNT
from simart_kit_plugins.nano.network import NanoNetwork
from simart_kit_plugins.nano.pooling import pooled
from simart_kit_plugins.nano.proposals import Proposal, segmentation_of, with_body
from simart_kit_plugins.nano.turning import VIEWS
from simart_kit_plugins.nano.voting import say, say_parts

from simart_kit import Joint, Limits, PartGuess
from simart_kit.testing.meshes import boxes_mesh

# A body with a bay, a drawer in front of it, a knob on the drawer, and a box on top.
BOXES = [
    ((0, 0, 0), (1, 1, 1)),
    ((0.1, -0.05, 0.1), (0.9, -0.001, 0.9)),
    ((0.4, -0.1, 0.4), (0.6, -0.051, 0.6)),
    ((0.2, 0.2, 1.001), (0.8, 0.8, 1.3)),
]
MESH = boxes_mesh(BOXES)
PIECE = np.repeat(np.arange(4), 12)


def proposal(pieces, label="part", axis=(0.0, -1.0, 0.0), parent=None, score=0.9):
    joint = Joint("j", "prismatic", "body", "part", axis=axis, limits=Limits(0.0, 0.5))
    return Proposal(np.isin(PIECE, pieces), PartGuess(label, label=label, score=score), joint, parent)


def test_what_both_find_is_there_once_with_the_joint_of_geometry():
    one, other = proposal([1, 2], "drawer"), proposal([1, 2], "door", axis=(0.0, 0.0, 1.0))
    (found,) = pooled(MESH, [one], [other])
    assert found.guess.label == "drawer"
    assert found.joint.axis == (0.0, -1.0, 0.0)


def test_a_joint_that_is_stuck_gives_way_to_one_that_is_free():
    into_the_body = (0.0, 1.0, 0.0)
    (found,) = pooled(MESH, [proposal([1, 2], axis=into_the_body)], [proposal([1, 2])])
    assert found.joint.axis == (0.0, -1.0, 0.0)


def test_a_joint_gives_way_to_one_that_is_much_surer():
    unsure, sure = proposal([3], "lid", axis=(1.0, 0.0, 0.0)), proposal([3], "lid", axis=(0.0, 0.0, 1.0))
    for confidence, kept in ((0.5, sure), (0.9, unsure)):
        first = replace(unsure, joint=replace(unsure.joint, confidence=confidence))
        (found,) = pooled(MESH, [first], [sure])
        assert found.joint.axis == kept.joint.axis


@pytest.mark.parametrize(("confidence", "kind"), [(0.8, "revolute"), (0.6, "prismatic")])
def test_what_surely_turns_does_not_slide_however_like_a_drawer_it_looks(confidence, kind):
    drawer = proposal([1, 2], "drawer")
    drawer = replace(drawer, joint=replace(drawer.joint, confidence=0.95))
    hinge = Joint("j", "revolute", "body", "part", axis=(1.0, 0.0, 0.0), limits=Limits(0.0, 0.5))
    tipping = replace(drawer, joint=replace(hinge, confidence=confidence))
    assert pooled(MESH, [drawer], [tipping])[0].joint.kind == kind
    # On rails that were looked for it slides.
    sliding = replace(drawer, guess=PartGuess("door", label="sliding_door"))
    assert pooled(MESH, [sliding], [tipping])[0].joint.kind == "prismatic"


def test_what_surely_spins_is_no_door():
    door = proposal([1, 2], "door", axis=(0.0, 0.0, 1.0))
    door = replace(door, joint=replace(door.joint, kind="revolute", confidence=0.95))
    wheel = replace(
        door, joint=Joint("j", "continuous", "body", "part", axis=(1.0, 0.0, 0.0), confidence=0.9)
    )
    (found,) = pooled(MESH, [door], [wheel])
    assert (found.joint.kind, found.joint.axis) == ("continuous", (1.0, 0.0, 0.0))


def test_what_either_finds_alone_is_kept_and_no_face_is_claimed_twice():
    lid = proposal([3], "lid", axis=(0.0, 0.0, 1.0))
    across = proposal([0, 3], "wrong")
    found = pooled(MESH, [proposal([1, 2])], [lid, across])
    assert [p.guess.label for p in found] == ["part", "lid"]
    assert not (found[0].faces & found[1].faces).any()


def test_a_stuck_part_that_only_the_network_finds_is_left_out():
    assert pooled(MESH, [], [proposal([3], axis=(0.0, 0.0, -1.0))]) == []
    assert len(pooled(MESH, [], [proposal([3], axis=(0.0, 0.0, 1.0))])) == 1


def test_what_slides_may_wait_behind_another_mover_as_a_rack_behind_a_door():
    behind, before = proposal([1], "rack"), proposal([2], "door", axis=(0.0, 0.0, 1.0))
    assert [p.guess.label for p in pooled(MESH, [before], [behind])] == ["door", "rack"]
    # The body does not get out of the way.
    assert pooled(MESH, [], [behind]) == []


def test_drawers_that_are_taken_for_one_are_several():
    lump, lid, drawer = proposal([1, 3], "lump"), proposal([3], "upper"), proposal([1, 2], "lower")
    found = pooled(MESH, [proposal([1, 2, 3], "lump")], [drawer, lid])
    assert [p.guess.label for p in found] == ["lower", "upper"]
    # One within another, such as a knob on a drawer, does not make it two.
    assert [p.guess.label for p in pooled(MESH, [lump], [proposal([1])])] == ["lump"]


def test_three_drawers_that_are_taken_for_one_with_their_carcass_are_several():
    rows = [((0, 0, z), (1, 1, z + 0.5)) for z in (0, 1, 2)]
    mesh = boxes_mesh([((2, 0, 0), (3, 1, 9)), *rows, ((0, 1.1, 0), (1, 2.1, 2))])
    piece, areas = np.repeat(np.arange(5), 12), mesh.face_areas

    def of(*pieces):
        return replace(proposal([1]), faces=np.isin(piece, pieces))

    chest, drawers = of(1, 2, 3, 4), [of(k) for k in (1, 2, 3)]
    assert max(areas[d.faces].sum() for d in drawers) < 0.2 * areas[chest.faces].sum()
    found = pooled(mesh, [chest], drawers)
    assert [p.faces.tolist() for p in found] == [d.faces.tolist() for d in drawers]
    assert len(pooled(mesh, [chest], drawers[:2])) == 1  # two are less than half of it
    # A garage's door goes up, whatever its sections look like.
    (door,) = pooled(mesh, [replace(chest, joint=replace(chest.joint, axis=(0.0, 0.0, 1.0)))], drawers)
    assert door.faces.tolist() == chest.faces.tolist()


def test_who_knows_the_object_is_told_of_nothing_else_and_of_no_other_joint():
    own = proposal([3], "lid", axis=(1.0, 0.0, 0.0), score=0.5)
    own = replace(own, joint=replace(own.joint, confidence=0.1))
    others = [proposal([3], "lid", axis=(0.0, 0.0, 1.0)), proposal([1, 2], "drawer")]
    (found,) = pooled(MESH, [own], others, known=True)
    assert found.joint == own.joint
    assert len(pooled(MESH, [own], others)) == 2


def test_who_knows_the_object_takes_the_exact_line_of_what_the_other_moves_alike():
    hinge = Joint("j", "revolute", "body", "part", axis=(0.0, 0.0, 1.0), limits=Limits(0.0, 1.5))
    own, other = (
        replace(proposal([1, 2], "door"), joint=replace(hinge, origin=(x, -0.05, 0.0), confidence=c))
        for x, c in ((0.15, 0.9), (0.1, 0.5))
    )
    (found,) = pooled(MESH, [own], [other], known=True)
    assert found.joint == other.joint
    sideways = replace(other, joint=replace(other.joint, axis=(1.0, 0.0, 0.0)))
    assert pooled(MESH, [own], [sideways], known=True)[0].joint == own.joint


def test_who_knows_the_object_and_finds_nothing_hears_the_other():
    (found,) = pooled(MESH, [], [proposal([3], "lid", axis=(0.0, 0.0, 1.0))], known=True)
    assert found.guess.label == "lid"


def test_a_carrier_is_found_again_among_those_kept():
    drawer, knob = proposal([1], "drawer"), proposal([2], "knob", parent=0)
    found = pooled(MESH, [proposal([1], "front")], [drawer, knob])
    assert [(p.guess.label, p.parent) for p in found] == [("front", None), ("knob", 0)]
    made = segmentation_of(found, 48, lambda label: "steel" if label else "wood")
    assert [(j.parent, j.child) for j in made.joints] == [("body", "front"), ("front", "knob")]
    assert [guess.material for guess in made.parts] == ["wood", "steel", "steel"]
    assert np.array_equal(made.face_part, np.array([0, 1, 2, 0])[PIECE])


def test_something_stands_still():
    small, large, on_it = proposal([2]), proposal([0, 3], "body"), proposal([1], "drawer", parent=1)
    found = with_body(MESH, [small, large, on_it])
    assert [(p.guess.label, p.parent) for p in found] == [("part", None), ("drawer", None)]
    carried = with_body(MESH, [large, proposal([1], "drawer"), proposal([2], "knob", parent=1)])
    assert [(p.guess.label, p.parent) for p in carried] == [("drawer", None), ("knob", 0)]
    assert with_body(MESH, [small, on_it]) == [small, on_it]


def test_what_carries_the_others_stands_still_where_only_feet_are_left():
    leaves = boxes_mesh(
        [((x, 0, 0.1), (x + 1, 0.02, 2)) for x in (0, 1.01, 2.02)] + [((1, 0, 0), (1.1, 0.02, 0.1))]
    )
    box = np.repeat(np.arange(4), 12)
    outer, middle, other = (
        replace(proposal([0], f"leaf_{k}", parent=parent), faces=box == k)
        for k, parent in ((0, 1), (1, None), (2, 1))
    )
    found = with_body(leaves, [outer, middle, other])
    assert [(p.guess.label, p.parent) for p in found] == [("leaf_0", None), ("leaf_2", None)]
    # Two of them have a body: the third.
    assert (
        with_body(leaves, [replace(outer, parent=None), replace(other, parent=None)])[1].guess.label
        == "leaf_2"
    )


CONFIG = NanoConfig(
    channels=16, layers=1, heads=2, hidden=16, point_channels=8, labels=("door",), categories=("cabinet",)
)


def cloud_seen_by(quarters, mirrored):
    generator = np.random.default_rng(0)
    points, normals = generator.uniform(-0.5, 0.5, (120, 3)), generator.normal(size=(120, 3))
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    angle = quarters * np.pi / 2
    turn = np.array([[np.cos(angle), -np.sin(angle), 0], [np.sin(angle), np.cos(angle), 0], [0, 0, 1]])
    matrix = turn @ np.diag([-1.0 if mirrored else 1.0, 1, 1])
    colors, area = generator.random((120, 3)), np.full(120, 1 / 120)
    return Cloud(points @ matrix.T, normals @ matrix.T, colors, np.arange(120) % 6, area, 6)


def arrays(network):
    return {name: tensor.detach().numpy() for name, tensor in network.state_dict().items()}


@pytest.mark.parametrize("view", VIEWS[1:4])
def test_votes_from_all_eight_sides_do_not_depend_on_the_side(view):
    torch.manual_seed(1)
    network = NanoNetwork(CONFIG, 1).eval()
    for parameter in network.parameters():
        parameter.data += 0.3 * torch.randn_like(parameter)
    network = ArrayNetwork(CONFIG, arrays(network))
    one, other = (say(network, cloud_seen_by(*v), 8) for v in ((0, False), view))
    alone = say(network, cloud_seen_by(*view), 1)
    assert np.allclose(one.together, other.together, atol=2e-3)
    assert np.allclose(one.moves, other.moves, atol=2e-3)
    assert np.abs(alone.moves - one.moves).max() > 0.01


def test_limits_seen_in_a_mirror_are_turned_back():
    class Blind(ArrayNetwork):
        """Says that all goes 2 rad or 0.4 sides, a quarter of it back, and more surely from each next side.

        Onward is the sense of the axis, whatever it sees.
        """

        sides = 0

        def parts(self, tokens, owner, share, numbers, real):
            read = super().parts(tokens, owner, share, numbers, real)
            self.sides += 1
            sense = np.full_like(read.sense, 3.0**self.sides)
            reach = np.log(np.float32([[2.0, 0.4]]))
            return replace(read, sense=sense, near=np.zeros(1, np.float32), reach=reach)

    network = Blind(CONFIG, arrays(NanoNetwork(CONFIG, 0)))
    tokens = say(network, cloud_seen_by(0, False), 2).tokens
    numbers = np.zeros((1, 2, COUNT))
    numbers[0, 0, 0], numbers[0, 1, 1] = 1, 1  # the first slides, the second turns
    said = say_parts(
        network, tokens, np.full((1, 6), 1 / 6, dtype=np.float32), numbers, np.ones((1, 2), bool)
    )
    # The second side is a mirror: there a turn goes the other way round.
    assert np.allclose(said.travel[0, 0], [-0.1, 0.3])
    assert np.allclose(said.travel[0, 1], [-1.5, 0.5])


@pytest.mark.parametrize(("near", "back"), [(-9.0, 0.0), (-1.5, 0.0), (-1.3, 0.107), (9.0, 0.5)])
def test_next_to_no_travel_on_the_shorter_side_is_none(near, back):
    class Told(ArrayNetwork):
        def parts(self, tokens, owner, share, numbers, real):
            read = super().parts(tokens, owner, share, numbers, real)
            return replace(read, near=np.float32([near]), reach=np.zeros((1, 2), np.float32))

    network = Told(CONFIG, arrays(NanoNetwork(CONFIG, 0)))
    tokens = say(network, cloud_seen_by(0, False), 1).tokens
    share, numbers = np.full((1, 6), 1 / 6, dtype=np.float32), np.zeros((1, 1, COUNT))
    said = say_parts(network, tokens, share, numbers, np.ones((1, 1), bool))
    assert np.abs(said.travel[0, 0]).min() == pytest.approx(back, abs=1e-3)
    assert np.abs(said.travel[0, 0]).sum() == pytest.approx(1)
