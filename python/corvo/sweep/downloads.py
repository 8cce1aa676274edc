# SPDX-License-Identifier: MIT
"""Inputs behind URLs: what they hold now, and local copies of them, through fsspec."""

import glob
import hashlib
import json
import os
import tempfile
from pathlib import Path
from typing import Any

from corvo._corvo import Error

_MARKS = ("ETag", "etag", "md5", "md5Hash", "CRC", "crc32", "LastModified", "mtime", "created")
"""What stores state about a file, the most reliable first."""


def is_url(text: str) -> bool:
    return "://" in text or "::" in text


def find_urls(place: str, url: str) -> list[str]:
    """Returns the URLs that match, in order. Raises Error if there are none."""
    if not glob.has_magic(url):
        return [url]
    files, path = _open(url)
    found = sorted(files.unstrip_protocol(match) for match in files.glob(path))
    if not found:
        raise Error(f'{place} is "{url}"; allowed is a URL at which something exists')
    return found


def state_of(url: str) -> str:
    """Returns a text that changes if the files at a URL do, by what their store says of them."""
    files, path = _open(url)
    try:
        found = files.find(path, detail=True) if files.isdir(path) else {path: files.info(path)}
    except OSError as error:
        raise Error(f"{url}: cannot be read ({error})") from None
    return json.dumps([[name, _mark(info)] for name, info in sorted(found.items())])


def fetch(url: str) -> Path:
    """Returns a local copy, which later calls on this machine find again."""
    files, path = _open(url)
    digest = hashlib.sha256((url + state_of(url)).encode()).hexdigest()[:32]
    folder = Path(tempfile.gettempdir()) / f"corvo_downloads_{os.getuid()}"
    copy = folder / digest / path.rstrip("/").rpartition("/")[2]
    if not copy.exists():
        folder.mkdir(mode=0o700, exist_ok=True)
        with tempfile.TemporaryDirectory(dir=folder) as unfinished:
            part = Path(unfinished) / "part"
            part.mkdir()
            files.get(path, str(part / copy.name), recursive=files.isdir(path))
            try:
                part.rename(copy.parent)
            except OSError:  # Another process was faster.
                if not copy.exists():
                    raise
    return copy


def _open(url: str) -> tuple[Any, str]:
    from fsspec.core import url_to_fs  # Only URLs take the time to load it.

    try:
        files, path = url_to_fs(url)
    except (ImportError, OSError, ValueError) as error:
        raise Error(f"{url}: cannot be opened ({error})") from None
    return files, path


def _mark(info: dict[str, Any]) -> list[str]:
    mark = next((str(info[name]) for name in _MARKS if info.get(name)), "")
    return [str(info.get("size")), mark]
