# SPDX-License-Identifier: MIT
"""The medians of a sweep as tables in Markdown, for texts and terminals."""

from collections.abc import Iterable, Sequence

from corvo.sweep.cells import cost_cells, heading, metric_cells, run_count, spread_text
from corvo.sweep.metrics import METRICS
from corvo.sweep.summary import Rows


def make_medians(rows: Rows, metrics: Sequence[str], costs: Iterable[tuple[object, ...]]) -> str:
    """Returns a table of the metrics and one of the costs.

    Args:
        rows: The rows of the sweep.
        metrics: The names of the metrics.
        costs: Name, processor time, memory and time of a run of each sequence.
    """
    shown = [METRICS[name] for name in metrics]
    header = ["median (worst)", "options", "runs", *map(heading, shown)]
    lines = [
        [group.input, group.options, run_count(group), *metric_cells(group, shown, spread_text)]
        for group in rows.groups(metrics)
    ]
    cost_header = ["cost", "processor, ms a frame", "memory, MB", "time of a run, s"]
    return f"{_table(header, lines)}\n{_table(cost_header, cost_cells(costs))}"


def _table(header: Sequence[str], lines: Iterable[Sequence[str]]) -> str:
    rows = [header, ["---"] * len(header), *lines]
    return "".join(f"| {' | '.join(map(_escaped, row))} |\n" for row in rows)


def _escaped(cell: str) -> str:
    return cell.replace("|", "\\|").replace("\n", " ")
