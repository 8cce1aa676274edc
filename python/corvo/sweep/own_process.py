# SPDX-License-Identifier: MIT
"""The process of a run beside its parent."""

import ctypes
import os
import resource
import signal

_PR_SET_PDEATHSIG = 1


def end_with(parent: int) -> None:
    """Ends this process when its parent ends, whatever ends that, and without a core file.

    So the run of a worker that was killed does not go on beside that which replaces it.
    """
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    ctypes.CDLL(None).prctl(_PR_SET_PDEATHSIG, signal.SIGKILL)
    if os.getppid() != parent:
        os.kill(os.getpid(), signal.SIGKILL)


def peak_memory_mb() -> float:
    """Returns the most memory that this process had, in units of 2^20 bytes."""
    with open("/proc/self/status", encoding="ascii") as status:
        kilobytes = next(line.split()[1] for line in status if line.startswith("VmHWM"))
    return int(kilobytes) / 1024
