# SPDX-License-Identifier: MIT
"""Processes of runs, as a worker sees them."""

import json
import os
import signal
import subprocess
import sys
from pathlib import Path


class RunServer:
    """The process that forks for each run. It is started when the first run is."""

    def __init__(self, module: str) -> None:
        self._module = module
        self._process: subprocess.Popen[bytes] | None = None

    def start(self, folder: Path) -> "ForkedRun":
        if self._process is None or self._process.poll() is not None:
            self._process = self._start_process()
        assert self._process.stdin
        self._process.stdin.write(json.dumps(str(folder)).encode() + b"\n")
        return ForkedRun(self._process)

    def _start_process(self) -> subprocess.Popen[bytes]:
        return subprocess.Popen(
            [sys.executable, "-m", self._module, str(os.getpid())],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            bufsize=0,  # poll() sees whether an answer is there.
            start_new_session=True,
            # A process with threads, which BLAS would start, cannot be forked safely.
            env={**os.environ, "OPENBLAS_NUM_THREADS": "1"},
        )


class ForkedRun:
    """A run, whose process its server has been asked for."""

    def __init__(self, server: subprocess.Popen[bytes]) -> None:
        assert server.stdout
        self.answers = server.stdout
        """Those of the server: once the process is known, the next is its exit code."""
        self._server = server
        self._process = int(self.answers.readline())
        self._exit_code: int | None = None

    def wait(self) -> int:
        """Returns the exit code. A server that was killed has taken the run with it."""
        if self._exit_code is None:
            answer = self.answers.readline()
            self._exit_code = int(answer) if answer else self._server.wait()
        return self._exit_code

    def end(self) -> None:
        if self._exit_code is None:
            os.kill(self._process, signal.SIGKILL)
            self.wait()

    def resident_pages(self) -> int:
        try:
            statm = Path(f"/proc/{self._process}/statm").read_bytes()
        except FileNotFoundError:  # It has ended with its server.
            return 0
        return int(statm.split()[1])
