"""Two runs compared: pairs, intervals, verdicts; and the bootstrap behind them."""

from __future__ import annotations

import json
from dataclasses import replace
from itertools import product
from pathlib import Path

import numpy as np
import pytest
from scipy import stats

from simart_kit.bench.compare import Comparison, MetricChange, compare
from simart_kit.bench.comparison_text import changed_rows, metric_rows, unpaired_texts
from simart_kit.bench.numbers import counted, listed, number, titled
from simart_kit.bench.protocols import protocol
from simart_kit.bench.rows import Row, Settings, object_folder, write_row, write_settings
from simart_kit.bench.statistics import bootstrap_interval, mean, sign_flip_p
from simart_kit.errors import BadInputError

TAG = protocol("simart").tag
SETTINGS = Settings("cabinets", TAG, "recipe default", "input", None, "as is", "0.1.0")
HIGHER, LOWER = "iou", "cd"  # metrics of the SIMART protocol, and which way is better


def run_folder(
    folder: Path, scores: dict[str, dict[str, float | None]], settings: Settings = SETTINGS, failed: str = ""
) -> Path:
    folder.mkdir()
    write_settings(folder, settings)
    for name, values in scores.items():
        write_row(folder, Row(name, status="failed" if name == failed else "scored", scores=values))
    return folder


def change(comparison: Comparison, key: str) -> MetricChange:
    return next(c for c in comparison.metrics if c.metric.key == key)


def both(tmp_path: Path, a: list[float | None], b: list[float | None], key: str) -> MetricChange:
    """The change of one metric of objects o0, o1, ... with these scores."""
    runs = [
        run_folder(tmp_path / run, {f"o{i}": {key: value} for i, value in enumerate(values)})
        for run, values in (("a", a), ("b", b))
    ]
    return change(compare(*runs), key)


def test_a_constant_gain_of_six_objects_is_sure(tmp_path: Path) -> None:
    # 0.25 -> 0.5, 0.5 -> 0.75, 0.75 -> 1: every sample of the differences has the mean 0.25, exactly. Of the
    # 64 ways to flip six signs, two are as far from 0: none flipped, and all.
    found = both(tmp_path, [0.25, 0.5, 0.75] * 2, [0.5, 0.75, 1.0] * 2, HIGHER)
    assert (found.pairs, found.unpaired) == (6, 0)
    assert (found.mean_a, found.mean_b, found.difference) == (0.5, 0.75, 0.25)
    assert (found.interval, found.p) == ((0.25, 0.25), 2 / 64)
    assert (found.wins, found.ties, found.losses) == (6, 0, 0)
    assert found.verdict == "better"


def test_five_objects_settle_nothing_however_much_they_gain(tmp_path: Path) -> None:
    found = both(tmp_path, [0.0] * 5, [1.0] * 5, HIGHER)
    assert (found.interval, found.p) == ((1.0, 1.0), 2 / 32)
    assert found.verdict == "no clear difference"


def test_differences_below_a_ten_thousandth_are_ties(tmp_path: Path) -> None:
    found = both(tmp_path, [0.5] * 14, [0.50009] * 14, HIGHER)
    assert (found.wins, found.ties, found.losses, found.changed) == (0, 14, 0, ())
    assert (found.p, found.verdict) == (1.0, "no clear difference")


@pytest.mark.parametrize(("key", "verdict"), [(HIGHER, "worse"), (LOWER, "better")])
def test_whether_less_is_better_depends_on_the_metric(tmp_path: Path, key: str, verdict: str) -> None:
    found = both(tmp_path, [0.5, 0.75, 1.0] * 2, [0.25, 0.5, 0.75] * 2, key)
    assert found.interval == (-0.25, -0.25)
    assert found.verdict == verdict
    assert (found.wins, found.losses) == ((0, 6) if verdict == "worse" else (6, 0))


def test_gains_and_losses_of_the_same_size_are_no_clear_difference(tmp_path: Path) -> None:
    # Differences +0.5, -0.5, +0.5, -0.5, 0: mean 0.
    found = both(tmp_path, [0.0, 0.5, 0.5, 1.0, 0.3], [0.5, 0.0, 1.0, 0.5, 0.3], HIGHER)
    assert found.difference == pytest.approx(0.0)
    assert found.interval is not None
    assert found.interval[0] < 0 < found.interval[1]
    assert (found.wins, found.ties, found.losses) == (2, 1, 2)
    assert found.verdict == "no clear difference"


