"""One colour a part, and the legend of the picture shows it."""

from itertools import pairwise

from simart_kit.colors import BODY, part_color
from simart_kit.drawing.legend import legend
from simart_kit.testing.meshes import cabinet_asset


def test_thirty_parts_differ_and_the_first_is_grey() -> None:
    colors = [part_color(index) for index in range(31)]
    assert len(set(colors)) == 31
    assert colors[0] == BODY
    assert all(
        max(abs(a - b) for a, b in zip(one, two, strict=True)) > 30 for one, two in pairwise(colors[1:])
    )


def test_the_legend_shows_the_colour_of_the_part_that_a_joint_moves() -> None:
    asset = cabinet_asset()
    entries = legend(asset)
    assert [e.color for e in entries] == [part_color(asset.part_index(e.joint.child)) for e in entries]
