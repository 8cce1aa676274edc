# SPDX-License-Identifier: MIT
"""Hashes of the content of inputs. A file is read again only if its size or time changes."""

import hashlib
import json
import os
from collections.abc import Iterable, Iterator
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from corvo._corvo import Error, Inputs
from corvo.files import write_whole
from corvo.sweep.downloads import is_url, state_of
from corvo.sweep.inputs import Input, run_arguments

_CAMERA = ("camera", "focal", "fov")

_Known = dict[str, tuple[int, int, str]]
"""Size, time of the last change in ns, and hash of files by their paths."""


class ContentHashes:
    """Hashes, which are kept in a file.

    Args:
        file: The file with the hashes of earlier sweeps, if it is there.
    """

    def __init__(self, file: Path) -> None:
        self._file = file
        self._known = _load(file)
        self._has_changed = False

    def of(self, inputs: Iterable[Input]) -> dict[str, str]:
        """Returns the hashes of inputs by their names: of images, camera, ground truth and masks.

        Raises:
            Error: An input cannot be read.
        """
        try:
            with ThreadPoolExecutor(os.cpu_count()) as threads:
                return {entry.name: self._of_input(entry, threads) for entry in inputs}
        except OSError as error:
            raise Error(f"{error.filename}: cannot be read ({error.strerror})") from None
        finally:
            if self._has_changed:
                write_whole(self._file, json.dumps(self._known).encode())

    def _of_input(self, entry: Input, threads: ThreadPoolExecutor) -> str:
        parts: list[str] = []
        for role, root in sorted(_roots(entry).items()):
            files = list(_files_below(root))
            paths = [path for path, _ in files]
            hashes = threads.map(self._of_file, *zip(*files)) if files else iter(())
            names = (os.path.relpath(path, root) for path in paths)
            parts += [f"{role} {name} {digest}" for name, digest in zip(names, hashes)]
        if is_url(entry.location):
            parts.append(state_of(entry.location))
        return hashlib.sha256("\n".join(parts).encode()).hexdigest()

    def _of_file(self, path: str, stat: os.stat_result) -> str:
        known = self._known.get(path)
        if known and (known[0], known[1]) == (stat.st_size, stat.st_mtime_ns):
            return known[2]
        with open(path, "rb") as stream:
            digest = hashlib.file_digest(stream, "sha256").hexdigest()
        self._known[path] = (stat.st_size, stat.st_mtime_ns, digest)
        self._has_changed = True
        return digest


def _roots(entry: Input) -> dict[str, Path]:
    """Returns the files and folders that an input consists of."""
    roots = entry.files()
    if is_url(entry.location):
        return roots
    roots["images"] = Path(entry.location)
    if roots["images"].is_dir() and "gt" not in entry.options:
        truth = _truth_of_layout(entry)
        if truth:
            roots["gt"] = Path(truth)
    return roots


def _truth_of_layout(entry: Input) -> str:
    """Returns the file of the ground truth, also outside of the folder, or an empty text."""
    others = {key: value for key, value in entry.options.items() if key not in _CAMERA}
    # Any field of view will do.
    return Inputs(run_arguments(entry.location, {**others, "fov": "60", "count": "1"})).truth_file


def _files_below(root: Path) -> Iterator[tuple[str, os.stat_result]]:
    """Yields the files of a folder in the order of their paths, or the file itself."""
    if not root.is_dir():
        yield str(root), root.stat()
        return
    with os.scandir(root) as listing:
        entries = sorted(listing, key=lambda entry: entry.name)
    for entry in entries:
        if entry.is_dir():
            yield from _files_below(Path(entry.path))
        else:
            yield entry.path, entry.stat()


def _load(file: Path) -> _Known:
    try:
        known = json.loads(file.read_bytes())
    except (FileNotFoundError, json.JSONDecodeError):
        return {}
    return {path: (size, time_ns, digest) for path, (size, time_ns, digest) in known.items()}