def test_one_object_settles_nothing(tmp_path: Path) -> None:
    found = both(tmp_path, [0.0], [1.0], HIGHER)
    assert found.interval is None
    assert (found.difference, found.wins, found.verdict) == (1.0, 1, "no clear difference")


def test_objects_without_the_number_in_one_run_are_told_and_not_paired(tmp_path: Path) -> None:
    # Pairs are o0 (+0.5) and o3 (+0.25): mean 0.375. o1 and o2 have it in one run; o4 in none.
    found = both(tmp_path, [0.0, None, 0.5, 0.5, None], [0.5, 0.5, None, 0.75, None], HIGHER)
    assert (found.pairs, found.unpaired) == (2, 2)
    assert found.difference == 0.375
    assert [c.name for c in found.changed] == ["o0", "o3"]
    found_all = compare(tmp_path / "a", tmp_path / "b")
    assert unpaired_texts(found_all, headline=True) == ["IoU: 2"]


def test_a_metric_that_no_object_has_has_no_mean(tmp_path: Path) -> None:
    found = both(tmp_path, [None], [None], HIGHER)
    assert (found.pairs, found.mean_a, found.mean_b, found.difference, found.interval) == (0, *[None] * 4)
    assert (found.p, found.verdict) == (None, "")


def test_objects_of_one_run_only_are_named_and_left_out(tmp_path: Path) -> None:
    a = run_folder(tmp_path / "a", {"x": {HIGHER: 0.5}, "y": {HIGHER: 0.0}, "old": {HIGHER: 1.0}})
    b = run_folder(tmp_path / "b", {"x": {HIGHER: 0.5}, "y": {HIGHER: 0.0}, "new": {HIGHER: 0.0}})
    found = compare(a, b)
    assert (found.objects, found.only_a, found.only_b) == (("x", "y"), ("old",), ("new",))
    assert change(found, HIGHER).mean_a == 0.25


def test_failed_objects_count_with_their_worst_scores(tmp_path: Path) -> None:
    a = run_folder(tmp_path / "a", {"x": {HIGHER: 0.5}, "y": {HIGHER: 1.0}})
    b = run_folder(tmp_path / "b", {"x": {HIGHER: 0.5}, "y": {HIGHER: 0.0}}, failed="y")
    found = compare(a, b)
    assert (found.failed_a, found.failed_b) == ((), ("y",))
    assert change(found, HIGHER).difference == -0.5  # (0 - 1) / 2
    assert change(found, HIGHER).changed[0].name == "y"


def test_the_objects_that_changed_most_come_first(tmp_path: Path) -> None:
    gains = [0.01, -0.5, 0.0, 0.3, 0.02, -0.04, 0.1]
    found = both(tmp_path, [0.5] * 7, [0.5 + gain for gain in gains], HIGHER)
    assert [c.name for c in found.changed] == ["o1", "o3", "o6", "o5", "o4"]  # five, and none without change


@pytest.mark.parametrize("name", ["data", "protocol", "variant"])
def test_runs_that_measured_something_else_are_refused(tmp_path: Path, name: str) -> None:
    a = run_folder(tmp_path / "a", {"x": {HIGHER: 0.5}})
    b = run_folder(tmp_path / "b", {"x": {HIGHER: 0.5}}, replace(SETTINGS, **{name: "simart/0"}))
    with pytest.raises(BadInputError, match=f"{name} is .* and 'simart/0' in "):
        compare(a, b)


def test_another_placement_is_told(tmp_path: Path) -> None:
    a = run_folder(tmp_path / "a", {"x": {HIGHER: 0.5}})
    b = run_folder(tmp_path / "b", {"x": {HIGHER: 0.5}}, replace(SETTINGS, placement="up +z"))
    assert compare(a, b).notes == ("placement is 'as is' in A and 'up +z' in B",)


def test_runs_of_a_protocol_that_has_changed_since_are_told(tmp_path: Path) -> None:
    old = replace(SETTINGS, protocol="simart/0")
    a = run_folder(tmp_path / "a", {"x": {HIGHER: 0.5}}, old)
    b = run_folder(tmp_path / "b", {"x": {HIGHER: 0.5}}, old)
    assert compare(a, b).notes == (
        f"both runs are of simart/0; this version has {TAG}, whose metrics may differ",
    )


