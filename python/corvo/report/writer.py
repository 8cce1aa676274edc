# SPDX-License-Identifier: MIT
"""Writes the page about results."""

from collections.abc import Sequence
from os import PathLike
from pathlib import Path

from corvo.report.page import make_page
from corvo.report.page_file import check_output, write_page
from corvo.report.run import open_runs
from corvo.result import Result


def write_report(
    results: Sequence[Result | str | PathLike[str]],
    output: str | PathLike[str],
    truth: str | PathLike[str] = "",
    *,
    force: bool = False,
) -> Path:
    """Writes a page about results, as `corvo report` does, and returns its file.

    Args:
        results: At least one result, or folder of one.
        output: The file of the page (.html). A page that corvo report has written is replaced.
        truth: A file or the folder of a dataset; for each result the ground truth of its run if
            left out.
        force: Whether any other file is replaced, too.

    Raises:
        Error: A result cannot be read or compared with the ground truth, or the file cannot be
            written or is not corvo's.
    """
    file = Path(output)
    check_output(file, force=force)
    opened = [result if isinstance(result, Result) else Result(result) for result in results]
    write_page(file, make_page(open_runs(opened, truth)))
    return file
