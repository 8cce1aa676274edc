# SPDX-License-Identifier: MIT
"""The commands and programs in the Markdown files of the repository."""

import re
from pathlib import Path
from typing import NamedTuple

ROOT = Path(__file__).parents[2]
PAGES = [
    "README.md",
    "CONTRIBUTING.md",
    "datasets/README.md",
    *sorted(str(path.relative_to(ROOT)) for path in (ROOT / "docs").rglob("*.md")),
]
SHELL = ("sh", "bash", "console")

_FENCE = re.compile(r"^```(\w*)\n(.*?)^```$", re.MULTILINE | re.DOTALL)


class Block(NamedTuple):
    language: str
    line: int
    text: str


class Command(NamedTuple):
    line: int
    text: str


def blocks(page: str) -> list[Block]:
    text = (ROOT / page).read_text()
    return [
        Block(match[1], text.count("\n", 0, match.start()) + 2, match[2])
        for match in _FENCE.finditer(text)
    ]


def commands(page: str) -> list[Command]:
    """Returns the commands of a page without their comments; a backslash joins lines."""
    found = []
    for block in blocks(page):
        if block.language in SHELL:
            start, joined = block.line, ""
            for number, line in enumerate(block.text.splitlines(), block.line + 1):
                joined += line.removesuffix("\\")
                if not line.endswith("\\"):
                    command = re.sub(r"(^|\s+)#.*$", "", joined.removeprefix("$ ")).strip()
                    found += [Command(start, command)] if command else []
                    start, joined = number, ""
    return found


def programs(page: str) -> list[Block]:
    return [block for block in blocks(page) if block.language == "python"]
