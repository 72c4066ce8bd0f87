"""`geometric` on fronts of real furniture and machines: odd handles, strips, worktops, pedestals."""

import numpy as np
import pytest

from .furniture import BOARD, Box, bar, box, carcass, drawer, legs, panel
from .test_geometric import assert_hinge, found

WIDE = (-0.5 + BOARD + 0.003, 0.5 - BOARD - 0.003)
SHELF = box((-0.5 + BOARD, 0.5 - BOARD), (-0.19, 0.19), (0.241, 0.259))
CHEST = [*carcass((-0.5, 0.5), (-0.2, 0.2), (0.0, 0.5)), SHELF]
ROWS = ((BOARD + 0.003, 0.238), (0.262, 0.5 - BOARD - 0.003))


def plate(x: float, z: float, front: float) -> Box:
    """A flat pull on a front: it stands out by a millimetre."""
    return box((x - 0.012, x + 0.012), (front - 0.001, front), (z - 0.02, z + 0.02))


def machine(*strip: Box) -> list[Box]:
    """A block with a door that has a handle, and something above that."""
    door = panel((-0.3, 0.3), -0.32, (0.003, 0.66))
    return [box((-0.3, 0.3), (-0.3, 0.3), (0.0, 0.85)), door, bar(0.25, 0.35, -0.32), *strip]


def test_handles_as_long_as_their_doors_may_reach_a_little_over_the_edge() -> None:
    """A fridge: either handle begins at the gap between the doors, and the upper one ends above its door."""
    body, heights = box((-0.3, 0.3), (-0.31, 0.31), (0.0, 1.7)), ((0.0, 1.2), (1.22, 1.7))
    doors = [panel((-0.3, 0.3), -0.34, z) for z in heights]
    seals = [box((-0.29, 0.29), (-0.322, -0.31), (low + 0.01, high - 0.01)) for low, high in heights]
    grips = [box((-0.295, -0.265), (-0.38, -0.322), z) for z in ((0.71, 1.205), (1.21, 1.705))]
    result = found([body, *doors, *seals, *grips])
    assert result.kinds == {"lower_door": "revolute", "upper_door": "revolute"}
    np.testing.assert_array_equal(result.faces("upper_door"), [*range(24, 36), *range(72, 84)])


@pytest.mark.parametrize(
    ("places", "kind"), [((-0.3, 0.3), "prismatic"), ((0.0,), "prismatic"), ((), "revolute")]
)
def test_flat_pulls_tell_a_drawer(places: tuple[float, ...], kind: str) -> None:
    front = panel(WIDE, -0.2, ROWS[0])
    pulls = [plate(x, 0.13, -0.2) for x in places]
    assert list(found([*carcass((-0.5, 0.5), (-0.2, 0.2), (0.0, 0.26)), front, *pulls]).kinds.values()) == [
        kind
    ]


@pytest.mark.parametrize("up", [0.0, 0.3, 0.4])
def test_low_wide_fronts_are_drawn_wherever_up_their_handle_is(up: float) -> None:
    fronts = [panel(WIDE, -0.2, z) for z in ROWS]
    bars = [bar(0.0, sum(z) / 2 + up * (z[1] - z[0]), -0.2, half=0.1, upright=False) for z in ROWS]
    assert found([*CHEST, *fronts, *bars]).kinds == dict.fromkeys(
        ("lower_drawer", "upper_drawer"), "prismatic"
    )


@pytest.mark.parametrize(("upright", "name"), [(True, "door"), (False, "drawer")])
def test_a_low_front_with_an_upright_bar_is_a_door_as_of_a_microwave(upright: bool, name: str) -> None:
    body = carcass((-0.25, 0.25), (-0.2, 0.2), (0.0, 0.26))
    front, handle = panel((-0.229, 0.229), -0.2, ROWS[0]), bar(0.08, 0.13, -0.2, half=0.08, upright=upright)
    assert list(found([*body, front, handle]).kinds) == [name]


