# SPDX-License-Identifier: MIT
"""A sweep: the runs of a plan and the folder with their outcomes."""

import hashlib
import json
import sys
from pathlib import Path

from corvo.sweep.child import Outcome
from corvo.sweep.cluster import connect, run_on_cluster
from corvo.sweep.content import ContentHashes
from corvo.sweep.files import write_whole
from corvo.sweep.journal import Journal
from corvo.sweep.plan import Plan
from corvo.sweep.tasks import Task, build_of_corvo, make_tasks

ROWS = "rows.parquet"
"""What was measured: the same for every execution of a plan."""
RUNS = "runs.parquet"
"""Times, attempts, machines and the last lines of output: different every time."""
PAGE = "report.html"


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
        self.folder = journal.folder
        self.build = build_of_corvo()
        self._journal = journal
        contents = ContentHashes(self.folder / "hashes.json").of(plan.inputs)
        self.tasks = list(make_tasks(plan, contents, self.build))
        self._left = 0

    @property
    def failed(self) -> list[Task]:
        outcomes = self._journal.outcomes
        return [task for task in self.tasks if task.key in outcomes and outcomes[task.key].failure]

    def run(self, address: str | None, workers: int | None, *, retry: bool) -> None:
        """Runs what is not finished, and writes the tables and the page if anything is new.

        Args:
            address: The address of a cluster of Ray; None for this machine.
            workers: The number of runs at once on this machine; one for each processor if None.
            retry: Whether runs that failed earlier are repeated.
        """
        tasks = self._unfinished(retry)
        self._left = len(tasks)
        try:
            if tasks:
                with connect(address, workers):
                    run_on_cluster(tasks, self.plan.limits, self._add)
        finally:
            self._summarize()

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
        self._left -= 1
        if sys.stderr.isatty():
            end = "" if self._left else "\n"
            print(f"\r{self._left} runs are left ", end=end, file=sys.stderr, flush=True)

    def _summarize(self) -> None:
        stamp, state = self.folder / "state", self._state().encode()
        results = [self.folder / name for name in (ROWS, RUNS)]
        if all(file.exists() for file in results) and _read(stamp) == state:
            return
        from corvo.sweep import tables  # A sweep without news does not take the time to load it.

        outcomes = self._journal.outcomes
        tables.write_rows(results[0], self.tasks, outcomes, self.build)
        tables.write_runs(results[1], self.tasks, outcomes)
        write_whole(stamp, state)

    def _state(self) -> str:
        """Returns a text that changes with whatever the tables and the page show."""
        titles = [
            [task.key, task.input.name, task.options.label, task.perturbation.title, task.is_judged]
            for task in self.tasks
        ]
        shown = [self._journal.size, self.build, self.plan.metrics, titles]
        return hashlib.sha256(json.dumps(shown).encode()).hexdigest()


def _read(file: Path) -> bytes:
    try:
        return file.read_bytes()
    except FileNotFoundError:
        return b""
