# SPDX-License-Identifier: MIT
"""Runs in processes of their own that need not load Python and corvo again.

`python -m corvo.sweep.run_server PARENT` forks for each run: a line of standard input is its
folder, as a text in JSON. Standard output answers with the number of its process, and with its
exit code when it has ended. Until the next line, the number is that of no other process.
"""

import json
import os
import sys
import traceback
from pathlib import Path
from typing import NoReturn

from corvo.sweep import trial
from corvo.sweep.own_process import end_with


def main(parent: int) -> None:
    """Serves runs until standard input or the parent ends."""
    end_with(parent)
    server = os.getpid()
    run = 0
    for line in sys.stdin:
        if run:
            os.waitpid(run, 0)
        run = os.fork()
        if run == 0:
            _execute(Path(json.loads(line)), server)
        print(run, flush=True)
        print(_exit_code(run), flush=True)


def _exit_code(run: int) -> int:
    """Waits for the end of a process and leaves it a zombie.

    Returns:
        Its exit code, or the negative number of the signal that ended it.
    """
    ending = os.waitid(os.P_PID, run, os.WEXITED | os.WNOWAIT)
    assert ending is not None
    return ending.si_status if ending.si_code == os.CLD_EXITED else -ending.si_status


def _execute(folder: Path, server: int) -> NoReturn:
    end_with(server)
    _redirect(folder / "output")
    exit_code = 0
    try:
        trial.main(folder)
    except BaseException:
        traceback.print_exc()
        exit_code = 1
    sys.stdout.flush()
    sys.stderr.flush()
    os._exit(exit_code)  # Nothing is left to tidy up.


def _redirect(output: Path) -> None:
    """Connects standard input with nothing, and standard output and error with an empty file."""
    null = os.open(os.devnull, os.O_RDONLY)
    file = os.open(output, os.O_WRONLY)
    os.dup2(null, 0)
    os.dup2(file, 1)
    os.dup2(file, 2)


if __name__ == "__main__":
    main(int(sys.argv[1]))