def test_the_pedestal_that_bears_the_drawers_of_a_desk_is_none() -> None:
    top = box((-0.7, 0.7), (-0.32, 0.32), (0.7, 0.72))
    pedestal = box((0.2, 0.65), (-0.28, 0.28), (0.0, 0.7))
    rows = [(0.05 + 0.21 * k, 0.24 + 0.21 * k) for k in range(3)]
    fronts = [box((0.22, 0.63), (-0.284, -0.28), z) for z in rows]
    knobs = [box((0.41, 0.44), (-0.31, -0.284), (sum(z) / 2 - 0.015, sum(z) / 2 + 0.015)) for z in rows]
    leg = box((-0.65, -0.6), (-0.28, 0.28), (0.0, 0.7))
    result = found([pedestal, top, leg, *fronts, *knobs])
    assert result.kinds == dict.fromkeys(("drawer_1", "drawer_2", "drawer_3"), "prismatic")
    moving = np.concatenate([result.faces(name) for name in result.kinds])
    assert moving.min() >= 36


@pytest.mark.parametrize(("half", "drawers"), [(0.49, 0), (0.35, 1)])
def test_the_apron_of_a_table_is_no_drawer_and_one_between_its_legs_is(half: float, drawers: int) -> None:
    top, mirror = box((-0.5, 0.5), (-0.3, 0.3), (0.7, 0.72)), box((-0.45, 0.45), (0.27, 0.29), (0.73, 1.6))
    stands = box((-0.02, 0.02), (0.27, 0.29), (0.72, 0.73))
    apron = drawer((-half, half), -0.29, 0.26, (0.58, 0.699))
    assert list(found([top, stands, mirror, *legs(1.0, 0.6, 0.699), *apron]).kinds) == ["drawer"] * drawers


class TestStrips:
    def test_controls_above_a_door_stay_and_those_of_a_drawer_do_not(self) -> None:
        strip = panel((-0.3, 0.3), -0.32, (0.68, 0.845))
        aside = box((0.18, 0.24), (-0.34, -0.32), (0.73, 0.79))
        assert found(machine(strip, aside)).kinds == {"door": "revolute"}
        centred = box((-0.03, 0.03), (-0.34, -0.32), (0.73, 0.79))
        assert found(machine(strip, centred)).kinds == {"door": "revolute", "drawer": "prismatic"}

    def test_a_panel_with_nothing_behind_it_hides_knees(self) -> None:
        top = box((-0.7, 0.7), (-0.35, 0.35), (0.7, 0.72))
        sides = [box((x, x + 0.03), (-0.3, 0.3), (0.0, 0.7)) for x in (-0.68, 0.65)]
        hiding = box((-0.648, 0.648), (0.2, 0.218), (0.35, 0.698))
        brackets = [box((x, x + 0.03), (0.218, 0.24), (0.5, 0.53)) for x in (-0.5, 0.47)]
        assert found([top, *sides, hiding, *brackets]).kinds == {}


def test_a_worktop_with_a_tap_on_it_is_no_lid() -> None:
    boards = [
        box((-0.25, 0.25), (-0.2, 0.2), (0.0, BOARD)),
        *[box(x, (-0.2, 0.2), (0.019, 0.7)) for x in ((-0.25, -0.232), (0.232, 0.25))],
        box((-0.231, 0.231), (0.19, 0.2), (0.019, 0.7)),
        box((-0.26, 0.26), (-0.22, 0.21), (0.701, 0.73)),
    ]
    door = [panel((-0.23, 0.23), -0.2, (0.02, 0.7)), bar(0.19, 0.35, -0.2)]
    tap = box((-0.02, 0.02), (0.12, 0.16), (0.73, 0.85))
    assert found([*boards, tap, *door]).kinds == {"door": "revolute"}


