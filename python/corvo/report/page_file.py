# SPDX-License-Identifier: MIT
"""The file of a page: it appears as a whole, and replaces only pages of corvo report."""

import re
import zlib
from pathlib import Path

from corvo._corvo import Error
from corvo.files import write_whole

_SEAL = re.compile(rb"<!-- corvo report, CRC-32 ([0-9a-f]{8}) -->\n\Z")


def check_output(file: Path, *, force: bool) -> None:
    """Raises Error if a file is there that write_page() has not written, or that has changed."""
    if file.is_dir():
        raise Error(f"{file}: is a folder; name the file of the page")
    if file.exists() and not force and not _is_page(file):
        raise Error(
            f"{file}: not written by an earlier corvo, or changed since; nothing was replaced: "
            "choose another output, or use --force"
        )


def write_page(file: Path, html: str) -> None:
    """Writes a page with a seal by which check_output() knows it. Raises Error if it cannot."""
    content = html.encode()
    seal = f"<!-- corvo report, CRC-32 {zlib.crc32(content):08x} -->\n".encode()
    try:
        file.parent.mkdir(parents=True, exist_ok=True)
        write_whole(file, content + seal)
    except OSError as error:
        raise Error(f"{file}: cannot be written ({error.strerror})") from None


def _is_page(file: Path) -> bool:
    try:
        content = file.read_bytes()
    except OSError as error:
        raise Error(f"{file}: cannot be read ({error.strerror})") from None
    seal = _SEAL.search(content)
    return seal is not None and zlib.crc32(content[: seal.start()]) == int(seal[1], 16)
