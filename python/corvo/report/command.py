# SPDX-License-Identifier: MIT
"""The command `corvo report`."""

import argparse

from corvo import _corvo
from corvo.command_parser import CommandParser
from corvo.commands import report
from corvo.report.writer import write_report

_DESCRIPTION = """\
Write a page (HTML) about one or several results of 'corvo run': trajectories, errors and their
expected size, an account of the frames, the camera, timing and options. The page is one file, which
a browser shows without a network."""

_EPILOG = """\
The page has the result files' contents alone: the same results give the same bytes.

Examples:
  corvo report result/03 -o report.html
  corvo report result/03 result/03_refined -o report.html       # side by side
  corvo report result/mh_01 --gt MH_01_easy -o report.html      # with another ground truth"""


def main(arguments: list[str]) -> int:
    """Executes the command and returns its exit code."""
    _corvo._set_up_logging()
    try:
        given = _make_parser().parse_args(arguments)
        write_report(given.results, given.output, given.truth, force=given.force)
    except _corvo.Error as error:
        return report(error)
    return 0


def _make_parser() -> argparse.ArgumentParser:
    parser = CommandParser(
        prog="corvo report",
        usage="corvo report RESULT... [--gt FILE] -o report.html [--force]",
        description=_DESCRIPTION,
        epilog=_EPILOG,
    )
    parser.add_argument("results", metavar="RESULT", nargs="+", help="the folder of a result")
    parser.add_argument(
        "--gt",
        dest="truth",
        default="",
        metavar="FILE",
        help="the ground truth, or the folder of a dataset that has it, as for 'corvo eval' "
        "(default: for each result that of its run, if it had one)",
    )
    parser.add_argument("-o", "--output", required=True, metavar="FILE", help="the page")
    parser.add_argument(
        "--force", action="store_true", help="replace a file that corvo report has not written"
    )
    return parser
