# SPDX-License-Identifier: MIT
"""What a sweep comes to: medians, intervals, the comparison with a baseline, and the page."""

import base64
import json
import math
import re
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
import sweep_support  # noqa: F401  Skips without corvo[sweep].
from conftest import Sequence as Room
from test_report import figures_of, without_plotly
from test_report_browser import SIZES_OF_DRAWINGS, open_page

import corvo
from corvo.sweep.bootstrap import grouped_median_interval, median_interval
from corvo.sweep.child import Outcome
from corvo.sweep.files import MEDIANS, PAGE, ROWS
from corvo.sweep.inputs import Input
from corvo.sweep.options import OptionSet
from corvo.sweep.perturbation import Perturbation
from corvo.sweep.regression import Regression, compare
from corvo.sweep.results import Findings, write_results
from corvo.sweep.summary import Rows
from corvo.sweep.tasks import Task

if TYPE_CHECKING:
    from playwright.sync_api import Browser

METRICS = {"ate": 0.05, "ate_percent": 0.05, "posed_share": 0.01, "segments": 0.0}
FAILED = Outcome(failure="crash", detail="ended by SIGSEGV", last_lines="<last> line", attempts=3)


def outcome_of(ate: float | None, posed: float = 1.0, segments: int = 1) -> Outcome:
    percent = None if ate is None else 10 * ate
    row = {"frames": 10, "posed_share": posed, "segments": segments, "losses": 0,
           "ate": ate, "ate_percent": percent}  # fmt: skip
    times = {"wall_s": 2.0, "processor_ms_per_frame": 7.0, "peak_memory_mb": 90.0}
    return Outcome(row, times)


def findings_of(
    outcomes: dict[str, list[Outcome]], labels: tuple[str, ...] = ("base",)
) -> Findings:
    """Returns findings with so many perturbations of each sequence."""
    tasks, by_key = [], {}
    for name, runs in outcomes.items():
        for label in labels:
            for start, outcome in enumerate(runs):
                key = f"{name} {label} {start}"
                entry = Input(name, "/" + name, report_only=frozenset({"start 9"}))
                options = OptionSet(label, {})
                tasks.append(Task(key, "0", entry, options, Perturbation(start=start)))
                by_key[key] = outcome
    return Findings(tasks, by_key, METRICS, "0.2.0+1")


def write(folder: Path, findings: Findings, baseline: Path | None = None) -> Regression | None:
    folder.mkdir(exist_ok=True)
    return write_results(folder, findings, baseline)


def test_medians_and_worst_cases_are_those_of_a_sequence(tmp_path: Path) -> None:
    street = [outcome_of(ate) for ate in (0.3, 0.1, 0.2)]
    room = [outcome_of(0.1, 0.5), outcome_of(None, 0.0, 0), FAILED]
    still = [outcome_of(None, 0.0, 0)] * 3
    write(tmp_path, findings_of({"street": street, "room": room, "still": still}))
    groups = {group.input: group for group in Rows(tmp_path / ROWS).groups(list(METRICS))}
    assert list(groups) == ["street", "room", "still"]
    ate = groups["street"].spreads["ate"]
    assert ate is not None and (ate.median, ate.worst) == (0.2, 0.3)
    assert 0.1 <= ate.interval.low <= 0.2 <= ate.interval.high <= 0.3
    lost = groups["room"].spreads["ate"]
    assert lost is not None and (lost.median, lost.worst) == (math.inf, math.inf)
    posed = groups["room"].spreads["posed_share"]
    assert posed is not None and (posed.median, posed.worst) == (0.0, 0.0)
    assert (groups["room"].num_runs, groups["room"].num_failed) == (3, 1)
    assert groups["still"].spreads["ate"] is None


def test_runs_that_are_only_reported_are_not_part_of_medians(tmp_path: Path) -> None:
    write(tmp_path, findings_of({"street": [outcome_of(0.1)] * 9 + [outcome_of(5.0)]}))
    rows = Rows(tmp_path / ROWS)
    (group,) = rows.groups(["ate"])
    assert group.spreads["ate"] is not None and group.spreads["ate"].worst == 0.1
    assert rows.query("SELECT max(ate) FROM runs") == [(5.0,)]


def test_the_interval_of_a_median_has_its_coverage() -> None:
    random = np.random.RandomState(7)
    samples = random.standard_normal((200, 25))
    hits = [low <= 0 <= high for low, high in map(median_interval, samples)]
    assert 0.90 <= np.mean(hits) <= 0.99


def test_the_interval_of_a_median_is_the_same_every_time() -> None:
    values = [0.3, 0.1, math.inf, 0.2]
    assert median_interval(values) == median_interval(values)
    assert median_interval([0.5]) == (0.5, 0.5)


