# SPDX-License-Identifier: MIT
"""A run in a child process: whatever happens to it is an outcome."""

import json
import os
import select
import signal
import subprocess
import sys
import time
from dataclasses import dataclass, field
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any, Literal

from corvo.sweep.limits import Limits

_Ending = int | Literal["time", "memory"]
"""The exit code of a process, or the limit that it exceeded."""

_LOOK_S = 0.2
"""The memory of a run is looked at so often, s."""

_TRIAL = "corvo.sweep.trial"
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
    """Runs a task in a child process, which is ended if it exceeds a limit."""
    with TemporaryDirectory(prefix="corvo_run_") as name:
        folder = Path(name)
        document = {**task, "parent": os.getpid()}
        (folder / "task.json").write_text(json.dumps(document), encoding="utf-8")
        start = time.perf_counter()
        outcome = _outcome(folder, _execute(folder, limits), limits)
        outcome.times["wall_s"] = time.perf_counter() - start
        return outcome


def _execute(folder: Path, limits: Limits) -> _Ending:
    program = [sys.executable, "-m", _TRIAL, str(folder)]
    with open(folder / "output", "wb") as output:
        process = subprocess.Popen(
            program, stdin=subprocess.DEVNULL, stdout=output, stderr=output, start_new_session=True
        )
    try:
        return _watch(process, limits)
    finally:
        if process.poll() is None:
            os.killpg(process.pid, signal.SIGKILL)
            process.wait()


def _watch(process: subprocess.Popen[bytes], limits: Limits) -> _Ending:
    """Waits for the end of a process, or until it exceeds a limit.

    The memory is looked at from outside: inside, an allocation that fails may become an image that
    cannot be read, and thus a wrong outcome.
    """
    deadline = time.monotonic() + limits.time_s
    max_pages = limits.memory_mb * (1 << 20) // os.sysconf("SC_PAGE_SIZE")
    handle = os.pidfd_open(process.pid)
    try:
        poll = select.poll()
        poll.register(handle, select.POLLIN)
        with open(f"/proc/{process.pid}/statm", "rb") as memory:
            while not poll.poll(1e3 * _LOOK_S):
                if time.monotonic() > deadline:
                    return "time"
                if int(os.pread(memory.fileno(), 100, 0).split()[1]) > max_pages:
                    return "memory"
    finally:
        os.close(handle)
    return process.wait()


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
