"""Small pieces of the body that only a moving part holds, and those that the body holds."""

import numpy as np
from simart_kit_plugins.nano.hardware import with_hardware
from simart_kit_plugins.nano.proposals import Proposal

from simart_kit import Joint, Limits, PartGuess
from simart_kit.testing.meshes import boxes_mesh

# A frame round a leaf; on the leaf a strap in its way, and a handle behind it; on the frame a stop behind it.
MESH = boxes_mesh(
    [
        ((-0.2, -0.1, 0.0), (-0.01, 0.1, 1.0)),
        ((1.01, -0.1, 0.0), (1.2, 0.1, 1.0)),
        ((0.0, 0.0, 0.0), (1.0, 0.05, 1.0)),
        ((0.1, -0.01, 0.5), (0.9, 0.0, 0.55)),
        ((0.8, 0.05, 0.4), (0.85, 0.15, 0.45)),
        ((0.96, 0.051, 0.0), (1.05, 0.1, 1.0)),
    ]
)
PIECE = np.repeat(np.arange(6), 12)
LEAF = Proposal(
    PIECE == 2,
    PartGuess("door"),
    Joint("j", "revolute", "body", "door", axis=(0.0, 0.0, -1.0), limits=Limits(0.0, 1.5)),
    None,
)


def test_straps_and_handles_go_with_the_leaf_and_stops_stay_with_the_frame() -> None:
    (grown,) = with_hardware(MESH, PIECE, [LEAF])
    assert set(PIECE[grown.faces]) == {2, 3, 4}


def test_a_handle_that_moves_itself_hangs_on_the_leaf_that_it_stands_before() -> None:
    turn = Joint("h", "revolute", "body", "handle", axis=(0.0, 1.0, 0.0), limits=Limits(0.0, 0.5))
    handle = Proposal(PIECE == 3, PartGuess("handle"), turn, None)
    leaf, small = with_hardware(MESH, PIECE, [LEAF, handle])
    assert (leaf.parent, small.parent) == (None, 0)
    assert set(PIECE[small.faces]) == {3}


def test_a_rail_behind_a_front_that_would_hit_the_next_one_stays() -> None:
    """It touches the lower front all along, which could not be pushed in past it."""
    low, high = ((-0.5, 0.0, 0.0), (0.5, 0.02, 0.3)), ((-0.5, 0.0, 0.31), (0.5, 0.02, 0.6))
    back = ((-0.5, 0.4, 0.0), (0.5, 0.42, 0.6))
    slide = Joint("j", "prismatic", "body", "drawer", axis=(0.0, -1.0, 0.0), limits=Limits(0.0, 0.3))
    piece = np.repeat(np.arange(4), 12)
    fronts = [Proposal(piece == k, PartGuess("drawer"), slide, None) for k in (0, 1)]
    for end, taken in ((0.32, {0}), (0.295, {0, 2})):
        mesh = boxes_mesh([low, high, ((-0.48, 0.02, 0.27), (0.48, 0.03, end)), back])
        lower, _ = with_hardware(mesh, piece, fronts)
        assert set(piece[lower.faces]) == taken
