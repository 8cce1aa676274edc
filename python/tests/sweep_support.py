# SPDX-License-Identifier: MIT
"""Tests of sweeps are skipped without corvo[sweep], or fail if CI is set."""

import os
import subprocess
import sys
from contextlib import suppress
from importlib.util import find_spec
from pathlib import Path

import pytest

PACKAGES = ("duckdb", "fsspec", "PIL", "plotly", "pyarrow", "ray", "yaml")

for _name in PACKAGES:
    if find_spec(_name) is None:
        if os.environ.get("CI"):
            raise ModuleNotFoundError(f"{_name} is not installed")
        pytest.skip(f"{_name} is not installed", allow_module_level=True)


def start_sweep(*arguments: object) -> subprocess.Popen[str]:
    return subprocess.Popen(
        [sys.executable, "-m", "corvo", "sweep", *map(str, arguments)],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )


def sweep(*arguments: object) -> tuple[int, str, str]:
    """Runs the command. Returns its exit code and what it printed."""
    with start_sweep(*arguments) as process:
        output, messages = process.communicate()
    return process.returncode, output, messages


def is_running(pid: int) -> bool:
    """Whether a process has not ended; whether anyone has asked for its end does not matter."""
    try:
        stat = Path(f"/proc/{pid}/stat").read_text()
    except OSError:
        return False
    return stat.rpartition(")")[2].split()[0] != "Z"


def parent_of(pid: int) -> int:
    return int(Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[1])


def processes_below(ancestor: int) -> dict[int, str]:
    """Returns the command lines of a process's descendants."""
    parents, lines = {}, {}
    for folder in Path("/proc").iterdir():
        if not folder.name.isdecimal():
            continue
        try:
            pid = int(folder.name)
            parent = parent_of(pid)
            line = (folder / "cmdline").read_bytes()
        except OSError:  # It has ended.
            continue
        parents[pid] = parent
        lines[pid] = line.replace(b"\0", b" ").decode(errors="replace")
    below = {ancestor}
    while new := {pid for pid, above in parents.items() if above in below} - below:
        below |= new
    return {pid: lines[pid] for pid in below - {ancestor}}


def servers_below(ancestor: int) -> list[int]:
    """Returns the processes among a process's descendants whose forks are runs, and these."""
    lines = processes_below(ancestor)
    return [pid for pid, line in lines.items() if "corvo.sweep.run_server" in line]


def runs_below(ancestor: int) -> list[int]:
    """Returns the processes of runs among a process's descendants."""
    processes = servers_below(ancestor)
    runs = []
    for pid in processes:
        with suppress(OSError):  # It has ended.
            if parent_of(pid) in processes and is_running(pid):
                runs.append(pid)
    return runs
