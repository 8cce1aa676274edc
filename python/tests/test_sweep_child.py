# SPDX-License-Identifier: MIT
"""A run of a sweep in its process, and the journal of finished ones."""

import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path
from threading import Timer
from typing import Any

import pytest
import sweep_support  # noqa: F401  Skips without corvo[sweep].
from conftest import Sequence as Room

import corvo
from corvo.sweep import child
from corvo.sweep.child import Outcome, run_in_child
from corvo.sweep.forked_run import RunServer
from corvo.sweep.inputs import Input
from corvo.sweep.journal import Journal
from corvo.sweep.limits import Limits
from corvo.sweep.options import OptionSet
from corvo.sweep.perturbation import Perturbation
from corvo.sweep.tasks import Task, task_document

LIMITS = Limits(100, 2000)
DEFAULTS = OptionSet("base", {})


def task_of(room: Room, perturbation: Perturbation = Perturbation(), **reading: str) -> Any:
    camera = {"camera": str(room.folder / "camera.yaml")}
    entry = Input("room", str(room.folder), camera | reading)
    return task_document(Task("0", "0", entry, DEFAULTS, perturbation))


def test_a_run_measures_what_the_command_does(room: Room, command_result: Path) -> None:
    outcome = run_in_child(task_of(room), LIMITS)
    expected = corvo.evaluate(corvo.Result(command_result))
    summary = corvo.Result(command_result).summary
    assert outcome.failure is None
    row = outcome.row
    assert row["frames"] == summary["frames"]
    assert row["posed_share"] == summary["posed_share"]
    assert row["ate"] == pytest.approx(expected["ate"]["rmse"], rel=1e-6)
    assert row["rpe"] == pytest.approx(expected["rpe_frames"]["translation"]["rmse"], rel=1e-6)
    assert row["coverage"] == expected["coverage"]
    assert row["live_ate"] > row["ate"]
    assert (row["segments"], row["losses"]) == (1, 0)
    assert 0 < outcome.times["processor_s"] and 20 < outcome.times["peak_memory_mb"] < 500


def test_a_reversed_run_is_as_accurate(room: Room) -> None:
    forward, backward = (
        run_in_child(task_of(room, Perturbation(reversal=reversal)), LIMITS).row
        for reversal in (False, True)
    )
    assert backward["posed_share"] > 0.9
    assert backward["ate"] < 3 * forward["ate"]


def test_without_a_truth_errors_are_unknown(room: Room) -> None:
    row = run_in_child(task_of(room, gt="none"), LIMITS).row
    assert row["posed_share"] > 0.9 and "ate" not in row


def test_wrong_input_is_an_error_that_does_not_name_its_place(room: Room) -> None:
    outcome = run_in_child(task_of(room, gt=str(room.folder / "none.tum")), LIMITS)
    assert outcome.failure == "error"
    assert str(room.folder) not in outcome.detail and "INPUT" in outcome.detail
    assert outcome.detail in outcome.last_lines


def test_a_run_that_needs_more_memory_is_ended(room: Room) -> None:
    outcome = run_in_child(task_of(room, Perturbation(passes=1000)), Limits(100, 20))
    assert (outcome.failure, outcome.detail) == ("memory", "needed more than 20 MB")


def test_a_run_that_takes_longer_is_ended(room: Room) -> None:
    start = time.monotonic()
    outcome = run_in_child(task_of(room, Perturbation(passes=1000)), Limits(1.5))
    assert (outcome.failure, outcome.detail) == ("time", "took longer than 1.5 s")
    assert time.monotonic() - start < 60


def test_a_run_that_crashes_leaves_its_last_lines(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "crashing.py").write_text(
        "import os, signal, sys\n"
        "from corvo.sweep import run_server, trial\n"
        "def crash(folder):\n"
        "    for i in range(100): print('line', i, flush=True)\n"
        "    os.kill(os.getpid(), signal.SIGSEGV)\n"
        "trial.main = crash\n"
        "run_server.main(int(sys.argv[1]))\n"
    )
    monkeypatch.setattr(child, "_server", RunServer("crashing"))
    monkeypatch.setenv("PYTHONPATH", str(tmp_path), prepend=os.pathsep)
    outcome = run_in_child({}, LIMITS)
    assert (outcome.failure, outcome.detail) == ("crash", "ended by SIGSEGV")
    assert outcome.last_lines.splitlines() == [f"line {i}" for i in range(80, 100)]


