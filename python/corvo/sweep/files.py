# SPDX-License-Identifier: MIT
"""The files of a sweep, which appear as a whole."""

import os
from pathlib import Path


ROWS = "rows.parquet"
"""What was measured: the same for every execution of a plan."""
RUNS = "runs.parquet"
"""Times, attempts, machines and the last lines of output: different every time."""
PAGE = "report.html"


def write_whole(file: Path, content: bytes) -> None:
    """Replaces a file. Whatever happens, it has either its former content or the new one."""
    part = file.with_name(f".{file.name}.{os.getpid()}")
    with open(part, "wb") as stream:
        stream.write(content)
        stream.flush()
        os.fsync(stream.fileno())
    part.replace(file)
