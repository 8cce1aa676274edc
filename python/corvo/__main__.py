# SPDX-License-Identifier: MIT
"""The command: `corvo` and `python -m corvo`."""

import sys
from importlib import import_module

from corvo import _corvo
from corvo.commands import report

_EXTRAS = {
    "report": "'corvo report RESULT... -o FILE' writes a page on runs; see 'corvo report --help'.",
    "sweep": "'corvo sweep PLAN -o DIR' runs many sequences; see 'corvo sweep --help'.",
    "view": "'corvo view RESULT|INPUT' shows a run in Rerun; see 'corvo view --help'.",
}
"""The commands of the package alone. Each needs the extra of its name."""


def main() -> int:
    arguments = sys.argv[1:]
    if arguments and arguments[0] in _EXTRAS:
        return _run_extra(arguments[0], arguments[1:])
    if arguments in ([], ["--help"], ["-h"]):
        print("\n".join(_EXTRAS.values()) + "\n")
    return _corvo._main(arguments)


def _run_extra(name: str, arguments: list[str]) -> int:
    try:
        command = import_module(f"corvo.{name}.command")
    except ModuleNotFoundError as error:
        package = str(error.name).partition(".")[0]
        return report(_corvo.Error(f"{package} is not installed: pip install corvo[{name}]"))
    exit_code: int = command.main(arguments)
    return exit_code


if __name__ == "__main__":
    sys.exit(main())
