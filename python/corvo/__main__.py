# SPDX-License-Identifier: MIT
"""The command: `corvo` and `python -m corvo`."""

import sys

from corvo import _corvo


def main() -> int:
    return _corvo._main(sys.argv[1:])


if __name__ == "__main__":
    sys.exit(main())
