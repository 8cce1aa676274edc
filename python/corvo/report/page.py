# SPDX-License-Identifier: MIT
"""The page about runs."""

from collections.abc import Sequence

from corvo.report.document import make_document
from corvo.report.run import Run
from corvo.report.sections import make_sections


def make_page(runs: Sequence[Run]) -> str:
    """Returns the HTML of a page about runs. It loads nothing from anywhere."""
    names = ", ".join(run.name for run in runs)
    return make_document("corvo report", names, make_sections(runs))
