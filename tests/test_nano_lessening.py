"""Examples with less on them: parts go or stay whole, with all that is told of them."""

import numpy as np
import pytest
from simart_kit_plugins.nano.examples import example
from simart_kit_plugins.nano.generate.catalogue import CATEGORIES
from simart_kit_plugins.nano.lessening import MOST_ASKED, few_asked, lessened
from simart_kit_plugins.nano.mixing import filling
from simart_kit_plugins.nano.scene import area_share
from simart_kit_plugins.nano.store import stored
from simart_kit_plugins.shapes.dice import Dice

SEEDS = range(12)


@pytest.fixture(scope="module", params=["office_chair", "tool_chest", "table"])
def whole(request):
    category = next(category for category in CATEGORIES if category.name == request.param)
    return stored(example(category.make(Dice((3,))), np.random.default_rng(3), 0.0))


def less(whole):
    return [lessened(whole, np.random.default_rng(seed)) for seed in SEEDS]


def test_something_goes_and_a_part_and_the_body_stay(whole):
    found = less(whole)
    assert min(len(one.own) for one in found) < len(whole.own)
    assert all((one.part == 0).any() for one in found)
    assert all((one.part > 0).any() == (whole.part > 0).any() for one in found)


def test_parts_go_or_stay_whole(whole):
    for one in less(whole):
        for number in np.unique(one.part[one.part > 0]):
            points = one.points[one.part[one.piece] == number]
            assert np.array_equal(points, whole.points[whole.part[whole.piece] == number])


def told(e):
    ends = np.cumsum([0, *e.candidates])
    return {
        int(number): (str(e.label[k]), int(e.kind[k]), *e.numbers[ends[k] : ends[k + 1]].ravel())
        for k, number in enumerate(e.number)
    }


def test_what_is_told_of_a_part_stays_with_it(whole):
    everything = told(whole)
    for one in less(whole):
        assert told(one) == {number: everything[number] for number in told(one)}
        assert set(told(one)) == {number for number in everything if (one.part == number).any()}


def test_no_part_stays_without_its_carrier(whole):
    for one in less(whole):
        carried = [number for number in one.parent.tolist() if number in whole.number]
        assert set(carried) <= set(one.number.tolist())


def test_what_touches_a_part_that_stays_is_left_too(whole):
    for one in less(whole):
        kept = np.isin(whole.part, one.part[one.part > 0])
        touching = (whole.part == 0) & (whole.gap[:, kept] <= 0.01).any(axis=1)
        middles = {tuple(row) for row in one.own[:, :3].tolist()}
        assert {tuple(row) for row in whole.own[touching, :3].tolist()} <= middles


def test_nothing_tells_what_the_object_was(whole):
    assert all(one.category == "" for one in less(whole) if len(one.own) < len(whole.own))


def test_what_is_left_fills_the_space_as_a_whole_surface(whole):
    for one in map(filling, less(whole)):
        low = (one.own[:, :3] - one.own[:, 3:6]).min(axis=0)
        high = (one.own[:, :3] + one.own[:, 3:6]).max(axis=0)
        assert (high - low).max() == pytest.approx(1, abs=1e-5)
        assert np.allclose(low + high, 0, atol=1e-5)
        assert area_share(one.own[:, 21].astype(float)).sum() == pytest.approx(1, abs=1e-5)


def bank_of_lockers():
    """One whose doors have handles of their own, and are more than are asked for."""
    category = next(category for category in CATEGORIES if category.name == "locker_bank")
    for seed in range(200):
        made = category.make(Dice((seed,)))
        if len(made.bodies) > 2 * MOST_ASKED and any(body.parent > 0 for body in made.bodies):
            return stored(example(made, np.random.default_rng(seed), 0.0))
    raise AssertionError("no bank of lockers is large enough")


def test_of_many_parts_a_few_are_asked_with_what_carries_them():
    many = bank_of_lockers()
    everything, found = told(many), [few_asked(many, np.random.default_rng(seed)) for seed in SEEDS]
    assert len(everything) > MOST_ASKED
    for one in found:
        assert told(one) == {number: everything[number] for number in told(one)}
        assert MOST_ASKED <= len(one.number) < len(many.number)
        assert set(one.parent.tolist()) <= {0, *one.number.tolist()}
        assert np.array_equal(one.part, many.part)
    assert len({tuple(one.number.tolist()) for one in found}) > 1


def test_of_few_parts_all_are_asked(whole):
    assert len(whole.number) <= MOST_ASKED
    assert few_asked(whole, np.random.default_rng(0)) is whole