def test_a_run_whose_server_is_killed_is_a_crash_and_the_next_one_is_not(room: Room) -> None:
    assert run_in_child(task_of(room), LIMITS).failure is None
    server = next(iter(sweep_support.servers_below(os.getpid())))
    Timer(0.5, os.kill, (server, signal.SIGKILL)).start()
    outcome = run_in_child(task_of(room, Perturbation(passes=1000)), LIMITS)
    assert (outcome.failure, outcome.detail) == ("crash", "ended by SIGKILL")
    assert run_in_child(task_of(room), LIMITS).failure is None


def test_a_run_ends_with_its_worker(room: Room, tmp_path: Path) -> None:
    task = json.dumps(task_of(room, Perturbation(passes=1000)))
    code = (
        "import json\nfrom corvo.sweep.child import Limits, run_in_child\n"
        f"run_in_child(json.loads({task!r}), Limits())"
    )
    with subprocess.Popen([sys.executable, "-c", code]) as worker:
        run = None
        while run is None:
            run = next(iter(sweep_support.runs_below(worker.pid)), None)
            time.sleep(0.02)
        time.sleep(1)  # Its images are being processed.
        worker.send_signal(signal.SIGKILL)
    deadline = time.monotonic() + 60
    while sweep_support.is_running(run) and time.monotonic() < deadline:
        time.sleep(0.02)
    assert not sweep_support.is_running(run)


DONE = Outcome({"ate": 0.1}, {"wall_s": 2.0})
FAILED = Outcome(failure="crash", detail="ended by SIGSEGV", last_lines="a\nb", attempts=3)


def test_a_journal_keeps_what_was_added(tmp_path: Path) -> None:
    with Journal(tmp_path / "sweep") as journal:
        journal.add("a", DONE)
        journal.add("b", FAILED)
    with Journal(tmp_path / "sweep") as journal:
        assert journal.outcomes == {"a": DONE, "b": FAILED}


@pytest.mark.parametrize("lost", [1, 10, 60])
def test_a_line_that_is_not_whole_was_never_there(tmp_path: Path, lost: int) -> None:
    with Journal(tmp_path) as journal:
        journal.add("a", DONE)
        size = journal.size
        journal.add("b", DONE)
    file = tmp_path / "journal.jsonl"
    os.truncate(file, file.stat().st_size - lost)
    with Journal(tmp_path) as journal:
        assert list(journal.outcomes) == ["a"]
        assert journal.size == size
        journal.add("c", DONE)
    with Journal(tmp_path) as journal:
        assert list(journal.outcomes) == ["a", "c"]


def test_a_damaged_line_is_as_if_it_was_never_there(tmp_path: Path) -> None:
    with Journal(tmp_path) as journal:
        for key in "abc":
            journal.add(key, DONE)
    file = tmp_path / "journal.jsonl"
    lines = file.read_text().splitlines(keepends=True)
    file.write_text(lines[0] + lines[1].replace("0.1", "0.2") + lines[2])
    with Journal(tmp_path) as journal:
        assert list(journal.outcomes) == ["a", "c"]


def test_one_process_at_a_time_has_a_journal(tmp_path: Path) -> None:
    with Journal(tmp_path):
        with pytest.raises(corvo.Error, match="another process runs this sweep"):
            Journal(tmp_path)


def test_a_folder_with_other_files_is_left_alone(tmp_path: Path) -> None:
    (tmp_path / "thesis.tex").touch()
    with pytest.raises(corvo.Error, match="has other files"):
        Journal(tmp_path)
    assert [file.name for file in tmp_path.iterdir()] == ["thesis.tex"]
