"""Pictures for the model: numerals stand on their pieces, colours differ, and hidden pieces shine through."""

import numpy as np
import pytest
from simart_kit_plugins.marks import axis_sheet, sheets
from simart_kit_plugins.marks.badges import Badge, inner_spot, places
from simart_kit_plugins.marks.hues import PALETTE, piece_colors
from simart_kit_plugins.marks.lines import shape_of, sliding_lines, turning_lines
from simart_kit_plugins.marks.views import Seen

from simart_kit.testing.meshes import boxes_mesh, cabinet_asset

SIZE = 160
# A small box inside a large one, and one before it.
NESTED = [((0, 0, 0), (2, 2, 2)), ((0.6, 0.6, 0.6), (1.4, 1.4, 1.4)), ((0.8, -0.4, 0.8), (1.2, 0, 1.2))]


@pytest.fixture(autouse=True)
def _small(monkeypatch):
    monkeypatch.setattr(sheets, "PANEL", SIZE)
    monkeypatch.setattr(sheets, "TILE", SIZE)
    monkeypatch.setattr(axis_sheet, "PANEL", SIZE)


@pytest.fixture(scope="module")
def nested():
    return Seen.of(boxes_mesh(NESTED), np.repeat([0, 1, 2], 12))


def red(picture):
    """(H, W) how much redder than green each pixel is."""
    return picture[..., 0].astype(int) - picture[..., 1]


def test_the_deepest_pixel_of_an_l_is_in_its_corner():
    mask = np.zeros((40, 40), bool)
    mask[30:, :] = mask[:, :10] = True
    (x, y), depth = inner_spot(mask)
    assert x < 10
    assert y >= 30
    assert depth == pytest.approx(6, abs=1)


def test_badges_do_not_cover_each_other_and_stay_inside():
    rng = np.random.default_rng(0)
    badges = [
        Badge(str(i), (float(x), float(y)), (0, 0, 0)) for i, (x, y) in enumerate(rng.random((25, 2)) * 300)
    ]
    badges += [Badge("77", (150.0, 150.0), (0, 0, 0))] * 2
    boxes = np.array(places(badges, (320, 320)))
    assert boxes.min() >= 0
    assert boxes.max() <= 320
    for i, one in enumerate(boxes):
        others = np.delete(boxes, i, axis=0)
        width = np.minimum(one[2], others[:, 2]) - np.maximum(one[0], others[:, 0])
        height = np.minimum(one[3], others[:, 3]) - np.maximum(one[1], others[:, 1])
        assert not ((width > 0) & (height > 0)).any()


def test_a_badge_that_may_not_stand_on_its_spot_does_not():
    ((left, top, right, bottom),) = places([Badge("A", (100.0, 100.0), (0, 0, 0), on_spot=False)], (200, 200))
    assert not (left < 100 < right and top < 100 < bottom)


def test_pieces_that_meet_have_colours_far_apart():
    picture = np.repeat(np.arange(30), 10)[None].repeat(20, axis=0)  # 30 stripes side by side
    colors = np.array(piece_colors([picture], 30), dtype=float)
    assert len(np.unique(colors, axis=0)) == len(PALETTE)
    assert np.linalg.norm(np.diff(colors, axis=0), axis=1).min() > 60


def test_each_piece_is_red_in_its_own_view(nested):
    (sheet,) = sheets.red_sheets(nested, [("0", (0,)), ("2", (2,))])
    first, second = sheet[:SIZE, :SIZE], sheet[:SIZE, SIZE:]
    outer = nested.outline((0,), nested.cameras[nested.best_side((0,))], SIZE)
    front = nested.outline((2,), nested.cameras[nested.best_side((2,))], SIZE)
    away = np.ones((SIZE, SIZE), bool)
    away[:40, :60] = False  # the numeral
    assert np.mean(red(first)[outer & away] > 60) > 0.9
    assert np.mean(red(second)[front & away] > 60) > 0.9
    assert np.mean(red(second)[outer & ~front & away] > 60) < 0.1  # but for a ring, the rest is pale


def test_a_piece_inside_another_shines_through(nested):
    (sheet,) = sheets.red_sheets(nested, [("1", (1,))])
    inside = nested.outline((1,), nested.cameras[nested.best_side((1,))], SIZE)
    assert inside.sum() > 500
    inside[:40, :60] = False
    assert np.all(red(sheet[:SIZE, :SIZE])[inside] > 40)


def test_many_pieces_take_several_sheets(nested, monkeypatch):
    monkeypatch.setattr(sheets, "TILE", 32)
    found = sheets.red_sheets(nested, [(str(i), (2,)) for i in range(sheets.PER_SHEET + 1)])
    assert [sheet.shape[1] for sheet in found] == [5 * 32, 32]


def test_marks_and_plain_pictures_have_four_and_two_views(nested):
    plain, marks = sheets.plain_sheet(nested), sheets.marks_sheet(nested)
    assert plain.shape[1] == marks.shape[1] == 2 * SIZE
    assert marks.shape[0] > 2 * SIZE > plain.shape[0] > SIZE
    assert plain.dtype == marks.dtype == np.uint8


def test_the_front_is_looked_at_from_the_front(nested):
    assert nested.best_side((2,)) == "front left"


@pytest.mark.parametrize("kind", ["lines", "arrows"])
def test_lines_are_drawn_over_the_link(kind):
    asset = cabinet_asset(textured=False)
    seen = Seen.of(asset.mesh, asset.face_part)
    shape = shape_of(asset.mesh, asset.face_part == 1, asset.face_part == 0)
    lines = turning_lines(shape) if kind == "lines" else sliding_lines(shape)
    sheet = axis_sheet.axis_sheet(seen, (1,), shape, lines)
    columns = sheet.shape[1] // SIZE
    panels = [
        sheet[row * (SIZE + 26) : row * (SIZE + 26) + SIZE, column * SIZE : (column + 1) * SIZE].astype(int)
        for row in range(sheet.shape[0] // (SIZE + 26))
        for column in range(columns)
    ]
    changed = [int((np.abs(panel - panels[0]).sum(axis=-1) > 60).sum()) for panel in panels[1:]]
    assert len(changed) == (3 if kind == "lines" else 1)  # one view for each direction of lines
    assert min(changed) > 300