def test_the_walls_of_a_table_game_are_no_drawer() -> None:
    """They stand around a field, on a board on legs, and rods stick out of them."""
    field, floor = (
        box((-0.578, 0.578), (-0.329, 0.329), (0.73, 0.745)),
        box((-0.6, 0.6), (-0.35, 0.35), (0.7, 0.719)),
    )
    long_sides = [box((-0.6, 0.6), y, (0.72, 0.9)) for y in ((-0.35, -0.33), (0.33, 0.35))]
    short_sides = [box(x, (-0.328, 0.328), (0.72, 0.89)) for x in ((-0.599, -0.58), (0.58, 0.599))]
    rods = [box((x, x + 0.015), (-0.45, 0.45), (0.82, 0.835)) for x in np.linspace(-0.5, 0.5, 6).tolist()]
    assert found([field, floor, *long_sides, *short_sides, *rods, *legs(1.0, 0.6, 0.699)]).kinds == {}


def test_wide_fronts_in_a_column_with_handles_aside_are_doors() -> None:
    fronts = [panel((-0.279, 0.279), -0.2, z) for z in ((0.021, 0.297), (0.303, 0.579))]
    shelf = box((-0.28, 0.28), (-0.19, 0.19), (0.291, 0.309))
    bars = [bar(0.24, z, -0.2) for z in (0.159, 0.441)]
    result = found([*carcass((-0.3, 0.3), (-0.2, 0.2), (0.0, 0.6)), shelf, *fronts, *bars])
    assert result.kinds == {"lower_door": "revolute", "upper_door": "revolute"}


def test_alike_wide_fronts_in_a_column_are_drawers_and_a_single_one_is_a_flap() -> None:
    shelves = [box((-0.28, 0.28), (-0.19, 0.19), (z - 0.009, z + 0.009)) for z in (0.2, 0.4)]
    rows = [(0.021, 0.197), (0.203, 0.397), (0.403, 0.579)]
    body = carcass((-0.3, 0.3), (-0.2, 0.2), (0.0, 0.6))
    result = found([*body, *shelves, *[panel((-0.279, 0.279), -0.2, z) for z in rows]])
    assert result.kinds == dict.fromkeys(("drawer_1", "drawer_2", "drawer_3"), "prismatic")
    single = found(
        [*carcass((-0.3, 0.3), (-0.2, 0.2), (0.0, 0.25)), panel((-0.279, 0.279), -0.2, (0.021, 0.229))]
    )
    assert_hinge(single.joint("door"), (0.0, -0.19, 0.021), "x")


class TestDeepDrawers:
    """A low front above a deep one, as on a filing cabinet and below a fridge's doors."""

    body = (
        *carcass((-0.3, 0.3), (-0.2, 0.2), (0.0, 0.65)),
        box((-0.28, 0.28), (-0.19, 0.19), (0.441, 0.459)),
        panel((-0.279, 0.279), -0.2, (0.453, 0.629)),
        panel((-0.279, 0.279), -0.2, (0.021, 0.447)),
        bar(0.0, 0.54, -0.2, half=0.1, upright=False),
    )

    def test_one_with_a_bar_in_the_middle_of_its_upper_half_is_drawn_too(self) -> None:
        grip = bar(0.0, 0.38, -0.2, half=0.1, upright=False)
        result = found([*self.body, grip])
        assert result.kinds == dict.fromkeys(("lower_drawer", "upper_drawer"), "prismatic")

    def test_one_with_a_window_is_the_door_of_an_oven(self) -> None:
        grip, window = bar(0.0, 0.38, -0.2, half=0.1, upright=False), panel((-0.2, 0.2), -0.201, (0.08, 0.34))
        result = found([*self.body, grip, window])
        assert result.kinds == {"drawer": "prismatic", "door": "revolute"}

    def test_one_with_a_grip_at_its_lower_edge_is_a_flap(self) -> None:
        grip = bar(0.0, 0.08, -0.2, half=0.1, upright=False)
        assert found([*self.body, grip]).kinds == {"drawer": "prismatic", "door": "revolute"}
