# SPDX-License-Identifier: MIT
"""The command `corvo sweep`."""

import argparse
import sys
from importlib.util import find_spec
from pathlib import Path

from corvo import _corvo
from corvo.command_parser import CommandParser
from corvo.commands import report
from corvo.sweep.journal import Journal
from corvo.sweep.plan import read_plan
from corvo.sweep.sweep import Sweep

_DESCRIPTION = """\
Run the odometry on many sequences, with several options and perturbations, as a plan (YAML) names
them. Finished runs are kept: the same command goes on where it was ended."""

_EPILOG = """\
Exit codes: 0 done, 1 invalid usage or plan, 2 worse than the baseline, 3 runs failed, without a
baseline, 130 interrupted.

Examples:
  corvo sweep plan.yaml -o sweep                             # over the cores of this machine
  corvo sweep plan.yaml -o sweep --address auto              # on a cluster of Ray
  corvo sweep plan.yaml -o sweep --baseline rows.parquet     # a regression is exit code 2"""


_PACKAGES = ("duckdb", "fsspec", "PIL", "plotly", "pyarrow", "ray")


_WORSE = 2
_FAILED = 3


def main(arguments: list[str]) -> int:
    """Executes the command and returns its exit code."""
    _corvo._set_up_logging()
    try:
        _check_packages()
        given = _make_parser().parse_args(arguments)
        return _sweep(given)
    except _corvo.Error as error:
        return report(error)
    except KeyboardInterrupt:
        print("corvo: interrupted; the same command goes on from here", file=sys.stderr)
        return 130


def _check_packages() -> None:
    """Raises Error if a package is missing that is loaded when it is needed."""
    for name in _PACKAGES:
        if find_spec(name) is None:
            raise _corvo.Error(f"{name} is not installed: pip install corvo[sweep]")


def _sweep(given: argparse.Namespace) -> int:
    plan = read_plan(given.plan)
    if given.baseline and not given.baseline.is_file():
        raise _corvo.Error(f"{given.baseline}: does not exist; allowed are the rows of a sweep")
    with Journal(given.output) as journal:
        sweep = Sweep(plan, journal)
        try:
            sweep.run(given.address, given.workers, retry=given.retry_failed)
        except BaseException:
            sweep.summarize()
            raise
        regression = sweep.summarize(given.baseline)
    print(f"{len(sweep.tasks)} runs, {sweep.num_failed} failed: {given.output}")
    if regression is None:
        return _FAILED if sweep.num_failed else 0
    for line in regression.lines():
        print(line)
    return _WORSE if regression.is_worse else 0


def _make_parser() -> argparse.ArgumentParser:
    parser = CommandParser(
        prog="corvo sweep",
        usage="corvo sweep PLAN.yaml -o DIR [OPTIONS]",
        description=_DESCRIPTION,
        epilog=_EPILOG,
    )
    parser.add_argument("plan", metavar="PLAN.yaml", type=Path, help="what is run")
    parser.add_argument(
        "-o", "--output", metavar="DIR", type=Path, required=True, help="the folder of the sweep"
    )
    parser.add_argument(
        "--workers", metavar="N", type=_count, help="runs at once (default: one for each processor)"
    )
    parser.add_argument("--address", help="join the cluster of Ray with this address, or 'auto'")
    parser.add_argument(
        "--retry-failed", action="store_true", help="run again what failed in an earlier execution"
    )
    parser.add_argument(
        "--baseline", metavar="ROWS.parquet", type=Path, help="rows of an earlier sweep to compare"
    )
    return parser


def _count(text: str) -> int:
    if not text.isdecimal() or not 1 <= int(text) <= 1024:
        raise argparse.ArgumentTypeError(f"is {text}; allowed is a whole number from 1 to 1024")
    return int(text)
