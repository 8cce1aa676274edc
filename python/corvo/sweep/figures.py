# SPDX-License-Identifier: MIT
"""The plots of the page about a sweep."""

from collections.abc import Sequence
from typing import Any

import numpy as np

from corvo.report import colors
from corvo.report.figure import MAX_POINTS, Figure
from corvo.report.html import number
from corvo.sweep.metrics import METRICS, Metric
from corvo.sweep.summary import Group, Rows, Spread

_MAX_SEQUENCES = 40
"""More would not be legible; those with the largest medians are drawn."""

_ERROR = METRICS["ate_percent"]
"""Comparable between sequences of any size."""


def spread_figure(groups: Sequence[Group], options: Sequence[str], metric: Metric) -> Figure | None:
    """Returns the medians of each sequence with their intervals and worst cases, or None."""
    drawn = _largest([group for group in groups if _finite(group.spreads.get(metric.name))], metric)
    if not drawn:
        return None
    sequences = list(dict.fromkeys(group.input for group in drawn))
    figure = Figure(
        f"spread-{metric.name}",
        f"{metric.title}, by sequence",
        "A dot is the median of the runs, the bar its 95% interval, the cross the worst run.",
    )
    for index, label in enumerate(options):
        alike = [group for group in drawn if group.options == label]
        figure.traces += _spread_traces(alike, metric, label, index, len(options))
    num_left_out = len({group.input for group in groups}) - len(sequences)
    if num_left_out:
        figure.notes.append(
            f"{num_left_out} sequences are left out: without a known median, or with smaller ones "
            f"than the {_MAX_SEQUENCES} largest."
        )
    figure.layout = {
        "xaxis": {"title": {"text": _axis(metric)}, "type": "log" if metric.unit else "linear"},
        "yaxis": {"autorange": "reversed", "categoryarray": sequences, "type": "category"},
        "showlegend": len(options) > 1,
    }
    figure.size = "tall"
    return figure


def _largest(groups: Sequence[Group], metric: Metric) -> list[Group]:
    """Returns the groups of the sequences with the largest medians, in their order."""
    medians: dict[str, float] = {}
    for group in groups:
        spread = group.spreads[metric.name]
        assert spread is not None
        medians[group.input] = max(spread.median, medians.get(group.input, 0.0))
    largest = sorted(medians, key=lambda name: -medians[name])[:_MAX_SEQUENCES]
    return [group for group in groups if group.input in largest]


def _finite(spread: Spread | None) -> bool:
    return spread is not None and bool(np.isfinite(spread.median))


def _spread_traces(
    groups: Sequence[Group], metric: Metric, label: str, index: int, count: int
) -> list[dict[str, Any]]:
    spreads = [spread for group in groups if (spread := group.spreads[metric.name])]
    medians = np.array([spread.median for spread in spreads])
    highs = np.array([spread.interval.high for spread in spreads])
    worst = np.array([spread.worst for spread in spreads])
    color = colors.line(index)["color"]
    common = {
        "type": "scatter",
        "mode": "markers",
        "y": [group.input for group in groups],
        "legendgroup": label,
    }
    bars = {
        "type": "data",
        "symmetric": False,
        "array": np.where(np.isfinite(highs), highs - medians, 0.0),
        "arrayminus": medians - np.array([spread.interval.low for spread in spreads]),
    }
    size = 11 if count == 1 else 9
    return [
        {**common, "x": medians, "error_x": bars, "name": label,
         "marker": {"color": color, "size": size, "symbol": index % 5},
         "hovertemplate": "%{y}: median %{x:.3g}"},
        {**common, "x": np.where(np.isfinite(worst), worst, np.nan), "showlegend": False,
         "marker": {"color": color, "size": size - 2, "symbol": "x-thin", "line": {"width": 2,
                                                                                  "color": color}},
         "hovertemplate": "%{y}: worst %{x:.3g}"},
    ]  # fmt: skip


def cumulative_figure(rows: Rows, options: Sequence[str]) -> Figure | None:
    """Returns the share of runs with at most an error, or None without errors."""
    figure = Figure("cumulative", "Cumulative error", "")
    texts = []
    for index, label in enumerate(options):
        errors, num_runs = _errors(rows, label)
        if not errors:
            continue
        shares = np.arange(1, len(errors) + 1) / num_runs
        step = -(-len(errors) // MAX_POINTS)
        figure.traces.append({
            "type": "scatter", "mode": "lines", "name": label, "line": {**colors.line(index),
                                                                       "shape": "hv"},
            "x": np.array(errors[::step]), "y": shares[::step],
            "hovertemplate": "%{y:.0%} have at most %{x:.3g}%",
        })  # fmt: skip
        median = errors[(num_runs - 1) // 2] if (num_runs - 1) // 2 < len(errors) else None
        reached = "is not reached" if median is None else f"have at most {number(median)}%"
        texts.append(f"{label}: half of {num_runs} runs {reached}.")
    figure.description = (
        "The share of the runs with a ground truth whose ATE is at most so many percent of the "
        "path. A run that fails or has no poses counts, and never reaches an error. "
        + " ".join(texts)
    )
    figure.layout = {
        "xaxis": {"title": {"text": _axis(_ERROR)}, "type": "log"},
        "yaxis": {"title": {"text": "share of runs"}, "range": [0, 1.02], "tickformat": ".0%"},
        "showlegend": len(options) > 1,
    }
    return figure if figure.traces else None


def _errors(rows: Rows, options: str) -> tuple[list[float], int]:
    """Returns the known errors, ascending, and the number of runs of sequences with a truth."""
    found = rows.query(
        f"SELECT {_ERROR.name} FROM runs WHERE judged AND options = ? AND input IN "
        f"(SELECT input FROM runs WHERE {_ERROR.name} IS NOT NULL) ORDER BY 1 NULLS LAST",
        [options],
    )
    return [error for (error,) in found if error is not None], len(found)


def coverage_figure(rows: Rows, options: Sequence[str]) -> Figure | None:
    """Returns how accurate runs are against how many frames they pose, or None without errors."""
    figure = Figure(
        "coverage",
        "Coverage against accuracy",
        "Each point is a run: to the right those that pose more frames, below the more accurate.",
    )
    for index, label in enumerate(options):
        found = rows.query(
            f"SELECT posed_share, {_ERROR.name}, input || ', ' || perturbation FROM runs "
            f"WHERE judged AND options = ? AND {_ERROR.name} IS NOT NULL ORDER BY position",
            [label],
        )
        if not found:
            continue
        step = -(-len(found) // MAX_POINTS)
        shares, errors, names = zip(*found[::step])
        figure.traces.append({
            "type": "scatter", "mode": "markers", "name": label, "text": list(names),
            "x": np.array(shares), "y": np.array(errors),
            "marker": {"color": colors.faint(index, 0.7), "size": 8, "symbol": index % 5},
            "hovertemplate": "%{text}: %{x:.0%} posed, %{y:.3g}%",
        })  # fmt: skip
        if step > 1:
            figure.notes.append(f"Of many runs, one in {step} is drawn.")
    figure.layout = {
        "xaxis": {"title": {"text": "frames posed"}, "tickformat": ".0%", "range": [0, 1.03]},
        "yaxis": {"title": {"text": _axis(_ERROR)}, "type": "log"},
        "showlegend": len(options) > 1,
    }
    return figure if figure.traces else None


def _axis(metric: Metric) -> str:
    title = "ATE" if metric is _ERROR else metric.title
    unit = "% of the path" if metric is _ERROR else metric.unit
    return f"{title} [{unit}]" if unit else title
