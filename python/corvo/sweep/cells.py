# SPDX-License-Identifier: MIT
"""The cells of tables about a sweep."""

from collections.abc import Callable, Iterable, Sequence
from math import isfinite

from corvo.report.html import number
from corvo.sweep.metrics import Metric
from corvo.sweep.summary import Group, Spread


def heading(metric: Metric) -> str:
    return f"{metric.title} [{metric.unit}]" if metric.unit else metric.title


def run_count(group: Group) -> str:
    return f"{group.num_runs}, {group.num_failed} failed" if group.num_failed else f"{group.num_runs}"


def metric_cells(
    group: Group, metrics: Sequence[Metric], cell: Callable[[Spread, Metric], str]
) -> list[str]:
    """Returns the cell of each metric; a dash where no run could be compared with a truth."""
    spreads = [(group.spreads[metric.name], metric) for metric in metrics]
    return [cell(spread, metric) if spread else "-" for spread, metric in spreads]


def cost_cells(costs: Iterable[tuple[object, ...]]) -> list[list[str]]:
    """Returns a line for each sequence: its name, processor time, memory and time of a run."""
    return [[str(name), *(f"{value:.3g}" for value in values)] for name, *values in costs]


def spread_text(spread: Spread, metric: Metric) -> str:
    """Returns the median and, in brackets, the worst value."""
    return f"{_value(spread.median, metric)} ({_value(spread.worst, metric)})"


def interval_text(spread: Spread, metric: Metric) -> str:
    return " to ".join(_value(value, metric) for value in spread.interval)


def _value(value: float, metric: Metric) -> str:
    if not isfinite(value):
        return "unknown"
    if metric.better == "more":
        return f"{value:.1%}"
    return number(value) if metric.unit else f"{value:g}"
