# SPDX-License-Identifier: MIT
"""The files with what a sweep has found: tables and a page."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from corvo.files import write_whole
from corvo.report.page_file import write_page
from corvo.sweep import tables
from corvo.sweep.child import Outcome
from corvo.sweep.files import MEDIANS, PAGE, ROWS, RUNS
from corvo.sweep.medians import make_medians
from corvo.sweep.page import Content, make_page
from corvo.sweep.regression import Regression, compare
from corvo.sweep.summary import Rows
from corvo.sweep.tasks import Task


@dataclass(frozen=True)
class Findings:
    """The runs of a plan and the outcomes of those that are finished, by their keys."""

    tasks: Sequence[Task]
    outcomes: Mapping[str, Outcome]
    metrics: Mapping[str, float]
    """Those that are shown and compared, with their tolerances."""
    build: str


def write_results(folder: Path, findings: Findings, baseline: Path | None) -> Regression | None:
    """Writes the files, and returns how the runs compare with a baseline.

    Raises:
        Error: The baseline cannot be read or has no runs in common.
    """
    tables.write_rows(folder / ROWS, findings.tasks, findings.outcomes, findings.build)
    tables.write_runs(folder / RUNS, findings.tasks, findings.outcomes)
    rows = Rows(folder / ROWS)
    regression = compare(rows, baseline, findings.metrics) if baseline else None
    metrics, costs = list(findings.metrics), rows.costs(folder / RUNS)
    write_whole(folder / MEDIANS, make_medians(rows, metrics, costs).encode())
    content = Content(
        folder.absolute().name,
        rows,
        metrics,
        costs,
        _failures(findings),
        regression,
        str(baseline),
    )
    write_page(folder / PAGE, make_page(content))
    return regression


def _failures(findings: Findings) -> list[tuple[str, str, str, Outcome]]:
    finished = [task for task in findings.tasks if task.key in findings.outcomes]
    return [
        (task.input.name, task.options.label, task.perturbation.title, outcome)
        for task in finished
        if (outcome := findings.outcomes[task.key]).failure
    ]
