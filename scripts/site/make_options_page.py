# SPDX-License-Identifier: MIT
"""Prints docs/options.md: every option of the command, and every key of an options file.

    make_options_page.py CORVO...       the command that is asked, such as build/release/apps/corvo
"""

import re
import subprocess
import sys
from collections.abc import Iterator
from typing import NamedTuple

INTRODUCTION = """\
# Options

`scripts/site/make_options_page.py` writes this page from what the command itself says: `corvo COMMAND --help` and `corvo config`. Ranges are in brackets.
The commands of the [Python package](python.md) alone, `corvo view`, `corvo report` and `corvo sweep`, have pages of their own.
"""
CONFIG = """\
## The options file

`--config FILE` changes these keys; `corvo config` prints them with their defaults, and `corvo config FILE` checks a file. [Options of the C++
structs](../vo/core/options.h) that have no key here are described there.
"""
# A name, with what excludes it, and its meaning, which may begin on the next line instead.
ENTRY = re.compile(r"  (\S.*?Excludes:(?: --[\w-]+)+|\S.*?(?=  |$))\s*(.*)")


class Row(NamedTuple):
    name: str
    meaning: str


def main() -> None:
    command = sys.argv[1:] or ["corvo"]
    names = [row.name for row in section(ask(command, "--help"), "Subcommands")]
    print(INTRODUCTION)
    print_command("corvo", "Options before the name of a command.", ask(command, "--help"))
    for name in names:
        parts = [name, "room"] if name == "synth" else [name]
        text = ask(command, *parts, "--help")
        usage = re.search(r"^Usage: (.*)$", ask(command, name, "--help"), re.MULTILINE)
        assert usage
        print_command(f"corvo {name}", f"`{usage[1]}`", text)
    print(CONFIG)
    print_config(ask(command, "config"))


def ask(command: list[str], *arguments: str) -> str:
    process = subprocess.run([*command, *arguments], check=True, capture_output=True, text=True)
    return process.stdout


def print_command(title: str, usage: str, help_text: str) -> None:
    rows = [*section(help_text, "Positionals"), *section(help_text, "Options")]
    print(f"## {title}\n\n{usage}\n\n| option | meaning |\n|---|---|")
    for row in rows:
        if not row.name.startswith("-h"):
            print(f"| `{readable(row.name)}` | {row.meaning} |")
    print()


def section(help_text: str, title: str) -> Iterator[Row]:
    """Yields the entries of a section of a help text; their meaning may begin on the next line."""
    text = re.search(rf"^{title}:\n(.*?)(?:\n\n|\Z)", help_text, re.MULTILINE | re.DOTALL)
    entry: Row | None = None
    for line in text[1].splitlines() if text else []:
        start = ENTRY.match(line)
        if start and not line.startswith("   "):
            if entry:
                yield entry
            entry = Row(start[1], start[2])
        elif entry:
            entry = Row(entry.name, f"{entry.meaning} {line.strip()}".strip())
    if entry:
        yield entry


def readable(name: str) -> str:
    """Writes the type, range and default of an option as a reader expects them."""
    name = re.sub(r"\bTEXT:\{(.*?)\}", lambda match: match[1].replace(",", "/"), name)
    name = re.sub(r"\b(?:FLOAT|INT):(FLOAT|INT) in ", r"\1 in ", name)
    name = re.sub(r"(?:\bFLOAT|\bINT|:FLOAT) in \[(.*?) - (.*?)\]", r" [\1 to \2]", name).replace("  ", " ")
    name = name.replace("|", "/")
    # The command names what an option excludes in any order.
    name = re.sub(
        r" Excludes: (.*)", lambda match: ", not with " + ", ".join(sorted(match[1].split())), name
    )
    return re.sub(r"(?<=[\]\w])=(\S+)", r", default \1", name).replace(" REQUIRED", ", required")


def print_config(text: str) -> None:
    meaning = ""
    for line in text.splitlines():
        if line.startswith("  #"):
            meaning += line[3:]
        elif line.startswith("  "):
            key, value = line.strip().split(": ")
            print(f"| `{key}` | `{value}` | {meaning.strip()} |")
            meaning = ""
        elif line.endswith(":"):
            print(f"### {line[:-1]}\n\n| key | default | meaning |\n|---|---|---|")
        elif not line:
            print()


if __name__ == "__main__":
    main()