def test_groups_that_differ_make_an_interval_wider() -> None:
    alike = [[1.0, 2.0, 3.0]] * 4
    different = [[1.0] * 3, [2.0] * 3, [3.0] * 3, [2.0] * 3]
    assert grouped_median_interval(alike) == (2.0, 2.0)
    assert grouped_median_interval(different) == (1.0, 3.0)


BEFORE = {"street": [outcome_of(0.1 + 0.01 * i) for i in range(5)], "room": [outcome_of(0.2)] * 5}


def changed(
    tmp_path: Path, now: dict[str, list[Outcome]], before: dict[str, list[Outcome]] = BEFORE
) -> Regression:
    write(tmp_path / "before", findings_of(before))
    regression = write(tmp_path / "now", findings_of(now), tmp_path / "before" / ROWS)
    assert regression is not None
    return regression


def scaled(factor: float) -> dict[str, list[Outcome]]:
    return {
        name: [outcome_of(factor * outcome.row["ate"]) for outcome in runs]
        for name, runs in BEFORE.items()
    }


@pytest.mark.parametrize(
    ("factor", "is_worse"), [(1.0, False), (1.04, False), (1.06, True), (0.5, False)]
)
def test_errors_may_grow_by_their_tolerance(
    tmp_path: Path, factor: float, is_worse: bool
) -> None:
    regression = changed(tmp_path, scaled(factor))
    ate = next(change for change in regression.changes if change.metric.name == "ate")
    assert ate.median == pytest.approx(factor - 1)
    assert ate.interval == pytest.approx((factor - 1, factor - 1))
    assert ate.is_worse == regression.is_worse == is_worse


def test_fewer_posed_frames_are_worse(tmp_path: Path) -> None:
    fewer = {name: [outcome_of(o.row["ate"], 0.98) for o in runs] for name, runs in BEFORE.items()}
    regression = changed(tmp_path, fewer)
    worse = [change.metric.name for change in regression.changes if change.is_worse]
    assert worse == ["posed_share"]


def test_a_run_that_fails_now_is_worse(tmp_path: Path) -> None:
    regression = changed(tmp_path, {**BEFORE, "room": [outcome_of(0.2)] * 4 + [FAILED]})
    assert regression.new_failures == [("room", "base", "start 4")]
    assert regression.is_worse
    assert "fails now: room, base, start 4" in regression.lines()


def test_a_run_that_lost_its_poses_is_worse(tmp_path: Path) -> None:
    lost = {name: [outcome_of(None)] * 5 for name in BEFORE}
    regression = changed(tmp_path, lost)
    assert {c.metric.name: c.num_lost for c in regression.changes if c.is_worse} == {
        "ate": 10, "ate_percent": 10,
    }  # fmt: skip


def test_a_run_that_failed_before_is_no_regression(tmp_path: Path) -> None:
    failed = {**BEFORE, "room": [FAILED] * 5}
    assert not changed(tmp_path, failed, failed).is_worse
    assert not changed(tmp_path, BEFORE, failed).is_worse


def test_runs_that_only_one_sweep_has_are_not_compared(tmp_path: Path) -> None:
    regression = changed(tmp_path, {"street": BEFORE["street"], "new": [outcome_of(9.0)] * 5})
    assert not regression.is_worse and regression.num_missing == 5
    assert {change.num_runs for change in regression.changes} == {5}


def test_a_baseline_of_other_runs_is_an_error(tmp_path: Path) -> None:
    with pytest.raises(corvo.Error, match="rows.parquet: has no runs of this plan"):
        changed(tmp_path, {"new": [outcome_of(1.0)]})


