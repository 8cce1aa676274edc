# SPDX-License-Identifier: MIT
"""Files that appear as a whole."""

import os
from pathlib import Path


def write_whole(file: Path, content: bytes) -> None:
    """Replaces a file. Whatever happens, it has either its former content or the new one."""
    part = file.with_name(f".{file.name}.{os.getpid()}")
    with open(part, "wb") as stream:
        stream.write(content)
        stream.flush()
        os.fsync(stream.fileno())
    part.replace(file)
