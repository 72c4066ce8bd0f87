"""The page of a benchmark run, as a browser shows it."""

from __future__ import annotations

import re
import shutil
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

from simart_kit.bench.page import write_page
from simart_kit.bench.page.overview import heading
from simart_kit.bench.pictures import PICTURES, write_pictures
from simart_kit.bench.protocols.simart import Simart
from simart_kit.bench.results import Summary, summarise
from simart_kit.bench.rows import Row, Settings, object_folder, write_row, write_settings
from simart_kit.errors import BadInputError

from .bench_objects import cabinet, prediction, truth
from .browser import needs_browser, started

if TYPE_CHECKING:
    from playwright.sync_api import Browser, Page

pytestmark = pytest.mark.slow

DASH = "\N{EN DASH}"
HOSTILE = "<script>window.hit=1"
ERROR = "<img src=x onerror=window.hit=1> broke </script><script>window.hit=1</script>"
SETTINGS = Settings("cupboards & co", "simart/1", "recipe <b>bold</b>", "input", None, "as given", "9.9.9")
PARTS = (
    {
        "outcome": "matched",
        "true": "door",
        "true_kind": "revolute",
        "found": False,
        "predicted": "part_1",
        "iou": 0.25,
        "origin": None,
        "pd_hits": 1,
    },
    {"outcome": "missed", "true": "drawer"},
)
# By name, type and axis the orders are different.
ROWS = (
    Row("alpha_one", "cabinet", scores={"type": 0.9, "axis": 0.25, "type_matched": 0.95}, parts=PARTS),
    Row("beta", "cabinet", static=True, scores={"type": 0.2, "axis": 0.1}, notes=("a <note>",)),
    Row("gamma", "fridge", scores={"type": None, "axis": None}, seconds=12.5),
    Row(HOSTILE, "fridge", scores={"type": 0.5, "axis": 0.2}),
    Row("zeta", "fridge", status="failed", error=ERROR, scores={"type": 0.0, "axis": 1.5}),
)
WORST_FIRST = ["zeta", "beta", HOSTILE, "alpha_one", "gamma"]