def test_a_baseline_that_is_no_table_is_an_error(tmp_path: Path) -> None:
    write(tmp_path, findings_of(BEFORE))
    (tmp_path / "other.parquet").write_text("no table")
    with pytest.raises(corvo.Error, match="other.parquet: is no table of a sweep"):
        compare(Rows(tmp_path / ROWS), tmp_path / "other.parquet", METRICS)


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A sweep of two sets of options that has become worse."""
    folder = tmp_path_factory.mktemp("report")
    labels = ("tracker.min_inliers=15", "tracker.min_inliers=20")
    write(folder / "before", findings_of(BEFORE, labels))
    now: dict[str, list[Outcome]] = {**scaled(1.5), "crashing": [FAILED, outcome_of(None)]}
    write(folder / "now", findings_of(now, labels), folder / "before" / ROWS)
    return folder / "now"


def test_the_page_shows_medians_failures_and_the_regression(folder: Path) -> None:
    page = (folder / PAGE).read_text()
    text = re.sub("<[^>]*>", "|", without_plotly(page))
    assert "0.18 (0.21)" in text  # Median and worst of the street.
    assert "+50.00%" in text and "|worse|" in text
    assert "ended by SIGSEGV" in text and "&lt;last&gt; line" in text
    assert "crashing, none" in text
    names = [figure["id"] for figure in figures_of(page)]
    assert names == ["spread-ate", "spread-ate_percent", "cumulative", "coverage"]


def test_the_medians_are_tables_in_markdown(folder: Path) -> None:
    lines = (folder / MEDIANS).read_text().splitlines()
    assert lines[0].startswith("| median (worst) | options | runs | ATE [m] |")
    assert any(
        line.startswith("| street | tracker.min_inliers=15 | 5 | 0.18 (0.21) |") for line in lines
    )
    assert any(
        line.startswith("| crashing | tracker.min_inliers=20 | 2, 1 failed | - |") for line in lines
    )
    assert lines[lines.index("") + 1] == (
        "| cost | processor, ms a frame | memory, MB | time of a run, s |"
    )


def test_names_do_not_break_the_tables(tmp_path: Path) -> None:
    write(tmp_path, findings_of({"left|right": [outcome_of(0.1)]}))
    lines = (tmp_path / MEDIANS).read_text().splitlines()
    assert lines[2].startswith("| left\\|right | base | 1 | 0.1 (0.1) |")


def test_the_cumulative_error_counts_runs_without_poses(tmp_path: Path) -> None:
    runs = [outcome_of(0.1), outcome_of(0.2), outcome_of(None), FAILED]
    write(tmp_path, findings_of({"street": runs, "still": [outcome_of(None)] * 4}))
    page = (tmp_path / PAGE).read_text()
    (curve,) = next(f["data"] for f in figures_of(page) if f["id"] == "cumulative")
    assert decoded(curve["x"]).tolist() == pytest.approx([1.0, 2.0])
    assert decoded(curve["y"]).tolist() == [0.25, 0.5]
    assert "half of 4 runs have at most 2%" in page


def decoded(array: dict[str, str]) -> Any:
    return np.frombuffer(base64.b64decode(array["bdata"]), array["dtype"])


def test_a_sweep_without_runs_has_a_page(tmp_path: Path) -> None:
    write(tmp_path, replace(findings_of(BEFORE), outcomes={}))
    assert "No run has a ground truth." in (tmp_path / PAGE).read_text()


@pytest.mark.parametrize("width", [360, 1440])
def test_a_browser_draws_every_plot(
    browser: "Browser", folder: Path, width: int
) -> None:
    opened = open_page(browser, folder / PAGE, width)
    drawings = opened.page.evaluate(SIZES_OF_DRAWINGS)
    assert len(drawings) == 4
    for name, drawn_width, height, num_curves in drawings:
        assert drawn_width > 300 and height >= 150 and num_curves > 0, name
    assert opened.page.evaluate("document.documentElement.scrollWidth") <= width
    assert opened.complaints == []


def test_a_regression_is_an_exit_code(room: Room, tmp_path: Path) -> None:
    import pyarrow.compute as pc
    import pyarrow.parquet as pq

    plan, sweep = tmp_path / "plan.yaml", tmp_path / "sweep"
    entry = {"path": str(room.folder), "camera": str(room.folder / "camera.yaml"), "count": 50}
    plan.write_text(json.dumps({"inputs": [entry]}))
    assert sweep_support.sweep(plan, "-o", sweep) == (0, f"1 runs, 0 failed: {sweep}\n", "")
    table = pq.read_table(sweep / ROWS)
    for name, factor in (("same", 1.0), ("better", 0.5)):
        ate = pc.multiply(table["ate"], factor)
        index = table.schema.get_field_index("ate")
        pq.write_table(table.set_column(index, "ate", ate), tmp_path / f"{name}.parquet")
    exit_code, output, _ = sweep_support.sweep(
        plan, "-o", sweep, "--baseline", tmp_path / "same.parquet"
    )
    assert exit_code == 0 and "ate: +0.00% (allowed +5.00%)" in output
    exit_code, output, _ = sweep_support.sweep(
        plan, "-o", sweep, "--baseline", tmp_path / "better.parquet"
    )
    assert exit_code == 2 and "ate: +100.00% (allowed +5.00%), 0 no longer known: worse" in output
    exit_code, _, messages = sweep_support.sweep(
        plan, "-o", sweep, "--baseline", tmp_path / "none.parquet"
    )
    assert exit_code == 1 and "none.parquet: does not exist" in messages
