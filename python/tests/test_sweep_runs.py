# SPDX-License-Identifier: MIT
"""The command `corvo sweep`: its rows are the same whatever happens while it runs."""

import json
import os
import resource
import signal
import subprocess
import time
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import Any

import pytest
from conftest import Sequence as Room
from sweep_support import is_running, parent_of, processes_below, runs_below, start_sweep, sweep

import pyarrow.parquet as pq

TIME_LIMIT_S = 120


@pytest.fixture(scope="module")
def plan(room: Room, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Six runs that succeed, and six whose ground truth is none."""
    file = tmp_path_factory.mktemp("plan") / "plan.yaml"
    truth = file.with_name("truth.tum")
    truth.write_text("no poses\n")
    entry = {"path": str(room.folder), "camera": str(room.folder / "camera.yaml"), "count": 50}
    broken = {**entry, "name": "no truth", "gt": str(truth)}
    document = {
        "inputs": [{**entry, "name": "room"}, broken],
        "options": {"grid": {"extractor.num_features": [800, 1000]}},
        "perturbations": [{"start": [0, 3]}, {"noise": 5}],
        "limits": {"time_s": TIME_LIMIT_S, "memory_mb": 2000, "attempts": 3},
    }
    file.write_text(json.dumps(document))
    return file


@pytest.fixture(scope="module")
def undisturbed(plan: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("undisturbed") / "sweep"
    exit_code, output, messages = sweep(plan, "-o", folder, "--workers", 1)
    assert (exit_code, messages) == (3, "")
    assert output == f"12 runs, 6 failed: {folder}\n"
    return folder


def rows_of(folder: Path) -> bytes:
    return (folder / "rows.parquet").read_bytes()


def table_of(folder: Path, name: str = "rows.parquet") -> list[dict[str, Any]]:
    rows: list[dict[str, Any]] = pq.read_table(folder / name).to_pylist()
    return rows


def wait_for(condition: Callable[[], Any], seconds: float = 60) -> Any:
    deadline = time.monotonic() + seconds
    while not (value := condition()):
        assert time.monotonic() < deadline
        time.sleep(0.01)
    return value


def run_below(process: subprocess.Popen[str], others: frozenset[int] = frozenset()) -> int | None:
    """Returns the process of a run of a sweep."""
    return next((pid for pid in runs_below(process.pid) if pid not in others), None)


def processor_time_s() -> float:
    """That of all processes that this one has waited for."""
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


def end(processes: Iterable[int]) -> None:
    for pid in processes:
        os.kill(pid, signal.SIGKILL)


def test_rows_are_in_the_order_of_the_plan(undisturbed: Path) -> None:
    rows = table_of(undisturbed)
    assert [(row["input"], row["options"], row["perturbation"]) for row in rows] == [
        (name, f"extractor.num_features={count}", title)
        for name in ("room", "no truth")
        for count in (800, 1000)
        for title in ("none", "start 3", "noise 5")
    ]
    assert [row["frames"] for row in rows[:3]] == [50, 47, 50]
    assert all(row["failure"] is None and row["ate"] < 0.05 for row in rows[:6])


def test_a_run_that_fails_is_a_row(undisturbed: Path) -> None:
    failed = table_of(undisturbed)[6:]
    assert {row["failure"] for row in failed} == {"error"}
    assert all("truth.tum" in row["detail"] and row["ate"] is None for row in failed)
    runs = {run["key"]: run for run in table_of(undisturbed, "runs.parquet")}
    assert all("truth.tum" in runs[row["key"]]["last_lines"] for row in failed)


def test_a_finished_sweep_costs_less_than_a_second(undisturbed: Path, plan: Path) -> None:
    names = ("rows.parquet", "runs.parquet", "journal.jsonl")
    before = [(undisturbed / name).stat().st_mtime_ns for name in names]
    times_s = []
    for _ in range(3):
        start = processor_time_s()  # Other processes of the machine do not count.
        assert sweep(plan, "-o", undisturbed)[0] == 3
        times_s.append(processor_time_s() - start)
    assert min(times_s) < 1
    assert [(undisturbed / name).stat().st_mtime_ns for name in names] == before


def test_rows_do_not_depend_on_workers_that_die_and_runs_that_die_or_hang(
    plan: Path, undisturbed: Path, tmp_path: Path
) -> None:
    file = tmp_path / "plan.yaml"  # The same runs, which may take less time.
    file.write_text(plan.read_text().replace(f'"time_s": {TIME_LIMIT_S}', '"time_s": 15'))
    with start_sweep(file, "-o", tmp_path / "sweep", "--workers", 2) as process:
        stopped = wait_for(lambda: run_below(process))
        os.kill(stopped, signal.SIGSTOP)
        killed = wait_for(lambda: run_below(process, frozenset({stopped})))
        os.kill(killed, signal.SIGKILL)
        seen = frozenset({stopped, killed})
        last = wait_for(lambda: run_below(process, seen))
        os.kill(parent_of(parent_of(last)), signal.SIGKILL)  # The worker.
        assert process.wait(120) == 3
    assert rows_of(tmp_path / "sweep") == rows_of(undisturbed)
    attempts = [run["attempts"] for run in table_of(tmp_path / "sweep", "runs.parquet")]
    assert sum(attempts) >= len(attempts) + 3


def test_a_killed_sweep_goes_on_where_it_stopped(
    plan: Path, undisturbed: Path, tmp_path: Path
) -> None:
    folder = tmp_path / "sweep"
    journal = folder / "journal.jsonl"
    with start_sweep(plan, "-o", folder, "--workers", 2) as process:
        wait_for(lambda: journal.exists() and journal.read_bytes().count(b"\n") >= 2)
        wait_for(lambda: run_below(process))
        below = processes_below(process.pid)
        process.kill()
    wait_for(lambda: not any(is_running(pid) for pid, line in below.items() if "Agent" not in line))
    end(pid for pid in below if is_running(pid))  # Agents of Ray, which may outlast it.
    finished = journal.read_bytes()
    assert not (folder / "rows.parquet").exists()
    assert sweep(plan, "-o", folder, "--workers", 2)[0] == 3
    assert journal.read_bytes().startswith(finished.rpartition(b"\n")[0])
    assert journal.read_bytes().count(b"\n") == 12
    assert rows_of(folder) == rows_of(undisturbed)


def test_an_interrupted_sweep_has_the_rows_of_finished_runs(plan: Path, tmp_path: Path) -> None:
    folder = tmp_path / "sweep"
    journal = folder / "journal.jsonl"
    with start_sweep(plan, "-o", folder, "--workers", 1) as process:
        wait_for(lambda: journal.exists() and journal.read_bytes().count(b"\n") >= 2)
        process.send_signal(signal.SIGINT)
        messages = process.communicate()[1]
    assert process.returncode == 130
    assert messages == "corvo: interrupted; the same command goes on from here\n"
    assert 1 <= len(table_of(folder)) < 12


def test_limits_end_runs_which_are_rows_then(room: Room, tmp_path: Path) -> None:
    file = tmp_path / "plan.yaml"
    entry = {"path": str(room.folder), "camera": str(room.folder / "camera.yaml")}
    limits = {"time_s": 1, "attempts": 2}
    document = {"inputs": [entry], "perturbations": [{"passes": 1000}], "limits": limits}
    file.write_text(json.dumps(document))
    assert sweep(file, "-o", tmp_path / "sweep")[0] == 3
    row, run = table_of(tmp_path / "sweep")[0], table_of(tmp_path / "sweep", "runs.parquet")[0]
    assert (row["failure"], row["detail"]) == ("time", "took longer than 1 s")
    assert run["attempts"] == 2
    document["limits"] = {"memory_mb": 50, "attempts": 1}
    file.write_text(json.dumps(document))
    assert sweep(file, "-o", tmp_path / "sweep", "--retry-failed")[0] == 3
    row = table_of(tmp_path / "sweep")[0]
    assert (row["failure"], row["detail"]) == ("memory", "needed more than 50 MB")


def test_a_bad_plan_makes_no_folder(tmp_path: Path) -> None:
    (tmp_path / "plan.yaml").write_text("inputs: []")
    exit_code, output, messages = sweep(tmp_path / "plan.yaml", "-o", tmp_path / "sweep")
    assert (exit_code, output) == (1, "")
    assert messages.startswith("corvo: error: ") and "inputs is []" in messages
    assert not (tmp_path / "sweep").exists()