@pytest.mark.parametrize("scores", [{"iou": float("nan")}, {"iou": "good"}, {"iou": True}, [0.5]])
def test_a_damaged_score_is_refused_with_its_file(tmp_path: Path, scores: object) -> None:
    a = run_folder(tmp_path / "a", {"x": {HIGHER: 0.5}})
    b = run_folder(tmp_path / "b", {"x": {HIGHER: 0.5}})
    file = object_folder(b, "x") / "row.json"
    file.write_text(json.dumps({**json.loads(file.read_text()), "scores": scores}))
    with pytest.raises(BadInputError, match=r"objects/x/row\.json is damaged"):
        compare(a, b)


def test_runs_without_a_common_object_or_no_runs_are_refused(tmp_path: Path) -> None:
    a = run_folder(tmp_path / "a", {"x": {HIGHER: 0.5}})
    b = run_folder(tmp_path / "b", {"y": {HIGHER: 0.5}})
    with pytest.raises(BadInputError, match="no object in common"):
        compare(a, b)
    with pytest.raises(BadInputError, match="no folder of a benchmark run"):
        compare(a, tmp_path)


def test_the_text_and_the_table_hold_the_numbers(tmp_path: Path) -> None:
    a = run_folder(tmp_path / "a", {f"x{i}": {HIGHER: 0.25, LOWER: 5e-5} for i in range(6)})
    b = run_folder(tmp_path / "b", {f"x{i}": {HIGHER: 0.5, LOWER: 5e-5} for i in range(6)})
    found = compare(a, b)
    gain = ["6", "0.250", "0.500", "+0.250", "0.250, 0.250", "6/0/0", "0.031", "better"]
    same = ["6", "5.0e-05", "5.0e-05", "+0.000", "0.000, 0.000", "0/6/0", "1.000", "unclear"]
    nothing = ["0", "-", "-", "-", "-", "0/0/0", "-", "-"]
    rows = metric_rows(found, headline=True)
    assert [["IoU", *gain], ["CD [size]", *same], ["Axis [rad]", *nothing]] == [
        next(row for row in rows if row[0] == title) for title in ("IoU", "CD [size]", "Axis [rad]")
    ]
    assert ["IoU", "x0", "0.250", "0.500", "+0.250"] in changed_rows(found)
    table = json.loads(json.dumps(found.table(), allow_nan=False))
    row = next(row for row in table["metrics"] if row["metric"]["key"] == HIGHER)
    assert (row["difference"], row["interval"], row["verdict"]) == (0.25, [0.25, 0.25], "better")


def test_rows_that_are_damaged_are_told(tmp_path: Path) -> None:
    runs = [run_folder(tmp_path / run, {"x": {HIGHER: 0.5}, "y": {HIGHER: 0.5}}) for run in ("a", "b")]
    (object_folder(runs[1], "y") / "row.json").write_text("{")
    found = compare(*runs)
    assert (found.objects, found.only_a) == (("x",), ("y",))
    assert found.notes == ("1 row of B left out as damaged: y; run it again",)


def test_the_short_table_has_the_headline_metrics_only(tmp_path: Path) -> None:
    found = compare(*(run_folder(tmp_path / run, {"x": {HIGHER: 0.5}}) for run in ("a", "b")))
    titles = [row[0] for row in metric_rows(found, headline=True)[1:]]
    assert titles == [titled(metric) for metric in protocol("simart").metrics if metric.headline]
    assert len(metric_rows(found)) - 1 == len(protocol("simart").metrics) > len(titles)
    assert changed_rows(found) == [["metric", "object", "A", "B", "B - A"]]


def test_the_mean_and_interval_of_few_values() -> None:
    assert mean(np.zeros(0)) is None
    assert mean(np.array([1.0, 2.0])) == 1.5
    assert bootstrap_interval(np.zeros(0)) is None
    assert bootstrap_interval(np.array([3.0])) is None
    # Of 0 and 1, the mean of two drawn is 0 or 1 with a chance of a quarter each: more than 2.5 %.
    assert bootstrap_interval(np.array([0.0, 1.0])) == (0.0, 1.0)
    # At 40 %, 30 % are left out at either end, and the middle half of the means is 0.5.
    assert bootstrap_interval(np.array([0.0, 1.0]), confidence=0.4) == (0.5, 0.5)


