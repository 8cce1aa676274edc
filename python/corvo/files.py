# SPDX-License-Identifier: MIT
"""Files that appear as a whole."""

import os
from pathlib import Path
from tempfile import TemporaryDirectory


def write_whole(file: Path, content: bytes) -> None:
    """Replaces a file. Whatever happens, it has either its former content or the new one."""
    with TemporaryDirectory(prefix=".corvo_", dir=file.parent) as folder:
        written = Path(folder) / file.name
        with open(written, "xb") as stream:
            stream.write(content)
            stream.flush()
            os.fsync(stream.fileno())
        written.replace(file)
