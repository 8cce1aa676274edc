# SPDX-License-Identifier: MIT
"""How runs are handed to workers: retries, losses, hanging workers, lost clusters."""

import sys
from collections.abc import Sequence
from types import SimpleNamespace
from typing import Any

import pytest
import sweep_support  # noqa: F401  Skips without corvo[sweep].

import corvo
from corvo.sweep import cluster
from corvo.sweep.child import Outcome
from corvo.sweep.inputs import Input
from corvo.sweep.limits import Limits
from corvo.sweep.options import OptionSet
from corvo.sweep.perturbation import Perturbation
from corvo.sweep.tasks import Task

DONE = Outcome({"frames": 10})
CRASH = Outcome(failure="crash", detail="ended by SIGSEGV")
HANG = "hang"


class RayError(Exception):
    pass


class OutOfMemoryError(RayError):
    pass


class TaskError(RayError):
    """What Ray raises if a task has raised."""

    def __init__(self, cause: Exception) -> None:
        super().__init__(str(cause))
        self.cause = cause


class FakeRay:
    """A cluster whose attempts end as they are given: in an outcome or an error, or never."""

    exceptions = SimpleNamespace(RayError=RayError, OutOfMemoryError=OutOfMemoryError)

    def __init__(self, endings: dict[str, list[Any]], processors: int = 2) -> None:
        self._endings = endings
        self._resources = {"CPU": float(processors)} if processors else {}
        self._running: dict[object, Any] = {}
        self.canceled = 0
        self.most_running = 0

    def remote(self, **_: object) -> Any:
        return lambda function: SimpleNamespace(remote=self._submit)

    def _submit(self, task: dict[str, Any], limits: Limits, build: str) -> object:
        reference = object()
        self._running[reference] = self._endings[task["key"]].pop(0)
        self.most_running = max(self.most_running, len(self._running))
        return reference

    def wait(
        self, references: Sequence[object], num_returns: int, timeout: float
    ) -> tuple[list[object], list[object]]:
        ready = [ref for ref in references if self._running[ref] is not HANG][:num_returns]
        return ready, [reference for reference in references if reference not in ready]

    def get(self, reference: object) -> Any:
        ending = self._running.pop(reference)
        if isinstance(ending, Exception):
            raise ending
        return ending

    def cancel(self, reference: object, force: bool) -> None:
        assert force
        del self._running[reference]
        self.canceled += 1

    def cluster_resources(self) -> dict[str, float]:
        return self._resources


def task_of(key: str) -> Task:
    return Task(key, "0", Input(key, "/" + key), OptionSet("base", {}), Perturbation())


def run(
    monkeypatch: pytest.MonkeyPatch, ray: FakeRay, keys: Sequence[str], limits: Limits = Limits()
) -> dict[str, Outcome]:
    monkeypatch.setitem(sys.modules, "ray", ray)
    outcomes: dict[str, Outcome] = {}

    def add(task: Task, outcome: Outcome) -> None:
        outcomes[task.key] = outcome

    cluster.run_on_cluster([task_of(key) for key in keys], limits, add)
    return outcomes


def outcome_of(monkeypatch: pytest.MonkeyPatch, *endings: Any) -> Outcome:
    copies = [Outcome(**vars(e)) if isinstance(e, Outcome) else e for e in endings]
    return run(monkeypatch, FakeRay({"a": copies}), "a")["a"]


def test_a_crash_is_tried_again(monkeypatch: pytest.MonkeyPatch) -> None:
    outcome = outcome_of(monkeypatch, CRASH, CRASH, DONE)
    assert (outcome.row, outcome.failure, outcome.attempts) == ({"frames": 10}, None, 3)


def test_a_run_that_crashes_every_time_fails(monkeypatch: pytest.MonkeyPatch) -> None:
    outcome = outcome_of(monkeypatch, CRASH, CRASH, CRASH)
    assert (outcome.failure, outcome.attempts) == ("crash", 3)


def test_wrong_input_is_not_tried_again(monkeypatch: pytest.MonkeyPatch) -> None:
    outcome = outcome_of(monkeypatch, Outcome(failure="error"))
    assert (outcome.failure, outcome.attempts) == ("error", 1)


def test_a_lost_worker_does_not_count_as_a_crash(monkeypatch: pytest.MonkeyPatch) -> None:
    outcome = outcome_of(monkeypatch, CRASH, *[RayError()] * 5, CRASH, DONE)
    assert (outcome.failure, outcome.attempts) == (None, 8)


def test_a_run_that_is_lost_every_time_fails(monkeypatch: pytest.MonkeyPatch) -> None:
    outcome = outcome_of(monkeypatch, *[RayError("node died")] * 11)
    assert (outcome.failure, outcome.attempts) == ("lost", 11)
    assert outcome.last_lines == "node died"


def test_a_machine_without_memory_counts_as_a_failure(monkeypatch: pytest.MonkeyPatch) -> None:
    outcome = outcome_of(monkeypatch, *[OutOfMemoryError()] * 3)
    assert (outcome.failure, outcome.attempts) == ("memory", 3)


def test_a_worker_that_hangs_is_ended(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(cluster, "_GRACE_S", 0.0)
    ray = FakeRay({"a": [HANG, DONE], "b": [DONE]})
    outcomes = run(monkeypatch, ray, "ab", Limits(time_s=0.02))
    assert ray.canceled == 1
    assert [outcomes[key].failure for key in "ab"] == [None, None]


def test_a_cluster_without_processors_is_an_error(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(cluster, "_GRACE_S", 0.0)
    with pytest.raises(corvo.Error, match="no processors left; finished runs are kept"):
        run(monkeypatch, FakeRay({"a": [DONE]}, processors=0), "a")


def test_few_runs_are_submitted_in_advance(monkeypatch: pytest.MonkeyPatch) -> None:
    keys = [str(i) for i in range(50)]
    ray = FakeRay({key: [Outcome({"frames": 10})] for key in keys}, processors=3)
    outcomes = run(monkeypatch, ray, keys)
    assert ray.most_running == 6
    assert sorted(outcomes) == sorted(keys)


def test_another_build_of_corvo_is_an_error(monkeypatch: pytest.MonkeyPatch) -> None:
    with pytest.raises(corvo.Error, match=r"has corvo 0\..*; allowed is 0.1.0\+0"):
        cluster._run({}, Limits(), "0.1.0+0")
    with pytest.raises(corvo.Error, match="has corvo"):
        outcome_of(monkeypatch, TaskError(corvo.Error("node has corvo 0.1; allowed is 0.2")))
