# SPDX-License-Identifier: MIT
"""A sweep: the runs of a plan and the folder with their outcomes."""

import hashlib
import json
import sys
from pathlib import Path
from typing import TYPE_CHECKING

from corvo.files import write_whole
from corvo.sweep.child import Outcome
from corvo.sweep.cluster import connect, run_on_cluster
from corvo.sweep.content import ContentHashes
from corvo.sweep.files import MEDIANS, PAGE, ROWS, RUNS
from corvo.sweep.journal import Journal
from corvo.sweep.plan import Plan
from corvo.sweep.tasks import Task, build_of_corvo, make_tasks

if TYPE_CHECKING:
    from corvo.sweep.regression import Regression


class Sweep:
    """The runs of a plan and their outcomes in a folder.

    Args:
        plan: The plan.
        journal: The finished runs, of this plan and of others.

    Raises:
        Error: An input cannot be read.
    """

    def __init__(self, plan: Plan, journal: Journal) -> None:
        self.plan = plan
        self._folder = journal.folder
        self._build = build_of_corvo()
        self._journal = journal
        contents = ContentHashes(self._folder / "hashes.json").of(plan.inputs)
        self.tasks = list(make_tasks(plan, contents, self._build))
        self._num_left = 0

    @property
    def num_failed(self) -> int:
        outcomes = self._journal.outcomes
        return sum(task.key in outcomes and bool(outcomes[task.key].failure) for task in self.tasks)

    def run(self, address: str | None, workers: int | None, *, retry: bool) -> None:
        """Runs what is not finished.

        Args:
            address: The address of a cluster of Ray; None for this machine.
            workers: The number of runs at once on this machine; one for each processor if None.
            retry: Whether runs that failed earlier are repeated.
        """
        tasks = self._unfinished(retry)
        self._num_left = len(tasks)
        if tasks:
            with connect(address, workers):
                run_on_cluster(tasks, self.plan.limits, self._add)

    def summarize(self, baseline: Path | None = None) -> "Regression | None":
        """Writes the tables and the page, if anything is new, and compares with a baseline.

        Raises:
            Error: The baseline cannot be read or has no runs in common.
        """
        # A sweep without news does not take the time to load more than this.
        files = [self._folder / name for name in ("state", ROWS, RUNS, MEDIANS, PAGE)]
        stamp, state = files[0], self._state().encode()
        is_there = all(file.exists() for file in files)
        if not baseline and is_there and stamp.read_bytes() == state:
            return None
        from corvo.sweep.results import Findings, write_results

        outcomes = self._journal.outcomes
        findings = Findings(self.tasks, outcomes, self.plan.metrics, self._build)
        regression = write_results(self._folder, findings, baseline)
        write_whole(stamp, b"" if baseline else state)
        return regression

    def _unfinished(self, retry: bool) -> list[Task]:
        outcomes = self._journal.outcomes
        tasks = {task.key: task for task in self.tasks}
        return [
            task
            for key, task in tasks.items()
            if key not in outcomes or (retry and outcomes[key].failure)
        ]

    def _add(self, task: Task, outcome: Outcome) -> None:
        self._journal.add(task.key, outcome)
        self._num_left -= 1
        if sys.stderr.isatty():
            end = "" if self._num_left else "\n"
            print(f"\r{self._num_left} runs are left ", end=end, file=sys.stderr, flush=True)

    def _state(self) -> str:
        """Returns a text that changes with whatever the tables and the page show."""
        titles = [
            [task.key, task.input.name, task.options.label, task.perturbation.title, task.is_judged]
            for task in self.tasks
        ]
        shown = [self._journal.size, self._build, self.plan.metrics, titles]
        return hashlib.sha256(json.dumps(shown).encode()).hexdigest()