@pytest.mark.parametrize("count", [5, 36, 400])
def test_the_interval_agrees_with_scipy(count: int) -> None:
    values = np.random.default_rng(count).gamma(2.0, size=count)
    theirs = stats.bootstrap(
        (values,), np.mean, n_resamples=20_000, method="percentile", rng=np.random.default_rng(1)
    ).confidence_interval
    ours = bootstrap_interval(values, resamples=20_000)
    # Of 20 000 means, an end at 2.5 % is known to some 2 % of their spread; 10 % is five times that.
    near = 0.1 * values.std() / np.sqrt(count)
    assert ours == pytest.approx((theirs.low, theirs.high), abs=near)


def test_the_interval_is_the_same_again_and_another_with_another_seed() -> None:
    values = np.random.default_rng(0).normal(size=3000)  # enough to be drawn in several chunks
    first = bootstrap_interval(values, resamples=1000)
    assert first == bootstrap_interval(values, resamples=1000)
    assert first != bootstrap_interval(values, resamples=1000, seed=1)


@pytest.mark.parametrize("count", [1, 2, 6, 12])
def test_the_chance_of_few_differences_is_that_of_all_sign_flips(count: int) -> None:
    values = np.random.default_rng(count).normal(0.5, size=count).round(1)
    means = [abs(np.mean(np.multiply(values, signs))) for signs in product((1, -1), repeat=count)]
    as_far = sum(m >= abs(np.mean(values)) - 1e-12 for m in means)
    assert sign_flip_p(values) == as_far / 2**count


def test_the_chance_of_many_differences_agrees_with_scipy() -> None:
    values = np.random.default_rng(0).normal(0.3, size=40)
    theirs = stats.permutation_test(
        (values, np.zeros(40)),
        lambda a, b: np.mean(a - b),
        permutation_type="samples",
        n_resamples=50_000,
        rng=np.random.default_rng(1),
    ).pvalue
    # Some 0.05: of 10 000 flips, its standard error is 0.002.
    assert sign_flip_p(values) == pytest.approx(theirs, abs=0.01)
    assert sign_flip_p(values) == sign_flip_p(values) != sign_flip_p(values, seed=1)


def test_differences_of_0_say_nothing_and_no_differences_have_no_chance() -> None:
    assert sign_flip_p(np.zeros(0)) is None
    assert sign_flip_p(np.zeros(30)) == 1.0
    assert sign_flip_p(np.array([0.2, 0.0, 0.1, 0.0])) == 2 / 4  # both as they are, or both flipped


def test_equal_systems_are_called_different_no_more_than_once_in_twenty() -> None:
    # Of 600 pairs of equal systems, 5 % are 30; 48 or more has a chance below 0.1 %.
    random = np.random.default_rng(0)
    for count in (7, 14):
        drawn = random.exponential(size=(2, 600, count))
        false = sum((sign_flip_p(row, flips=999) or 1.0) < 0.05 for row in drawn[0] - drawn[1])
        assert 0 < false < 48


@pytest.mark.parametrize(
    ("value", "text", "signed"),
    [
        (None, "-", "-"),
        (0.0, "0.000", "+0.000"),
        (0.0005, "0.001", "+0.001"),
        (0.000044, "4.4e-05", "+4.4e-05"),
        (-0.00012, "-1.2e-04", "-1.2e-04"),
        (-1.5, "-1.500", "-1.500"),
        (12345.6, "1.235e+04", "+1.235e+04"),
        (float("inf"), "inf", "+inf"),
    ],
)
def test_a_number_is_never_shown_as_0_when_it_is_not(value: float | None, text: str, signed: str) -> None:
    assert (number(value), number(value, sign=True)) == (text, signed)


def test_counts_and_lists_are_words() -> None:
    assert [counted(n, "object") for n in (0, 1, 2)] == ["0 objects", "1 object", "2 objects"]
    assert listed(["a", "b", "c"], most=2) == "a, b and 1 more"
    assert listed(["a", "b"], most=2) == "a, b"
