"""Parts of one shape are as sure as they are on average, and the nearest of those alike carries a part."""

import numpy as np
import pytest
from simart_kit_plugins.nano.cloud import Cloud
from simart_kit_plugins.nano.siblings import nearest_carriers, shared_certainty


def cloud_of(boxes):
    """Points all over boxes of (middle, size), a piece each; area as their size says."""
    generator = np.random.default_rng(0)
    points, piece, area = [], [], []
    for number, (middle, size) in enumerate(boxes):
        inside = generator.uniform(-0.5, 0.5, (400, 3))
        side = generator.integers(3, size=400)
        inside[np.arange(400), side] = np.sign(inside[np.arange(400), side]) / 2
        points.append(inside * size + middle)
        piece += [number] * 400
        x, y, z = size
        area += [2 * (x * y + y * z + z * x) / 400] * 400
    area = np.array(area) / np.sum(area)
    everywhere = np.concatenate(points)
    return Cloud(everywhere, everywhere, everywhere, np.array(piece), area, len(boxes))


def test_legs_of_one_shape_share_their_certainty_and_a_seat_keeps_its_own():
    legs = [((x, y, -0.25), (0.05, 0.05, 0.5)) for x in (-0.3, 0.3) for y in (-0.3, 0.3)]
    cloud = cloud_of([*legs, ((0, 0, 0.05), (0.8, 0.8, 0.1))])
    parts = [np.array([k]) for k in range(5)]
    found = shared_certainty(cloud, parts, np.array([0.6, 0.2, 0.2, 0.2, 0.9]))
    assert found == pytest.approx([0.3, 0.3, 0.3, 0.3, 0.9])


def test_a_quarter_turn_about_the_upright_axis_makes_no_other_shape_but_lying_down_does():
    standing = [((-0.3, 0, 0), (0.3, 0.02, 0.5)), ((0.3, 0, 0), (0.02, 0.3, 0.5))]
    lying = ((0, 0.4, 0), (0.3, 0.5, 0.02))
    cloud = cloud_of([*standing, lying])
    found = shared_certainty(cloud, [np.array([k]) for k in range(3)], np.array([0.8, 0.4, 0.1]))
    assert found == pytest.approx([0.6, 0.6, 0.1])


def test_no_parts_have_nothing_to_share():
    assert len(shared_certainty(cloud_of([((0, 0, 0), (1, 1, 1))]), [], np.zeros(0))) == 0


class TestNearestCarriers:
    casters = ((-0.3, 0, -0.4), (0.3, 0, -0.4))
    wheels = ((0.3, 0.06, -0.45), (-0.3, 0.06, -0.45))
    cloud = cloud_of([(place, (0.05, 0.05, 0.05)) for place in (*casters, *wheels, (0.0, 0.4, 0.4))])
    parts = tuple(np.array([k]) for k in range(5))
    takes = ("caster", "caster", "wheel", "wheel", "wheel")
    body = np.array([[0.9, 0.025, 0.025, 0.025, 0.025, 0.0]] * 2)

    def carriers(self, *wheels):
        return nearest_carriers(self.cloud, self.parts, self.takes, np.concatenate([self.body, wheels]))

    def test_wheels_that_all_look_alike_turn_in_the_caster_beside_them(self):
        same = [0.1, 0.8, 0.1, 0.0, 0.0, 0.0]
        assert self.carriers(same, same, [1.0, 0, 0, 0, 0, 0]) == [0, 0, 2, 1, 0]

    def test_casters_that_are_likelier_than_the_body_together_are_likelier(self):
        assert self.carriers(*[[0.4, 0.3, 0.3, 0.0, 0.0, 0.0]] * 3)[2:4] == [2, 1]

    def test_what_lies_beside_none_of_several_is_carried_by_the_body(self):
        assert self.carriers(*[[0.1, 0.8, 0.1, 0.0, 0.0, 0.0]] * 3)[4] == 0

    def test_a_single_carrier_may_be_far_away(self):
        takes = ("arm", "caster", "wheel", "wheel", "wheel")
        chance = np.array([[0.1, 0.8, 0.1, 0.0, 0.0, 0.0]] * 5)
        assert nearest_carriers(self.cloud, self.parts, takes, chance)[4] == 1

    def test_no_parts_have_no_carriers(self):
        assert nearest_carriers(self.cloud, (), (), np.zeros((0, 1))) == []
