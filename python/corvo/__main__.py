# SPDX-License-Identifier: MIT
"""The command: `corvo` and `python -m corvo`."""

import sys

from corvo import _corvo
from corvo.commands import report


def main() -> int:
    arguments = sys.argv[1:]
    if arguments[:1] == ["view"]:
        return _view(arguments[1:])
    if arguments in ([], ["--help"], ["-h"]):
        print("'corvo view RESULT|INPUT' shows a run in Rerun; see 'corvo view --help'.\n")
    return _corvo._main(arguments)


def _view(arguments: list[str]) -> int:
    try:
        from corvo.view.command import main
    except ModuleNotFoundError as error:
        return report(_corvo.Error(f"{error.name} is not installed: pip install corvo[view]"))
    return main(arguments)


if __name__ == "__main__":
    sys.exit(main())
