# SPDX-License-Identifier: MIT
"""A run in a child process: whatever happens to it is an outcome."""

import json
import os
import select
import signal
import time
from dataclasses import dataclass, field
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any, Literal

from corvo.sweep.forked_run import ForkedRun, RunServer
from corvo.sweep.limits import Limits

_Ending = int | Literal["time", "memory"]
"""The exit code of a process, or the limit that it exceeded."""

_LOOK_S = 0.2
"""The memory of a run is looked at so often, s."""

_LAST_LINES = 20
_LAST_BYTES = 4000


@dataclass
class Outcome:
    """What became of an attempt, or of the last of several."""

    row: dict[str, Any] = field(default_factory=dict)
    """What was measured, without times; empty if the run failed."""
    times: dict[str, float] = field(default_factory=dict)
    failure: str | None = None
    """None, or "error" (of the input), "crash", "memory", "time" or "lost" (with its machine)."""
    detail: str = ""
    """What is known of the failure, in a line that is the same every time."""
    last_lines: str = ""
    """The end of what the run printed."""
    attempts: int = 1
    node: str = ""
    """The name of the machine."""


def run_in_child(task: dict[str, Any], limits: Limits) -> Outcome:
    """Runs a task in a child process, which is ended if it exceeds a limit.

    Only one thread may run tasks.
    """
    with TemporaryDirectory(prefix="corvo_run_") as name:
        folder = Path(name)
        (folder / "task.json").write_text(json.dumps(task), encoding="utf-8")
        (folder / "output").touch()  # The process may be killed before it prints anything.
        start = time.perf_counter()
        outcome = _outcome(folder, _execute(folder, limits), limits)
        outcome.times["wall_s"] = time.perf_counter() - start
        return outcome


_server = RunServer("corvo.sweep.run_server")


def _execute(folder: Path, limits: Limits) -> _Ending:
    run = _server.start(folder)
    try:
        return _watch(run, limits)
    finally:
        run.end()


def _watch(run: ForkedRun, limits: Limits) -> _Ending:
    """Waits for the end of a run, or until it exceeds a limit.

    The memory is looked at from outside: inside, an allocation that fails may become an image that
    cannot be read, and thus a wrong outcome.
    """
    deadline = time.monotonic() + limits.time_s
    max_pages = limits.memory_mb * (1 << 20) // os.sysconf("SC_PAGE_SIZE")
    poll = select.poll()
    poll.register(run.answers, select.POLLIN)
    while not poll.poll(1e3 * _LOOK_S):
        if time.monotonic() > deadline:
            return "time"
        if run.resident_pages() > max_pages:
            return "memory"
    return run.wait()


def _outcome(folder: Path, ending: _Ending, limits: Limits) -> Outcome:
    lines = _last_lines(folder / "output")
    match ending:
        case "time":
            detail = f"took longer than {limits.time_s:g} s"
            return Outcome(failure="time", detail=detail, last_lines=lines)
        case "memory":
            detail = f"needed more than {limits.memory_mb} MB"
            return Outcome(failure="memory", detail=detail, last_lines=lines)
        case 0:
            result = json.loads((folder / "result.json").read_bytes())
            if "error" in result:
                return Outcome(failure="error", detail=result["error"], last_lines=lines)
            return Outcome(result["row"], result["times"], last_lines=lines)
        case _:
            return Outcome(failure="crash", detail=_crash(ending), last_lines=lines)


def _crash(exit_code: int) -> str:
    if exit_code < 0:
        return f"ended by {signal.Signals(-exit_code).name}"
    return f"ended with exit code {exit_code}"


def _last_lines(file: Path) -> str:
    """Returns the last lines of a text, without what a pipe or a terminal could not show."""
    content = file.read_bytes()[-_LAST_BYTES:].decode(errors="replace")
    return "\n".join(content.splitlines()[-_LAST_LINES:])
