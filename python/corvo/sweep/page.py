# SPDX-License-Identifier: MIT
"""The page about a sweep."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from corvo.report.document import make_document
from corvo.report.figure import Figure
from corvo.report.html import breakable, details, markup, paragraph, table
from corvo.report.section import Section
from corvo.sweep.cells import (
    cost_cells, heading, interval_text, metric_cells, run_count, spread_text,
)  # fmt: skip
from corvo.sweep.child import Outcome
from corvo.sweep.figures import coverage_figure, cumulative_figure, spread_figure
from corvo.sweep.metrics import METRICS, Metric
from corvo.sweep.regression import Regression, shown
from corvo.sweep.summary import Group, Rows, Spread

_MAX_ROWS = 200
"""Longer tables are cut, and say so."""


@dataclass(frozen=True)
class Content:
    """What the page is about."""

    name: str
    rows: Rows
    metrics: Sequence[str]
    costs: Sequence[tuple[object, ...]]
    failures: Sequence[tuple[str, str, str, Outcome]]
    """Sequence, options, perturbation and outcome of the runs that failed."""
    regression: Regression | None
    baseline: str


def make_page(content: Content) -> str:
    """Returns the HTML of a page about a sweep. It loads nothing from anywhere."""
    return make_document("corvo sweep", content.name, _sections(content))


def _sections(content: Content) -> list[Section]:
    rows = content.rows
    options = rows.texts("options")
    groups = rows.groups(content.metrics)
    metrics = [METRICS[name] for name in content.metrics]
    spreads = [spread_figure(groups, options, metric) for metric in metrics if metric.unit]
    general = [cumulative_figure(rows, options), coverage_figure(rows, options)]
    sections = [
        Section("summary", "Summary", [_counts(content, options)]),
        Section("sequences", "Sequences", [_medians(groups, metrics), *_drawn(spreads)]),
        Section("runs", "All runs", _drawn(general) or [paragraph("No run has a ground truth.")]),
        Section("failures", "Failed runs", [_failures(content.failures)]),
        Section("cost", "Cost", [_costs(content.costs)]),
    ]
    if content.regression:
        compared = _regression(content.regression, content.baseline)
        sections.insert(1, Section("regression", "Against the baseline", [compared]))
    return sections


def _drawn(figures: Sequence[Figure | None]) -> list[str | Figure]:
    return [figure for figure in figures if figure]


def _counts(content: Content, options: Sequence[str]) -> str:
    rows = content.rows
    counts = rows.query("SELECT count(*), count(failure), count(*) FILTER (NOT judged) FROM runs")
    num_runs, num_failed, num_unjudged = counts[0]
    lines = [
        ("Runs", num_runs),
        ("Failed", num_failed),
        ("Not part of medians", num_unjudged),
        ("Sequences", len(rows.texts("input"))),
        ("Sets of options", len(options)),
        ("Perturbations", ", ".join(rows.texts("perturbation"))),
        ("corvo", ", ".join(rows.texts("corvo"))),
    ]
    return table("The sweep", ["", content.name], lines)


def _medians(groups: Sequence[Group], metrics: Sequence[Metric]) -> str:
    text = paragraph(
        "Median over the perturbations, and the worst run in brackets. A run that fails or has no "
        "poses counts as the worst. A dash: no ground truth."
    )
    intervals = _group_table("95% intervals of the medians", groups, metrics, interval_text)
    note = paragraph("From resampled runs (bootstrap).")
    return (
        text
        + _group_table("Median (worst)", groups, metrics, spread_text)
        + _cut(len(groups))
        + details("95% intervals of the medians", note + intervals)
    )


def _group_table(
    caption: str,
    groups: Sequence[Group],
    metrics: Sequence[Metric],
    cell: Callable[[Spread, Metric], str],
) -> str:
    has_options = len({group.options for group in groups}) > 1
    header = ["Sequence", *(["Options"] if has_options else []), "Runs", *map(heading, metrics)]
    lines = []
    for group in groups[:_MAX_ROWS]:
        lines.append((
            group.input,
            *([breakable(group.options)] if has_options else []),
            run_count(group),
            *metric_cells(group, metrics, cell),
        ))  # fmt: skip
    return table(caption, header, lines)


def _cut(count: int) -> str:
    if count <= _MAX_ROWS:
        return ""
    return paragraph(f"{count - _MAX_ROWS} more are in `rows.parquet`.")


def _regression(regression: Regression, baseline: str) -> str:
    lines = [
        (
            heading(change.metric),
            change.num_runs,
            shown(change.median, change.metric),
            " to ".join(shown(value, change.metric) for value in change.interval),
            change.num_lost,
            shown(change.tolerance, change.metric),
            "worse" if change.is_worse else "not worse",
        )
        for change in regression.changes
    ]
    header = ["Metric", "Runs", "Median change", "95% interval", "No longer known", "Allowed", ""]
    text = paragraph(
        f"Each run is compared with that of the same sequence, options and perturbation in "
        f"`{baseline}`. A positive change is for the worse: in percent of an error, or the "
        "difference of a share or count. The interval is from resampled sequences."
    )
    html = text + table("Changes", header, lines)
    if regression.new_failures:
        html += table("Runs that fail now", ["Sequence", "Options", "Perturbation"],
                      regression.new_failures[:_MAX_ROWS])  # fmt: skip
    if regression.num_missing:
        html += paragraph(f"{regression.num_missing} runs of the baseline are not in this sweep.")
    return html


def _failures(failures: Sequence[tuple[str, str, str, Outcome]]) -> str:
    if not failures:
        return paragraph("No run failed.")
    lines = [
        (name, options, perturbation, outcome.failure, outcome.detail, outcome.attempts)
        for name, options, perturbation, outcome in failures[:_MAX_ROWS]
    ]
    header = ["Sequence", "Options", "Perturbation", "Kind", "Detail", "Attempts"]
    lasts = [
        details(f"{name}, {perturbation}", f"<pre>{markup(outcome.last_lines)}</pre>\n")
        for name, _, perturbation, outcome in failures[:_MAX_ROWS]
        if outcome.last_lines
    ]
    return table("Failed runs", header, lines) + _cut(len(failures)) + "".join(lasts)


def _costs(costs: Sequence[tuple[object, ...]]) -> str:
    header = ["Sequence", "Processor, ms a frame", "Memory, MB", "Time of a run, s"]
    lines = cost_cells(costs[:_MAX_ROWS])
    text = paragraph("Medians over the runs that did not fail; memory is the most of any.")
    return text + table("Cost", header, lines) + _cut(len(costs))
