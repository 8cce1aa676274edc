# SPDX-License-Identifier: MIT
"""The outcomes of finished runs, each written once, as a whole."""

import fcntl
import json
import os
import zlib
from collections.abc import Iterator
from dataclasses import asdict
from pathlib import Path

from corvo._corvo import Error
from corvo.sweep.child import Outcome

_NAME = "journal.jsonl"


class Journal:
    """A file with a line for each finished run, to which one process at a time appends.

    Every line begins with the checksum of the rest. A line that is not whole, because the process
    or the machine ended while it was written, is as if it was never there.

    Args:
        folder: The folder of the sweep, which is created.

    Raises:
        Error: The folder has other files, but no journal; or another process uses it.
    """

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        file = folder / _NAME
        if folder.is_dir() and not file.exists() and any(folder.iterdir()):
            raise Error(f"{folder}: has other files; allowed is an empty folder or that of a sweep")
        folder.mkdir(parents=True, exist_ok=True)
        self._stream = open(file, "a+b")
        try:
            fcntl.flock(self._stream, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            self._stream.close()
            raise Error(f"{folder}: another process runs this sweep") from None
        self.outcomes = self._read()
        """The outcome of every finished run by its key."""

    def __enter__(self) -> "Journal":
        return self

    def __exit__(self, *_: object) -> None:
        self._stream.close()

    @property
    def size(self) -> int:
        """Bytes, which only grow."""
        return os.fstat(self._stream.fileno()).st_size

    def add(self, key: str, outcome: Outcome) -> None:
        """Adds the outcome of a run. Once this returns, it outlasts a crash of the machine."""
        content = json.dumps([key, asdict(outcome)], separators=(",", ":")).encode()
        self._stream.write(b"%08x %s\n" % (zlib.crc32(content), content))
        self._stream.flush()
        os.fsync(self._stream.fileno())
        self.outcomes[key] = outcome

    def _read(self) -> dict[str, Outcome]:
        self._stream.seek(0)
        outcomes = {}
        end = 0
        for line in self._stream:
            if line.endswith(b"\n"):
                end += len(line)
            for key, outcome in _parse(line):
                outcomes[key] = outcome
        if end < self.size:
            self._stream.truncate(end)
        return outcomes


def _parse(line: bytes) -> Iterator[tuple[str, Outcome]]:
    """Yields the run of a line if the line is whole."""
    checksum, _, content = line.rstrip(b"\n").partition(b" ")
    if line.endswith(b"\n") and checksum == b"%08x" % zlib.crc32(content):
        key, outcome = json.loads(content)
        yield key, Outcome(**outcome)