@pytest.fixture(scope="module")
def pictures(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("pictures")
    write_pictures(folder, truth(cabinet()), prediction(cabinet()), None)
    return folder


@pytest.fixture(scope="module")
def run(tmp_path_factory: pytest.TempPathFactory, pictures: Path) -> Path:
    folder = tmp_path_factory.mktemp("run")
    write_settings(folder, SETTINGS)
    for row in ROWS:
        drawn = row if row.name == "gamma" else _with_pictures(folder, row, pictures)
        write_row(folder, drawn)
    write_page(folder)
    return folder


def _with_pictures(run: Path, row: Row, pictures: Path) -> Row:
    shutil.copytree(pictures, object_folder(run, row.name))
    return Row(**{**vars(row), "pictures": {key: f"{key}.png" for key in PICTURES}})


@pytest.fixture(scope="module")
def browser() -> Iterator[Browser]:
    with started() as browser:
        yield browser


@pytest.fixture
def page(browser: Browser, run: Path) -> Iterator[Page]:
    """The page, just opened; whatever it complains about fails the test."""
    page = browser.new_page(viewport={"width": 1280, "height": 900})
    page.set_default_timeout(5000)
    complaints: list[str] = []
    page.on("console", lambda message: complaints.append(message.text))
    page.on("pageerror", lambda error: complaints.append(str(error)))
    page.on("request", lambda request: complaints.append(request.url) if _is_remote(request.url) else None)
    page.goto((run / "report.html").as_uri())
    yield page
    page.close()
    assert complaints == []


def _is_remote(url: str) -> bool:
    return not url.startswith(("file:", "data:"))


def names(page: Page) -> list[str]:
    """Names of the objects that are shown, from top to bottom."""
    return page.locator("#objects .toggle:visible").all_inner_texts()


def sorted_by(page: Page, key: str) -> str | None:
    return page.locator(f"th[data-key={key}]").first.get_attribute("aria-sort")


@needs_browser
def test_failures_come_first_then_the_worst_and_what_has_no_number_last(page: Page) -> None:
    assert names(page) == WORST_FIRST


@needs_browser
def test_a_click_on_a_heading_puts_the_worst_first_and_a_second_the_best(page: Page) -> None:
    button = page.locator("thead th[data-key=axis] button")
    button.click()
    # The larger an axis error the worse; gamma has none.
    assert names(page) == ["zeta", "alpha_one", HOSTILE, "beta", "gamma"]
    assert sorted_by(page, "axis") == "descending"
    button.click()
    assert names(page) == ["beta", HOSTILE, "alpha_one", "zeta", "gamma"]
    assert sorted_by(page, "axis") == "ascending"
    page.locator("#worst").click()
    assert names(page) == WORST_FIRST
    assert sorted_by(page, "axis") == "none"


@needs_browser
def test_headings_work_from_the_keyboard_and_words_sort_from_a_to_z(page: Page) -> None:
    page.locator("thead th[data-key=category] button").focus()
    page.keyboard.press("Enter")
    # Within a category the order is that of before: failures first, then worst first.
    assert names(page) == ["beta", "alpha_one", "zeta", HOSTILE, "gamma"]


@needs_browser
def test_the_address_keeps_sort_and_filter(page: Page) -> None:
    page.locator("thead th[data-key=type] button").click()
    page.locator("thead th[data-key=type] button").click()
    page.locator("#filter").fill("a")
    before, address = names(page), page.url
    assert before[0] == "alpha_one"
    page.goto("about:blank")
    page.goto(address)
    assert names(page) == before
    assert sorted_by(page, "type") == "descending"


@needs_browser
def test_the_filter_looks_at_names_categories_and_errors(page: Page) -> None:
    for text, expected in (
        ("ALPHA", ["alpha_one"]),
        ("cabinet", ["beta", "alpha_one"]),
        ("broke", ["zeta"]),
        ("nothing like it", []),
    ):
        page.locator("#filter").fill(text)
        assert names(page) == expected
        assert page.locator("#shown").inner_text() == f"{len(expected)} of 5 shown"


@needs_browser
def test_only_failed_or_only_static_objects_can_be_shown(page: Page) -> None:
    for show, expected in (("failed", ["zeta"]), ("static", ["beta"]), ("all", WORST_FIRST)):
        page.locator(f"input[value={show}]").check()
        assert names(page) == expected


@needs_browser
def test_details_unfold_and_show_parts_notes_and_the_error(page: Page) -> None:
    toggle = page.locator(".toggle", has_text="alpha_one")
    assert not page.locator(".parts").is_visible()
    toggle.click()
    assert toggle.get_attribute("aria-expanded") == "true"
    parts = page.locator(".parts tbody tr").all_inner_texts()
    assert [part.split("\t") for part in parts] == [
        ["matched\nIoU < 0.5\n", "door\nrevolute\n", "part_1", "0.250", "1"],
        ["missed", "drawer", DASH, DASH, DASH],
    ]
    # Nobody has an origin, and this protocol has no metric of the last key.
    headings = page.locator(".parts thead th").all_inner_texts()
    assert headings == ["Outcome", "True part", "Predicted part", "IoU", "pd hits"]
    page.locator(".toggle", has_text="zeta").click()
    assert page.locator(".error:visible").all_inner_texts() == [ERROR]
    page.locator(".toggle", has_text="beta").click()
    assert "a <note>" in page.locator(".notes:visible").inner_text()


@needs_browser
def test_foreign_text_is_shown_and_never_run(page: Page) -> None:
    assert HOSTILE in names(page)
    assert page.locator("h1").inner_text() == "recipe <b>bold</b> on cupboards & co"
    assert page.evaluate("window.hit") is None
    assert page.locator("script").count() == 1


@needs_browser
def test_pictures_are_there_and_a_click_shows_those_of_the_object_larger(page: Page) -> None:
    thumbnails = page.locator("#objects img")
    assert thumbnails.count() == 4 * len(PICTURES)  # gamma has none
    thumbnails.first.scroll_into_view_if_needed()
    page.wait_for_function("document.querySelector('#objects img').naturalWidth > 0")
    thumbnails.nth(1).click()
    viewer = page.locator("#viewer")
    assert viewer.get_by_role("heading").inner_text() == "zeta"
    page.wait_for_function("[...document.querySelectorAll('#viewer img')].every((i) => i.naturalWidth > 0)")
    captions = ["Input", "Truth", "Prediction", "Truth, open", "Prediction, open"]
    assert viewer.locator("figcaption").all_inner_texts() == captions
    assert viewer.locator(".chosen figcaption").all_inner_texts() == ["Truth"]
    page.keyboard.press("ArrowRight")
    assert viewer.get_by_role("heading").inner_text() == "beta"
    page.keyboard.press("Escape")
    assert not viewer.is_visible()


@needs_browser
def test_means_come_penalised_and_over_matched_parts(page: Page) -> None:
    cells = page.locator("table.summary").first.locator("tbody tr").first.locator("td").all_inner_texts()
    # Type: (0.9 + 0.2 + 0.5 + 0.0) / 4 objects; only alpha has a number over matched parts, so no interval.
    assert [cells[0], cells[2], *cells[3:]] == ["0.400", "4", "0.950", "", "1"]
    lower, _, upper = cells[1].partition(f" {DASH} ")
    assert 0.0 <= float(lower) < 0.4 < float(upper) <= 0.9


@needs_browser
def test_a_number_that_is_not_defined_is_a_dash_that_says_so(page: Page) -> None:
    cell = page.locator("tbody[data-rank='4'] td[data-key=type] span")
    assert cell.inner_text() == DASH
    assert cell.get_attribute("title") == "not defined for this object"


@needs_browser
def test_metrics_are_explained_and_the_protocols_flaws_told(page: Page) -> None:
    told = page.locator("section[aria-labelledby=explanations]").inner_text().lower()
    for metric in Simart.metrics:
        repeats = metric.key.removesuffix("_matched") in {m.key for m in Simart.metrics} - {metric.key}
        assert (metric.text.rstrip(".").lower() in told) is not repeats
    for flaw in Simart.flaws:
        assert flaw.lower().replace("`", "") in told
    hint = page.locator("thead th[data-key=axis] button").get_attribute("title") or ""
    assert hint.endswith("lower is better.")


@needs_browser
def test_dark_systems_get_light_text_on_dark_ground(browser: Browser, run: Path) -> None:
    def luminance(color: str) -> float:
        return sum(float(value) for value in color[4:-1].split(",")) / 3  # "rgb(21, 24, 29)"

    for scheme, is_dark in (("dark", True), ("light", False)):
        page = browser.new_page(color_scheme=scheme)  # type: ignore[arg-type]
        page.goto((run / "report.html").as_uri())
        style = "(name) => getComputedStyle(document.body)[name]"
        ground, ink = (luminance(page.evaluate(style, name)) for name in ("backgroundColor", "color"))
        page.close()
        assert (ground < ink) is is_dark
        assert abs(ground - ink) > 180


@needs_browser
def test_on_a_phone_all_pictures_of_an_object_are_in_view_and_nothing_scrolls_sideways(
    browser: Browser, run: Path
) -> None:
    page = browser.new_page(viewport={"width": 390, "height": 844})
    page.goto((run / "report.html").as_uri())
    inside, outside = page.evaluate("[document.body.scrollWidth, document.documentElement.clientWidth]")
    page.locator("thead th[data-key=axis] button").click()
    pictures = page.locator("tbody[data-rank='3'] img").evaluate_all(
        "(all) => all.map((i) => i.getBoundingClientRect()).map((r) => [r.left, r.right, r.width])"
    )
    first = names(page)[1]
    page.close()
    assert inside <= outside
    assert len(pictures) == len(PICTURES)
    assert all(left >= 0 and right <= 390 and width > 50 for left, right, width in pictures)
    assert first == "alpha_one"  # cards can be sorted as the table can


@needs_browser
def test_on_a_desktop_the_page_scrolls_and_the_headings_stay(page: Page) -> None:
    for toggle in page.locator(".toggle").all():
        toggle.click()
    page.locator("#objects tbody").last.scroll_into_view_if_needed()
    top, scrolled = page.evaluate(
        "[document.querySelector('#objects thead th').getBoundingClientRect().top, window.scrollY]"
    )
    assert scrolled > 500
    assert top == 0


@needs_browser
@pytest.mark.parametrize("width", [390, 1280])
def test_long_names_break_at_underscores_only(browser: Browser, tmp_path: Path, width: int) -> None:
    write_settings(tmp_path, SETTINGS)
    words = ["bigym", "dishwasher", "extraordinarily", "unbreakable"]
    link = {"outcome": "matched", "true": "_".join(words * 3), "predicted": "_".join(words * 3), "iou": 1.0}
    write_row(tmp_path, Row("_".join(words), "cabinet", scores={"type": 1.0}, parts=(link,)))
    page = browser.new_page(viewport={"width": width, "height": 800})
    page.goto(write_page(tmp_path).as_uri())
    page.locator(".toggle").click()
    # A word that is broken has a rectangle on each of its lines.
    broken = """(element) => [...element.childNodes].filter((node) => node.nodeType === 3).map((node) => {
      const range = document.createRange();
      range.selectNodeContents(node);
      return range.getClientRects().length;
    })"""
    pieces = page.locator(".toggle").evaluate(broken)
    inside, outside = page.evaluate("[document.body.scrollWidth, document.documentElement.clientWidth]")
    page.close()
    assert pieces == [1] * len(words)
    assert inside <= outside


def test_headings_tell_units(run: Path) -> None:
    assert "Axis [rad] \N{DOWNWARDS ARROW}" in (run / "report.html").read_text(encoding="utf-8")


def test_particulates_numbers_stand_beside_those_without_punishment(tmp_path: Path) -> None:
    write_settings(tmp_path, replace(SETTINGS, protocol="particulate/1"))
    keys = ("rest_per_part_avg_chamfer", "rest_per_part_avg_chamfer_nopunish")
    for name, value in (("one", 0.25), ("two", 0.75)):
        write_row(tmp_path, Row(name, scores=dict(zip(keys, (value, value / 10), strict=True))))
    content = write_page(tmp_path).read_text(encoding="utf-8")
    first = re.search(r"<tr><th[^>]*>CD rest.*?</tr>", content)
    assert first is not None
    # (0.25 + 0.75) / 2 and a tenth of it.
    assert re.findall(r'class="number mean">([^<]*)<', first[0]) == ["0.500", "0.050"]


def test_openable_parts_are_told_by_s2os_own_names(tmp_path: Path) -> None:
    write_settings(tmp_path, replace(SETTINGS, protocol="s2o/1"))
    part = {"outcome": "matched", "true": "door", "predicted": "lid", "class": "door", "pd": 1, "mao": 0}
    write_row(tmp_path, Row("one", scores={"pd_f1": 1.0}, parts=(part,)))
    content = write_page(tmp_path).read_text(encoding="utf-8")
    table = content[content.index('class="parts"') :].partition("</thead>")[0]
    headings = re.findall(r"<th[^>]*>([^<]*)</th>", table)
    assert headings == ["Outcome", "True part", "Predicted part", "class", "pd", "mao"]


def test_the_heading_counts_objects_and_parts() -> None:
    group = summarise((), Simart()).all
    known = replace(group, objects=3, failed=1, static=1, true_parts=37, found=24, missed=13, invented=1)
    for changed, parts in (
        (known, "37 moving parts: 24 found, 13 missed, 1 invented (IoU \N{GREATER-THAN OR EQUAL TO} 0.5)"),
        (replace(known, true_parts=1), "1 moving part: 24 found"),
        (replace(known, found=None, missed=None, invented=None), ""),
    ):
        told = heading(SETTINGS, Summary("simart/1", changed, {}))
        lines = [re.sub("<[^>]*>", "", line) for line in told.split("</p>")]
        assert lines[0].endswith("3 objects: 2 scored, 1 failed, 1 static")
        assert lines[1].startswith(parts)
        assert bool(lines[1]) is bool(parts)


def test_the_same_rows_give_the_same_bytes(run: Path) -> None:
    before = (run / "report.html").read_bytes()
    assert write_page(run).read_bytes() == before
    assert b"http://" not in before
    assert b"https://" not in before


def test_two_hundred_objects_stay_below_thirty_megabytes(tmp_path: Path, pictures: Path) -> None:
    write_settings(tmp_path, SETTINGS)
    count = 40  # a fifth of them
    for index in range(count):
        row = Row(f"object_{index}", "cabinet", scores={"type": index / count}, parts=PARTS * 10)
        write_row(tmp_path, _with_pictures(tmp_path, row, pictures))
    size = write_page(tmp_path).stat().st_size
    assert size < 30e6 / 5


def test_a_damaged_picture_is_left_out(tmp_path: Path, pictures: Path) -> None:
    write_settings(tmp_path, SETTINGS)
    row = _with_pictures(tmp_path, ROWS[0], pictures)
    (object_folder(tmp_path, row.name) / "truth.png").write_bytes(b"no picture")
    (object_folder(tmp_path, row.name) / "input.png").unlink()
    write_row(tmp_path, row)
    assert write_page(tmp_path).read_text(encoding="utf-8").count("<img") == len(PICTURES) - 2


def test_a_run_without_any_row_has_a_page(tmp_path: Path) -> None:
    write_settings(tmp_path, SETTINGS)
    assert "Means over objects" in write_page(tmp_path).read_text(encoding="utf-8")


def test_a_folder_of_something_else_is_refused(tmp_path: Path) -> None:
    with pytest.raises(BadInputError, match="no folder of a benchmark run"):
        write_page(tmp_path)
