# SPDX-License-Identifier: MIT
"""The arguments of commands that are written in Python."""

import argparse
from typing import NoReturn

from corvo._corvo import Error


class CommandParser(argparse.ArgumentParser):
    """The arguments of a command, whose help shows its texts as they are. Wrong usage raises Error."""

    def __init__(self, *, prog: str, usage: str, description: str, epilog: str) -> None:
        super().__init__(
            prog=prog,
            usage=usage,
            description=description,
            epilog=epilog,
            formatter_class=argparse.RawDescriptionHelpFormatter,
            allow_abbrev=False,
        )

    def error(self, message: str) -> NoReturn:
        raise Error(message)
