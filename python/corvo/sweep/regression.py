# SPDX-License-Identifier: MIT
"""A sweep beside an earlier one, run by run."""

import math
import statistics
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from corvo._corvo import Error
from corvo.sweep.bootstrap import Interval, grouped_median_interval
from corvo.sweep.metrics import METRICS, Metric
from corvo.sweep.summary import Rows


@dataclass(frozen=True)
class Change:
    """How a metric has changed over the judged runs that both sweeps have."""

    metric: Metric
    tolerance: float
    num_runs: int
    median: float
    """The median change, worse if positive: relative for errors, otherwise a difference."""
    interval: Interval
    """Of the median, if sequences are resampled."""
    num_lost: int
    """Runs in which it was known and no longer is."""

    @property
    def is_worse(self) -> bool:
        return self.median > self.tolerance or self.num_lost > 0


@dataclass(frozen=True)
class Regression:
    changes: list[Change]
    new_failures: list[tuple[str, str, str]]
    """Sequence, options and perturbation of the runs that fail and did not."""
    num_missing: int
    """Runs of the baseline that this sweep does not have."""

    def lines(self) -> list[str]:
        """Returns what a terminal shows."""
        lines = [
            f"{change.metric.name}: {shown(change.median, change.metric)} "
            f"(allowed {shown(change.tolerance, change.metric)}), {change.num_lost} no longer "
            f"known: {'worse' if change.is_worse else 'not worse'}"
            for change in self.changes
        ]
        return lines + [f"fails now: {', '.join(run)}" for run in self.new_failures]

    @property
    def is_worse(self) -> bool:
        return bool(self.new_failures) or any(change.is_worse for change in self.changes)


_PAIRS = (
    "runs AS new JOIN baseline AS old USING (input, options, perturbation) "
    "WHERE new.judged AND old.judged"
)


def compare(rows: Rows, baseline: Path, tolerances: Mapping[str, float]) -> Regression:
    """Compares the runs that both have: those of equal names of input, options and perturbation.

    Args:
        rows: Those of this sweep.
        baseline: The file with those of an earlier one.
        tolerances: By metric, how much its median may become worse.

    Raises:
        Error: The baseline cannot be read or has no runs in common.
    """
    rows.load("baseline", baseline)
    (num_pairs,) = rows.query(f"SELECT count(*) FROM {_PAIRS}")[0]
    if num_pairs == 0:
        raise Error(
            f"{baseline}: has no runs of this plan; allowed are rows with some of its inputs, "
            "options and perturbations"
        )
    changes = [_change(rows, METRICS[name], limit) for name, limit in tolerances.items()]
    failures = rows.query(
        "SELECT input, options, perturbation FROM "
        f"{_PAIRS} AND new.failure IS NOT NULL AND old.failure IS NULL ORDER BY new.position"
    )
    (num_missing,) = rows.query(
        "SELECT count(*) FROM baseline ANTI JOIN runs USING (input, options, perturbation)"
    )[0]
    return Regression([change for change in changes if change], [*failures], num_missing)


def shown(change: float, metric: Metric) -> str:
    """Returns a change, in percent if it is relative."""
    if math.isinf(change):
        return "unknown"
    return f"{100 * change:+.2f}%" if metric.is_relative else f"{change:+.3g}"


def _change(rows: Rows, metric: Metric, tolerance: float) -> Change | None:
    """Returns None if the metric is known in no run of both sweeps."""
    pairs = rows.query(
        f"SELECT input, new.{metric.name}, old.{metric.name} FROM {_PAIRS} ORDER BY new.position"
    )
    changes: dict[str, list[float]] = {}
    for sequence, now, before in pairs:
        if now is not None and before is not None:
            changes.setdefault(sequence, []).append(_worsening(metric, now, before))
    lost = sum(now is None and before is not None for _, now, before in pairs)
    every = [change for group in changes.values() for change in group]
    if not every:
        return Change(metric, tolerance, 0, 0.0, Interval(0.0, 0.0), lost) if lost else None
    interval = grouped_median_interval(list(changes.values()))
    return Change(metric, tolerance, len(every), statistics.median(every), interval, lost)


def _worsening(metric: Metric, now: float, before: float) -> float:
    """Returns by how much a value is worse: relative for errors, absolute for shares and counts."""
    if metric.is_relative:
        if before == 0:
            return 0.0 if now == 0 else math.inf
        return now / before - 1
    return now - before if metric.better == "less" else before - now
