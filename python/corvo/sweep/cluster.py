# SPDX-License-Identifier: MIT
"""The machines on which runs are executed: this one, or a cluster of Ray."""

import logging
import os
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from typing import Any

from corvo._corvo import Error
from corvo.sweep.child import Outcome, run_in_child
from corvo.sweep.limits import Limits
from corvo.sweep.tasks import Task, build_of_corvo, task_document

_MAX_LOSSES = 10
"""A run that was lost with its machine more often is given up."""

_GRACE_S = 120.0
"""What a worker may need beyond the limits of its runs, s, before it counts as hanging."""

_START_ATTEMPTS = 3
"""Ray gives up after half a minute, which a busy machine may need."""

_OBJECT_STORE_BYTES = 80 << 20
"""Outcomes are a few kilobytes and pass by the store."""


@contextmanager
def connect(address: str | None, workers: int | None) -> Iterator[None]:
    """Starts Ray on this machine, or joins the cluster with an address.

    Args:
        address: That of a cluster, or None.
        workers: Number of runs at once on this machine; one for each processor if None.
    """
    os.environ.setdefault("RAY_USAGE_STATS_ENABLED", "0")
    import ray

    local: dict[str, Any] = {
        "num_cpus": workers or len(os.sched_getaffinity(0)),
        "include_dashboard": False,
        "object_store_memory": _OBJECT_STORE_BYTES,
    }
    given = {"address": address} if address else {"address": "local", **local}
    common = {"logging_level": logging.ERROR, "log_to_driver": False}
    _start(common | given, attempts=1 if address else _START_ATTEMPTS)
    try:
        yield
    finally:
        ray.shutdown()


def _start(options: dict[str, Any], attempts: int) -> None:
    import ray

    for attempt in range(attempts):
        try:
            ray.init(**options)
            return
        except Exception as error:  # Ray raises also those of no other class.
            ray.shutdown()
            if attempt == attempts - 1:
                raise Error(f"Ray cannot be used: {error}") from None


def run_on_cluster(
    tasks: Sequence[Task], limits: Limits, done: Callable[[Task, Outcome], None]
) -> None:
    """Runs tasks, each in a child process of a worker, and calls `done` with each outcome.

    A run that crashes or exceeds a limit is repeated; so is one whose worker ends or hangs.

    Raises:
        Error: A worker has another build of corvo, or no processors are left.
    """
    _Scheduler(limits, done).run(tasks)


class _Attempt:
    """A task that is submitted, how often that was, and since when."""

    def __init__(self, task: Task) -> None:
        self.task = task
        self.failures = 0
        self.losses = 0
        self.since = 0.0


class _Scheduler:
    def __init__(self, limits: Limits, done: Callable[[Task, Outcome], None]) -> None:
        import ray

        self._ray = ray
        self._limits = limits
        self._done = done
        self._build = build_of_corvo()
        self._running: dict[Any, _Attempt] = {}
        self._remote = ray.remote(num_cpus=1, max_retries=0)(_run)

    def run(self, tasks: Sequence[Task]) -> None:
        waiting = [_Attempt(task) for task in reversed(tasks)]
        while waiting or self._running:
            # Few are submitted in advance: a cluster need not hold them all.
            capacity = 2 * self._processors()
            while waiting and len(self._running) < capacity:
                self._submit(waiting.pop())
            references = list(self._running)
            ready, _ = self._ray.wait(references, num_returns=len(references), timeout=0)
            if not ready:
                ready, _ = self._ray.wait(references, num_returns=1, timeout=1.0)
            for reference in ready:
                self._finish(self._running.pop(reference), self._outcome(reference))
            self._cancel_hanging()

    def _processors(self) -> int:
        """Returns their number, for which is waited while there are none."""
        deadline = time.monotonic() + _GRACE_S
        resources: Callable[[], dict[str, float]] = self._ray.cluster_resources
        while (count := int(resources().get("CPU", 0))) == 0:
            if time.monotonic() > deadline:
                raise Error("the cluster has no processors left; finished runs are kept")
            time.sleep(1)
        return count

    def _submit(self, attempt: _Attempt) -> None:
        attempt.since = time.monotonic()
        document = task_document(attempt.task)
        self._running[self._remote.remote(document, self._limits, self._build)] = attempt

    def _outcome(self, reference: Any) -> Outcome:
        try:
            outcome: Outcome = self._ray.get(reference)
            return outcome
        except self._ray.exceptions.RayError as error:
            cause = getattr(error, "cause", None)
            if isinstance(cause, Error):
                raise cause from None
            text = str(error)[-2000:]
            if isinstance(error, self._ray.exceptions.OutOfMemoryError):
                detail = "its machine had no memory left"
                return Outcome(failure="memory", detail=detail, last_lines=text)
            return Outcome(failure="lost", detail="its worker ended", last_lines=text)

    def _finish(self, attempt: _Attempt, outcome: Outcome) -> None:
        attempt.losses += outcome.failure == "lost"
        attempt.failures += outcome.failure not in (None, "lost")
        attempts = self._limits.attempts
        is_final = attempt.failures >= attempts or attempt.losses > _MAX_LOSSES
        if outcome.failure in (None, "error") or is_final:
            outcome.attempts = attempt.failures + attempt.losses + (outcome.failure is None)
            self._done(attempt.task, outcome)
        else:
            self._submit(attempt)

    def _cancel_hanging(self) -> None:
        """Ends workers that do not end their runs: one waits for at most one other."""
        longest_s = 2 * self._limits.time_s + _GRACE_S
        for reference, attempt in list(self._running.items()):
            if time.monotonic() - attempt.since > longest_s:
                del self._running[reference]
                self._ray.cancel(reference, force=True)
                self._finish(attempt, Outcome(failure="lost", detail="its worker did not answer"))


def _run(task: dict[str, Any], limits: Limits, build: str) -> Outcome:
    """Executes a run in a worker."""
    own = build_of_corvo()
    if own != build:
        name = os.uname().nodename
        raise Error(f"{name} has corvo {own}; allowed is {build}, as where the sweep is started")
    outcome = run_in_child(task, limits)
    outcome.node = os.uname().nodename
    return outcome
